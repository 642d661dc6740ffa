// SPDX-License-Identifier: LGPL-2.1-or-later
// Folders, processes and table of the cases of a study.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/sweep.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <sstream>
#include <thread>

extern char **environ;

namespace NPT
{
  namespace fs = std::filesystem;

  namespace
  {
    using Clock = std::chrono::steady_clock;

    constexpr int exec_failed = 127; // as in a shell

    std::string
    read_text(const fs::path &path)
    {
      std::ifstream     in(path, std::ios::binary);
      std::stringstream content;
      content << in.rdbuf();
      return content.str();
    }

    // The lines that mean something: parameters are compared by these, so that
    // a text reworded in the program does not run finished cases again.
    std::string
    without_comments(const std::string &parameters)
    {
      std::istringstream lines(parameters);
      std::string        line, result;
      while (std::getline(lines, line))
        {
          const std::size_t first = line.find_first_not_of(" \t\r");
          if (first != std::string::npos && line[first] != '#')
            result += line + '\n';
        }
      return result;
    }

    bool
    is_parallel()
    {
      return dealii::Utilities::MPI::job_supports_mpi() &&
             dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1;
    }

    // The first process decides, all others learn it.
    std::vector<std::string>
    broadcast_lines(const std::vector<std::string> &lines)
    {
      if (!is_parallel())
        return lines;
      std::string text;
      for (const std::string &line : lines)
        text += line + "\n";
      unsigned int size = text.size();
      MPI_Bcast(&size, 1, MPI_UNSIGNED, 0, MPI_COMM_WORLD);
      text.resize(size);
      MPI_Bcast(text.data(), size, MPI_CHAR, 0, MPI_COMM_WORLD);
      std::istringstream       in(text);
      std::vector<std::string> result;
      for (std::string line; std::getline(in, line);)
        result.push_back(line);
      return result;
    }

    // A waiting process must not take the core of a working one, as MPI_Barrier
    // would do by asking all the time.
    void
    wait_for_all_processes()
    {
      if (!is_parallel())
        return;
      MPI_Request request;
      MPI_Ibarrier(MPI_COMM_WORLD, &request);
      for (int done = 0;;)
        {
          MPI_Test(&request, &done, MPI_STATUS_IGNORE);
          if (done != 0)
            return;
          std::this_thread::sleep_for(std::chrono::milliseconds(50));
        }
    }

    // A run is a process of its own also for MPI: it must not take itself for
    // a member of the study's job. Threads would take the cores of other cases.
    std::vector<std::string>
    environment_of_runs()
    {
      static const std::vector<std::string> of_mpi = {
        "OMPI_", "PMIX_", "PMI_", "PMI2_", "MPI_", "HYDRA_", "HYDI_", "PRTE_"};
      static const std::vector<std::string> threads = {"OMP_NUM_THREADS=1",
                                                       "OPENBLAS_NUM_THREADS=1",
                                                       "DEAL_II_NUM_THREADS=1"};

      std::vector<std::string> result;
      for (char **entry = environ; *entry != nullptr; ++entry)
        {
          const std::string text        = *entry;
          const auto        begins_with = [&](const std::string &start) {
            return text.compare(0, start.size(), start) == 0;
          };
          // The permission to run as root is the user's, not the job's.
          const bool drop =
            (is_parallel() && !begins_with("OMPI_ALLOW_") &&
             std::any_of(of_mpi.begin(), of_mpi.end(), begins_with)) ||
            std::any_of(threads.begin(),
                        threads.end(),
                        [&](const std::string &t) {
                          return begins_with(t.substr(0, t.find('=') + 1));
                        });
          if (!drop)
            result.push_back(text);
        }
      result.insert(result.end(), threads.begin(), threads.end());
      return result;
    }

