// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about shear in the terms of fabric testers.

#include <npt_dealii/homogenization/tester_terms.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;

namespace
{
  using Six = std::array<double, MacroModes::n>;

  // The stretch with given yarns and angle [rad], without rotation: the root
  // of C = F^T F.
  Six
  gradients(const double warp, const double weft, const double g)
  {
    const double C11 = warp * warp, C22 = weft * weft,
                 C12 = warp * weft * std::sin(g);
    const double det = std::sqrt(C11 * C22 - C12 * C12);
    const double sum = std::sqrt(C11 + C22 + 2. * det);
    return {{(C11 + det) / sum - 1.,
             (C22 + det) / sum - 1.,
             2. * C12 / sum,
             0.,
             0.,
             0.}};
  }
} // namespace



TEST_CASE("A trellis has unstretched yarns and the torque of the formula",
          "[homogenization]")
{
  // 10, 20, 40 degrees; H3 = 2 sin(g/2), H1 = H2 = cos(g/2) - 1.
  for (const double degrees : {10., 20., 40.})
    {
      const double g = degrees * M_PI / 180.;
      const Six    H = {
           {std::cos(g / 2) - 1., std::cos(g / 2) - 1., 2. * std::sin(g / 2)}};
      const Six         n     = {{0.3, -0.1, 0.7}};
      const TesterTerms terms = tester_terms(H, n);
      CHECK(terms.shear_angle == Approx(degrees).epsilon(1e-12));
      CHECK(terms.warp_stretch == Approx(1.).epsilon(1e-14));
      CHECK(terms.weft_stretch == Approx(1.).epsilon(1e-14));
      const double m = 0.7 * std::cos(g / 2) - 0.1 * std::sin(g / 2);
      CHECK(terms.shear_torque == Approx(m).epsilon(1e-12));
      CHECK(terms.frame_force == Approx(m / std::cos(g)).epsilon(1e-12));
    }
}



TEST_CASE("Torque is the work of turning yarns of constant stretch",
          "[homogenization]")
{
  const Six    n    = {{0.3, -0.2, 0.7}};
  const double step = 1e-6;
  for (const double g : {-0.4, 0.05, 0.8})
    {
      const Six H = gradients(1.1, 0.95, g), a = gradients(1.1, 0.95, g - step),
                b = gradients(1.1, 0.95, g + step);
      double work = 0;
      for (unsigned int k = 0; k < 3; ++k)
        work += n[k] * (b[k] - a[k]) / (2. * step);
      const TesterTerms terms = tester_terms(H, n);
      CHECK(terms.shear_torque == Approx(work).epsilon(1e-8));
      CHECK(terms.warp_stretch == Approx(1.1).epsilon(1e-12));
      CHECK(terms.weft_stretch == Approx(0.95).epsilon(1e-12));
      CHECK(terms.shear_angle * M_PI / 180. == Approx(g).epsilon(1e-12));
    }
}
