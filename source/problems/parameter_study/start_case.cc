// SPDX-License-Identifier: LGPL-2.1-or-later
// The process of one case: a copy of this one, or a program started anew.

#include <npt_dealii/base/mpi_session.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/problems/parameter_study/start_case.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <vector>

extern char **environ;

namespace NPT
{
  namespace
  {
    // Threads would take the cores of other cases.
    const std::vector<std::pair<std::string, std::string>> one_thread = {
      {"OMP_NUM_THREADS", "1"},
      {"OPENBLAS_NUM_THREADS", "1"},
      {"DEAL_II_NUM_THREADS", "1"}};

    // A case is a process of its own also for MPI: it must not take itself for
    // a member of the study's job.
    std::vector<std::string>
    environment_of_program()
    {
      static const std::vector<std::string> of_mpi = {
        "OMPI_", "PMIX_", "PMI_", "PMI2_", "MPI_", "HYDRA_", "HYDI_", "PRTE_"};

      const bool is_launched = Launcher::of_this_process().is_present;
      std::vector<std::string> result;
      for (char **entry = environ; *entry != nullptr; ++entry)
        {
          const std::string text        = *entry;
          const auto        begins_with = [&](const std::string &start) {
            return text.compare(0, start.size(), start) == 0;
          };
          // The permission to run as root is the user's, not the job's.
          const bool drop =
            (is_launched && !begins_with("OMPI_ALLOW_") &&
             std::any_of(of_mpi.begin(), of_mpi.end(), begins_with)) ||
            std::any_of(one_thread.begin(),
                        one_thread.end(),
                        [&](const auto &variable) {
                          return begins_with(variable.first + "=");
                        });
          if (!drop)
            result.push_back(text);
        }
      for (const auto &[name, value] : one_thread)
        result.push_back(name + "=" + value);
      return result;
    }

    std::vector<char *>
    pointers(std::vector<std::string> &texts)
    {
      std::vector<char *> result;
      for (std::string &text : texts)
        result.push_back(text.data());
      result.push_back(nullptr);
      return result;
    }

    // What the system knows of the new process; only calls that are safe in a
    // signal handler.
    void
    set_up_process(const double cpu_limit,
                   const char  *screen,
                   const char  *error)
    {
      prctl(PR_SET_PDEATHSIG, SIGTERM); // no orphans if the study is ended
      rlimit limit{};
      limit.rlim_cur = static_cast<rlim_t>(std::ceil(cpu_limit));
      limit.rlim_max = limit.rlim_cur + 5;
      if (cpu_limit > 0)
        setrlimit(RLIMIT_CPU, &limit);
      rlimit no_core{};
      setrlimit(RLIMIT_CORE, &no_core);
      const int out  = open(screen, O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int err  = open(error, O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int none = open("/dev/null", O_RDONLY);
      dup2(none, 0);
      dup2(out, 1);
      dup2(err, 2);
      for (const int file : {out, err, none})
        if (file > 2)
          close(file);
    }

    // As execve() does: handlers are those of another program, what is ignored
    // stays so.
    void
    forget_signal_handlers()
    {
      for (int signal = 1; signal < NSIG; ++signal)
        {
          struct sigaction action
          {};
          if (sigaction(signal, nullptr, &action) != 0 ||
              action.sa_handler == SIG_IGN || action.sa_handler == SIG_DFL)
            continue;
          std::signal(signal, SIG_DFL);
        }
    }

    void
    flush_streams()
    {
      for (std::ostream *stream : {&std::cout, &std::cerr, &std::clog})
        stream->flush();
      std::fflush(nullptr);
    }

    // noexcept: nothing may get from here into the study, of which this is a
    // copy.
    [[noreturn]] void
    run_copy(const SweepOptions             &options,
             const std::vector<std::string> &arguments) noexcept
    {
      forget_signal_handlers();
      OutputFolder::leave_all();
      for (const auto &[name, value] : one_thread)
        setenv(name.c_str(), value.c_str(), 1);
      for (std::ostream *stream : {&std::cout, &std::cerr, &std::clog})
        {
          stream->clear();
          stream->copyfmt(std::ios(nullptr)); // as in a new program
        }
      const int status = options.run(arguments);
      flush_streams();
      _exit(status);
    }
  } // namespace



  pid_t
  start_case(const SweepOptions &options, const std::string &folder)
  {
    // All memory for execve() is taken before fork(): where there are threads,
    // those of MPI, only calls that are safe in a signal handler are allowed
    // between the two.
    const std::string screen           = folder + "/screen.txt",
                      error            = folder + "/error.txt";
    std::vector<std::string> arguments = {folder + "/case.prm",
                                          "--output",
                                          folder};
    if (options.continues)
      arguments.push_back("--continue");
    std::vector<std::string> program_and_arguments = arguments,
                             environment           = environment_of_program();
    program_and_arguments.insert(program_and_arguments.begin(),
                                 options.program);
    const std::vector<char *> argv = pointers(program_and_arguments),
                              envp = pointers(environment);
    const bool copies =
      options.run && !dealii::Utilities::MPI::job_supports_mpi();

    flush_streams(); // what they hold belongs to this process
    const pid_t pid = fork();
    if (pid != 0)
      return pid;
    set_up_process(options.cpu_limit, screen.c_str(), error.c_str());
    if (copies)
      run_copy(options, arguments);
    execve(options.program.c_str(), argv.data(), envp.data());
    _exit(exec_failed);
  }
} // namespace NPT
