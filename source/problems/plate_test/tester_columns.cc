// SPDX-License-Identifier: LGPL-2.1-or-later
// Columns of curves.csv in the terms of fabric testers.

#include <npt_dealii/homogenization/tester_terms.h>
#include <npt_dealii/problems/plate_results/curve_column.h>
#include <npt_dealii/problems/plate_test/plate_step.h>

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

    using Column = Registry<CurveColumn>::Registration;
    const Column angle("shear_angle",
                       {"degree", value<&TesterTerms::shear_angle>});
    const Column warp("warp_stretch", {"-", value<&TesterTerms::warp_stretch>});
    const Column weft("weft_stretch", {"-", value<&TesterTerms::weft_stretch>});
    const Column torque("shear_torque",
                        {"N/mm", value<&TesterTerms::shear_torque>});
    const Column force("frame_force",
                       {"N/mm", value<&TesterTerms::frame_force>});
  } // namespace
} // namespace NPT
