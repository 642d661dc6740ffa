// SPDX-License-Identifier: LGPL-2.1-or-later
// From the command line to the exit status.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/mpi_session.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/base/program.h>
#include <npt_dealii/base/text_file.h>

#include <deal.II/base/multithread_info.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <thread>

namespace NPT
{
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

    // A pipe is empty for whom reads it next: he gets a copy in memory.
    std::string
    copy_of_stream(const std::string &content)
    {
      const int file = memfd_create("parameters", 0);
      for (std::size_t done = 0; done < content.size();)
        {
          const ssize_t n =
            write(file, content.data() + done, content.size() - done);
          if (n < 0)
            throw InputError(std::string("the parameter file cannot be handed "
                                         "on: ") +
                             std::strerror(errno));
          done += n;
        }
      return "/dev/fd/" + std::to_string(file);
    }

    /// The parameter file as it is read, once.
    struct ParameterSource
    {
      ParameterText              text;
      std::optional<std::string> content; ///< of a pipe
    };

    ParameterSource
    read_parameters(const std::string &file)
    {
      if (file.empty())
        return {};
      if (!is_stream(file))
        return {read_parameter_text(file), {}};
      const unsigned int n_processes = Launcher::of_this_process().n_processes;
      if (n_processes > 1)
        throw InputError("'" + file +
                         "' is no file but a stream, which only "
                         "one of the " +
                         std::to_string(n_processes) +
                         " processes can read; write it to a file first");
      const std::string content = read_text_file(file, "file '" + file + "'");
      return {make_parameter_text(content, file), content};
    }

    /// Whatever is executed with the same arguments finds what the pipe had.
    void
    hand_on(const ParameterSource &source,
            const std::string     &parameter_file,
            char                 **argv)
    {
      static std::string file;
      if (!source.content)
        return;
      file = copy_of_stream(*source.content);
      for (char **argument = argv + 1; *argument != nullptr; ++argument)
        if (*argument == parameter_file)
          *argument = file.data();
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
    refuse_several_processes(const std::string &problem, const unsigned int n)
    {
      throw InputError("one " + problem +
                       " runs in one process, but mpirun started " +
                       std::to_string(n) +
                       "; start it without mpirun, or make it a case of a "
                       "parameter study, which runs its cases side by side");
    }

    // What only reads does not need MPI, which costs as much as reading. Of
    // several processes all read, and the first one shows.
    void
    read_only(const std::string   &name,
              const Problem       &problem,
              const ParameterText &text,
              CommandLine          command)
    {
      const Launcher launcher = Launcher::of_this_process();
      if (launcher.n_processes > 1 && !problem.runs_in_parallel)
        refuse_several_processes(name, launcher.n_processes);
      if (launcher.rank > 0)
        {
          std::cout.rdbuf(nullptr);
          if (command.action == CommandLine::Action::geometry)
            command.action = CommandLine::Action::validate;
        }
      problem.start(text, command);
    }

    void
    exchange_with_texgen(const Program &program, const CommandLine &command)
    {
      if (!program.from_texgen || !program.to_texgen)
        throw InputError("TexGen files are read and written by npt_dealii, "
                         "not by " +
                         program.name + ".");
      if (command.action == CommandLine::Action::from_texgen)
        program.from_texgen(command.parameter_file);
      else
        program.to_texgen(read_parameter_text(command.parameter_file),
                          command.overrides);
    }

    void
    read_data_sheet(const Program &program, const CommandLine &command)
    {
      if (!program.from_data_sheet)
        throw InputError("Data sheets are read by npt_dealii, not by " +
                         program.name + ".");
      program.from_data_sheet(command.parameter_file, command.overrides);
    }

    // A data sheet where a parameter file should be.
    void
    refuse_data_sheet(const ParameterText &text, const std::string &file)
    {
      for (const ParameterText::Statement &statement : text.statements)
        if (statement.kind == ParameterText::Kind::subsection &&
            statement.name == "Data sheet")
          throw InputError(file +
                           " is a data sheet; turn it into a parameter file "
                           "by npt_dealii --from-data-sheet " +
                           file + " > FILE.prm.");
    }

    void
    run_problem(const Program                      &program,
                const CommandLine                  &command,
                char                              **argv,
                const std::function<void(char **)> &before_computing,
                std::unique_ptr<MPISession>        &mpi)
    {
      // Which problem it is decides which entries there are.
      const ParameterSource source = read_parameters(command.parameter_file);
      const ParameterText  &text   = source.text;
      refuse_data_sheet(text, command.parameter_file);
      std::string name = get_entry(text, command.overrides, "Problem")
                           .value_or(program.default_problem);
      const auto &others = program.other_problems;
      if (command.action == CommandLine::Action::geometry &&
          (!Registry<Problem>::instance().contains(name) ||
           !Registry<Problem>::instance().get(name).has_geometry))
        throw InputError("--geometry-only shows the cell of a plate test, but "
                         "Problem is " +
                         name + ".");
      const bool is_of_other =
        std::find(others.begin(), others.end(), name) != others.end();
      if (command.continues &&
          (is_of_other ||
           (Registry<Problem>::instance().contains(name) &&
            !Registry<Problem>::instance().get(name).can_continue)))
        throw InputError("--continue goes on with a plate test or a parameter "
                         "study, but Problem is " +
                         name + "; start it without this option.");
      if (is_of_other)
        {
          hand_on(source, command.parameter_file, argv);
          start_beside(program, name, argv);
        }
      if (!Registry<Problem>::instance().contains(name) ||
          !Registry<Problem>::instance().get(name).is_listed)
        refuse_problem(program, name);
      if (const auto &becomes = Registry<Problem>::instance().get(name).becomes;
          becomes && command.action == CommandLine::Action::run)
        if (const std::string other = becomes(text, command); !other.empty())
          name = other;
      const Problem &problem = Registry<Problem>::instance().get(name);

      // Threads are not used; the linear algebra of these sizes gains nothing
      // by them.
      dealii::MultithreadInfo::set_thread_limit(1);
      if (command.action != CommandLine::Action::run)
        return read_only(name, problem, text, command);
      hand_on(source, command.parameter_file, argv); // it may start anew
      before_computing(argv);
      if (problem.needs_mpi || Launcher::of_this_process().is_present)
        mpi = std::make_unique<MPISession>();
      if (mpi && mpi->n_processes() > 1 && !problem.runs_in_parallel)
        refuse_several_processes(name, mpi->n_processes());
      problem.start(text, command);
      if (mpi)
        mpi->meet_at_end();
    }



    // How a run ends that did not come to its end: with a sentence on the
    // screen and an exit status.
    class Failure
    {
    public:
      Failure(const Program &program, const std::unique_ptr<MPISession> &mpi)
        : program_(program)
        , mpi_(mpi)
        , screen_(std::cerr.rdbuf())
      {}

      // What all processes meet at once, as the stage that was given up: they
      // have the same numbers. The first one may be drawing yet.
      int
      end_together(const std::string &sentence, const int status)
      {
        if (is_first())
          say(sentence);
        if (mpi_)
          mpi_->meet_at_end();
        return status;
      }

      // What one process may have met alone: the others would wait for it in
      // the next sum. Those who met the same are here soon; the first one waits
      // less, so that it speaks for all.
      int
      end_all(const std::string &sentence, const int status)
      {
        if (is_first())
          say(sentence);
        if (all_end(is_first() ? 2. : 4.))
          return status;
        if (!is_first())
          say(sentence);
        if (mpi_)
          MPI_Abort(MPI_COMM_WORLD, status);
        return status;
      }

    private:
      bool
      is_first() const
      {
        return (mpi_ ? mpi_->rank() : Launcher::of_this_process().rank) == 0;
      }

      // Whether all processes come to their end within some seconds. Without
      // MPI it is mpirun that ends this one, if the first one has failed.
      bool
      all_end(const double patience) const
      {
        if (mpi_)
          return mpi_->meet_at_end(patience);
        if (!is_first())
          std::this_thread::sleep_for(std::chrono::duration<double>(patience));
        return is_first();
      }

      void
      say(std::string sentence)
      {
        // What a file has in its values must not steer the screen, nor fill
        // it.
        for (char &c : sentence)
          if (c != '\n')
            c = printable(std::string(1, c))[0];
        constexpr std::size_t longest = 3000;
        if (sentence.size() > longest)
          sentence.replace(longest / 2, sentence.size() - longest, " ... ");
        screen_ << program_.name << ": " << sentence << std::endl;
      }

      const Program                     &program_;
      const std::unique_ptr<MPISession> &mpi_;
      std::ostream screen_; // also of those who were silenced
    };
  } // namespace



