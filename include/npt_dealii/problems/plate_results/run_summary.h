// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines summary.csv, the one row that says how a run ended: for studies, and
// for other programs that start many runs.

#ifndef npt_dealii_problems_plate_results_run_summary_h
#define npt_dealii_problems_plate_results_run_summary_h

#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <string>
#include <vector>

namespace NPT
{
  /// How a run ended.
  struct RunSummary
  {
    /// running, done, failed (a stage was given up, or the run was interrupted
    /// or met an error), refused (unusable input), crashed, or time limit; a
    /// run itself only knows the first three. One that was killed stays
    /// running.
    std::string status;

    /// Short name of the failure, LoadStepFailure::reason(), "" if done.
    std::string reason;

    /// The sentence of the program, "" if done.
    std::string message;

    std::string  stage; ///< last one with an accepted step, or first
    double       load_factor       = 0; ///< reached in that stage
    unsigned int steps             = 0; ///< accepted, all stages
    unsigned int newton_iterations = 0; ///< of accepted steps, all stages
    unsigned int cuts              = 0; ///< failed steps, all stages
    unsigned int n_unknowns        = 0; ///< of Newton's method, last stage
    double       cpu_seconds       = 0;
  };

  /// Stage, steps, iterations and cuts of a curve; status, reason and unknowns
  /// are left for the caller.
  RunSummary
  summarize_curve(const std::vector<CurveRow> &curve);

  /// The columns of summary.csv; tables of many runs have them too.
  const std::vector<std::string> &
  run_summary_columns();

  /// The values of a summary in these columns.
  std::vector<TableCell>
  run_summary_cells(const RunSummary &summary);

  /// Write a summary as a table of one row; the file appears complete or not at
  /// all.
  void
  write_run_summary(const std::string &filename, const RunSummary &summary);

  /// Throws InputError if the file is missing or not such a table.
  RunSummary
  read_run_summary(const std::string &filename);
} // namespace NPT

#endif
