// SPDX-License-Identifier: LGPL-2.1-or-later
// Processes of cases: copies of this one, or programs started anew.

#include <npt_dealii/base/mpi_session.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/problems/parameter_study/case_process.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
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

    // What the system knows of a case's process; only calls that are safe in a
    // signal handler.
    void
    set_files(const char *screen, const char *error)
    {
      const int out  = open(screen, O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int err  = open(error, O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int none = open("/dev/null", O_RDONLY);
      if (out < 0 || err < 0)
        _exit(output_failed); // not into the files of the case before
      dup2(none, 0);
      dup2(out, 1);
      dup2(err, 2);
      for (const int file : {out, err, none})
        if (file > 2)
          close(file);
    }

    void
    set_up_process()
    {
      prctl(PR_SET_PDEATHSIG, SIGTERM); // no orphans if the study is ended
      rlimit no_core{};
      setrlimit(RLIMIT_CORE, &no_core);
    }

    // What no run lasts: thirty years. Limits beyond are as good as this one,
    // and more than the counters of the system can take.
    constexpr double longest_limit = 1e9;

    // Of a program, in whole seconds; it keeps nothing else over execve().
    void
    limit_cpu_time_of_program(const double seconds)
    {
      rlimit limit{};
      limit.rlim_cur =
        static_cast<rlim_t>(std::ceil(std::min(seconds, longest_limit)));
      limit.rlim_max = limit.rlim_cur + 5;
      setrlimit(RLIMIT_CPU, &limit);
    }

    // Of what this process computes from now on; 0: no limit. It is ended by
    // the signal that the system has for that, to which nobody here listens.
    void
    limit_cpu_time_of_case(const double given)
    {
      const double         seconds = std::min(given, longest_limit);
      static const timer_t timer   = []() {
        sigevent event{};
        event.sigev_notify = SIGEV_SIGNAL;
        event.sigev_signo  = SIGXCPU;
        timer_t created{};
        timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &created);
        return created;
      }();
      itimerspec limit{};
      limit.it_value.tv_sec = static_cast<time_t>(std::floor(seconds));
      limit.it_value.tv_nsec =
        static_cast<long>(1e9 * (seconds - std::floor(seconds)));
      timer_settime(timer, 0, &limit, nullptr);
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

    double
    seconds(const rusage &usage)
    {
      const auto of = [](const timeval &t) {
        return t.tv_sec + 1e-6 * t.tv_usec;
      };
      return of(usage.ru_utime) + of(usage.ru_stime);
    }

    // Of this process and those that it has started.
    double
    cpu_seconds_so_far()
    {
      rusage own{}, started{};
      getrusage(RUSAGE_SELF, &own);
      getrusage(RUSAGE_CHILDREN, &started);
      return seconds(own) + seconds(started);
    }

    // The largest memory, which a case reports, is its own. Without the
    // permission for that it is that of all cases so far.
    void
    forget_peak_memory()
    {
      std::ofstream("/proc/self/clear_refs") << 5 << std::flush;
    }

    std::vector<std::string>
    arguments_of_case(const SweepOptions &options, const std::string &folder)
    {
      std::vector<std::string> result = {folder + "/case.prm",
                                         "--output",
                                         folder};
      if (options.continues)
        result.push_back("--continue");
      return result;
    }

    int
    run_case(const SweepOptions &options, const std::string &folder)
    {
      set_files((folder + "/screen.txt").c_str(),
                (folder + "/error.txt").c_str());
      limit_cpu_time_of_case(options.cpu_limit);
      forget_peak_memory();
      for (std::ostream *stream : {&std::cout, &std::cerr, &std::clog})
        {
          stream->clear();
          stream->copyfmt(std::ios(nullptr)); // as in a new program
        }
      const int status = options.run(arguments_of_case(options, folder));
      flush_streams();
      limit_cpu_time_of_case(0.);
      return status;
    }

    bool
    is_orderly(const int status)
    {
      return status >= 0 && status <= 2;
    }

    // The life of a copy. noexcept: nothing may get from here into the study,
    // of which this is a copy.
    [[noreturn]] void
    run_cases_of_copy(const SweepOptions &options,
                      std::string         folder,
                      const int           channel) noexcept
    {
      set_up_process();
      forget_signal_handlers();
      OutputFolder::leave_all();
      for (const auto &[name, value] : one_thread)
        setenv(name.c_str(), value.c_str(), 1);
      MPISession::keep_for_later();
      for (double before = 0;;)
        {
          CaseEnd end;
          end.status       = run_case(options, folder);
          const double now = cpu_seconds_so_far();
          end.cpu_seconds  = now - before;
          before           = now;
          if (!is_orderly(end.status))
            _exit(end.status);
          char          next[PATH_MAX];
          const ssize_t size =
            ::send(channel, &end, sizeof(end), MSG_NOSIGNAL) == sizeof(end) ?
              recv(channel, next, sizeof(next), 0) :
              0;
          if (size <= 0)
            break; // no more cases
          folder.assign(next, size);
        }
      MPISession::end_if_kept();
      _exit(0);
    }
  } // namespace



  CaseProcess::CaseProcess(const SweepOptions &options)
    : options_(options)
  {}



  CaseProcess::~CaseProcess()
  {
    if (!is_busy_)
      forget_process();
    else if (channel_ >= 0)
      close(channel_);
  }



  // A process without a case; it ends, if it has not done so.
  void
  CaseProcess::forget_process()
  {
    if (channel_ >= 0)
      {
        // Also where later copies hold this end of the channel.
        shutdown(channel_, SHUT_RDWR);
        close(channel_);
      }
    if (pid_ > 0)
      waitpid(pid_, nullptr, 0);
    channel_ = pid_ = -1;
  }



  void
  CaseProcess::begin(const std::string &folder)
  {
    Assert(!is_busy_, dealii::ExcInternalError());
    AssertThrow(folder.size() < PATH_MAX,
                dealii::ExcMessage("The name of the folder " + folder +
                                   " is too long."));
    const ssize_t size = folder.size();
    if (channel_ < 0 ||
        ::send(channel_, folder.data(), folder.size(), MSG_NOSIGNAL) != size)
      {
        forget_process();
        fork_process(folder);
      }
    is_busy_ = true;
  }



  void
  CaseProcess::fork_process(const std::string &folder)
  {
    // All memory for execve() is taken before fork(): where there are threads,
    // those of MPI, only calls that are safe in a signal handler are allowed
    // between the two.
    const std::string screen = folder + "/screen.txt",
                      error  = folder + "/error.txt";
    std::vector<std::string> program_and_arguments =
                               arguments_of_case(options_, folder),
                             environment = environment_of_program();
    program_and_arguments.insert(program_and_arguments.begin(),
                                 options_.program);
    const std::vector<char *> argv = pointers(program_and_arguments),
                              envp = pointers(environment);
    const bool copies =
      options_.run && !dealii::Utilities::MPI::job_supports_mpi();

    int ends[2] = {-1, -1};
    AssertThrow(!copies ||
                  socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) ==
                    0,
                dealii::ExcMessage("No process can be started: " +
                                   std::string(std::strerror(errno))));
    flush_streams(); // what they hold belongs to this process
    pid_ = fork();
    if (pid_ == 0 && copies)
      {
        close(ends[0]);
        run_cases_of_copy(options_, folder, ends[1]);
      }
    if (pid_ == 0)
      {
        set_up_process();
        set_files(screen.c_str(), error.c_str());
        if (options_.cpu_limit > 0)
          limit_cpu_time_of_program(options_.cpu_limit);
        execve(options_.program.c_str(), argv.data(), envp.data());
        _exit(exec_failed);
      }
    const int reason = errno;
    if (copies)
      close(ends[1]);
    channel_     = ends[0];
    cpu_seconds_ = 0;
    AssertThrow(pid_ > 0,
                dealii::ExcMessage("No process can be started: " +
                                   std::string(std::strerror(reason))));
  }



  std::optional<CaseEnd>
  CaseProcess::end()
  {
    CaseEnd result;
    if (channel_ >= 0 &&
        recv(channel_, &result, sizeof(result), MSG_DONTWAIT) == sizeof(result))
      {
        cpu_seconds_ += result.cpu_seconds;
        is_busy_ = false;
        return result;
      }
    return end_of_process(WNOHANG);
  }



  CaseEnd
  CaseProcess::end_by_force()
  {
    kill(pid_, SIGKILL);
    return *end_of_process(0);
  }



  std::optional<CaseEnd>
  CaseProcess::end_of_process(const int options)
  {
    CaseEnd result;
    int     status = 0;
    rusage  usage{};
    pid_t   ended;
    do
      ended = wait4(pid_, &status, options, &usage);
    while (ended < 0 && errno == EINTR);
    if (ended == 0)
      return {};
    AssertThrow(ended == pid_,
                dealii::ExcMessage("How a case ended cannot be told: " +
                                   std::string(std::strerror(errno))));
    result.signal      = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    result.status      = WIFEXITED(status) ? WEXITSTATUS(status) : 0;
    result.cpu_seconds = seconds(usage) - cpu_seconds_;
    if (channel_ >= 0)
      close(channel_);
    channel_ = pid_ = -1;
    is_busy_        = false;
    return result;
  }



  void
  CaseProcess::send(const int signal) const
  {
    if (pid_ > 0)
      kill(pid_, signal);
  }
} // namespace NPT
