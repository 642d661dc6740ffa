// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the closest point: planes, cylinders, edges, corners, ridges and
// valleys.

#include <npt_dealii/contact/geometry/contact_search.h>

#include <limits>

#include "contact/contact_test_tools.h"
#include "iga/iga_test_tools.h"

using namespace ContactTests;

namespace
{
  // What makes u a local minimum of the distance on a surface that is smooth:
  // the slopes of half the squared distance, zero or held by a boundary.
  template <int dim>
  double
  defect_of_minimum(const Face<dim> &face, const ClosestPoint<dim> &c)
  {
    double worst = 0.;
    for (int k = 0; k < dim - 1; ++k)
      {
        const auto  &breaks = face.iga_surface.knot_vector(k).breaks();
        const double slope  = -(c.r * c.a[k]) / c.a[k].norm();
        if (c.u[k] <= breaks.front())
          worst = std::max(worst, -slope);
        else if (c.u[k] >= breaks.back())
          worst = std::max(worst, slope);
        else
          worst = std::max(worst, std::abs(slope));
      }
    return worst;
  }

  // A plane square [-1,1] (x [-1,1]) at height zero, skew parameters.
  template <int dim>
  NURBSPatch<dim>
  plane_slab()
  {
    const Map<dim> map = [](const Point<dim> &u) {
      Point<dim> x = u;
      x[0]         = 2. * u[0] - 1.;
      if (dim == 3)
        x[1] = 2. * u[1] - 1.;
      x[dim - 1] = u[dim - 1] - 1.;
      return x;
    };
    if constexpr (dim == 2)
      return slab<2>({{KnotVector::uniform(2, 3)}}, map);
    else
      return slab<3>({{KnotVector::uniform(2, 3), KnotVector::uniform(2, 2)}},
                     map);
  }
} // namespace



TEST_CASE("Over and under a plane the gap is the height", "[contact]")
{
  const Face<3> face(plane_slab<3>(), 2, 1);
  const Face<2> line(plane_slab<2>(), 1, 1);
  for (const double height : {0.7, 0.01, 0., -0.01, -0.4})
    for (const double x : {-0.95, -1. / 3., 0., 0.41})
      {
        const auto c = face.project(Point<3>(x, 0.3, height), {{0.9, 0.1}});
        REQUIRE(c.found);
        CHECK(std::abs(c.gap - height) < 1e-14); // rounding
        CHECK((c.normal - Tensor<1, 3>({0., 0., 1.})).norm() < 1e-14);
        CHECK(std::abs(c.u[0] - (x + 1.) / 2.) < 1e-14);
        CHECK(std::abs(c.u[1] - 0.65) < 1e-14);
        CHECK((c.free[0] && c.free[1] && !c.on_boundary));

        const auto d = line.project(Point<2>(x, height), {{0.9}});
        REQUIRE(d.found);
        CHECK(std::abs(d.gap - height) < 1e-14);
        CHECK((d.normal - Tensor<1, 2>({0., 1.})).norm() < 1e-14);
      }
}



TEST_CASE("Beside a plane the closest point lies on its edge or its corner",
          "[contact]")
{
  Face<3>      face(plane_slab<3>(), 2, 1);
  const double R = 0.25;
  for (const double radius : {0., R})
    for (const double height : {0.3, 0., -0.2})
      {
        face.surface.set_edge_radius(radius);
        const auto edge =
          face.project(Point<3>(1.4, 0.3, height), {{0.2, 0.2}});
        REQUIRE(edge.found);
        CHECK((!edge.free[0] && edge.free[1] && edge.on_boundary));
        CHECK(edge.u[0] == 1.);
        CHECK(std::abs(edge.u[1] - 0.65) < 1e-14); // rounding
        // Sharp: the distance. Rounded: the distance from a half circle whose
        // center lies below the edge, (A15) of doc/theory.md.
        const auto distance = [=](const double beside) {
          return std::hypot(beside, height + radius) - radius;
        };
        CHECK(std::abs(edge.gap - distance(0.4)) < 1e-14);
        CHECK((edge.r.norm() * edge.normal - edge.r).norm() < 1e-14);

        const auto corner =
          face.project(Point<3>(-1.3, 1.4, height), {{0.8, 0.1}});
        REQUIRE(corner.found);
        CHECK((!corner.free[0] && !corner.free[1] && corner.on_boundary));
        CHECK((corner.u[0] == 0. && corner.u[1] == 1.));
        CHECK(std::abs(corner.gap - distance(0.5)) < 1e-14);
      }
}



