// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the height over a bent plate.

#include <npt_dealii/base/second_order.h>
#include <npt_dealii/problems/plate_test/mean_height.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;
using Height = MeanHeight::Height;

TEST_CASE("Derivatives of the height are those of the formula", "[homogenize]")
{
  // (A26) with numbers that differentiate themselves.
  using Number                 = SecondOrder<Height::n_variables>;
  const double               k = GENERATE(0., 0.1, -0.3), direction = 0.4;
  const dealii::Tensor<1, 3> x({1.3, -0.7, 0.6});
  const Number x1 = Number::variable(0, x[0]), x2 = Number::variable(1, x[1]),
               x3        = Number::variable(2, x[2]),
               curvature = Number::variable(3, k),
               b1        = Number::variable(4, std::cos(direction)),
               b2        = Number::variable(5, std::sin(direction)),
               one       = Number::constant(1.);
  const Number along     = b1 * x1 + b2 * x2;
  const Number q         = 2. * x3 + curvature * (x3 * x3 + along * along);
  const Number expected  = q * inverse(square_root(one + curvature * q) + one);

  const Height d({{k, std::cos(direction), std::sin(direction)}}, x, true);
  CHECK(d.value == Approx(expected.value).epsilon(1e-14));
  for (unsigned int v = 0; v < Height::n_variables; ++v)
    {
      CHECK(d.gradient[v] == Approx(expected.gradient[v]).margin(1e-14));
      for (unsigned int w = 0; w < Height::n_variables; ++w)
        CHECK(d.hessian[v][w] == Approx(expected.hessian[v][w]).margin(1e-13));
    }
}

TEST_CASE("The height is the distance from the axis less the radius",
          "[homogenize]")
{
  const double radius = 5; // the axis runs along y through (0, 0, -5)
  const Height d({{1 / radius, 1., 0.}},
                 dealii::Tensor<1, 3>({1.2, 3., 0.4}),
                 false);
  CHECK(d.value == Approx(std::hypot(1.2, 0.4 + radius) - radius));
}
