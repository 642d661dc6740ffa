// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about in-plane stretch in the coordinates of the yarns.

#include <npt_dealii/homogenization/tester_terms.h>
#include <npt_dealii/homogenization/yarn_frame.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;

TEST_CASE("Stretch without rotation and yarns with their angle determine each "
          "other",
          "[homogenization]")
{
  for (const YarnFrame &frame : {YarnFrame{1., 1., 0.},
                                 YarnFrame{1.1, 0.9, 0.7},
                                 YarnFrame{0.95, 1.02, -1.2}})
    {
      const YarnFrame again =
        YarnFrames::of_gradients(YarnFrames::gradients(frame));
      CHECK(again.warp_stretch == Approx(frame.warp_stretch).epsilon(1e-14));
      CHECK(again.weft_stretch == Approx(frame.weft_stretch).epsilon(1e-14));
      CHECK(again.shear_angle ==
            Approx(frame.shear_angle).epsilon(1e-13).margin(1e-15));
    }
}



TEST_CASE("Derivatives of the yarns' coordinates are their differences",
          "[homogenization]")
{
  const Membrane H = {{0.05, -0.03, 0.6}};
  const double   d = 1e-5;
  for (const auto function : {YarnFrames::warp_stretch,
                              YarnFrames::weft_stretch,
                              YarnFrames::shear_angle,
                              YarnFrames::bias_stretch})
    for (unsigned int k = 0; k < 3; ++k)
      {
        Membrane plus = H, minus = H;
        plus[k] += d;
        minus[k] -= d;
        const auto at = function(H), a = function(minus), b = function(plus);
        CHECK(at.gradient[k] ==
              Approx((b.value - a.value) / (2. * d)).epsilon(1e-8));
        for (unsigned int l = 0; l < 3; ++l)
          CHECK(at.hessian[k][l] ==
                Approx((b.gradient[l] - a.gradient[l]) / (2. * d))
                  .epsilon(1e-7)
                  .margin(1e-8));
      }
}



TEST_CASE("Tensions and torque do the work of n1, n2, n3", "[homogenization]")
{
  const Membrane H = {{0.05, -0.03, 0.6}}, n = {{0.3, -0.2, 0.7}};
  const Membrane f = YarnFrames::conjugates(H, n);
  const auto     q = {YarnFrames::warp_stretch(H),
                      YarnFrames::weft_stretch(H),
                      YarnFrames::shear_angle(H)};
  for (unsigned int k = 0; k < 3; ++k)
    {
      double       sum = 0;
      unsigned int j   = 0;
      for (const auto &coordinate : q)
        sum += f[j++] * coordinate.gradient[k];
      CHECK(sum == Approx(n[k]).epsilon(1e-13));
    }
  // The closed form of the torque.
  const TesterTerms terms =
    tester_terms({{H[0], H[1], H[2], 0., 0., 0.}}, {{0.3, -0.2, 0.7}});
  CHECK(f[2] == Approx(terms.shear_torque).epsilon(1e-13));
}



TEST_CASE("A traction along the bias alone is the bias force",
          "[homogenization]")
{
  const Membrane    H       = {{0.05, -0.03, 0.6}};
  const auto        stretch = YarnFrames::bias_stretch(H);
  const auto       &v       = stretch.gradient;
  const TesterTerms terms =
    tester_terms({{H[0], H[1], H[2], 0., 0., 0.}},
                 {{0.4 * v[0], 0.4 * v[1], 0.4 * v[2], 0., 0., 0.}});
  CHECK(terms.bias_force == Approx(0.4).epsilon(1e-13));
  CHECK(terms.bias_stretch == stretch.value);
}
