// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the variations of gap, closest point and metric by differences.

#include <npt_dealii/contact/geometry/contact_kinematics.h>

#include "contact/contact_test_tools.h"

using namespace ContactTests;
using NPT::ContactKinematics;

namespace
{
  // A direction in which point and control points move.
  template <int dim>
  struct Motion
  {
    Tensor<1, dim>              point;
    std::vector<Tensor<1, dim>> positions;

    Motion(const Face<dim> &face, std::mt19937 &generator)
      : point(random_vector<dim>(generator, 0.5))
    {
      for (unsigned int l = 0; l < face.positions.size(); ++l)
        positions.push_back(random_vector<dim>(generator, 0.5));
    }
  };

  template <int dim>
  typename ContactKinematics<dim>::Row
  jets_of(const ClosestPoint<dim> &c, const Motion<dim> &motion)
  {
    typename ContactKinematics<dim>::Row row{};
    for (int i = 0; i < dim; ++i)
      row[i] = motion.point[i];
    for (unsigned int l = 0; l < c.shape.lattice.size(); ++l)
      for (int i = 0; i < dim; ++i)
        {
          const double P = motion.positions[c.shape.lattice[l]][i];
          unsigned int f = 0;
          row[i] -= c.shape.value[l] * P;
          for (const auto &first : c.shape.first)
            row[dim * ++f + i] += first[l] * P;
          for (const auto &second : c.shape.second)
            row[dim * ++f + i] += second[l] * P;
        }
    return row;
  }

  template <typename Row>
  double
  dot(const Row &a, const Row &b)
  {
    double sum = 0.;
    for (unsigned int k = 0; k < a.size(); ++k)
      sum += a[k] * b[k];
    return sum;
  }

  // The closest point after a step along a motion.
  template <int dim>
  ClosestPoint<dim>
  moved(const Face<dim>         &face,
        const Point<dim>        &x,
        const ClosestPoint<dim> &c,
        const Motion<dim>       &motion,
        const double             h)
  {
    auto positions = face.positions;
    for (unsigned int l = 0; l < positions.size(); ++l)
      positions[l] += h * motion.positions[l];
    // From inside of the same span: in a ridge the two sides differ.
    auto start = c.u;
    for (unsigned int k = 0; k < start.size(); ++k)
      {
        const auto &breaks = face.iga_surface.segment_breaks(k);
        start[k] +=
          0.01 *
          (0.5 * (breaks[c.segment[k]] + breaks[c.segment[k] + 1]) - c.u[k]);
      }
    ClosestPoint<dim> result;
    NPT::project(
      face.surface, positions, x + h * motion.point, start, true, result);
    REQUIRE(result.found);
    REQUIRE(result.free == c.free);
    return result;
  }

  template <int dim>
  void
  check_variations(const Face<dim>                   &face,
                   const Point<dim>                  &x,
                   const std::array<double, dim - 1> &start,
                   const std::array<bool, dim - 1>   &free)
  {
    constexpr int m  = dim - 1;
    using Kinematics = ContactKinematics<dim>;
    const auto c     = face.project(x, start, true);
    REQUIRE(c.found);
    REQUIRE(c.free == free);
    const Kinematics kinematics(c);

    std::mt19937      generator(8);
    const Motion<dim> d(face, generator), e(face, generator);
    const auto        jets_d = jets_of(c, d), jets_e = jets_of(c, e);

    // Central differences: error h^2 plus 1e-16/h.
    const double h  = 1e-5;
    const auto plus = moved(face, x, c, d, h), minus = moved(face, x, c, d, -h);
    const auto check = [h](const double p, const double m_, const double v) {
      CHECK(std::abs((p - m_) / (2 * h) - v) < 1e-8 * (1 + std::abs(v)));
    };
    check(plus.gap, minus.gap, dot(kinematics.gap_variation(), jets_d));
    for (int a = 0; a < m; ++a)
      {
        check(plus.u[a],
              minus.u[a],
              dot(kinematics.parameter_variation(a), jets_d));
        for (int b = a; b < m; ++b)
          check(plus.a[a] * plus.a[b],
                minus.a[a] * minus.a[b],
                dot(kinematics.metric_variation(
                      SymmetricIndices<m>::second(a, b)),
                    jets_d));
      }

    // Second variations: the first ones along e, before and after a step
    // along d, at the closest point that moves along.
    std::array<double, m> traction;
    for (int a = 0; a < m; ++a)
      traction[a] = 0.7 - 1.6 * a;
    const Kinematics at_plus(plus), at_minus(minus);
    const auto jets_plus = jets_of(plus, e), jets_minus = jets_of(minus, e);
    for (const bool with_traction : {false, true})
      for (const double pressure : {0., -1.3})
        {
          const auto t = with_traction ? traction : std::array<double, m>{};
          std::array<double, Kinematics::n * Kinematics::n> M{};
          kinematics.add_second_variation(pressure, t, M);
          double value = 0., skew = 0.;
          for (unsigned int k = 0; k < Kinematics::n; ++k)
            for (unsigned int l = 0; l < Kinematics::n; ++l)
              {
                value += jets_e[k] * M[k * Kinematics::n + l] * jets_d[l];
                skew = std::max(skew,
                                std::abs(M[k * Kinematics::n + l] -
                                         M[l * Kinematics::n + k]));
              }
          CHECK(skew < 1e-13); // rounding
          double p = pressure * dot(at_plus.gap_variation(), jets_plus),
                 q = pressure * dot(at_minus.gap_variation(), jets_minus);
          for (int a = 0; a < m; ++a)
            {
              p += t[a] * dot(at_plus.parameter_variation(a), jets_plus);
              q += t[a] * dot(at_minus.parameter_variation(a), jets_minus);
            }
          check(p, q, value);
        }
  }
} // namespace



