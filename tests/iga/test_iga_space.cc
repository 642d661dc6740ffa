// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the discrete space: cells, joined control points,
// reference elements, and Bezier coefficients.

#include <npt_dealii/iga/element_table.h>

#include <deal.II/base/polynomials_bernstein.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;
using Catch::Matchers::Contains;

namespace
{
  const double right_angle = std::acos(0.);

  // Quarter ring with two spans along the radius and three along the angle.
  NURBSPatch<2>
  refined_ring(const double begin)
  {
    NURBSPatch<2> ring = quarter_ring(1., 2., begin);
    ring.subdivide(0, 2);
    ring.subdivide(1, 3);
    return ring;
  }



  template <int dim>
  void
  check_reference_elements()
  {
    for (const Basis basis : all_bases)
      {
        const IGASpace<dim> space({general_patch<dim>(true)}, {}, basis);
        const unsigned int  p          = space.degree(0);
        const auto         &element    = space.reference_element(0);
        const auto          order      = lexicographic_numbering(element);
        const auto         &polynomial = space.local_polynomials(0);
        REQUIRE(p == 3);
        REQUIRE(order.size() == element.n_dofs_per_cell());

        Point<dim> x;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] = 0.13 + 0.29 * d;
        double error = 0.;
        for (unsigned int a = 0; a < order.size(); ++a)
          {
            double       product = 1.;
            unsigned int rest    = a;
            for (unsigned int d = 0; d < dim; ++d)
              {
                product *= polynomial[rest % (p + 1)].value(x[d]);
                rest /= p + 1;
              }
            error =
              std::max(error,
                       std::abs(product - element.shape_value(order[a], x)));
          }
        INFO(name(basis));
        CHECK(error < 1e-14); // products of numbers below one
      }
  }



  template <int dim>
  void
  check_triangulation()
  {
    const NURBSPatch<dim>  patch = general_patch<dim>(true);
    NURBSPatch<dim>        finer = patch;
    dealii::Tensor<1, dim> away;
    away[0] = 5.;
    finer.transform([&](const Point<dim> &X) { return X + away; });
    finer.subdivide(dim - 1, 2);
    const IGASpace<dim> space({patch, finer, patch}, {0, 0, 1}, Basis::NURBS);

    unsigned int n_cells = 0;
    for (unsigned int i = 0; i < 3; ++i)
      {
        unsigned int n = 1;
        for (unsigned int d = 0; d < dim; ++d)
          n *= space.patch(i).knot_vector(d).n_spans();
        n_cells += n;
      }
    REQUIRE(space.cells().size() == n_cells);
    REQUIRE(space.triangulation().n_active_cells() == n_cells);
    CHECK(n_cells == 6 + 12 + 6);

    unsigned int           c     = 0;
    double                 error = 0.;
    std::set<unsigned int> vertices[3];
    for (const auto &cell : space.triangulation().active_cell_iterators())
      {
        const unsigned int i = space.cells()[c].patch;
        CHECK(cell->active_cell_index() == c);
        CHECK(cell->material_id() == i);
        for (const unsigned int v : cell->vertex_indices())
          {
            vertices[i].insert(cell->vertex_index(v));
            // Vertex v of the cell is corner v of the span.
            Point<dim> t;
            for (unsigned int d = 0; d < dim; ++d)
              t[d] = (v >> d) & 1;
            error = std::max(error,
                             cell->vertex(v).distance(space.patch(i).value(
                               parameter_in_cell(space, c, t))));
          }
        ++c;
      }
    CHECK(error < 1e-14); // the same sums
    // No vertex belongs to two patches: two of them are apart, two coincide but
    // belong to different bodies.
    CHECK(vertices[0].size() + vertices[1].size() + vertices[2].size() ==
          space.triangulation().n_used_vertices());
  }



  template <int dim>
  void
  check_bezier_coefficients(const bool rational)
  {
    std::mt19937                           generator(5);
    std::uniform_real_distribution<double> number(-1., 1.);
    for (const Basis basis : all_bases)
      {
        const IGASpace<dim> space({general_patch<dim>(rational)}, {}, basis);
        const unsigned int  p     = space.degree(0);
        double              error = 0., weight_error = 0.;
        for (unsigned int c = 0; c < space.cells().size(); ++c)
          {
            const auto indices = space.control_points_of_cell(c);
            std::vector<std::vector<double>> coefficients(
              indices.size(), std::vector<double>(2));
            for (auto &v : coefficients)
              for (double &x : v)
                x = number(generator);
            std::vector<double> weights;
            const auto          bezier =
              space.bezier_coefficients(c, coefficients, weights);
            REQUIRE(bezier.size() == indices.size());
            REQUIRE(weights.size() == indices.size());

            for (unsigned int q = 0; q < 5; ++q)
              {
                Point<dim> t;
                for (unsigned int d = 0; d < dim; ++d)
                  t[d] = 0.5 + 0.5 * number(generator);
                const auto R =
                  direct_functions(space, c, parameter_in_cell(space, c, t));
                for (unsigned int k = 0; k < 2; ++k)
                  {
                    double field = 0., sum = 0., W = 0.;
                    for (unsigned int l = 0; l < R.size(); ++l)
                      {
                        field += R[l] * coefficients[l][k];
                        double       B    = weights[l];
                        unsigned int rest = l;
                        for (unsigned int d = 0; d < dim; ++d)
                          {
                            B *= dealii::PolynomialsBernstein<double>(rest %
                                                                        (p + 1),
                                                                      p)
                                   .value(t[d]);
                            rest /= p + 1;
                          }
                        W += B;
                        sum += B * bezier[l][k];
                      }
                    error = std::max(error, std::abs(sum / W - field));
                  }
              }
            if (basis == Basis::Lagrange || !rational)
              for (const double w : weights)
                weight_error = std::max(weight_error, std::abs(w - 1.));
          }
        INFO(name(basis) << ", rational " << rational);
        // Lagrange to Bernstein of degree 3: condition number about 10 per
        // direction.
        CHECK(error < 1e-12);
        CHECK(weight_error < 1e-12);
      }
  }
} // namespace



