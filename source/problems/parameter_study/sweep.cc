// SPDX-License-Identifier: LGPL-2.1-or-later
// Folders, results and table of the cases of a study.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/ranks.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/case_process.h>
#include <npt_dealii/problems/parameter_study/sweep.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <sstream>
#include <thread>

namespace NPT
{
  namespace fs = std::filesystem;

  namespace
  {
    using Clock = std::chrono::steady_clock;

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

    bool
    is_first_process()
    {
      return !is_parallel() ||
             dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
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

    std::string
    signal_name(const int signal)
    {
      const char *const text = strsignal(signal);
      return text == nullptr ? "signal " + std::to_string(signal) : text;
    }

    // What a run wrote about itself or, if it did not come to its end, what its
    // curve says.
    RunSummary
    what_remains(const fs::path &folder)
    {
      try
        {
          const RunSummary summary =
            read_run_summary((folder / "summary.csv").string());
          if (summary.status != "running")
            return summary;
        }
      catch (const InputError &)
        {
          // The curve, if the run got so far, is complete up to its last
          // accepted step.
        }
      const fs::path curve = folder / "curves.csv";
      try
        {
          if (fs::exists(curve))
            return summarize_curve(read_curves(curve.string()));
        }
      catch (const InputError &)
        {
          // Damaged; how the process ended is said elsewhere.
        }
      return {};
    }

    // The error message of a run in one line.
    std::string
    last_words(const fs::path &folder)
    {
      std::string said = read_text(folder / "error.txt");
      std::replace(said.begin(), said.end(), '\n', ' ');
      const std::string prefix = "npt_dealii: ";
      if (said.compare(0, prefix.size(), prefix) == 0)
        said.erase(0, prefix.size());
      return said;
    }

    void
    set_end(RunSummary        &summary,
            const std::string &status,
            const std::string &reason,
            const std::string &message)
    {
      summary.status  = status;
      summary.reason  = reason;
      summary.message = message;
    }

    // How a run ended, by its exit status and by what it left.
    RunSummary
    judge_run(const fs::path     &folder,
              const CaseEnd      &end,
              const bool          wall_limit_hit,
              const SweepOptions &options)
    {
      RunSummary summary = what_remains(folder);
      // Of a case that went on, those of all its processes.
      summary.cpu_seconds    = options.continues ?
                                 std::max(summary.cpu_seconds, end.cpu_seconds) :
                                 end.cpu_seconds;
      const std::string said = last_words(folder);

      if (wall_limit_hit ||
          (options.cpu_limit > 0 &&
           (end.signal == SIGXCPU ||
            (end.signal == SIGKILL && end.cpu_seconds >= options.cpu_limit))))
        {
          std::ostringstream message;
          message << "Ended after " << options.cpu_limit
                  << " s, the CPU limit of a case.";
          set_end(summary, "time limit", "time limit", message.str());
        }
      else if (end.signal == SIGKILL && said.empty())
        set_end(summary,
                "crashed",
                signal_name(SIGKILL),
                "Killed from outside. If nobody did so, the system had no "
                "memory left: take a coarser mesh or fewer processes.");
      else if (end.signal != 0)
        set_end(summary, "crashed", signal_name(end.signal), said);
      else
        switch (end.status)
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
              set_end(summary, "refused", "input", said);
              break;
            case exec_failed:
              set_end(summary,
                      "crashed",
                      "not started",
                      options.program + " cannot be started.");
              break;
            case output_failed:
              set_end(summary, "crashed", "output", said);
              break;
            default:
              set_end(summary, "crashed", "unexpected error", said);
          }
      return summary;
    }

    void
    make_folder(const fs::path &folder)
    {
      std::error_code error;
      fs::create_directories(folder, error);
      if (error)
        throw OutputError(folder.string(), error.message());
    }

    struct Slot
    {
      explicit Slot(const SweepOptions &options)
        : process(options)
      {}

      CaseProcess       process;
      std::size_t       c = 0; // its case
      Clock::time_point start;
    };