  int
  run_program(const Program                      &program,
              const int                           argc,
              char                              **argv,
              const std::function<void(char **)> &before_computing)
  {
    // A reader of the screen who leaves (`| head`) does not end the run, and a
    // file that may not grow any more is an error like a full disk.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    // How gnuplot and the cases of a study end is asked for; who starts this
    // program may have it ignore that.
    std::signal(SIGCHLD, SIG_DFL);
    std::unique_ptr<MPISession> mpi; // if it turns out to be needed
    Failure                     failure(program, mpi);
    try
      {
        CommandLine command = parse_command_line(argc, argv);
        command.run_again   = [&](std::vector<std::string> arguments) {
          std::vector<char *> all = {argv[0]};
          for (std::string &argument : arguments)
            all.push_back(argument.data());
          all.push_back(nullptr);
          return run_program(program,
                             all.size() - 1,
                             all.data(),
                             before_computing);
        };
        if (command.action == CommandLine::Action::help)
          std::cout << program.help;
        else if (command.action == CommandLine::Action::version)
          std::cout << version_text();
        else if (command.action == CommandLine::Action::from_texgen ||
                 command.action == CommandLine::Action::to_texgen)
          exchange_with_texgen(program, command);
        else if (command.action == CommandLine::Action::from_data_sheet)
          read_data_sheet(program, command);
        else
          run_problem(program, command, argv, before_computing, mpi);
        return 0;
      }
    catch (const InputError &error)
      {
        // One line, also if the input has more where it should have a name.
        return failure.end_all(printable(error.what()), 2);
      }
    catch (const OutputError &error)
      {
        return failure.end_all(error.what(), 4);
      }
    catch (const StageFailed &error)
      {
        failure.end_together(error.what(), 1);
        mpi.reset(); // a signal does not
        Interruption::end_by_signal();
        return 1;
      }
    catch (const std::bad_alloc &)
      {
        return failure.end_all("the memory does not suffice. What to try: " +
                                 OutOfMemory::remedy() + '.',
                               1);
      }
    catch (const std::exception &error)
      {
        return failure.end_all(
          std::string("unexpected error, please report it:\n") + error.what(),
          3);
      }
  }
} // namespace NPT
