// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how the rows of stages follow each other.

#include <npt_dealii/problems/plate_results/stage_starts.h>

#include <algorithm>

namespace NPT
{
  const CurveRow *
  row_before(const std::vector<CurveRow> &rows,
             const std::string           &stage,
             const StageStarts           &starts)
  {
    const auto is_of = [](const std::string &name) {
      return [&name](const CurveRow &row) { return row.stage == name; };
    };
    const auto start = starts.find(stage);
    if (start != starts.end())
      {
        const auto last =
          std::find_if(rows.rbegin(), rows.rend(), is_of(start->second));
        return last == rows.rend() ? nullptr : &*last;
      }
    const auto first = std::find_if(rows.begin(), rows.end(), is_of(stage));
    return first == rows.begin() ? nullptr : &*(first - 1);
  }



  std::vector<CurveRow>
  rows_to(const std::vector<CurveRow> &rows,
          const std::string           &stage,
          const StageStarts           &starts)
  {
    std::vector<CurveRow> result; // backwards
    const CurveRow       *before = nullptr;
    for (std::string name = stage;; name = before->stage)
      {
        for (auto row = rows.rbegin(); row != rows.rend(); ++row)
          if (row->stage == name)
            result.push_back(*row);
        before = row_before(rows, name, starts);
        if (before == nullptr || before->stage == name)
          break;
      }
    std::reverse(result.begin(), result.end());
    return result;
  }
} // namespace NPT
