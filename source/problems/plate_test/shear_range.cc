// SPDX-License-Identifier: LGPL-2.1-or-later
// Shear angles against the contact surfaces of the cell.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/homogenization/yarn_frame.h>
#include <npt_dealii/problems/load_programme/tester_targets.h>
#include <npt_dealii/problems/plate_test/shear_range.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  namespace
  {
    constexpr double degree = dealii::numbers::PI / 180.;

    // What H3 alone makes of the right angle; that of a tester's stage as the
    // stage says.
    double
    largest_shear_angle(const LoadStage &stage)
    {
      if (const auto expected = TesterTargets::expected_shear_angle(stage))
        return std::abs(*expected);
      double angle = 0;
      for (const auto &[mode, target] : stage.H_targets)
        if (std::string(MacroModes::table[mode].name) == "H3")
          angle =
            std::abs(YarnFrames::of_gradients({{0., 0., target}}).shear_angle);
      return angle;
    }
  } // namespace



  double
  shear_angle_of_sub_unit_cell(const CellParameters &cell)
  {
    const auto along =
      [](const double spacing, const double width, const double other_width) {
        const double hypotenuse = std::hypot(spacing, width);
        return std::acos(std::min(1., other_width / hypotenuse)) -
               std::atan2(width, spacing);
      };
    // Crossings of the warp have the distance of the weft.
    const WarpWeft &L = cell.crossing_spacing, &w = cell.bundle_width;
    return std::max(0.,
                    std::min(along(L.weft, w.warp, w.weft),
                             along(L.warp, w.weft, w.warp)));
  }



  std::vector<std::string>
  doubts_of_shear(const PlateTestParameters &parameters)
  {
    std::vector<std::string> doubts;
    if (parameters.cell.type != "sub-unit cell")
      return doubts;
    const double limit = shear_angle_of_sub_unit_cell(parameters.cell);
    for (const LoadStage &stage : parameters.load_programme.stages)
      if (const double angle = largest_shear_angle(stage);
          angle > limit * (1. + 1e-9))
        doubts.push_back(
          "Stage " + stage.name + " shears by " +
          short_number(angle / degree, 3) + " degrees; beyond " +
          short_number(limit / degree, 3) +
          " degrees bundles of these widths touch farther from their crossing "
          "than half a spacing, where the sub-unit cell has no contact, and "
          "resultants come out too small. What to try: Type = two-crossing cell "
          "(subsection Cell).");
    return doubts;
  }
} // namespace NPT
