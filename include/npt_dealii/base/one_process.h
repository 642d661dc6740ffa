// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the refusal of several MPI processes where a run has one process.

#ifndef npt_dealii_base_one_process_h
#define npt_dealii_base_one_process_h

#include <string>

namespace NPT
{
  /**
   * Do nothing in a program with one process. Several would all compute the
   * same and write into one folder: the first one then says so, and all end
   * with exit status 2.
   *
   * To be called while MPI is initialized, before anything is written. No
   * exception: while one is on its way deal.II leaves MPI unfinished, and
   * mpirun would report a crash instead of our sentence.
   *
   * @param problem Named in the sentence.
   */
  void
  refuse_several_processes(const std::string &problem);
} // namespace NPT

#endif