TEST_CASE("A penetrating point that slides over the edge keeps its gap",
          "[contact]")
{
  Face<3> face(plane_slab<3>(), 2, 1);
  face.surface.set_edge_radius(0.2);
  const double depth = 0.05;
  double       last  = -depth;
  for (double x = 0.99; x < 1.3; x += 1e-4)
    {
      const auto c = face.project(Point<3>(x, 0.3, -depth), {{0.9, 0.5}});
      REQUIRE(c.found);
      // A distance: its slope is at most one.
      CHECK(std::abs(c.gap - last) < 1.001e-4);
      last = c.gap;
    }
  CHECK(last > 0.13); // hypot(0.3, 0.15) - 0.2 = 0.1354
}



TEST_CASE("The gap to a cylinder is the difference of the radii", "[contact]")
{
  // Radii 1 and 2, height 3: exact by weights.
  const NURBSPatch<3> tube = IGATests::quarter_tube(1., 2., 3.);
  const Face<3>       outer(tube, 0, 1), inner(tube, 0, 0);
  for (const double radius : {0.7, 0.9, 1.3, 1.95, 2., 2.2, 4.})
    for (const double angle : {0.1, 0.8, 1.5})
      {
        INFO("radius " << radius << ", angle " << angle);
        const Tensor<1, 3> radial({std::cos(angle), std::sin(angle), 0.});
        Point<3>           x(0, 0, 1.2);
        x += radius * radial;

        const auto c = outer.project(x, {{0.5, 0.9}});
        REQUIRE(c.found);
        CHECK(std::abs(c.gap - (radius - 2.)) < 1e-13); // rounding
        CHECK((c.normal - radial).norm() < 1e-13);
        // Inside of the tube is outside of the body.
        const auto d = inner.project(x, {{0.4, 0.2}});
        REQUIRE(d.found);
        CHECK(std::abs(d.gap - (1. - radius)) < 1e-13);
        CHECK((d.normal + radial).norm() < 1e-13);
        // Height is linear in its parameter.
        CHECK(std::abs(d.u[1] - 0.4) < 1e-13);
      }

  // Above the rim the closest point slides along it.
  const auto rim = outer.project(Point<3>(1.5, 2., 3.4), {{0.1, 0.1}});
  REQUIRE(rim.found);
  CHECK((rim.free[0] && !rim.free[1] && rim.u[1] == 1.));
  CHECK(std::abs(rim.gap - std::hypot(0.5, 0.4)) < 1e-13);

  // In the plane: the ring.
  const Face<2> ring(IGATests::quarter_ring(1., 2.), 0, 1);
  const auto    c = ring.project(Point<2>(1.2, 0.9), {{1.}});
  REQUIRE(c.found);
  CHECK(std::abs(c.gap + 0.5) < 1e-13);
}



TEST_CASE("Along a path over edge and corner the open gap never grows faster "
          "than the point moves",
          "[contact]")
{
  const auto check = [](const auto &face, const auto &from, const auto &to) {
    auto         x          = from;
    const auto   d          = (to - from) / 400.;
    double       gap_before = 0., worst = 0.;
    auto         c     = face.project(x, {});
    unsigned int kinds = 0, changes = 0;
    for (unsigned int i = 0; i <= 400; ++i, x += d)
      {
        c = face.project(x, c.u);
        REQUIRE(c.found);
        unsigned int now = 0;
        for (unsigned int k = 0; k < c.free.size(); ++k)
          now += (c.free[k] ? 1 : 0) << k;
        if (i > 0)
          {
            // A distance is Lipschitz with the constant one.
            worst = std::max(worst, std::abs(c.gap - gap_before));
            changes += now != kinds ? 1 : 0;
          }
        kinds      = now;
        gap_before = c.gap;
      }
    CHECK(worst <= d.norm() * (1 + 1e-10));
    CHECK(changes >= 1);
    CHECK(changes <= 6); // interior, edge, corner, edge, interior and a spare
  };
  const Face<3> face(wavy_slab<3>(), 2, 1);
  check(face, Point<3>(-1.5, 0.2, 0.6), Point<3>(1.5, 0.5, 0.5));
  check(face, Point<3>(0.5, 1.5, 0.6), Point<3>(1.5, 0.3, 0.4));
  const Face<2> line(wavy_slab<2>(), 1, 1);
  check(line, Point<2>(-1.5, 0.5), Point<2>(1.5, 0.45));
}



