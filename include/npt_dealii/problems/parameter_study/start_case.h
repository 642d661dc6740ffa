// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines starting the process of one case of a study.

#ifndef npt_dealii_problems_parameter_study_start_case_h
#define npt_dealii_problems_parameter_study_start_case_h

#include <npt_dealii/problems/parameter_study/sweep.h>

#include <sys/types.h>

#include <string>

namespace NPT
{
  /// Exit status of a process whose program could not be started, as in a
  /// shell.
  constexpr int exec_failed = 127;

  /**
   * Start a process that computes the case of a folder: `case.prm` in,
   * `screen.txt`, `error.txt` and the files of the run out.
   *
   * The process is a copy of this one, by fork(). If it can, it goes on with
   * SweepOptions::run and has the program, which takes longer to load than a
   * small case to compute, at hand. Otherwise it executes
   * SweepOptions::program; it must where MPI is initialized, since a copy
   * cannot use MPI.
   *
   * Either way it has one thread, the limit of CPU time, and no memory of
   * signals that this process listens to; it is ended when this process ends. A
   * copy leaves by _exit(), so that what this process has in store for its own
   * end (unwritten lines, temporary files) is not done twice.
   *
   * @param folder Existing folder of the case.
   * @return Id of the process, negative if there is none (errno says why).
   */
  pid_t
  start_case(const SweepOptions &options, const std::string &folder);
} // namespace NPT

#endif