TEST_CASE("A basis is found by its name only", "[iga]")
{
  for (const Basis basis : all_bases)
    CHECK(value_of<Basis>(name(basis)) == basis);
  CHECK_THAT(input_error([]() { value_of<Basis>("nurbs"); }),
             Contains("'nurbs'") && Contains("Lagrange"));
}



TEST_CASE("Reference elements are tensor products of the local polynomials",
          "[iga]")
{
  check_reference_elements<2>();
  check_reference_elements<3>();
}



TEST_CASE("Every knot span is one cell that carries the number of its patch",
          "[iga]")
{
  check_triangulation<2>();
  check_triangulation<3>();
}



TEST_CASE("Cells are neighbors across the patches of a body, not across bodies",
          "[iga]")
{
  const std::vector<NURBSPatch<2>> quarters = {refined_ring(0.),
                                               refined_ring(right_angle),
                                               refined_ring(2 * right_angle),
                                               refined_ring(3 * right_angle)};
  for (const Basis basis : all_bases)
    {
      const auto neighbors_of_other_patches =
        [&](const std::vector<unsigned int> &bodies) {
          const IGASpace<2> ring(quarters, bodies, basis);
          unsigned int      n = 0;
          for (const auto &cell : ring.triangulation().active_cell_iterators())
            for (const unsigned int f : cell->face_indices())
              if (!cell->at_boundary(f) &&
                  cell->neighbor(f)->material_id() != cell->material_id())
                ++n;
          return n;
        };
      INFO(name(basis));
      // Four seams with two spans, seen from both sides.
      CHECK(neighbors_of_other_patches({0, 0, 0, 0}) == 16);
      CHECK(neighbors_of_other_patches({0, 0, 1, 1}) == 8);
      CHECK(neighbors_of_other_patches({}) == 0);
    }
}