TEST_CASE("Over a ridge the gap is continuous and belongs to the edge inside "
          "the normal cone",
          "[contact]")
{
  // Control points on the curve: the slope in the edge is 0.5 + 0.2 / 2.
  const double slope = 0.6;
  const auto   check = [slope](const auto &face) {
    constexpr int dim = std::decay_t<decltype(face.positions[0])>::dimension;
    double        before = 0.;
    unsigned int  n_edge = 0, n_entries = 0;
    bool          was_edge = false;
    const double  step     = 0.002;
    std::array<double, dim - 1> u;
    u.fill(-0.5);
    for (int i = -200; i <= 200; ++i)
      {
        Point<dim> x;
        x[0] = i * step;
        if (dim == 3)
          x[1] = 0.1;
        x[dim - 1]   = 0.3;
        const auto c = face.project(x, u);
        REQUIRE(c.found);
        // Inside the cone of the normals (-+slope, 1) the edge is closest.
        const bool edge = !c.free[0];
        if (std::abs(std::abs(x[0]) - 0.3 * slope) > 1e-9)
          CHECK(edge == (std::abs(x[0]) < 0.3 * slope));
        if (edge)
          CHECK(std::abs(c.gap - std::hypot(x[0], 0.3)) < 1e-13);
        if (i > -200)
          CHECK(std::abs(c.gap - before) <= step * (1 + 1e-10));
        n_edge += edge ? 1 : 0;
        n_entries += edge && !was_edge ? 1 : 0;
        was_edge = edge;

        // The same answer from the other side and from the answer itself.
        auto far = c.u;
        far[0]   = 0.7;
        CHECK(std::abs(face.project(x, far).gap - c.gap) < 1e-12);
        CHECK(std::abs(face.project(x, c.u).u[0] - c.u[0]) < 1e-14);
        before = c.gap;
        u      = c.u;
      }
    CHECK(n_edge > 100);
    CHECK(n_entries == 1);
  };
  check(Face<2>(roof<2>(0.5), 1, 1));
  check(Face<3>(roof<3>(0.5), 2, 1));
  check(Face<3>(roof<3>(0.5), 2, 1, Basis::Lagrange));
}



TEST_CASE("Under a valley the penetration is continuous and negative",
          "[contact]")
{
  const double  slope = -0.5;
  const Face<2> line(roof<2>(slope), 1, 1);
  const Face<3> face(roof<3>(slope), 2, 1, Basis::Bernstein);
  const double  step   = 0.002;
  double        before = 0.;
  unsigned int  n_edge = 0;

  std::array<double, 2> u = {{-0.4, 0.}};
  for (int i = -100; i <= 100; ++i)
    {
      const double x = i * step;
      const auto   c = face.project(Point<3>(x, 0.1, -0.2), u);
      REQUIRE(c.found);
      CHECK(c.gap < -0.1);
      if (!c.free[0])
        {
          ++n_edge;
          CHECK(std::abs(c.gap + std::hypot(x, 0.2)) < 1e-13);
        }
      if (i > -100)
        CHECK(std::abs(c.gap - before) <= step * (1 + 1e-10));
      before           = c.gap;
      u                = c.u;
      const auto again = face.project(Point<3>(x, 0.1, -0.2), u);
      CHECK(std::abs(again.u[0] - u[0]) < 1e-14);
      CHECK(again.free == c.free);
      CHECK(std::abs(line.project(Point<2>(x, -0.2), {{0.3}}).gap - c.gap) <
            1e-12);
    }
  CHECK(n_edge > 50);
}



TEST_CASE("Above a valley the walls take turns but the nearest gap is "
          "continuous",
          "[contact]")
{
  const Face<2> face(roof<2>(-0.5), 1, 1);
  double        before = 0.;
  for (int i = -50; i <= 50; ++i)
    {
      const Point<2> x(i * 0.004, 0.2);
      const auto a = face.project(x, {{-0.5}}), b = face.project(x, {{0.5}});
      REQUIRE((a.found && b.found));
      CHECK((a.free[0] && b.free[0])); // never stuck in the edge
      const double gap = std::min(a.gap, b.gap);
      if (i > -50)
        CHECK(std::abs(gap - before) <= 0.004 * (1 + 1e-10));
      before = gap;
    }
}



