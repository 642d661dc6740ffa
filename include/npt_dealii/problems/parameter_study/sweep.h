// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines running the cases of a study: each in a process and a folder of its
// own, side by side, and the table that says how they ended.

#ifndef npt_dealii_problems_parameter_study_sweep_h
#define npt_dealii_problems_parameter_study_sweep_h

#include <npt_dealii/problems/plate_results/run_summary.h>

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /// One case: a complete parameter file and how its run ended.
  struct SweepCase
  {
    /// What distinguishes the case: short names of the swept entries with
    /// their values, in the order of the file.
    std::vector<std::pair<std::string, std::string>> values;

    /// The complete, documented parameter file with all defaults. Two cases
    /// whose texts differ in comments and blank lines only are one run.
    std::string parameters;

    /// Folder of the run within the study's, "cases/0001"; set by run_cases().
    std::string folder;

    RunSummary result;
  };

  /// "Method mortar, Normal penalty 10".
  std::string
  describe_case(const SweepCase &c);

  struct SweepOptions
  {
    /// Existing folder of the study.
    std::string directory;

    /// Runs at a time; 0: as many as cores are available. With several MPI
    /// processes it is the number of each of them, and 0 means one.
    unsigned int side_by_side = 0;

    /// CPU time after which a run is ended [s]; 0: never.
    double cpu_limit = 0;

    /// Run finished cases again.
    bool repeat = false;

    /// Cases that were stopped go on where they were, by --continue.
    bool continues = false;

    /// Started as `program FOLDER/case.prm --output FOLDER`.
    std::string program = "/proc/self/exe";

    /// The same without starting a program: called with the arguments in a copy
    /// of this process, once for every case of the copy; returns the exit
    /// status. See CaseProcess.
    std::function<int(const std::vector<std::string> &arguments)> run;
  };

  /// Cores that this process may use.
  unsigned int
  n_available_cores();

  /**
   * Run all cases that are not finished and fill `folder` and `result` of all.
   *
   * Every case has a folder `cases/0001`, ... with `case.prm`, its parameters;
   * `screen.txt` and `error.txt`, what the program said; the files of the run;
   * and, written last, `result.csv`. A case counts as finished if some folder
   * has its parameters, comments apart, and a result worth keeping: "done",
   * "failed" (a stage was given up) or "refused", and "time limit" unless more
   * time is allowed now. So an interrupted study goes on where it was, a study
   * with more values runs the new cases only, and whatever is changed in the
   * parameters is computed anew. Folders of cases that the study no longer has
   * stay as they are.
   *
   * Every place, of those side by side, is a process of its own: whatever
   * happens to its case, the others go on. CPU seconds are those from the
   * reading of the case's parameters to its pictures. It runs with one thread.
   * See CaseProcess.
   *
   * While an object Interruption lives, a signal to end is handed on to the
   * cases, which end as plate tests do; then StageFailed is thrown.
   *
   * Collective over MPI_COMM_WORLD if MPI is initialized: the processes take
   * the next case each by creating the file `claim` in its folder, which must
   * be on a file system that all of them see. Results are complete on all
   * processes at the end.
   *
   * @param log One line per case that ends, and the numbers before.
   */
  void
  run_cases(std::vector<SweepCase> &cases,
            const SweepOptions     &options,
            std::ostream           &log);

  /**
   * Write the table of all cases: folder, swept values, status, reason, stage
   * and load factor reached, accepted steps, Newton iterations, cuts, CPU
   * seconds, unknowns.
   */
  void
  write_case_table(const std::string            &filename,
                   const std::vector<SweepCase> &cases);
} // namespace NPT

#endif
