// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the process that computes cases of a study, one after the other.

#ifndef npt_dealii_problems_parameter_study_case_process_h
#define npt_dealii_problems_parameter_study_case_process_h

#include <npt_dealii/problems/parameter_study/sweep.h>

#include <sys/types.h>

#include <optional>
#include <string>

namespace NPT
{
  /// Exit status of a process whose program could not be started, as in a
  /// shell.
  constexpr int exec_failed = 127;

  /// Exit status of runs that cannot write their results, see README.md.
  constexpr int output_failed = 4;

  /// How a case ended.
  struct CaseEnd
  {
    int    signal      = 0; ///< the one that ended it; 0: it ended by itself
    int    status      = 0; ///< exit status, if it ended by itself
    double cpu_seconds = 0; ///< of the case, its child processes included
  };

  /**
   * A place where cases of a study are computed, one at a time: `case.prm` of
   * their folder in, `screen.txt`, `error.txt` and the files of the run out.
   *
   * If it can, the process is a copy of this one, by fork(). It has the
   * program, which takes longer to load than a small case to compute, at hand;
   * it calls SweepOptions::run, tells how that ended, and takes the next case,
   * for which MPI, too, is there already. It ends with a case that crashes,
   * leaves, or has a status other than those of a run that came to its end,
   * was given up or was refused; the next case has a new one. Otherwise, where
   * MPI is initialized, which a copy cannot use, every case executes
   * SweepOptions::program.
   *
   * Either way a case has one thread, a limit of CPU time of its own, and no
   * memory of signals that this process listens to; it is ended when this
   * process ends. A copy leaves by _exit(), so that what this process has in
   * store for its own end (unwritten lines, temporary files) is not done twice.
   */
  class CaseProcess
  {
  public:
    explicit CaseProcess(const SweepOptions &options);

    /// Ends a process that waits for a case; leaves one that computes alone.
    ~CaseProcess();

    CaseProcess(const CaseProcess &) = delete;
    CaseProcess &
    operator=(const CaseProcess &) = delete;

    /**
     * Begin the case of a folder. No other case may be on its way.
     *
     * @throws dealii::ExceptionBase if no process can be started.
     */
    void
    begin(const std::string &folder);

    bool
    is_busy() const
    {
      return is_busy_;
    }

    /// Becomes readable when a copy tells how its case ended; -1: there is no
    /// copy.
    int
    channel() const
    {
      return channel_;
    }

    /// How the case ended, if it has.
    std::optional<CaseEnd>
    end();

    /// Kill the process of the case and wait for its end.
    CaseEnd
    end_by_force();

    /// Send a signal to the process of the case.
    void
    send(const int signal) const;

  private:
    void
    fork_process(const std::string &folder);
    void
    forget_process();
    std::optional<CaseEnd>
    end_of_process(const int options);

    const SweepOptions &options_;
    pid_t               pid_         = -1; ///< -1: there is none
    int                 channel_     = -1; ///< to a copy; -1: there is none
    double              cpu_seconds_ = 0;  ///< of its earlier cases
    bool                is_busy_     = false;
  };
} // namespace NPT

#endif
