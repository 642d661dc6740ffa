// SPDX-License-Identifier: LGPL-2.1-or-later
// The program: read the parameter file, build the problem, run it, report.
// Exit status: 0 done, 1 the run ended early, 2 the input cannot be used.

#include <npt_dealii/base/blas_kernels.h>
#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/top/numerical_plate_test.h>
#include <npt_dealii/top/parameters.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace
{
  int
  run(int argc, char **argv)
  {
    using namespace NPT;
    const CommandLine command = parse_command_line(argc, argv);
    switch (command.action)
      {
        case CommandLine::Action::help:
          std::cout << help_text();
          return 0;
        case CommandLine::Action::version:
          std::cout << version_text();
          return 0;
        default:
          break;
      }
    if (command.action == CommandLine::Action::print_defaults &&
        command.parameter_file.empty())
      {
        std::cout << Parameters::documented_defaults();
        return 0;
      }

    Parameters parameters =
      Parameters::read(read_parameter_text(command.parameter_file),
                       command.overrides);
    if (command.action == CommandLine::Action::print_defaults)
      {
        std::cout << parameters.used_file;
        return 0;
      }
    if (command.action == CommandLine::Action::validate)
      {
        std::cout << command.parameter_file << " is valid." << std::endl;
        return 0;
      }

    const std::string directory = command.output_directory.empty() ?
                                    parameters.output.directory :
                                    command.output_directory;
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    if (!std::filesystem::is_directory(directory))
      throw InputError("The output directory '" + directory +
                       "' cannot be created: " + error.message() + ".");

    NumericalPlateTest test(parameters, directory, std::cout);
    test.run();
    return 0;
  }
} // namespace

int
main(int argc, char **argv)
{
  NPT::select_blas_kernels(argv);

  // One process per run: Trilinos' solvers only need MPI to be there. Threads
  // are not used; the linear algebra of these sizes gains nothing by them.
  int    mpi_argc = 1;
  char **mpi_argv = argv;
  try
    {
      dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);
      return run(argc, argv);
    }
  catch (const NPT::InputError &error)
    {
      std::cerr << "npt_dealii: " << error.what() << std::endl;
      return 2;
    }
  catch (const NPT::StageFailed &error)
    {
      std::cerr << "npt_dealii: " << error.what() << std::endl;
      return 1;
    }
  catch (const std::exception &error)
    {
      std::cerr << "npt_dealii: unexpected error, please report it:\n"
                << error.what() << std::endl;
      return 3;
    }
}
