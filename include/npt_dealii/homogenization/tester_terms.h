// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines in-plane shear in the terms of fabric testers: yarns and their angle.

#ifndef npt_dealii_homogenization_tester_terms_h
#define npt_dealii_homogenization_tester_terms_h

#include <npt_dealii/homogenization/macro_modes.h>

#include <array>

namespace NPT
{
  /**
   * What a shear frame shows of the plane stretch F = [[1 + H1, H3/2], [H3/2,
   * 1 + H2]]. The yarns a = F e_1 and b = F e_2 enclose pi/2 - g,
   *
   * @f[ \lambda_1 = |a|, \quad \lambda_2 = |b|, \quad
   *     \sin g = \frac{a \cdot b}{\lambda_1 \lambda_2}, \qquad
   *     m = \frac{\partial H_k}{\partial g} n_k
   *       = \frac{F_{11} F_{22}}{F_{11} + F_{22}} \left( 2 n_3
   *         - \frac{F_{12}}{F_{11}} n_1 - \frac{F_{12}}{F_{22}} n_2 \right) ,
   * @f]
   *
   * with the derivative at constant yarn stretches and without rotation: m dg
   * is the work per reference area of turning the yarns. With inextensible
   * yarns (trellis) m = n_3 cos(g/2) - (n_1 + n_2)/2 sin(g/2).
   *
   * Tensions are those of (A36). The bias force is that of a strip cut along
   * the bias e_b, per reference width, whose edges are free (bias extension),
   *
   * @f[ p = \frac{\lambda_b}{e_b \cdot U e_b}
   *         \left( \frac{n_1 + n_2}{2} + n_3 \right) , @f]
   *
   * which in other states is just this number.
   */
  struct TesterTerms
  {
    double shear_angle;  ///< g [degree]
    double warp_stretch; ///< lambda_1 [-]
    double weft_stretch; ///< lambda_2 [-]
    double shear_torque; ///< m [N/mm], moment per area
    double frame_force;  ///< F_sh = m / cos g [N/mm], as normalized by the
                         ///< side of a picture frame
    double warp_tension; ///< along the warp, at a constant angle [N/mm]
    double weft_tension; ///< along the weft [N/mm]
    double bias_stretch; ///< lambda_b [-]
    double bias_force;   ///< p [N/mm]
  };

  /// @param H, n Gradients and their conjugates; bending has no part in it.
  TesterTerms
  tester_terms(const std::array<double, MacroModes::n> &H,
               const std::array<double, MacroModes::n> &n);
} // namespace NPT

#endif
