// SPDX-License-Identifier: LGPL-2.1-or-later
// The main function of every test program: MPI is initialized once, except with
// NPT_TESTS_WITHOUT_MPI, and deal.II's assertions throw instead of aborting, so
// that tests can see them.

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
#ifndef NPT_TESTS_WITHOUT_MPI
  // What Open MPI else leaves in the environment makes programs that a test
  // starts take themselves for a part of this one.
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  setenv("OMPI_MCA_orte_create_session_dirs", "0", 0);
  int    mpi_argc = 1;
  char **mpi_argv = argv;

  dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);
#endif
  dealii::deal_II_exceptions::disable_abort_on_exception();
  return Catch::Session().run(argc, argv);
}