TEST_CASE("The cells of several bodies can be divided evenly among processes",
          "[iga]")
{
  NURBSPatch<3> tube = quarter_tube(1., 2., 3.), next = tube;
  for (unsigned int d = 0; d < 3; ++d)
    tube.subdivide(d, 4);
  next.transform(
    [](const Point<3> &X) { return Point<3>(X[0], X[1], X[2] + 3.); });
  next.subdivide(0, 4);
  next.subdivide(1, 4);
  next.subdivide(2, 2);
  // The second body lies in the first one: bodies in contact are not joined.
  const IGASpace<3> space({tube, next, tube}, {0, 0, 1}, Basis::NURBS);
  for (const unsigned int n : {2, 3})
    {
      dealii::Triangulation<3> triangulation;
      triangulation.copy_triangulation(space.triangulation());
      dealii::GridTools::partition_triangulation(n, triangulation);
      std::vector<unsigned int> size(n, 0);
      for (const auto &cell : triangulation.active_cell_iterators())
        {
          REQUIRE(cell->subdomain_id() < n);
          ++size[cell->subdomain_id()];
        }
      INFO(n << " parts");
      CHECK(std::accumulate(size.begin(), size.end(), 0u) == 64 + 32 + 64);
      for (const unsigned int s : size)
        CHECK(std::abs(s - 160. / n) < 0.1 * 160. / n);
    }
}



TEST_CASE("The space keeps the geometry of its patches", "[iga]")
{
  for (const bool rational : {true, false})
    for (const Basis basis : all_bases)
      {
        const NURBSPatch<3> patch = general_patch<3>(rational);
        const IGASpace<3>   space({patch}, {}, basis);
        double              error = 0., node_error = 0.;
        for (unsigned int c = 0; c < space.cells().size(); ++c)
          for (const Point<3> &t : {Point<3>(0.2, 0.9, 0.4),
                                    Point<3>(0., 1., 0.3),
                                    Point<3>(0.5, 0.5, 0.5)})
            {
              const Point<3> u = parameter_in_cell(space, c, t);
              error =
                std::max(error,
                         patch.value(u).distance(direct_position(space, c, u)));
            }
        // The vertices of the spans are nodes of every Lagrange element.
        for (unsigned int c = 0; c < space.cells().size(); ++c)
          for (unsigned int v = 0; v < 8; ++v)
            {
              const Point<3> u =
                parameter_in_cell(space,
                                  c,
                                  Point<3>(v & 1, (v >> 1) & 1, (v >> 2) & 1));
              node_error =
                std::max(node_error,
                         patch.value(u).distance(direct_position(space, c, u)));
            }
        INFO(name(basis) << ", rational " << rational);
        CHECK(node_error < 1e-13); // elevation to degree 3
        if (basis == Basis::Lagrange && rational)
          {
            // Polynomials through nodes on a rational body: close, not equal.
            CHECK(error > 1e-6);
            CHECK(error < 1e-2);
          }
        else
          CHECK(error < 1e-13); // as above
      }
}



TEST_CASE("Lower degrees are raised to the highest one of the patch", "[iga]")
{
  const IGASpace<3> space({general_patch<3>(true)}, {}, Basis::NURBS);
  CHECK(space.degree(0) == 3);
  for (unsigned int d = 0; d < 3; ++d)
    CHECK(space.patch(0).knot_vector(d).degree() == 3);
  // Functions 7, 4 + 2, 3 + 1: a knot of degree 2 becomes a double one of 3.
  CHECK(space.n_control_points() == 7 * 6 * 4);
  const IGASpace<3> c0({general_patch<3>(true)}, {}, Basis::Bernstein);
  CHECK(c0.n_control_points() == 10 * 7 * 4);
}