TEST_CASE("Variations of gap, closest point and metric are derivatives: inside "
          "of a surface, open, closed and nearly touching",
          "[contact]")
{
  const Face<2> line2(wavy_slab<2>(2), 1, 1), line3(wavy_slab<2>(3), 1, 1);
  const Face<3> face2(wavy_slab<3>(2), 2, 1), face3(wavy_slab<3>(3), 2, 1);
  for (const double gap : {0.2, 1e-9, -0.15})
    {
      const auto above = [gap](const auto &face, const auto &u) {
        const auto on = face.project(face.value(u), u);
        return face.value(u) + gap * on.normal;
      };
      for (const Face<2> *line : {&line2, &line3})
        check_variations<2>(*line,
                            above(*line, std::array<double, 1>{{0.3}}),
                            {{0.3}},
                            {{true}});
      const std::array<double, 2> u = {{-0.2, 0.3}};
      for (const Face<3> *face : {&face2, &face3})
        check_variations<3>(*face, above(*face, u), u, {{true, true}});
    }
}



TEST_CASE("Variations are derivatives beside the edges and corners of a "
          "surface",
          "[contact]")
{
  Face<2> line(wavy_slab<2>(), 1, 1);
  Face<3> face(wavy_slab<3>(3), 2, 1);
  // Sharp and rounded, over and under the tangent plane.
  for (const double radius : {0., 0.3})
    {
      line.surface.set_edge_radius(radius);
      face.surface.set_edge_radius(radius);
      for (const double height : {0.4, -0.3})
        {
          INFO("radius " << radius << ", height " << height);
          check_variations<2>(line, Point<2>(1.2, height), {{0.9}}, {{false}});
          check_variations<3>(face,
                              Point<3>(1.4, 0.1, height),
                              {{0.9, 0.}},
                              {{false, true}});
          check_variations<3>(face,
                              Point<3>(0.1, -1.3, height),
                              {{0., -0.9}},
                              {{true, false}});
          check_variations<3>(face,
                              Point<3>(1.4, -1.3, height),
                              {{0.9, -0.9}},
                              {{false, false}});
        }
    }
}



TEST_CASE("Variations are derivatives in the normal cone of a ridge and of a "
          "valley",
          "[contact]")
{
  const Face<2> ridge(roof<2>(0.5), 1, 1), valley(roof<2>(-0.5), 1, 1);
  check_variations<2>(ridge, Point<2>(0.05, 0.3), {{-0.4}}, {{false}});
  check_variations<2>(valley, Point<2>(0.05, -0.3), {{-0.4}}, {{false}});
  const Face<3> ridge3(roof<3>(0.5), 2, 1), valley3(roof<3>(-0.5), 2, 1);
  check_variations<3>(ridge3,
                      Point<3>(0.05, 0.1, 0.3),
                      {{-0.4, 0.3}},
                      {{false, true}});
  check_variations<3>(valley3,
                      Point<3>(0.05, 0.1, -0.3),
                      {{-0.4, 0.3}},
                      {{false, true}});
}
