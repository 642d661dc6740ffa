// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines where the stages of a curve begin.

#ifndef npt_dealii_problems_plate_results_stage_starts_h
#define npt_dealii_problems_plate_results_stage_starts_h

#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <map>
#include <string>
#include <vector>

namespace NPT
{
  /// Stages that do not begin at the end of the one before them in the curve,
  /// with the name of that at whose end they do.
  using StageStarts = std::map<std::string, std::string>;

  /// The row of the state in which a stage began, or would begin behind the
  /// last row; nullptr if that is the undeformed cell.
  const CurveRow *
  row_before(const std::vector<CurveRow> &rows,
             const std::string           &stage,
             const StageStarts           &starts = {});

  /// The rows that lead from the undeformed cell to the end of a stage: one
  /// test, without the rows of others that began on its way.
  std::vector<CurveRow>
  rows_to(const std::vector<CurveRow> &rows,
          const std::string           &stage,
          const StageStarts           &starts = {});
} // namespace NPT

#endif
