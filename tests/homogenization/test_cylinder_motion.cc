// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the motions of a bent plate.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/homogenization/cylinder_motion.h>

#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  using namespace NPT;
  using dealii::Tensor;

  // Stretched, sheared, and bent by k n (x) n.
  Gradients
  bent(const double k, const Tensor<1, 2> &n)
  {
    return {{0.05,
             -0.1,
             0.2,
             k * n[0] * n[0],
             k * n[1] * n[1],
             2. * k * n[0] * n[1]}};
  }

  double
  distance(const RigidMotion &a, const RigidMotion &b)
  {
    return (a.R - b.R).norm() + (a.t - b.t).norm();
  }
} // namespace



TEST_CASE("The motions of a sheared plate that is bent about any one axis are "
          "a group, also beyond a full turn",
          "[homogenization]")
{
  for (const double angle : {0., 0.3, 1.2, -0.7})
    for (const double k : {0., 0.1, -0.4, 1.5})
      {
        const Tensor<1, 2>   n({std::cos(angle), std::sin(angle)});
        const CylinderMotion motion(n);
        const Gradients      H = bent(k, n);
        const Tensor<1, 2>   p({2., -1.}), q({3., 1.7});
        const RigidMotion    P = motion.at(H, p), Q = motion.at(H, q);
        const RigidMotion    PQ{P.R * Q.R, P.R * Q.t + P.t};
        CHECK(distance(PQ, motion.at(H, p + q)) < 1e-12);
        CHECK((transpose(P.R) * P.R -
               Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()))
                .norm() < 1e-13);
      }
}



TEST_CASE("A bent plate lies on the circle of its curvature per undeformed "
          "length",
          "[homogenization]")
{
  // Radius (1 + H1)/H4, angle H4 Y1.
  const Gradients   H = {{0.25, 0., 0., 0.5, 0., 0.}};
  const double      r = 1.25 / 0.5, theta = 0.5 * 3.;
  const RigidMotion S =
    CylinderMotion(Tensor<1, 2>({1., 0.})).at(H, Tensor<1, 2>({3., 7.}));
  CHECK(
    (S.t - Tensor<1, 3>({r * std::sin(theta), 7., r * (std::cos(theta) - 1.)}))
      .norm() < 1e-14);
  CHECK((S.R * Tensor<1, 3>({0., 0., 1.}) -
         Tensor<1, 3>({std::sin(theta), 0., std::cos(theta)}))
          .norm() < 1e-14);
}



TEST_CASE("To first order the motions move points as the macroscopic modes do",
          "[homogenization]")
{
  // x = p + z becomes S_p z; the modes are those of its straight position, up
  // to the rotation about the point itself that the frame adds.
  const CylinderMotion motion(Tensor<1, 2>({0.8, 0.6}));
  const Tensor<1, 2>   p({1.3, -0.4}), a({2., 1.});
  const Tensor<1, 3>   z({0., 0., 0.35});
  const auto           x = [&](const Gradients &H, const Tensor<1, 2> &at) {
    return motion.at(H, at)(z);
  };
  for (unsigned int n = 0; n < MacroModes::n; ++n)
    {
      const double h = 1e-6;
      Gradients    plus{}, minus{};
      plus[n]                     = h;
      minus[n]                    = -h;
      const Tensor<1, 2> q        = p + a;
      const Tensor<1, 3> at_q     = (x(plus, q) - x(minus, q)) / (2. * h);
      const Tensor<1, 3> at_p     = (x(plus, p) - x(minus, p)) / (2. * h);
      const Tensor<1, 3> expected = macroscopic_jump(
        n,
        SymmetryOperation::translation("", Tensor<1, 3>({a[0], a[1], 0.})),
        dealii::Point<3>(p[0], p[1], z[2]));
      INFO("H" << n + 1);
      CHECK((at_q - at_p - expected).norm() < 1e-8);
    }
}



TEST_CASE("Derivatives of the motions are those by differences, also for "
          "curvatures without a group",
          "[homogenization]")
{
  const CylinderMotion motion(Tensor<1, 2>({0.8, -0.6}));
  const Tensor<1, 2>   p({1.3, -2.4});
  for (const double scale : {0., 1.})
    {
      Gradients H = {{0.1, -0.05, 0.2, 0.3, -0.2, 0.25}};
      for (unsigned int n = 3; n < 6; ++n)
        H[n] *= scale;
      const auto d = motion.derivatives_at(H, p);
      // Those of first order alone are the same.
      const auto first = motion.first_derivatives_at(H, p);
      for (unsigned int i = 0; i < 3; ++i)
        {
          CHECK(first.t[i].value == Approx(d.t[i].value));
          for (unsigned int n = 0; n < MacroModes::n; ++n)
            {
              CHECK(first.t[i].gradient[n] ==
                    Approx(d.t[i].gradient[n]).margin(1e-14));
              for (unsigned int j = 0; j < 3; ++j)
                CHECK(first.R[i][j].gradient[n] ==
                      Approx(d.R[i][j].gradient[n]).margin(1e-14));
            }
        }
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        {
          const double h    = 1e-5;
          Gradients    plus = H, minus = H;
          plus[n] += h;
          minus[n] -= h;
          const auto above = motion.derivatives_at(plus, p),
                     below = motion.derivatives_at(minus, p);
          const auto check =
            [&](const auto &at, const auto &high, const auto &low) {
              CHECK(at.gradient[n] ==
                    Approx((high.value - low.value) / (2. * h)).margin(1e-8));
              for (unsigned int k = 0; k < MacroModes::n; ++k)
                CHECK(at.hessian[n][k] ==
                      Approx((high.gradient[k] - low.gradient[k]) / (2. * h))
                        .margin(1e-8));
            };
          for (unsigned int i = 0; i < 3; ++i)
            {
              check(d.t[i], above.t[i], below.t[i]);
              for (unsigned int j = 0; j < 3; ++j)
                check(d.R[i][j], above.R[i][j], below.R[i][j]);
            }
        }
    }
}
