// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the refusal of several MPI processes where a run has one process.

#include <npt_dealii/base/one_process.h>

#include <deal.II/base/mpi.h>

#include <cstdlib>
#include <iostream>

namespace NPT
{
  void
  refuse_several_processes(const std::string &problem)
  {
    using namespace dealii::Utilities::MPI;
    const unsigned int n = n_mpi_processes(MPI_COMM_WORLD);
    if (n == 1)
      return;
    if (this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cerr << "npt_dealii: one " << problem
                << " runs in one process, but mpirun started " << n
                << "; start it without mpirun, or make it a case of a "
                   "parameter study, which runs its cases side by side"
                << std::endl;
    MPI_Finalize();
    std::exit(2);
  }
} // namespace NPT