    pid_t
    start_run(const SweepOptions &options, const fs::path &folder)
    {
      // All memory is taken before fork(): between fork and exec only calls
      // that are safe in a signal handler are allowed.
      const std::string program          = options.program,
                        file             = (folder / "case.prm").string(),
                        output           = folder.string(),
                        screen           = (folder / "screen.txt").string(),
                        error            = (folder / "error.txt").string();
      std::vector<std::string> arguments = {program, file, "--output", output},
                               environment = environment_of_runs();
      const auto pointers = [](std::vector<std::string> &texts) {
        std::vector<char *> result;
        for (std::string &text : texts)
          result.push_back(text.data());
        result.push_back(nullptr);
        return result;
      };
      const std::vector<char *> argv = pointers(arguments),
                                envp = pointers(environment);
      rlimit limit{};
      limit.rlim_cur = static_cast<rlim_t>(std::ceil(options.cpu_limit));
      limit.rlim_max = limit.rlim_cur + 5;

      const pid_t pid = fork();
      if (pid != 0)
        return pid;
      prctl(PR_SET_PDEATHSIG, SIGTERM); // no orphans if the study is ended
      if (options.cpu_limit > 0)
        setrlimit(RLIMIT_CPU, &limit);
      rlimit no_core{};
      setrlimit(RLIMIT_CORE, &no_core);
      const int out  = open(screen.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int err  = open(error.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
      const int none = open("/dev/null", O_RDONLY);
      dup2(none, 0);
      dup2(out, 1);
      dup2(err, 2);
      execve(program.c_str(), argv.data(), envp.data());
      _exit(exec_failed);
    }

    std::string
    signal_name(const int signal)
    {
      const char *const text = strsignal(signal);
      return text == nullptr ? "signal " + std::to_string(signal) : text;
    }

    // What remains of a run says how it ended.
    RunSummary
    judge_run(const fs::path     &folder,
              const int           status,
              const bool          wall_limit_hit,
              const double        cpu_seconds,
              const SweepOptions &options)
    {
      RunSummary summary;
      try
        {
          summary = read_run_summary((folder / "summary.csv").string());
        }
      catch (const InputError &)
        {
          // The run did not come to its end; the curve, if it got so far, is
          // complete up to its last accepted step.
          const fs::path curve = folder / "curves.csv";
          try
            {
              if (fs::exists(curve))
                summary = summarize_curve(read_curves(curve.string()));
            }
          catch (const InputError &)
            {
              // Damaged; how the process ended is said below.
            }
        }
      summary.cpu_seconds = cpu_seconds;

      std::string said = read_text(folder / "error.txt");
      std::replace(said.begin(), said.end(), '\n', ' ');
      const std::string prefix = "npt_dealii: ";
      if (said.compare(0, prefix.size(), prefix) == 0)
        said.erase(0, prefix.size());

      if (wall_limit_hit ||
          (WIFSIGNALED(status) && options.cpu_limit > 0 &&
           (WTERMSIG(status) == SIGXCPU ||
            (WTERMSIG(status) == SIGKILL && cpu_seconds >= options.cpu_limit))))
        {
          std::ostringstream message;
          message << "Ended after " << options.cpu_limit
                  << " s, the CPU limit of a case.";
          summary.status  = "time limit";
          summary.reason  = "time limit";
          summary.message = message.str();
        }
      else if (WIFSIGNALED(status))
        {
          summary.status  = "crashed";
          summary.reason  = signal_name(WTERMSIG(status));
          summary.message = said;
        }
      else
        switch (WEXITSTATUS(status))
          {
            case 0:
              summary.status = "done";
              break;
            case 1:
              summary.status = "failed";
              if (summary.reason.empty())
                summary.reason = "not named";
              if (summary.message.empty())
                summary.message = said;
              break;
            case 2:
              summary.status  = "refused";
              summary.reason  = "input";
              summary.message = said;
              break;
            case exec_failed:
              summary.status  = "crashed";
              summary.reason  = "not started";
              summary.message = options.program + " cannot be started.";
              break;
            default:
              summary.status  = "crashed";
              summary.reason  = "unexpected error";
              summary.message = said;
          }
      return summary;
    }

    struct Run
    {
      std::size_t       c;
      Clock::time_point start;
    };

    // A summary left by an earlier run must not be taken for this one's.
    void
    clean_folder(const fs::path &folder)
    {
      for (const char *name : {"summary.csv", "curves.csv", "result.csv"})
        fs::remove(folder / name);
    }

    bool
    is_worth_keeping(const RunSummary &result, const SweepOptions &options)
    {
      if (options.repeat)
        return false;
      if (result.status == "time limit")
        return options.cpu_limit > 0 &&
               result.cpu_seconds + 1 >= options.cpu_limit;
      return result.status != "crashed";
    }

    bool
    has_worthy_result(const fs::path &folder, const SweepOptions &options)
    {
      try
        {
          return is_worth_keeping(
            read_run_summary((folder / "result.csv").string()), options);
        }
      catch (const InputError &)
        {
          return false; // no result yet
        }
    }
  } // namespace



  std::string
  describe_case(const SweepCase &c)
  {
    std::string result;
    for (const auto &[name, value] : c.values)
      result += (result.empty() ? "" : ", ") + name + " " + value;
    return result;
  }



  unsigned int
  n_available_cores()
  {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof(set), &set) == 0)
      return std::max(1, CPU_COUNT(&set));
    return std::max(1u, std::thread::hardware_concurrency());
  }



