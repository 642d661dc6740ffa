// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of surfaces that turn into the body at round ends.

#include <npt_dealii/iga/iga_surface.h>
#include <npt_dealii/iga/round_end.h>

#include <algorithm>
#include <cmath>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;

namespace
{
  // Position and its derivatives of one order in the last parameter.
  template <int dim>
  Point<dim>
  in_last_parameter(const IGASurface<dim>                   &surface,
                    const std::array<double, dim - 1>       &u,
                    const unsigned int                       order,
                    const std::array<unsigned int, dim - 1> *segment = nullptr)
  {
    constexpr int         m = dim - 1;
    SurfaceShape<dim - 1> shape;
    surface.evaluate(u, order, shape, segment);
    const std::vector<double> &values =
      order == 0 ? shape.value :
      order == 1 ? shape.first[m - 1] :
      order == 2 ? shape.second[SymmetricIndices<m>::second(m - 1, m - 1)] :
                   shape.third[SymmetricIndices<m>::third(m - 1, m - 1, m - 1)];
    Point<dim> x;
    for (unsigned int l = 0; l < values.size(); ++l)
      x += values[l] * surface.reference_position(shape.lattice[l]);
    return x;
  }



  // The points of a surface of the general patch, with round ends of a length,
  // against the map of the body.
  template <int dim>
  double
  distance_from_body(const bool         rational,
                     const Basis        basis,
                     const unsigned int side,
                     const double       length)
  {
    constexpr int         m     = dim - 1;
    const NURBSPatch<dim> patch = general_patch<dim>(rational);
    const IGASpace<dim>   space({patch}, {}, basis);
    const IGASurface<dim> surface(space, 0, m, side, 0., length);
    const auto           &across  = patch.knot_vector(m - 1).breaks();
    const auto           &through = patch.knot_vector(m).breaks();
    double                error   = 0.;
    for (double t = 0.; t <= 1.; t += 1. / 64)
      {
        std::array<double, dim - 1> u;
        u[0]     = 0.37;
        u[m - 1] = across.front() + t * (across.back() - across.front());
        Point<dim> place;
        place[0]          = 0.37;
        place[m - 1]      = u[m - 1];
        double       tau  = 0.;
        const double low  = across.front() + length,
                     high = across.back() - length;
        if (u[m - 1] < low)
          {
            tau          = (low - u[m - 1]) / length;
            place[m - 1] = low - length * value_of(RoundEnd::way(), tau);
          }
        if (u[m - 1] > high)
          {
            tau          = (u[m - 1] - high) / length;
            place[m - 1] = high + length * value_of(RoundEnd::way(), tau);
          }
        const double depth = 0.5 * (through.back() - through.front()) *
                             value_of(RoundEnd::depth(), tau);
        place[m] = side == 0 ? through.front() + depth : through.back() - depth;
        error    = std::max(error,
                         patch.value(place).distance(
                           in_last_parameter<dim>(surface, u, 0)));
      }
    return error;
  }



  // A bar of 4 by 0.8, three spans long and n spans wide.
  NURBSPatch<3>
  bar(const unsigned int n)
  {
    std::vector<Point<3>> points;
    for (unsigned int A = 0; A < 8; ++A)
      points.emplace_back(3. * (A % 2), 4. * (A / 2 % 2), 0.8 * (A / 4));
    const KnotVector line = KnotVector::uniform(1, 1);
    NURBSPatch<3>    patch({{line, line, line}}, points);
    for (unsigned int d = 0; d < 3; ++d)
      patch.elevate_degree(d, 1);
    patch.subdivide(0, 3);
    patch.subdivide(1, n);
    patch.subdivide(2, 2);
    return patch;
  }
} // namespace



TEST_CASE("A surface with round ends is the map of the body along their curve, "
          "in all bases, whatever knots the curve meets",
          "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {false, true})
      for (const unsigned int side : {0, 1})
        for (const double length : {0.07, 0.3, 0.41})
          {
            if (basis == Basis::Lagrange && rational)
              continue; // interpolates a rational body
            INFO(name(basis) << ", rational " << rational << ", side " << side
                             << ", length " << length);
            // Rounding in powers of degree up to 15.
            CHECK(distance_from_body<2>(rational, basis, side, length) < 1e-11);
            CHECK(distance_from_body<3>(rational, basis, side, length) < 1e-11);
          }
}



TEST_CASE("A surface with round ends is C1 wherever its knots allow it, also "
          "where the ends begin",
          "[iga]")
{
  const IGASpace<3>   space({general_patch<3>(true)}, {}, Basis::NURBS);
  const IGASurface<3> surface(space, 0, 2, 1, 0., 0.41);
  const auto         &breaks = surface.segment_breaks(1);
  // Two ends and the flat part between them; the curve crosses the knot 0.3.
  CHECK(surface.n_segments(1) == 4);
  double jump = 0.;
  for (unsigned int i = 1; i + 1 < breaks.size(); ++i)
    {
      CHECK(surface.is_smooth(1, i));
      const std::array<double, 2>       u      = {{0.37, breaks[i]}};
      const std::array<unsigned int, 2> before = {{1, i - 1}}, after = {{1, i}};
      for (const unsigned int order : {0, 1})
        jump = std::max(jump,
                        in_last_parameter<3>(surface, u, order, &before)
                          .distance(
                            in_last_parameter<3>(surface, u, order, &after)));
    }
  CHECK(jump < 1e-12); // rounding
}