TEST_CASE("Patches of one body share the control points of their interface",
          "[iga]")
{
  const std::vector<NURBSPatch<2>> rings = {refined_ring(0.),
                                            refined_ring(right_angle)};
  for (const Basis basis : all_bases)
    {
      INFO(name(basis));
      const IGASpace<2>  joined(rings, {4, 4}, basis);
      const auto        &patch = joined.patch(0);
      const unsigned int n_r   = patch.n_control_points(0),
                         n_t   = patch.n_control_points(1);
      CHECK(joined.n_control_points() == n_r * (2 * n_t - 1));
      CHECK(joined.control_points().size() == joined.weights().size());
      for (unsigned int i = 0; i < n_r; ++i)
        CHECK(joined.control_point(0, patch.index({{i, n_t - 1}})) ==
              joined.control_point(1, patch.index({{i, 0}})));

      // Every global control point is used, and stands where its patch has it.
      std::vector<bool> used(joined.n_control_points(), false);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int A = 0; A < patch.n_control_points(); ++A)
          {
            const unsigned int G = joined.control_point(i, A);
            used[G]              = true;
            CHECK(joined.control_points()[G].distance(
                    joined.patch(i).control_points()[A]) < 1e-14); // rounding
            CHECK(joined.weights()[G] == Approx(joined.patch(i).weights()[A]));
          }
      CHECK(std::count(used.begin(), used.end(), false) == 0);

      const IGASpace<2> apart(rings, {0, 1}, basis);
      CHECK(apart.n_control_points() == 2 * n_r * n_t);
      CHECK(apart.body(1) == 1);
      const IGASpace<2> by_default(rings, {}, basis);
      CHECK(by_default.n_control_points() == 2 * n_r * n_t);
    }
}



TEST_CASE("Four quarters of one body close to a ring", "[iga]")
{
  const std::vector<NURBSPatch<2>> quarters = {refined_ring(0.),
                                               refined_ring(right_angle),
                                               refined_ring(2 * right_angle),
                                               refined_ring(3 * right_angle)};
  for (const Basis basis : all_bases)
    {
      const IGASpace<2> ring(quarters, {0, 0, 0, 0}, basis);
      CHECK(ring.n_control_points() ==
            ring.patch(0).n_control_points(0) * 4 *
              (ring.patch(0).n_control_points(1) - 1));
    }
}



TEST_CASE("Faces in space are joined within a body and never between bodies",
          "[iga]")
{
  const NURBSPatch<3>  first = quarter_tube(1., 2., 3.);
  NURBSPatch<3>        above = first, inside = quarter_tube(0.5, 1., 3.);
  dealii::Tensor<1, 3> up;
  up[2] = 3.;
  above.transform([&](const Point<3> &X) { return X + up; });
  const std::vector<NURBSPatch<3>> tubes = {first, inside, above};
  // Degree 2 in all directions: 27 control points each, 9 on every face.
  for (const Basis basis : all_bases)
    {
      CHECK(IGASpace<3>(tubes, {0, 0, 0}, basis).n_control_points() ==
            3 * 27 - 2 * 9);
      CHECK(IGASpace<3>(tubes, {0, 1, 0}, basis).n_control_points() ==
            3 * 27 - 9);
      CHECK(IGASpace<3>(tubes, {0, 1, 2}, basis).n_control_points() == 3 * 27);
    }
}



TEST_CASE("Patches are joined in whatever directions they were described",
          "[iga]")
{
  // Two blocks side by side; the parameters of the second run along the edges
  // in all 24 right-handed ways. At degree 3 faces and edges have control
  // points whose order differs between the two.
  const KnotVector knots = KnotVector::uniform(3, 1);
  const auto block = [&](const std::function<Point<3>(const Point<3> &)> &map) {
    std::vector<Point<3>> points;
    for (unsigned int A = 0; A < 64; ++A)
      points.push_back(map(Point<3>(knots.greville(A % 4),
                                    knots.greville(A / 4 % 4),
                                    knots.greville(A / 16))));
    return NURBSPatch<3>({{knots, knots, knots}}, points);
  };
  const NURBSPatch<3> first = block([](const Point<3> &X) { return X; });

  unsigned int                n_ways = 0;
  std::array<unsigned int, 3> axis   = {{0, 1, 2}};
  do
    for (unsigned int mirrored = 0; mirrored < 8; ++mirrored)
      {
        Tensor<2, 3> turn;
        for (unsigned int d = 0; d < 3; ++d)
          turn[axis[d]][d] = (mirrored >> d) & 1 ? -1. : 1.;
        if (determinant(turn) < 0)
          continue;
        ++n_ways;
        const Point<3>      middle(0.5, 0.5, 0.5);
        const NURBSPatch<3> second = block([&](const Point<3> &X) {
          return Point<3>(Point<3>(1., 0., 0.) + middle + turn * (X - middle));
        });
        for (const Basis basis : all_bases)
          {
            const IGASpace<3> space({first, second}, {0, 0}, basis);
            INFO(name(basis) << ", turned by " << turn);
            CHECK(space.n_control_points() == 7 * 4 * 4);
            CHECK(space.triangulation().n_used_vertices() == 12);
            double error = 0.;
            for (unsigned int c = 0; c < 2; ++c)
              for (unsigned int l = 0; l < 64; ++l)
                error = std::max(
                  error,
                  space.control_points()[space.control_points_of_cell(c)[l]]
                    .distance(space.patch(c).control_points()[l]));
            CHECK(error < 1e-14);
          }
      }
  while (std::next_permutation(axis.begin(), axis.end()));
  CHECK(n_ways == 24);
}