  void
  run_cases(std::vector<SweepCase> &cases,
            const SweepOptions     &options,
            std::ostream           &log)
  {
    const fs::path study = options.directory;
    const bool     first =
      !is_parallel() ||
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

    // ---- The first process gives every case its folder.
    std::vector<std::string> folders, to_run;
    if (first)
      {
        std::map<std::string, std::string> folder_of; // parameters -> folder
        unsigned int                       last_number = 0;
        fs::create_directories(study / "cases");
        std::set<std::string> names;
        for (const auto &entry : fs::directory_iterator(study / "cases"))
          names.insert(entry.path().filename().string());
        for (const std::string &name : names)
          {
            const fs::path folder = study / "cases" / name;
            fs::remove(folder / "claim"); // of an interrupted study
            last_number =
              std::max<unsigned int>(last_number,
                                     std::strtoul(name.c_str(), nullptr, 10));
            if (!fs::exists(folder / "case.prm"))
              continue;
            // Of several folders with the same parameters the first with a
            // result.
            const auto known = folder_of.emplace(without_comments(read_text(
                                                   folder / "case.prm")),
                                                 "cases/" + name);
            if (!known.second &&
                !has_worthy_result(study / known.first->second, options) &&
                has_worthy_result(folder, options))
              known.first->second = "cases/" + name;
          }
        std::set<std::string> seen;
        for (SweepCase &c : cases)
          {
            std::string &folder = folder_of[without_comments(c.parameters)];
            if (folder.empty())
              {
                std::string number = std::to_string(++last_number);
                number.insert(0,
                              4 - std::min<std::size_t>(4, number.size()),
                              '0');
                folder = "cases/" + number;
                fs::create_directories(study / folder);
                replace_file((study / folder / "case.prm").string(),
                             [&](std::ostream &out) { out << c.parameters; });
              }
            folders.push_back(folder);
            if (!seen.insert(folder).second)
              continue;
            if (!has_worthy_result(study / folder, options))
              {
                clean_folder(study / folder);
                to_run.push_back(folder);
              }
          }
      }
    folders = broadcast_lines(folders);
    to_run  = broadcast_lines(to_run);
    AssertDimension(folders.size(), cases.size());
    for (std::size_t i = 0; i < cases.size(); ++i)
      cases[i].folder = folders[i];

    const unsigned int n_slots = options.side_by_side > 0 ?
                                   options.side_by_side :
                                 is_parallel() ? 1 :
                                                 n_available_cores();
    if (first)
      {
        log << cases.size() << (cases.size() == 1 ? " case, " : " cases, ")
            << to_run.size() << " to run, ";
        if (is_parallel())
          log << dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)
              << " processes with " << n_slots << " at a time" << std::endl;
        else
          log << n_slots << " at a time" << std::endl;
      }

