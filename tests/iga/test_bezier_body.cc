// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about points in rational Bezier solids.

#include <npt_dealii/iga/bezier_body.h>

#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  using dealii::Point;
  using namespace NPT;

  // A block [0,4] x [-1,1] x [0,h(y)], h from 1 at the edges to 2, curved along
  // x; with weights, so that it is rational.
  NURBSPatch<3>
  arched_block()
  {
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int j = 0; j < 3; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double y = j - 1.;
            points.emplace_back(2. * i,
                                y,
                                (i == 1 ? 0.5 : 0.) + k * (j == 1 ? 3. : 1.));
            weights.push_back(j == 1 ? 0.8 : 1.);
          }
    const KnotVector quadratic = KnotVector::uniform(2, 1);
    NURBSPatch<3>    patch({{quadratic, quadratic, KnotVector::uniform(1, 1)}},
                        points,
                        weights);
    patch.make_isotropic();
    for (unsigned int d = 0; d < 3; ++d)
      patch.subdivide(d, 3 - d);
    return patch;
  }
} // namespace



TEST_CASE(
  "A point of a body is found at its own parameters, one outside is not",
  "[iga]")
{
  for (const Basis basis : {Basis::NURBS, Basis::Bernstein})
    {
      const IGASpace<3> space({arched_block()}, {}, basis);
      const BezierBody  body(space, 0, space.control_points());
      CHECK(body.n_cells() == 3 * 2 * 1);
      for (const double a : {0.1, 0.5, 0.93})
        for (const double b : {0.07, 0.5, 0.8})
          for (const double c : {0., 0.3, 1.})
            {
              const Point<3> x     = arched_block().value(Point<3>(a, b, c));
              const auto     found = body.find(x);
              REQUIRE(found);
              CHECK((found->span[0] + found->xi[0]) / 3 ==
                    Approx(a).margin(1e-8));
              CHECK((found->span[1] + found->xi[1]) / 2 ==
                    Approx(b).margin(1e-8));
              CHECK(found->xi[2] == Approx(c).margin(1e-8));
              CHECK(body.value(*found).distance(x) < 1e-8);
            }
      CHECK(!body.find(Point<3>(2., 0., -0.1)));
      CHECK(!body.find(Point<3>(2., 1.01, 0.5)));
      CHECK(!body.find(Point<3>(2., 0.9, 1.9)));
    }
}



TEST_CASE("Depth in a straight bar is the distance from its nearest side, and "
          "its ends do not count",
          "[iga]")
{
  std::vector<Point<3>> corners;
  for (unsigned int l = 0; l < 8; ++l)
    corners.emplace_back(10. * (l % 2), 4. * (l / 2 % 2), 1. * (l / 4));
  const KnotVector linear = KnotVector::uniform(1, 1);
  NURBSPatch<3>    bar({{linear, linear, linear}},
                    corners,
                    std::vector<double>(8, 1.));
  bar.subdivide(0, 4);
  bar.subdivide(1, 3);
  bar.subdivide(2, 2);
  const IGASpace<3> space({bar}, {}, Basis::NURBS);
  const BezierBody  body(space, 0, space.control_points());
  const auto        depth = [&](const Point<3> &x) {
    const auto place = body.find(x);
    REQUIRE(place);
    return body.depth(*place);
  };
  CHECK(depth(Point<3>(5., 2., 0.4)) == Approx(0.4));
  CHECK(depth(Point<3>(5., 2., 0.7)) == Approx(0.3));
  CHECK(depth(Point<3>(5., 3.9, 0.5)) == Approx(0.1));
  CHECK(depth(Point<3>(0.01, 2., 0.5)) == Approx(0.5));

  // With a round edge: 0.1 and 0.2 from two faces are sqrt(0.3^2 + 0.2^2) from
  // its center, and the corner is outside.
  const auto rounded = [&](const Point<3> &x) {
    return body.depth(*body.find(x), 0.4);
  };
  CHECK(rounded(Point<3>(5., 3.9, 0.8)) == Approx(0.4 - std::sqrt(0.13)));
  CHECK(rounded(Point<3>(5., 3.99, 0.99)) < 0.);
  CHECK(rounded(Point<3>(5., 2., 0.7)) == Approx(0.3));

  const BezierBody moved =
    body.mapped([](const unsigned int, const unsigned int, const Point<3> &x) {
      return x + Point<3>(100., 0., 0.);
    });
  CHECK(!moved.find(Point<3>(5., 2., 0.4)));
  CHECK(moved.find(Point<3>(105., 2., 0.4)));
}