    // A summary left by an earlier run must not be taken for this one's; one
    // that goes on needs its files.
    void
    clean_folder(const fs::path &folder, const SweepOptions &options)
    {
      fs::remove(folder / "result.csv");
      if (!options.continues)
        for (const char *name : {"summary.csv", "curves.csv"})
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



  namespace
  {
    // Folders of the cases in a study, by their parameters.
    class CaseFolders
    {
    public:
      CaseFolders(const fs::path &study, const SweepOptions &options)
        : study_(study)
        , options_(options)
      {
        make_folder(study / "cases");
        std::set<std::string> names;
        for (const auto &entry : fs::directory_iterator(study / "cases"))
          names.insert(entry.path().filename().string());
        for (const std::string &name : names)
          add(name);
      }

      // The folder of a case; made if there is none.
      std::string
      folder_of(const SweepCase &c)
      {
        std::string &folder = folder_of_[without_comments(c.parameters)];
        if (folder.empty())
          {
            std::string number = std::to_string(++last_number_);
            number.insert(0, 4 - std::min<std::size_t>(4, number.size()), '0');
            folder = "cases/" + number;
            make_folder(study_ / folder);
            replace_file((study_ / folder / "case.prm").string(),
                         [&](std::ostream &out) { out << c.parameters; });
          }
        return folder;
      }

    private:
      // A folder of an earlier run.
      void
      add(const std::string &name)
      {
        const fs::path folder = study_ / "cases" / name;
        fs::remove(folder / "claim"); // of an interrupted study
        last_number_ =
          std::max<unsigned int>(last_number_,
                                 std::strtoul(name.c_str(), nullptr, 10));
        if (!fs::exists(folder / "case.prm"))
          return;
        // Of several folders with the same parameters the first with a result.
        const auto known =
          folder_of_.emplace(without_comments(read_text(folder / "case.prm")),
                             "cases/" + name);
        if (!known.second &&
            !has_worthy_result(study_ / known.first->second, options_) &&
            has_worthy_result(folder, options_))
          known.first->second = "cases/" + name;
      }

      const fs::path                     study_;
      const SweepOptions                &options_;
      std::map<std::string, std::string> folder_of_; // parameters -> folder
      unsigned int                       last_number_ = 0;
    };



    // Gives every case its folder and says which of them are to be run. The
    // first process decides.
    std::vector<std::string>
    assign_folders(std::vector<SweepCase> &cases, const SweepOptions &options)
    {
      const fs::path           study = options.directory;
      std::vector<std::string> folders, to_run;
      if (is_first_process())
        {
          CaseFolders           known(study, options);
          std::set<std::string> seen;
          for (const SweepCase &c : cases)
            {
              const std::string folder = known.folder_of(c);
              folders.push_back(folder);
              if (seen.insert(folder).second &&
                  !has_worthy_result(study / folder, options))
                {
                  clean_folder(study / folder, options);
                  to_run.push_back(folder);
                }
            }
        }
      folders = broadcast_lines(folders);
      to_run  = broadcast_lines(to_run);
      AssertDimension(folders.size(), cases.size());
      for (std::size_t i = 0; i < cases.size(); ++i)
        cases[i].folder = folders[i];
      return to_run;
    }



    // The processes of a study: starts those of its cases while there is room,
    // and looks for those that have ended.
    class RunningCases
    {
    public:
      RunningCases(const std::vector<SweepCase>   &cases,
                   const std::vector<std::string> &to_run,
                   const SweepOptions             &options,
                   const unsigned int              n_slots,
                   std::ostream                   &log)
        : study_(options.directory)
        , to_run_(to_run)
        , options_(options)
        , log_(log)
      {
        for (unsigned int i = 0; i < n_slots; ++i)
          slots_.push_back(std::make_unique<Slot>(options));
        for (const SweepCase &c : cases)
          description_[c.folder] = describe_case(c);
      }

      void
      run_all()
      {
        for (bool any_runs = true; any_runs || next_ < to_run_.size();)
          {
            if (Interruption::requested())
              end_all();
            any_runs = false;
            for (const auto &slot : slots_)
              {
                if (slot->process.is_busy())
                  look_for_end(*slot);
                while (!slot->process.is_busy() && next_ < to_run_.size() &&
                       is_available(to_run_[next_]))
                  begin(*slot, next_++);
                any_runs = any_runs || slot->process.is_busy();
              }
            if (any_runs || next_ < to_run_.size())
              wait_a_little();
          }
      }

    private:
      // 20 ms, or until a copy is ready for another case.
      void
      wait_a_little() const
      {
        std::vector<pollfd> channels;
        for (const auto &slot : slots_)
          if (slot->process.is_busy() && slot->process.channel() >= 0)
            channels.push_back({slot->process.channel(), POLLIN, 0});
        poll(channels.data(), channels.size(), 20);
      }

      // No more cases; those that run finish their load step.
      void
      end_all()
      {
        next_ = to_run_.size();
        if (!told_to_end_)
          for (const auto &slot : slots_)
            if (slot->process.is_busy())
              slot->process.send(SIGTERM);
        told_to_end_ = true;
      }

      // A case of a study that was killed may be in its last step yet.
      bool
      is_available(const std::string &name)
      {
        if (!OutputFolder::is_in_use((study_ / name).string()))
          return true;
        if (waits_for_ != name)
          log_ << "Another run uses " << name << "; waiting for its end."
               << std::endl;
        waits_for_ = name;
        return false;
      }

      void
      begin(Slot &slot, const std::size_t c)
      {
        const fs::path folder = study_ / to_run_[c];
        // Whoever creates the claim has the case.
        const int claim =
          open((folder / "claim").c_str(), O_WRONLY | O_CREAT | O_EXCL, 0644);
        if (claim < 0 && errno == EEXIST)
          return;
        if (claim < 0)
          throw OutputError((folder / "claim").string(), std::strerror(errno));
        close(claim);
        slot.process.begin(folder.string());
        slot.c     = c;
        slot.start = Clock::now();
      }

      // Also writes the result of a case that has ended.
      void
      look_for_end(Slot &slot) const
      {
        const double wall_seconds =
          std::chrono::duration<double>(Clock::now() - slot.start).count();
        // A run that waits for something uses no CPU time.
        const bool too_long =
          options_.cpu_limit > 0 && wall_seconds > 10 * options_.cpu_limit + 60;
        std::optional<CaseEnd> end = slot.process.end();
        if (!end && too_long)
          end = slot.process.end_by_force();
        // What was told to end has no result.
        if (!end || (told_to_end_ && end->signal != 0))
          return;
        end->cpu_seconds        = std::round(1000 * end->cpu_seconds) / 1000;
        const fs::path   folder = study_ / to_run_[slot.c];
        const RunSummary result =
          judge_run(folder, *end, too_long && end->signal != 0, options_);
        write_run_summary((folder / "result.csv").string(), result);
        report(slot.c, end->cpu_seconds, result);
      }

      void
      report(const std::size_t c,
             const double      cpu,
             const RunSummary &result) const
      {
        const std::string &name = to_run_[c];
        std::ostringstream line;
        char               numbers[64];
        std::snprintf(numbers,
                      sizeof(numbers),
                      "%4zu/%zu %8.1f s  ",
                      c + 1,
                      to_run_.size(),
                      cpu);
        line << numbers << name << "  " << result.status;
        if (result.status != "done")
          line << " (" << result.reason << ") at " << result.stage << " "
               << result.load_factor;
        if (!description_.at(name).empty())
          line << "  " << description_.at(name);
        log_ << line.str() << std::endl;
      }

      const fs::path                     study_;
      const std::vector<std::string>    &to_run_;
      const SweepOptions                &options_;
      std::ostream                      &log_;
      std::map<std::string, std::string> description_; // of a folder
      std::vector<std::unique_ptr<Slot>> slots_;
      std::size_t                        next_        = 0;
      bool                               told_to_end_ = false;
      std::string                        waits_for_; // the case said to do so
    };
  } // namespace



  void
  run_cases(std::vector<SweepCase> &cases,
            const SweepOptions     &options,
            std::ostream           &log)
  {
    const fs::path                 study  = options.directory;
    const std::vector<std::string> to_run = assign_folders(cases, options);

    const unsigned int n_slots = options.side_by_side > 0 ?
                                   options.side_by_side :
                                 is_parallel() ? 1 :
                                                 n_available_cores();
    if (is_first_process())
      {
        log << cases.size() << (cases.size() == 1 ? " case, " : " cases, ")
            << to_run.size() << " to run, ";
        if (is_parallel())
          log << dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD)
              << " processes with " << n_slots << " at a time" << std::endl;
        else
          log << n_slots << " at a time" << std::endl;
      }
    RunningCases(cases, to_run, options, n_slots, log).run_all();

    wait_for_all_processes();
    if (is_first_process())
      for (const std::string &folder : to_run)
        fs::remove(study / folder / "claim");
    if (Ranks(MPI_COMM_WORLD).any(Interruption::requested()))
      throw StageFailed("The study was interrupted; the option --continue goes "
                        "on with its cases.",
                        "interrupted");
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
