// SPDX-License-Identifier: LGPL-2.1-or-later
// Columns of curves.csv in the terms of fabric testers.

#include <npt_dealii/homogenization/tester_terms.h>
#include <npt_dealii/problems/plate_results/curve_column.h>
#include <npt_dealii/problems/plate_test/plate_step.h>

#include <limits>

namespace NPT
{
  namespace
  {
    template <double TesterTerms::*term>
    double
    value(const PlateStep &plate)
    {
      std::array<double, MacroModes::n> H, n;
      for (unsigned int k = 0; k < MacroModes::n; ++k)
        {
          H[k] = plate.step.after.u[plate.cell.macro().mode(k)];
          n[k] = plate.step.after.reactions[k];
        }
      return tester_terms(H, n).*term;
    }

    constexpr double none = std::numeric_limits<double>::quiet_NaN();

    double
    plate_distance(const PlateStep &plate)
    {
      const double distance =
        plate.step.after.u[plate.cell.macro().plate_distance()];
      return distance > 0. ? distance : none;
    }

    double
    pressure(const PlateStep &plate)
    {
      return plate_distance(plate) > 0. ?
               -plate.step.after.reactions[MacroUnknowns::n_macro] /
                 plate.cell.fabric().area() :
               none;
    }

    // Volume of the bundles at rest over that between the plates.
    double
    bundle_fraction(const PlateStep &plate)
    {
      const double distance = plate_distance(plate);
      if (!(distance > 0.))
        return none;
      double volume = 0;
      for (const double part : plate.cell.bodies().integrals_of_functions(true))
        volume += part;
      const auto H = gradients_of(plate.cell.macro(), plate.step.after.u);
      return volume / (distance * plate.cell.fabric().area() *
                       ((1. + H[0]) * (1. + H[1]) - 0.25 * H[2] * H[2]));
    }

    using Column = Registry<CurveColumn>::Registration;
    const Column angle("shear_angle",
                       {"degree", value<&TesterTerms::shear_angle>});
    const Column warp("warp_stretch", {"-", value<&TesterTerms::warp_stretch>});
    const Column weft("weft_stretch", {"-", value<&TesterTerms::weft_stretch>});
    const Column torque("shear_torque",
                        {"N/mm", value<&TesterTerms::shear_torque>});
    const Column frame("frame_force",
                       {"N/mm", value<&TesterTerms::frame_force>});
    const Column warp_tension("warp_tension",
                              {"N/mm", value<&TesterTerms::warp_tension>});
    const Column weft_tension("weft_tension",
                              {"N/mm", value<&TesterTerms::weft_tension>});
    const Column bias_stretch("bias_stretch",
                              {"-", value<&TesterTerms::bias_stretch>});
    const Column bias_force("bias_force",
                            {"N/mm", value<&TesterTerms::bias_force>});

    const Column plates("plate_distance", {"mm", plate_distance});
    const Column of_plates("pressure", {"MPa", pressure});
    const Column fraction("bundle_fraction", {"-", bundle_fraction});
  } // namespace
} // namespace NPT
