// SPDX-License-Identifier: LGPL-2.1-or-later
// In-plane shear in the terms of fabric testers.

#include <npt_dealii/homogenization/tester_terms.h>
#include <npt_dealii/homogenization/yarn_frame.h>

#include <cmath>

namespace NPT
{
  TesterTerms
  tester_terms(const std::array<double, MacroModes::n> &H,
               const std::array<double, MacroModes::n> &n)
  {
    const double F11 = 1. + H[0], F22 = 1. + H[1], F12 = 0.5 * H[2];
    TesterTerms  terms;
    terms.warp_stretch = std::hypot(F11, F12);
    terms.weft_stretch = std::hypot(F12, F22);
    const double g =
      std::asin((F11 + F22) * F12 / (terms.warp_stretch * terms.weft_stretch));
    terms.shear_angle  = g * 180. / dealii::numbers::PI;
    terms.shear_torque = F11 * F22 / (F11 + F22) *
                         (2. * n[2] - F12 / F11 * n[0] - F12 / F22 * n[1]);
    terms.frame_force         = terms.shear_torque / std::cos(g);
    const Membrane H_membrane = {{H[0], H[1], H[2]}};
    const Membrane f = YarnFrames::conjugates(H_membrane, {{n[0], n[1], n[2]}});
    terms.warp_tension = f[0];
    terms.weft_tension = f[1];
    terms.bias_stretch = YarnFrames::bias_stretch(H_membrane).value;
    terms.bias_force   = terms.bias_stretch / (0.5 * (F11 + F22) + F12) *
                       (0.5 * (n[0] + n[1]) + n[2]);
    return terms;
  }
} // namespace NPT
