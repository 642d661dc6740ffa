// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about what a process knows of mpirun before MPI is started.

#include <npt_dealii/base/mpi_session.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

using namespace NPT;

namespace
{
  // What a process learns that a launcher starts with these variables.
  Launcher
  launcher_with(const std::map<std::string, std::string> &variables)
  {
    static const std::vector<std::string> names = {"OMPI_COMM_WORLD_SIZE",
                                                   "OMPI_COMM_WORLD_RANK",
                                                   "PMI_SIZE",
                                                   "PMI_RANK",
                                                   "PMI_ID",
                                                   "PMI_FD",
                                                   "PMIX_RANK",
                                                   "MV2_COMM_WORLD_SIZE",
                                                   "MV2_COMM_WORLD_RANK"};
    std::map<std::string, std::string>    before;
    for (const std::string &name : names)
      {
        if (const char *const value = std::getenv(name.c_str()))
          before[name] = value;
        unsetenv(name.c_str());
      }
    for (const auto &[name, value] : variables)
      setenv(name.c_str(), value.c_str(), 1);
    const Launcher result = Launcher::of_this_process();
    for (const auto &variable : variables)
      unsetenv(variable.first.c_str());
    for (const auto &[name, value] : before)
      setenv(name.c_str(), value.c_str(), 1);
    return result;
  }
} // namespace

TEST_CASE("A process knows from its environment whether mpirun started it",
          "[base]")
{
  const Launcher none = launcher_with({});
  CHECK_FALSE(none.is_present);
  CHECK(none.n_processes == 1);
  CHECK(none.rank == 0);

  const Launcher open_mpi = launcher_with({{"OMPI_COMM_WORLD_SIZE", "12"},
                                           {"OMPI_COMM_WORLD_RANK", "10"},
                                           {"PMIX_RANK", "10"}});
  CHECK(open_mpi.is_present);
  CHECK(open_mpi.n_processes == 12);
  CHECK(open_mpi.rank == 10);

  const Launcher mpich =
    launcher_with({{"PMI_SIZE", "3"}, {"PMI_RANK", "2"}, {"PMI_FD", "7"}});
  CHECK(mpich.is_present);
  CHECK(mpich.n_processes == 3);
  CHECK(mpich.rank == 2);

  // The number of processes is not told.
  const Launcher srun = launcher_with({{"PMIX_RANK", "5"}});
  CHECK(srun.is_present);
  CHECK(srun.n_processes == 1);
  CHECK(srun.rank == 5);
}