TEST_CASE("Across a rounded kink gap and normal are continuous on both sides",
          "[contact]")
{
  const auto check = [](const auto &face) {
    constexpr int dim = std::decay_t<decltype(face.positions[0])>::dimension;
    // Slopes of +-0.2 meet at the kink and +-0.3 stays below it around; the
    // turn of 0.4 takes 0.4 times the greatest curvature of a cubic, 1.5.
    const double step = 1e-3, greatest_turn = 2. * step;
    for (const double height : {0.1, -0.1})
      {
        ClosestPoint<dim>           c;
        Tensor<1, dim>              normal;
        double                      gap = 0.;
        std::array<double, dim - 1> u;
        u.fill(0.);
        for (int i = -300; i <= 300; ++i)
          {
            Point<dim> x;
            x[0] = i * step;
            if (dim == 3)
              x[1] = 0.1;
            x[dim - 1] = height;
            u[0]       = i < 0 ? -0.4 : 0.4;
            c          = face.project(x, u);
            REQUIRE(c.found);
            CHECK(c.free[0]);
            if (i > -300)
              {
                CHECK(std::abs(c.gap - gap) <= 0.3 * step);
                CHECK((c.normal - normal).norm() < greatest_turn);
              }
            gap    = c.gap;
            normal = c.normal;
          }
      }
  };
  for (const double slope : {0.1, -0.1})
    {
      check(Face<2>(roof<2>(slope), 1, 1, Basis::NURBS, 0.2));
      check(Face<3>(roof<3>(slope), 2, 1, Basis::Bernstein, 0.2));
      check(Face<3>(roof<3>(slope), 2, 1, Basis::Lagrange, 0.2));
    }
}



TEST_CASE("Knots of full multiplicity in a smooth surface are not felt",
          "[contact]")
{
  const NURBSPatch<3> patch = wavy_slab<3>();
  const Face<3>       smooth(patch, 2, 1), c0(patch, 2, 1, Basis::Bernstein),
    lagrange(patch, 2, 1, Basis::Lagrange);
  std::mt19937 generator(5);
  for (unsigned int i = 0; i < 60; ++i)
    {
      Point<3> x;
      x += random_vector<3>(generator, 1.2);
      x[2] *= 0.3;
      const auto a = smooth.project(x, {{0.05, -0.05}});
      // From the other end of the surface, over all knots.
      const auto b = c0.project(x, a.u), c = c0.project(x, {{0.05, -0.05}});
      const auto d = lagrange.project(x, a.u);
      REQUIRE((a.found && b.found && c.found && d.found));
      CHECK(std::abs(a.gap - b.gap) < 1e-12); // rounding
      CHECK(std::abs(a.gap - d.gap) < 1e-12);
      CHECK(std::abs(a.gap - c.gap) < 1e-12);
    }
}



TEST_CASE("From any start value the projection near a surface ends in the same "
          "point",
          "[contact]")
{
  const Face<3> face(wavy_slab<3>(), 2, 1);
  const Face<3> tube(IGATests::quarter_tube(1., 2., 3.), 0, 1);
  std::mt19937  generator(11);
  double        spread = 0.;
  for (unsigned int i = 0; i < 12; ++i)
    {
      Point<3>   x;
      const auto v = random_vector<3>(generator, 0.8);
      x += v;
      x[2]                    = face.value({{v[0], v[1]}})[2] + 0.2 * v[2];
      const auto     expected = face.project(x, {{v[0], v[1]}});
      const Point<3> y(1.5, 1.2 + 0.3 * v[0], 1.5 + v[1]);
      const auto     on_tube = tube.project(y, {{0.5, 0.5}});
      for (const double s : {-1., -0.7, 0.1, 1.})
        for (const double t : {-1., 0.3, 1.})
          {
            const auto c = face.project(x, {{s, t}});
            const auto d = tube.project(y, {{0.5 + s / 2, 0.5 + t / 2}});
            REQUIRE((c.found && d.found));
            for (unsigned int k = 0; k < 2; ++k)
              spread = std::max({spread,
                                 std::abs(c.u[k] - expected.u[k]),
                                 std::abs(d.u[k] - on_tube.u[k])});
          }
    }
  CHECK(spread < 1e-12); // rounding in the slopes over a Hessian near 0.5
}



