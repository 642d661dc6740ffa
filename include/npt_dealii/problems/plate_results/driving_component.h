// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines which macroscopic mode drives a part of a curve.

#ifndef npt_dealii_problems_plate_results_driving_component_h
#define npt_dealii_problems_plate_results_driving_component_h

#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace NPT
{
  /**
   * The amount of work that a mode does and takes back on the rows [first,
   * last], per area [N/mm],
   *
   * @f[ \sum_{rows} \tfrac{1}{2} (|n_k| + |n_k^-|) \, |H_k - H_k^-| . @f]
   *
   * Amounts, because the work of a step from -A to A cancels. It ranks modes
   * whose gradients cannot be compared: extensions have no unit, curvatures
   * have 1/mm.
   */
  double
  amount_of_work(const std::vector<CurveRow> &rows,
                 const std::size_t            first,
                 const std::size_t            last,
                 const unsigned int           k);

  /// Return the mode whose loading drives the given rows: the one with the
  /// largest amount of work. If no work is done at all, the first mode of the
  /// table that changes; nothing if none does.
  std::optional<unsigned int>
  driving_component(const std::vector<CurveRow> &rows);
} // namespace NPT

#endif
