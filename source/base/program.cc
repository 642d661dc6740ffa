// SPDX-License-Identifier: LGPL-2.1-or-later
// From the command line to the exit status.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/one_process.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/base/program.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>

namespace NPT
{
  using dealii::Utilities::MPI::MPI_InitFinalize;

  namespace
  {
    [[noreturn]] void
    refuse_problem(const Program &program, const std::string &problem)
    {
      // verify names what it can compute; npt_dealii names all problems, since
      // it starts verify where needed.
      const bool                     knows_all = !program.other_program.empty();
      const std::vector<std::string> valid =
        knows_all ? problem_names() : Registry<Problem>::instance().names();
      std::string names;
      for (const std::string &name : valid)
        names += (names.empty()        ? "" :
                  name == valid.back() ? " or " :
                                         ", ") +
                 name;
      if (problem.empty())
        throw InputError("Problem is not set; it must be " + names + ".");
      throw InputError("Problem is '" + problem + "'; it must be " + names +
                       (knows_all ? "" : " for the program " + program.name) +
                       did_you_mean(problem, valid));
    }

    /// Start the program that stands beside this one, with the same arguments.
    [[noreturn]] void
    start_beside(const Program     &program,
                 const std::string &problem,
                 char             **argv)
    {
      std::error_code             error;
      const std::filesystem::path own =
        std::filesystem::read_symlink("/proc/self/exe", error);
      std::string other = (own.parent_path() / program.other_program).string();
      char *const own_name = argv[0];
      argv[0]              = other.data();
      execv(other.c_str(), argv);
      argv[0] = own_name; // only if that failed
      throw InputError("Problem is " + problem + ", which the program " +
                       program.other_program + " computes; " + other +
                       " cannot be started. Build it (`make " +
                       program.other_program + "`) or put it there.");
    }

    void
    run_problem(const Program                      &program,
                const CommandLine                  &command,
                char                              **argv,
                const std::function<void(char **)> &before_computing,
                std::unique_ptr<MPI_InitFinalize>  &mpi)
    {
      // Which problem it is decides which entries there are.
      const ParameterText text = command.parameter_file.empty() ?
                                   ParameterText() :
                                   read_parameter_text(command.parameter_file);
      const std::string   name = get_entry(text, command.overrides, "Problem")
                                 .value_or(program.default_problem);
      const auto &others = program.other_problems;
      if (command.action == CommandLine::Action::geometry &&
          (!Registry<Problem>::instance().contains(name) ||
           !Registry<Problem>::instance().get(name).has_geometry))
        throw InputError("--geometry-only shows the cell of a plate test, but "
                         "Problem is " +
                         name + ".");
      if (std::find(others.begin(), others.end(), name) != others.end())
        start_beside(program, name, argv);
      if (!Registry<Problem>::instance().contains(name))
        refuse_problem(program, name);
      const Problem &problem = Registry<Problem>::instance().get(name);

      if (command.action == CommandLine::Action::run)
        before_computing(argv);
      // Threads are not used; the linear algebra of these sizes gains nothing
      // by them.
      int    mpi_argc = 1;
      char **mpi_argv = argv;
      mpi = std::make_unique<MPI_InitFinalize>(mpi_argc, mpi_argv, 1);
      if (!problem.runs_in_parallel)
        refuse_several_processes(name);
      problem.start(text, command);
    }
  } // namespace



  int
  run_program(const Program                      &program,
              const int                           argc,
              char                              **argv,
              const std::function<void(char **)> &before_computing)
  {
    // Outlives the exceptions: deal.II does not finish MPI while one is on its
    // way.
    std::unique_ptr<MPI_InitFinalize> mpi;
    // What ends one process alone must end the others, which wait for it.
    const auto end_all = [](const int status) {
      int is_running = 0;
      MPI_Initialized(&is_running);
      if (is_running != 0 &&
          dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, status);
      return status;
    };
    try
      {
        const CommandLine command = parse_command_line(argc, argv);
        if (command.action == CommandLine::Action::help)
          std::cout << program.help;
        else if (command.action == CommandLine::Action::version)
          std::cout << version_text();
        else
          run_problem(program, command, argv, before_computing, mpi);
        return 0;
      }
    catch (const InputError &error)
      {
        std::cerr << program.name << ": " << error.what() << std::endl;
        return 2;
      }
    catch (const StageFailed &error)
      {
        std::cerr << program.name << ": " << error.what() << std::endl;
        Interruption::end_by_signal();
        return 1;
      }
    catch (const std::bad_alloc &)
      {
        std::cerr << program.name
                  << ": the memory does not suffice. What to try: "
                  << OutOfMemory::remedy() << '.' << std::endl;
        return end_all(1);
      }
    catch (const std::exception &error)
      {
        std::cerr << program.name << ": unexpected error, please report it:\n"
                  << error.what() << std::endl;
        return end_all(3);
      }
  }
} // namespace NPT