TEST_CASE("Elements between common corners must have common control points",
          "[iga]")
{
  // Two squares, one above the other; where they meet the second has a bay.
  const KnotVector knots  = KnotVector::uniform(2, 1);
  const auto       square = [&](const double bottom, const double bay) {
    std::vector<Point<2>> points;
    for (unsigned int A = 0; A < 9; ++A)
      points.emplace_back(0.5 * (A % 3),
                          bottom + 0.5 * (A / 3) + (A == 1 ? bay : 0.));
    return NURBSPatch<2>({{knots, knots}}, points);
  };
  const std::vector<NURBSPatch<2>> patches = {square(0., 0.), square(1., 0.3)};
  CHECK(IGASpace<2>(patches, {0, 0}, Basis::NURBS).n_control_points() == 16);
  for (const Basis basis : {Basis::Bernstein, Basis::Lagrange})
    CHECK_THAT(input_error([&]() {
                 IGASpace<2>(patches, {0, 0}, basis);
               }),
               Contains("common corners") && Contains("patch 1"));
}



TEST_CASE("A ring closed within one patch keeps its seam", "[iga]")
{
  // A square ring of degree 1: first and last column coincide.
  std::vector<Point<2>> points;
  for (const double angle : {0., 1., 2., 3., 0.})
    for (const double r : {1., 2.})
      points.emplace_back(r * std::cos(right_angle * angle),
                          r * std::sin(right_angle * angle));
  const NURBSPatch<2> ring(
    {{KnotVector::uniform(1, 1), KnotVector::uniform(1, 4)}}, points);
  NURBSPatch<2> hub = ring;
  hub.transform([](const Point<2> &X) { return Point<2>(0.5 * X); });
  CHECK(IGASpace<2>({ring}, {}, Basis::NURBS).n_control_points() == 10);
  // All five outer points of the hub find a partner on the ring, and the seam
  // stays open in both.
  for (const Basis basis : all_bases)
    {
      const IGASpace<2> both({ring, hub}, {0, 0}, basis);
      CHECK(both.n_control_points() == 10 + 5);
      CHECK(both.triangulation().n_used_vertices() == 10 + 5);
      for (unsigned int j = 0; j < 5; ++j)
        CHECK(both.control_point(0, 2 * j) == both.control_point(1, 2 * j + 1));
    }
}



TEST_CASE("Joined patches with different weights are refused", "[iga]")
{
  const NURBSPatch<2> ring = quarter_ring(1., 2.);
  const NURBSPatch<2> next = quarter_ring(1., 2., right_angle);
  std::vector<double> weights(next.weights());
  weights[0] *= 1.01;
  const NURBSPatch<2> other(next.knot_vectors(),
                            next.control_points(),
                            weights);
  CHECK_THAT(input_error([&]() {
               IGASpace<2>({ring, other}, {0, 0}, Basis::NURBS);
             }),
             Contains("equal weights") && Contains("patch 1"));
  CHECK(input_error([&]() {
          IGASpace<2>({ring, other}, {0, 1}, Basis::NURBS);
        }) == "(accepted)");
}



TEST_CASE("Bezier coefficients give the field of a cell in every basis",
          "[iga]")
{
  for (const bool rational : {true, false})
    {
      check_bezier_coefficients<2>(rational);
      check_bezier_coefficients<3>(rational);
    }
}
