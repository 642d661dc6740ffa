// SPDX-License-Identifier: LGPL-2.1-or-later
// The program: read the parameter file, build the problem, run it, report.
// Exit status: 0 done, 1 the run ended early, 2 the input cannot be used.

#include <npt_dealii/base/blas_kernels.h>
#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/top/material_test_parameters.h>
#include <npt_dealii/top/numerical_material_test.h>
#include <npt_dealii/top/numerical_plate_test.h>
#include <npt_dealii/top/parameters.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <iostream>

namespace
{
  using namespace NPT;

  // Print or check the parameters if that is all that was asked for.
  template <typename AnyParameters>
  bool
  done_with_parameters(const CommandLine   &command,
                       const AnyParameters &parameters)
  {
    if (command.action == CommandLine::Action::print_defaults)
      std::cout << parameters.used_file;
    else if (command.action == CommandLine::Action::validate)
      std::cout << command.parameter_file << " is valid." << std::endl;
    else
      return false;
    return true;
  }



  std::string
  make_output_directory(const CommandLine &command,
                        const std::string &of_parameters)
  {
    const std::string directory = command.output_directory.empty() ?
                                    of_parameters :
                                    command.output_directory;
    std::error_code   error;
    std::filesystem::create_directories(directory, error);
    if (!std::filesystem::is_directory(directory))
      throw InputError("The output directory '" + directory +
                       "' cannot be created: " + error.message() + ".");
    return directory;
  }



  int
  run(int argc, char **argv)
  {
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

    // Which problem it is decides which entries there are.
    const ParameterText text = command.parameter_file.empty() ?
                                 ParameterText() :
                                 read_parameter_text(command.parameter_file);
    const std::string   problem =
      get_entry(text, command.overrides, "Problem").value_or("plate test");

    if (problem == "material test")
      {
        const auto parameters =
          MaterialTestParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return 0;
        NumericalMaterialTest test(
          parameters,
          make_output_directory(command, parameters.output.directory),
          std::cout);
        test.run();
      }
    else if (problem == "identification")
      {
        const auto parameters =
          IdentificationRunParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return 0;
        run_identification(parameters,
                           make_output_directory(command,
                                                 parameters.output.directory),
                           std::cout);
      }
    else if (problem == "plate test")
      {
        const auto parameters = Parameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return 0;
        NumericalPlateTest test(
          parameters,
          make_output_directory(command, parameters.output.directory),
          std::cout);
        test.run();
      }
    else
      throw InputError(
        "Problem is '" + problem +
        "'; it must be plate test, material test or identification" +
        did_you_mean(problem,
                     {"plate test", "material test", "identification"}));
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
