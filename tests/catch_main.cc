// SPDX-License-Identifier: LGPL-2.1-or-later
// The main function of every test program: MPI is initialized once, and
// deal.II's assertions throw instead of aborting, so that tests can see them.

#define CATCH_CONFIG_RUNNER
#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <catch2/catch.hpp>

int
main(int argc, char *argv[])
{
  // Containers run as root; Open MPI refuses that unless told so.
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 0);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 0);
  int    mpi_argc = 1;
  char **mpi_argv = argv;

  dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);
  dealii::deal_II_exceptions::disable_abort_on_exception();
  return Catch::Session().run(argc, argv);
}
