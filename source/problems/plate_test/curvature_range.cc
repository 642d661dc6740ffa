// SPDX-License-Identifier: LGPL-2.1-or-later
// Curvatures against the sizes of the cell.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/curvature_range.h>

#include <cmath>

namespace NPT
{
  namespace
  {
    // The largest curvature of the programme.
    struct LargestCurvature
    {
      std::string  stage;
      unsigned int mode         = 0;
      double       value        = 0; // [1/mm]
      bool         is_objective = false;
    };

    LargestCurvature
    largest_curvature(const std::vector<LoadStage> &stages)
    {
      LargestCurvature largest;
      for (const LoadStage &stage : stages)
        for (const auto &[mode, target] : stage.H_targets)
          {
            if (MacroModes::table[mode].kind != MacroMode::Kind::bending)
              continue;
            const bool   is_torsion = mode == MacroModes::number_of("H6");
            const double value = std::abs(target) * (is_torsion ? 0.5 : 1.);
            if (value > largest.value)
              largest = {stage.name,
                         mode,
                         value,
                         stage.bends_along.has_value()};
          }
      return largest;
    }
  } // namespace



  std::vector<std::string>
  doubts_of_curvature(const PlateTestParameters &parameters)
  {
    const LargestCurvature largest =
      largest_curvature(parameters.load_programme.stages);
    std::vector<std::string> doubts;
    if (largest.value == 0.)
      return doubts;
    const CellParameters &cell = parameters.cell;
    const double          k    = largest.value;
    const double          t    = layer_thickness(cell);
    const double      spacing  = largest.mode == MacroModes::number_of("H5") ?
                                   cell.crossing_spacing.warp :
                                   cell.crossing_spacing.weft;
    const std::string what     = "Stage " + largest.stage + " bends by " +
                             MacroModes::table[largest.mode].name +
                             " to a radius of " + short_number(1. / k, 3) +
                             " mm";
    if (0.5 * k * t > 0.2)
      doubts.push_back(what + ", and the layer is " + short_number(t, 3) +
                       " mm thick: its faces are stretched and shortened by " +
                       short_number(50. * k * t, 2) +
                       " %, too much for the moment of a plate.");
    if (cell.type == "laminate")
      return doubts;
    if (k * spacing > 1.)
      doubts.push_back(what + ", less than the distance of the crossings, " +
                       short_number(spacing, 3) +
                       " mm: so bent, a fabric is no plate, and its curvature "
                       "a mean of kinks. Below " +
                       short_number(1. / spacing, 2) +
                       " 1/mm the radius is larger.");
    if (!largest.is_objective && k * spacing > 0.1)
      doubts.push_back(
        what + ", and the crossings are " + short_number(spacing, 3) +
        " mm apart: with linear jumps such slopes act as strains of " +
        short_number(12.5 * k * k * spacing * spacing, 2) +
        " %. What to try: Jumps = objective (subsection Homogenization), or a "
        "smaller curvature.");
    return doubts;
  }
} // namespace NPT
