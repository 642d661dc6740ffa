// SPDX-License-Identifier: LGPL-2.1-or-later
// The program: read the parameter file, build the problem, run it, report.
// Exit status: 0 done, 1 the run ended early, 2 the input cannot be used.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/one_process.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/linear_algebra/blas_kernels.h>
#include <npt_dealii/problems/identification/identification_run.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>
#include <npt_dealii/problems/material_test/numerical_material_testing.h>
#include <npt_dealii/problems/parameter_study/parameter_study.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>
#include <npt_dealii/problems/plate_test/run_summary.h>
#include <npt_dealii/verification/contact/contact_benchmark.h>
#include <npt_dealii/verification/solids/solid_benchmark.h>

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



  // A plate test, and summary.csv that says how it ended.
  void
  run_plate_test(const PlateTestParameters &parameters,
                 const std::string         &directory)
  {
    NumericalPlateTesting test(parameters, directory, std::cout);
    const auto            summarize = [&]() {
      RunSummary summary = summarize_curve(test.curve());
      summary.status     = "done";
      summary.n_unknowns = test.n_unknowns();
      return summary;
    };
    try
      {
        test.run();
      }
    catch (const StageFailed &failure)
      {
        RunSummary summary = summarize();
        summary.status     = "failed";
        summary.reason     = failure.reason();
        summary.message    = failure.what();
        // The curve has the cuts of accepted steps only.
        unsigned int cuts_of_stage = 0;
        for (const CurveRow &row : test.curve())
          cuts_of_stage += row.stage == failure.stage() ? row.cuts : 0;
        summary.cuts += failure.n_cuts() - cuts_of_stage;
        write_run_summary(directory + "/summary.csv", summary);
        throw;
      }
    write_run_summary(directory + "/summary.csv", summarize());
  }



  void
  run(const CommandLine &command)
  {
    // Which problem it is decides which entries there are.
    const ParameterText text = command.parameter_file.empty() ?
                                 ParameterText() :
                                 read_parameter_text(command.parameter_file);
    const std::string   problem =
      get_entry(text, command.overrides, "Problem").value_or("plate test");

    // Several processes are for the cases of a study only.
    if (problem != "parameter study")
      refuse_several_processes(problem);
    if (command.action == CommandLine::Action::geometry &&
        problem != "plate test")
      throw InputError("--geometry-only shows the cell of a plate test, but "
                       "Problem is " +
                       problem + ".");
    if (problem == "material test")
      {
        const auto parameters =
          MaterialTestParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return;
        NumericalMaterialTesting test(
          parameters,
          make_output_directory(command, parameters.output.directory),
          std::cout);
        test.run();
      }
    else if (problem == "contact benchmark")
      {
        const auto parameters =
          ContactBenchmarkParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return;
        ContactBenchmark benchmark(
          parameters,
          make_output_directory(command, parameters.output.directory),
          std::cout);
        benchmark.run();
      }
    else if (problem == "identification")
      {
        const auto parameters =
          IdentificationRunParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return;
        run_identification(parameters,
                           make_output_directory(command,
                                                 parameters.output.directory),
                           std::cout);
      }
    else if (problem == "plate test")
      {
        const auto parameters =
          PlateTestParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return;
        const std::string directory =
          make_output_directory(command, parameters.output.directory);
        if (command.action == CommandLine::Action::geometry)
          NumericalPlateTesting(parameters, directory, std::cout).preview();
        else
          run_plate_test(parameters, directory);
      }
    else if (problem == "parameter study")
      {
        const auto parameters = StudyParameters::read(text, command.overrides);
        if (command.action == CommandLine::Action::validate)
          std::cout << parameters.cases.size() << " cases: ";
        if (done_with_parameters(command, parameters))
          return;
        run_parameter_study(parameters,
                            make_output_directory(command,
                                                  parameters.directory),
                            std::cout);
      }
    else if (problem == "solid benchmark")
      {
        const auto parameters =
          SolidBenchmarkParameters::read(text, command.overrides);
        if (done_with_parameters(command, parameters))
          return;
        SolidBenchmark benchmark(parameters,
                                 make_output_directory(command,
                                                       parameters.directory),
                                 std::cout);
        benchmark.run();
      }
    else
      {
        std::string names;
        for (const std::string &name : problem_names())
          names += (names.empty()                  ? "" :
                    name == problem_names().back() ? " or " :
                                                     ", ") +
                   name;
        throw InputError("Problem is '" + problem + "'; it must be " + names +
                         did_you_mean(problem, problem_names()));
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  try
    {
      const NPT::CommandLine command = NPT::parse_command_line(argc, argv);
      switch (command.action)
        {
          case NPT::CommandLine::Action::help:
            std::cout << NPT::help_text();
            return 0;
          case NPT::CommandLine::Action::version:
            std::cout << NPT::version_text();
            return 0;
          case NPT::CommandLine::Action::run:
            NPT::select_blas_kernels(argv);
            break;
          default: // solves nothing
            break;
        }

      // One process per run: Trilinos' solvers only need MPI to be there.
      // Threads are not used; the linear algebra of these sizes gains nothing
      // by them.
      int                                      mpi_argc = 1;
      char                                   **mpi_argv = argv;
      dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);
      run(command);
      return 0;
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