TEST_CASE("The answer is a local minimum, for points and starts in no pattern",
          "[contact]")
{
  const Face<3> face(wavy_slab<3>(3, 0.3), 2, 1);
  const Face<2> line(wavy_slab<2>(2, 0.3), 1, 1);
  std::mt19937  generator(1);
  unsigned int  n_lost = 0;
  double        worst  = 0.;
  for (unsigned int i = 0; i < 400; ++i)
    {
      Point<3> x;
      x += random_vector<3>(generator, 1.7);
      const auto u = random_vector<2>(generator, 1.);
      const auto c = face.project(x, {{u[0], u[1]}});
      if (!c.found)
        ++n_lost;
      else
        worst = std::max(worst, defect_of_minimum(face, c));
      const auto d = line.project(Point<2>(x[0], x[1]), {{u[0]}});
      if (!d.found)
        ++n_lost;
      else
        worst = std::max(worst, defect_of_minimum(line, d));
    }
  CHECK(n_lost == 0);
  CHECK(worst < 1e-11); // rounding of the slope, lengths of about two
}



TEST_CASE("A cell far from the origin projects as well as one at it",
          "[contact]")
{
  const NURBSPatch<3> patch = wavy_slab<3>();
  NURBSPatch<3>       moved = patch;
  const Tensor<1, 3>  shift({3000., -2000., 500.});
  moved.transform([&](const Point<3> &x) { return x + shift; });
  const Face<3> near(patch, 2, 1), far(moved, 2, 1);
  std::mt19937  generator(2);
  for (unsigned int i = 0; i < 60; ++i)
    {
      Point<3> x;
      x += random_vector<3>(generator, 0.9);
      x[2] *= 0.2;
      const auto a = near.project(x, {{0., 0.}});
      const auto b = far.project(x + shift, {{0., 0.}});
      REQUIRE(a.found);
      REQUIRE(b.found);
      // Positions carry rounding of 3000 times 2e-16.
      CHECK(std::abs(a.gap - b.gap) < 1e-11);
    }
}



TEST_CASE("Degenerate input is reported as not found instead of hanging",
          "[contact]")
{
  Face<3>      face(wavy_slab<3>(), 2, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(!face.project(Point<3>(nan, 0., 0.), {{0., 0.}}).found);
  const auto positions = face.positions;

  face.positions.assign(positions.size(), Point<3>(0.1, 0.2, 0.3));
  CHECK(!face.project(Point<3>(1., 0., 0.), {{0.1, 0.1}}).found);
  face.positions    = positions;
  face.positions[7] = Point<3>(nan, nan, nan);
  CHECK(!face.project(Point<3>(-0.5, -0.5, 0.), {{-0.5, -0.5}}).found);

  // A surface crumpled to a line still ends.
  face.positions = positions;
  for (auto &P : face.positions)
    P = Point<3>(P[0], 0., 0.);
  face.project(Point<3>(0.3, 0.5, 0.4), {{0.1, 0.1}});
}



TEST_CASE("Third derivatives come only when asked for and change nothing else",
          "[contact]")
{
  const Face<3>  face(wavy_slab<3>(3), 2, 1);
  const Point<3> x(0.2, -0.3, 0.3);
  const auto     a = face.project(x, {{0., 0.}}, false);
  const auto     b = face.project(x, {{0., 0.}}, true);
  CHECK(a.u == b.u);
  CHECK(a.gap == b.gap);
  double size = 0.;
  for (const auto &t : b.x_third)
    size += t.norm();
  CHECK(size > 1e-2);
}



TEST_CASE("The search offers starts that lead to the globally nearest point",
          "[contact]")
{
  const Face<3>               face(wavy_slab<3>(2, 0.3), 2, 1);
  const NPT::ContactSearch<3> search({face.surface}, {face.positions});
  std::mt19937                generator(4);
  for (unsigned int i = 0; i < 30; ++i)
    {
      Point<3> x;
      x += random_vector<3>(generator, 1.2);
      x[2] *= 0.4;
      double best = 1e9, sampled = 1e9;
      for (const auto &start : search.nearest(x, 3))
        best = std::min(best, face.project(x, start.u).r.norm());
      for (unsigned int s = 0; s <= 40; ++s)
        for (unsigned int t = 0; t <= 40; ++t)
          sampled =
            std::min(sampled,
                     x.distance(face.value({{s / 20. - 1., t / 20. - 1.}})));
      CHECK(best <= sampled + 1e-13); // rounding
    }
}
