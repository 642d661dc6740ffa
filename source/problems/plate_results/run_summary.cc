// SPDX-License-Identifier: LGPL-2.1-or-later
// Writing and reading of summary.csv.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_results/run_summary.h>

namespace NPT
{
  RunSummary
  summarize_curve(const std::vector<CurveRow> &curve)
  {
    RunSummary result;
    if (curve.empty())
      return result;
    result.stage       = curve.back().stage;
    result.load_factor = curve.back().load_factor;
    result.steps       = curve.size();
    result.cpu_seconds = curve.back().cpu_seconds;
    for (const CurveRow &row : curve)
      {
        result.newton_iterations += row.newton_iterations;
        result.cuts += row.cuts;
      }
    return result;
  }



  const std::vector<std::string> &
  run_summary_columns()
  {
    static const std::vector<std::string> columns = {"status",
                                                     "reason",
                                                     "stage",
                                                     "load_factor",
                                                     "steps",
                                                     "newton_iterations",
                                                     "cuts",
                                                     "unknowns",
                                                     "cpu_seconds",
                                                     "message"};
    return columns;
  }



  std::vector<TableCell>
  run_summary_cells(const RunSummary &summary)
  {
    return {summary.status,
            summary.reason,
            summary.stage,
            summary.load_factor,
            summary.steps,
            summary.newton_iterations,
            summary.cuts,
            summary.n_unknowns,
            summary.cpu_seconds,
            summary.message};
  }



  void
  write_run_summary(const std::string &filename, const RunSummary &summary)
  {
    write_table(filename,
                run_summary_columns(),
                {run_summary_cells(summary)},
                {"How the run ended: last stage and the load factor reached in "
                 "it; sums over all accepted steps."});
  }



  RunSummary
  read_run_summary(const std::string &filename)
  {
    const Table table = read_table(filename);
    if (table.n_rows() != 1)
      throw InputError("The file '" + filename + "' has " +
                       std::to_string(table.n_rows()) +
                       " rows; the summary of a run has one.");
    RunSummary result;
    result.status            = table.text_column("status")[0];
    result.reason            = table.text_column("reason")[0];
    result.stage             = table.text_column("stage")[0];
    result.message           = table.text_column("message")[0];
    result.load_factor       = table.column("load_factor")[0];
    result.steps             = table.column("steps")[0];
    result.newton_iterations = table.column("newton_iterations")[0];
    result.cuts              = table.column("cuts")[0];
    result.n_unknowns        = table.column("unknowns")[0];
    result.cpu_seconds       = table.column("cpu_seconds")[0];
    return result;
  }
} // namespace NPT