TEST_CASE("Functions of round ends have the derivatives that differences show",
          "[iga]")
{
  const double        h = 1e-4;
  const IGASpace<3>   space({general_patch<3>(true)}, {}, Basis::NURBS);
  const IGASurface<3> surface(space, 0, 2, 0, 0., 0.3);
  for (const double v : {0.05, 0.2, 0.77, 0.93})
    for (unsigned int order = 0; order < 3; ++order)
      {
        const auto at = [&](const double w) {
          return in_last_parameter<3>(surface, {{0.37, w}}, order);
        };
        const auto slope =
          in_last_parameter<3>(surface, {{0.37, v}}, order + 1);
        const Tensor<1, 3> difference = (at(v + h) - at(v - h)) / (2. * h);
        // h^2 times derivatives of higher order, which are below 1e4.
        CHECK((difference - slope).norm() < 1e-5 * (1. + slope.norm()));
      }
}



TEST_CASE("The round edge of a rectangular bar is a half circle within 0.9 %, "
          "meets the side in the middle, and leaves the face as it is",
          "[iga]")
{
  const IGASpace<3>   space({bar(7)}, {}, Basis::NURBS);
  const IGASurface<3> flat(space, 0, 2, 1), round(space, 0, 2, 1, 0., 0.1);
  // The radius is 0.4: a tenth of the width, and half of the height.
  double         least = 1e300, most = 0.;
  const Point<3> center(1., 0.4, 0.4);
  for (double v = 0.; v <= 0.1; v += 0.005)
    {
      const double r =
        in_last_parameter<3>(round, {{1. / 3., v}}, 0).distance(center);
      least = std::min(least, r / 0.4);
      most  = std::max(most, r / 0.4);
    }
  CHECK(least > 0.991);
  CHECK(most < 1.009);

  const Point<3> side = in_last_parameter<3>(round, {{1. / 3., 0.}}, 0);
  CHECK(side.distance(Point<3>(1., 0., 0.4)) < 1e-14);
  const Point<3> along = in_last_parameter<3>(round, {{1. / 3., 0.}}, 1);
  CHECK(std::abs(along[1]) < 1e-13);
  CHECK(along[2] > 1.);

  SurfaceShape<2> a, b;
  flat.evaluate({{0.4, 0.35}}, 3, a);
  round.evaluate({{0.4, 0.35}}, 3, b);
  CHECK(a.lattice == b.lattice);
  CHECK(a.value == b.value);
  CHECK(a.third == b.third);
}



TEST_CASE("The area of a surface with round ends is the length of its section "
          "times that of the bar, whether or not ends begin at a knot",
          "[iga]")
{
  // Length of the curve (A47) in a square of side 0.4.
  double    length = 0.;
  const int n      = 20000;
  for (int i = 0; i < n; ++i)
    {
      const auto at = [](const double tau) {
        return Point<2>(value_of(RoundEnd::way(), tau),
                        value_of(RoundEnd::depth(), tau));
      };
      length += 0.4 * at((i + 1.) / n).distance(at(static_cast<double>(i) / n));
    }
  for (const unsigned int n_across : {3, 7, 10})
    {
      INFO(n_across << " spans across");
      const IGASpace<3>   space({bar(n_across)}, {}, Basis::NURBS);
      const IGASurface<3> surface(space, 0, 2, 1, 0., 0.1);
      double              area = 0.;
      for (const auto &point : surface.quadrature(0))
        {
          CHECK(point.area > 0.);
          area += point.area;
        }
      // Three Gauss points on a quarter turn.
      CHECK(area == Approx(3. * (3.2 + 2. * length)).epsilon(2e-4));
    }
}



TEST_CASE(
  "Gauss points of a round end belong to the control points of the face",
  "[iga]")
{
  const IGASpace<3>   space({bar(3)}, {}, Basis::NURBS);
  const IGASurface<3> surface(space, 0, 2, 1, 0., 0.1);
  CHECK(surface.n_control_points() > surface.n_face_control_points());
  CHECK(surface.n_face_control_points() == 5 * 5);
  double       sum_error = 0.;
  unsigned int beyond    = 0;
  for (const auto &point : surface.quadrature(0))
    {
      double sum = 0.;
      for (const double R : point.averaging.value)
        sum += R;
      sum_error = std::max(sum_error, std::abs(sum - 1.));
      for (const unsigned int l : point.averaging.lattice)
        beyond += l >= surface.n_face_control_points();
    }
  CHECK(sum_error < 1e-14); // rounding
  CHECK(beyond == 0);
}