    // ---- Run: start while there is room, look for those that have ended.
    std::map<std::string, std::string> description;
    for (const SweepCase &c : cases)
      description[c.folder] = describe_case(c);
    std::map<pid_t, Run> running;
    std::size_t          next = 0;
    while (next < to_run.size() || !running.empty())
      {
        while (next < to_run.size() && running.size() < n_slots)
          {
            const fs::path folder = study / to_run[next];
            // Whoever creates the claim has the case.
            const int claim = open((folder / "claim").c_str(),
                                   O_WRONLY | O_CREAT | O_EXCL,
                                   0644);
            if (claim >= 0)
              {
                close(claim);
                const pid_t pid = start_run(options, folder);
                AssertThrow(pid > 0,
                            dealii::ExcMessage(
                              "No process can be started: " +
                              std::string(std::strerror(errno))));
                running[pid] = {next, Clock::now()};
              }
            ++next;
          }

        for (auto run = running.begin(); run != running.end();)
          {
            const double wall_seconds =
              std::chrono::duration<double>(Clock::now() - run->second.start)
                .count();
            // A run that waits for something uses no CPU time.
            const bool too_long = options.cpu_limit > 0 &&
                                  wall_seconds > 10 * options.cpu_limit + 60;
            if (too_long)
              kill(run->first, SIGKILL);
            int         status = 0;
            rusage      usage{};
            const pid_t ended =
              wait4(run->first, &status, too_long ? 0 : WNOHANG, &usage);
            if (ended == 0)
              {
                ++run;
                continue;
              }
            const auto seconds = [](const timeval &t) {
              return t.tv_sec + 1e-6 * t.tv_usec;
            };
            const double cpu = std::round(1000 * (seconds(usage.ru_utime) +
                                                  seconds(usage.ru_stime))) /
                               1000;
            const std::string &name   = to_run[run->second.c];
            const fs::path     folder = study / name;
            const RunSummary   result =
              judge_run(folder, status, too_long, cpu, options);
            write_run_summary((folder / "result.csv").string(), result);

            std::ostringstream line;
            char               numbers[64];
            std::snprintf(numbers,
                          sizeof(numbers),
                          "%4zu/%zu %8.1f s  ",
                          run->second.c + 1,
                          to_run.size(),
                          cpu);
            line << numbers << name << "  " << result.status;
            if (result.status != "done")
              line << " (" << result.reason << ") at " << result.stage << " "
                   << result.load_factor;
            if (!description[name].empty())
              line << "  " << description[name];
            log << line.str() << std::endl;
            run = running.erase(run);
          }
        if (!running.empty())
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
      }
    wait_for_all_processes();
    if (first)
      for (const std::string &folder : to_run)
        fs::remove(study / folder / "claim");

    for (SweepCase &c : cases)
      c.result = read_run_summary((study / c.folder / "result.csv").string());
  }



  void
  write_case_table(const std::string            &filename,
                   const std::vector<SweepCase> &cases)
  {
    std::vector<std::string> columns = {"case"};
    if (!cases.empty())
      for (const auto &value : cases[0].values)
        columns.push_back(value.first);
    columns.insert(columns.end(),
                   run_summary_columns().begin(),
                   run_summary_columns().end());
    TableWriter table(
      filename,
      columns,
      {"All cases of the study: folder, swept entries, how the "
       "run ended, stage and load factor reached, sums over "
       "all accepted steps, CPU seconds of the whole process."});
    for (const SweepCase &c : cases)
      {
        std::vector<TableCell> row = {c.folder};
        for (const auto &value : c.values)
          row.push_back(value.second);
        for (const TableCell &cell : run_summary_cells(c.result))
          row.push_back(cell);
        table.add_row(row);
      }
  }
} // namespace NPT
