// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the table of accepted load steps in the log of a plate test.

#ifndef npt_dealii_problems_plate_results_step_table_h
#define npt_dealii_problems_plate_results_step_table_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <string>
#include <vector>

namespace NPT
{
  /// One aligned line of the log per accepted load step; the titles of the
  /// columns are repeated when a stage begins.
  class StepTable
  {
  public:
    /// The log must outlive the table.
    explicit StepTable(RunLog &log);

    /**
     * Choose the modes whose gradients the table shows. Without a choice each
     * line shows the gradient that has the largest product with its conjugate.
     */
    void
    show_components(const std::vector<unsigned int> &components);

    /// Show columns of curves.csv in place of gradients, until components are
    /// chosen again.
    void
    show_columns(const std::vector<std::string> &columns);

    /// @param residual The last norm of the Newton iteration.
    void
    add_row(const CurveRow &row, const double residual);

  private:
    RunLog                   &log_;
    std::vector<unsigned int> components_;
    std::vector<std::string>  columns_;
    bool                      first_step_ = true;
    std::string               last_stage_;
  };
} // namespace NPT

#endif
