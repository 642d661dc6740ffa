// SPDX-License-Identifier: LGPL-2.1-or-later
// Curvatures against the sizes of the cell.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/curvature_range.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace NPT
{
  namespace
  {
    // A curvature that a stage prescribes.
    struct Bend
    {
      std::string what;      // the begin of a sentence
      double      curvature; // [1/mm]
      double      spacing;   // of the crossings along the bent direction [mm]
      bool        is_objective; // neighboring cells turn
    };

    std::vector<Bend>
    all_bends(const PlateTestParameters &parameters)
    {
      const WarpWeft   &spacing = parameters.cell.crossing_spacing;
      std::vector<Bend> bends;
      for (const LoadStage &stage : parameters.load_programme.stages)
        for (const auto &[mode, target] : stage.H_targets)
          {
            const MacroMode &macro_mode = MacroModes::table[mode];
            if (macro_mode.kind != MacroMode::Kind::bending || target == 0.)
              continue;
            const std::string name = macro_mode.name;
            const double      curvature =
              std::abs(target) * (name == "H6" ? 0.5 : 1.);
            bends.push_back(
              {"Stage " + stage.name + " bends by " + name +
                 " to a radius of " + short_number(1. / curvature, 3) + " mm",
               curvature,
               name == "H4" ? spacing.weft :
               name == "H5" ? spacing.warp :
                              std::max(spacing.warp, spacing.weft),
               stage.bends_along.has_value()});
          }
      return bends;
    }

    // The largest curvature times a length, of those that count.
    const Bend *
    worst(const std::vector<Bend>                   &bends,
          const std::function<double(const Bend &)> &product)
    {
      const Bend *result = nullptr;
      for (const Bend &bend : bends)
        if (product(bend) > (result == nullptr ? 0. : product(*result)))
          result = &bend;
      return result;
    }
  } // namespace



  std::vector<std::string>
  doubts_of_curvature(const PlateTestParameters &parameters)
  {
    const std::vector<Bend>  bends = all_bends(parameters);
    std::vector<std::string> doubts;
    const double             t = layer_thickness(parameters.cell);
    if (const Bend *bend =
          worst(bends, [&](const Bend &b) { return 0.5 * b.curvature * t; });
        bend != nullptr && 0.5 * bend->curvature * t > 0.2)
      doubts.push_back(bend->what + ", and the layer is " + short_number(t, 3) +
                       " mm thick: its faces are stretched and shortened by " +
                       short_number(50. * bend->curvature * t, 2) +
                       " %, too much for the moment of a plate.");
    if (parameters.cell.type == "laminate")
      return doubts;
    const auto slope = [](const Bend &b) { return b.curvature * b.spacing; };
    if (const Bend *bend = worst(bends, slope);
        bend != nullptr && slope(*bend) > 1.)
      doubts.push_back(bend->what +
                       ", less than the distance of the "
                       "crossings, " +
                       short_number(bend->spacing, 3) +
                       " mm: so bent, a fabric is no plate, and its curvature "
                       "a mean of kinks. Below " +
                       short_number(1. / bend->spacing, 2) +
                       " 1/mm the radius is larger.");
    if (const Bend *bend =
          worst(bends,
                [&](const Bend &b) { return b.is_objective ? 0. : slope(b); });
        bend != nullptr && slope(*bend) > 0.1)
      doubts.push_back(
        bend->what + ", and the crossings are " +
        short_number(bend->spacing, 3) +
        " mm apart: with linear jumps such slopes act as strains of " +
        short_number(12.5 * slope(*bend) * slope(*bend), 2) +
        " %. What to try: Jumps = objective (subsection Homogenization), or a "
        "smaller curvature.");
    return doubts;
  }
} // namespace NPT
