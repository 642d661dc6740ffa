// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a column of curves.csv that registers itself.

#ifndef npt_dealii_problems_plate_results_curve_column_h
#define npt_dealii_problems_plate_results_curve_column_h

#include <npt_dealii/base/registry.h>

#include <functional>
#include <string>

namespace NPT
{
  /// What a column can be computed from, problems/plate_test/plate_step.h.
  struct PlateStep;

  /**
   * A column behind those of CurveRow. Its name in Registry<CurveColumn> is
   * that in the file; it is written, read back and plotted as the others. Like
   * every result it must not act back on the test.
   */
  struct CurveColumn
  {
    std::string                              unit; ///< "N/mm"; "-" for a number
    std::function<double(const PlateStep &)> value; ///< of an accepted step
  };
} // namespace NPT

#endif
