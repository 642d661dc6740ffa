// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of patch faces as surfaces.

#include <npt_dealii/iga/iga_surface.h>
#include <npt_dealii/iga/iga_values.h>

#include <algorithm>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;
using Catch::Matchers::Contains;

namespace
{


  template <int m>
  std::array<double, m>
  parameter(const Point<m> &u)
  {
    std::array<double, m> result;
    for (unsigned int a = 0; a < m; ++a)
      result[a] = u[a];
    return result;
  }



  // The functions (or one derivative of them) spread over the whole lattice,
  // so that functions that are zero at the point count too.
  template <int dim>
  std::vector<double>
  on_lattice(const IGASurface<dim>           &surface,
             const std::vector<unsigned int> &lattice,
             const std::vector<double>       &values)
  {
    REQUIRE(lattice.size() == values.size());
    std::vector<double> result(surface.n_control_points(), 0.);
    for (unsigned int l = 0; l < values.size(); ++l)
      result[lattice[l]] = values[l];
    return result;
  }



  double
  max_difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    REQUIRE(a.size() == b.size());
    double difference = 0.;
    for (unsigned int i = 0; i < a.size(); ++i)
      difference = std::max(difference, std::abs(a[i] - b[i]));
    return difference;
  }



  template <int m, int dim>
  void
  check_derivatives(const IGASurface<dim> &surface)
  {
    using Indices        = SymmetricIndices<m>;
    unsigned int n_spans = 1;
    for (unsigned int a = 0; a < m; ++a)
      n_spans *= surface.knot_vector(a).n_spans();
    double error[4] = {0., 0., 0., 0.};
    double size[4]  = {0., 0., 0., 0.};
    for (unsigned int s = 0; s < n_spans; ++s)
      {
        std::array<unsigned int, m> span;
        Point<m>                    u;
        unsigned int                rest = s;
        for (unsigned int a = 0; a < m; ++a)
          {
            const auto &k = surface.knot_vector(a);
            span[a]       = rest % k.n_spans();
            rest /= k.n_spans();
            u[a] =
              k.breaks()[span[a]] +
              (0.3 + 0.4 * a) * (k.breaks()[span[a] + 1] - k.breaks()[span[a]]);
          }
        // Derivatives of one order, one component of the symmetric array.
        const auto of_order = [&](const unsigned int order,
                                  const unsigned int component) {
          return [&surface, &span, order, component](const Point<m> &v) {
            SurfaceShape<m> shape;
            surface.evaluate(parameter<m>(v), order, shape, &span);
            return on_lattice(surface,
                              shape.lattice,
                              order == 0 ? shape.value :
                              order == 1 ? shape.first[component] :
                              order == 2 ? shape.second[component] :
                                           shape.third[component]);
          };
        };
        const auto compare = [&](const unsigned int         order,
                                 const std::vector<double> &exact,
                                 const std::vector<double> &approximate) {
          error[order] =
            std::max(error[order], max_difference(exact, approximate));
          for (const double x : exact)
            size[order] = std::max(size[order], std::abs(x));
        };

        const double h = 1e-3;
        for (unsigned int a = 0; a < m; ++a)
          {
            compare(1,
                    of_order(1, a)(u),
                    difference<m>(of_order(0, 0), u, a, h));
            for (unsigned int b = 0; b < m; ++b)
              {
                compare(2,
                        of_order(2, Indices::second(a, b))(u),
                        difference<m>(of_order(1, a), u, b, h));
                for (unsigned int c = 0; c < m; ++c)
                  compare(
                    3,
                    of_order(3, Indices::third(a, b, c))(u),
                    difference<m>(of_order(2, Indices::second(a, b)), u, c, h));
              }
          }
      }
    // Relative to the size of the derivatives: rounding 1e-16 / h plus h^4
    // times (for rational functions) fifth derivatives of them.
    for (unsigned int order = 1; order <= 3; ++order)
      {
        INFO("derivative " << order << " of size " << size[order]);
        CHECK(size[order] > 1.);
        CHECK(error[order] < 1e-8 * size[order]);
      }
  }



  // Values on every face against the volume functions, and the normals.
  template <int dim>
  void
  check_faces(const bool rational, const Basis basis)
  {
    INFO("dim " << dim << ", " << name(basis) << ", rational " << rational);
    constexpr int         m     = dim - 1;
    const NURBSPatch<dim> patch = general_patch<dim>(rational);
    const IGASpace<dim>   space({patch}, {3}, basis);

    double value_error = 0., lattice_error = 0., flux = 0., smallest = 1e300,
           averaging_sum = 0., averaging_least = 0., shape_least = 0.,
           averaging_difference = 0.;
    Tensor<1, dim> total_normal;
    unsigned int   n_points = 0;
    for (unsigned int direction = 0; direction < dim; ++direction)
      for (unsigned int side = 0; side < 2; ++side)
        {
          const IGASurface<dim> surface(space, 0, direction, side);
          CHECK(surface.body() == 3);
          CHECK(surface.degree() == 3);
          unsigned int n = 1;
          for (unsigned int a = 0; a < m; ++a)
            {
              CHECK(
                surface.knot_vector(a).knots() ==
                space.patch(0).knot_vector((direction + 1 + a) % dim).knots());
              n *= surface.n_control_points(a);
            }
          CHECK(surface.n_control_points() == n);

          for (const auto &point : surface.quadrature(5))
            {
              // The cell at this face, in the volume.
              std::array<unsigned int, dim> span;
              Point<dim>                    u;
              const auto &normal_knots = space.patch(0).knot_vector(direction);
              span[direction] = side == 0 ? 0 : normal_knots.n_spans() - 1;
              u[direction]    = side == 0 ? normal_knots.breaks().front() :
                                            normal_knots.breaks().back();
              for (unsigned int a = 0; a < m; ++a)
                {
                  span[(direction + 1 + a) % dim] = point.span[a];
                  u[(direction + 1 + a) % dim]    = point.u[a];
                }
              unsigned int c = 0;
              while (space.cells()[c].span != span)
                ++c;

              SurfaceShape<m> shape;
              surface.evaluate(point.u, 1, shape, &point.span);
              if (n_points++ % 4 == 0) // enough, and four times as fast
                {
                  // All functions of the cell, those of other points being
                  // zero.
                  const auto          R       = direct_functions(space, c, u);
                  const auto          indices = space.control_points_of_cell(c);
                  std::vector<double> volume(space.n_control_points(), 0.),
                    face(volume);
                  for (unsigned int l = 0; l < R.size(); ++l)
                    volume[indices[l]] = R[l];
                  for (unsigned int l = 0; l < shape.lattice.size(); ++l)
                    face[surface.control_point(shape.lattice[l])] =
                      shape.value[l];
                  value_error =
                    std::max(value_error, max_difference(volume, face));
                }
              lattice_error =
                std::max(lattice_error,
                         point.X.distance(direct_position(space, c, u)));
              CHECK(point.shape.value == shape.value);

              // Outward normal: across the face the position moves along it.
              Tensor<1, dim> tangent[m], normal;
              for (unsigned int l = 0; l < shape.lattice.size(); ++l)
                for (unsigned int a = 0; a < m; ++a)
                  tangent[a] += shape.first[a][l] *
                                surface.reference_position(shape.lattice[l]);
              if constexpr (dim == 3)
                normal = cross_product_3d(tangent[0], tangent[1]);
              else
                {
                  normal[0] = tangent[0][1];
                  normal[1] = -tangent[0][0];
                }
              normal *= surface.orientation() / normal.norm();
              Point<dim> inside = u;
              inside[direction] += side == 0 ? 1e-3 : -1e-3;
              const Tensor<1, dim> outward =
                point.X - direct_position(space, c, inside);
              smallest = std::min(smallest, outward * normal / outward.norm());
              flux += (normal * point.X) * point.area / dim;
              total_normal += normal * point.area;

              SurfaceShape<m> alone;
              surface.evaluate_averaging(point.u, alone);
              CHECK(alone.lattice == shape.lattice);
              double sum = 0.;
              for (const double value : alone.value)
                {
                  sum += value;
                  averaging_least = std::min(averaging_least, value);
                }
              averaging_sum = std::max(averaging_sum, std::abs(sum - 1.));
              for (const double value : shape.value)
                shape_least = std::min(shape_least, value);
              CHECK(max_difference(alone.value, point.averaging.value) < 1e-14);
              averaging_difference =
                std::max(averaging_difference,
                         max_difference(alone.value, shape.value));
            }
        }
    // Power coefficients of degree 3 on [0,1]: one digit lost.
    CHECK(value_error < 1e-13);
    CHECK(lattice_error < 1e-13); // the same
    CHECK(smallest > 0.3);        // cosine of the skewness of the patch
    // Divergence theorem; the volume by more points than needed.
    IGAValues<dim> values(space, 5);
    double         body_volume = 0.;
    for (const auto &span : space.triangulation().active_cell_iterators())
      {
        values.reinit(span);
        for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
          body_volume += values.JxW(q);
      }
    // Five points integrate the polynomials exactly; what they leave of the
    // rational functions was 2e-6.
    const double tolerance =
      rational && basis != Basis::Lagrange ? 1e-5 : 1e-12;
    CHECK(std::abs(flux - body_volume) < tolerance);
    CHECK(total_normal.norm() < tolerance);

    CHECK(averaging_sum < 1e-14);    // rounding
    CHECK(averaging_least > -1e-15); // rounding
    if (basis == Basis::Lagrange)
      {
        // The displacement functions change sign: the reason for the others.
        CHECK(shape_least < -0.01);
        CHECK(averaging_difference > 0.1);
      }
    else
      CHECK(averaging_difference < 1e-14); // the same functions
  }
} // namespace



TEST_CASE("Surface functions without weights are products of those of Cox and "
          "de Boor, and so are their first and second derivatives",
          "[iga]")
{
  for (const KnotVector &first : uneven_knot_vectors())
    for (const KnotVector &second : uneven_knot_vectors())
      if (first.degree() == second.degree())
        {
          const KnotVector thickness = KnotVector::uniform(first.degree(), 1);
          std::vector<Point<3>> points;
          for (unsigned int k = 0; k < thickness.n_functions(); ++k)
            for (unsigned int j = 0; j < second.n_functions(); ++j)
              for (unsigned int i = 0; i < first.n_functions(); ++i)
                points.emplace_back(first.greville(i),
                                    second.greville(j),
                                    thickness.greville(k));
          const IGASpace<3>   space({NURBSPatch<3>({{first, second, thickness}},
                                                 points)},
                                  {},
                                  Basis::NURBS);
          const IGASurface<3> surface(space, 0, 2, 1);
          double              error = 0.;
          for (unsigned int e = 0; e < first.n_spans(); ++e)
            for (unsigned int f = 0; f < second.n_spans(); ++f)
              for (const double u : points_of_span(first, e))
                for (const double v : points_of_span(second, f))
                  {
                    const std::array<unsigned int, 2> span = {{e, f}};
                    SurfaceShape<2>                   shape;
                    surface.evaluate({{u, v}}, 2, shape, &span);
                    const auto N = first.values(e, u, 2),
                               M = second.values(f, v, 2);
                    // Derivatives grow with the inverse of the span.
                    const double h = first.breaks()[e + 1] - first.breaks()[e],
                                 k =
                                   second.breaks()[f + 1] - second.breaks()[f];
                    const unsigned int n = first.degree() + 1;
                    REQUIRE(shape.value.size() == n * n);
                    for (unsigned int l = 0; l < n * n; ++l)
                      {
                        const unsigned int i = l % n, j = l / n;
                        error = std::max(
                          {error,
                           std::abs(shape.value[l] - N[0][i] * M[0][j]),
                           h * std::abs(shape.first[0][l] - N[1][i] * M[0][j]),
                           k * std::abs(shape.first[1][l] - N[0][i] * M[1][j]),
                           h * h *
                             std::abs(shape.second[0][l] - N[2][i] * M[0][j]),
                           h * k *
                             std::abs(shape.second[1][l] - N[1][i] * M[1][j]),
                           k * k *
                             std::abs(shape.second[2][l] - N[0][i] * M[2][j])});
                      }
                  }
          INFO("degree " << first.degree());
          // Second derivatives of Bernstein polynomials of degree 4 are 12,
          // their power coefficients up to 12; p knots inserted.
          CHECK(error < 1e-12);
        }
}



namespace
{
  // Against the sum over the functions, at some points of all segments.
  template <int m, int dim>
  void
  check_jet(const IGASurface<dim> &surface)
  {
    std::vector<Point<dim>> positions;
    for (unsigned int l = 0; l < surface.n_control_points(); ++l)
      {
        positions.push_back(surface.reference_position(l));
        positions.back()[0] += 0.01 * (l % 5); // a moved surface
      }
    const unsigned int n_last = surface.n_segments(m - 1);
    double             error = 0., size = 0.;
    for (unsigned int s = 0; s < surface.n_segments(0) * n_last; ++s)
      {
        std::array<unsigned int, m> segment;
        segment[0]     = s / n_last;
        segment[m - 1] = s % n_last;
        if (m == 1 && s / n_last != s % n_last)
          continue;
        std::array<double, m> u;
        for (unsigned int a = 0; a < m; ++a)
          {
            const auto &breaks = surface.segment_breaks(a);
            u[a] =
              breaks[segment[a]] +
              (0.2 + 0.5 * a) * (breaks[segment[a] + 1] - breaks[segment[a]]);
          }
        SurfaceShape<m> shape;
        surface.evaluate(u, 2, shape, &segment);
        const auto jet     = surface.jet(u, positions, segment);
        const auto compare = [&](const std::vector<double> &functions,
                                 const Tensor<1, dim>      &found) {
          Tensor<1, dim> sum;
          for (unsigned int l = 0; l < shape.lattice.size(); ++l)
            sum += functions[l] * positions[shape.lattice[l]];
          error = std::max(error, (found - sum).norm());
          size  = std::max(size, sum.norm());
        };
        compare(shape.value, jet.x);
        for (unsigned int k = 0; k < shape.first.size(); ++k)
          compare(shape.first[k], jet.first[k]);
        for (unsigned int k = 0; k < shape.second.size(); ++k)
          compare(shape.second[k], jet.second[k]);
      }
    CAPTURE(size);
    CHECK(size > 0.);
    CHECK(error < 1e-13 * size);
  }
} // namespace



TEST_CASE(
  "A point of a surface and its derivatives are sums over the functions",
  "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {true, false})
      {
        INFO(name(basis) << ", rational " << rational);
        const IGASpace<2> plane({general_patch<2>(rational)}, {}, basis);
        check_jet<1>(IGASurface<2>(plane, 0, 1, 0));
        const IGASpace<3> body({general_patch<3>(rational)}, {}, basis);
        for (const unsigned int side : {0, 1})
          {
            check_jet<2>(IGASurface<3>(body, 0, 2, side));
            check_jet<2>(IGASurface<3>(body, 0, 1, side, 0.2));
            check_jet<2>(IGASurface<3>(body, 0, 2, side, 0., 0.1));
          }
      }
}



TEST_CASE("Surface derivatives up to the third are those of the functions",
          "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {true, false})
      {
        INFO(name(basis) << ", rational " << rational);
        const IGASpace<2> plane({general_patch<2>(rational)}, {}, basis);
        check_derivatives<1>(IGASurface<2>(plane, 0, 1, 0));
        const IGASpace<3> body({general_patch<3>(rational)}, {}, basis);
        check_derivatives<2>(IGASurface<3>(body, 0, 2, 1));
      }
}



TEST_CASE("Faces of a plane patch carry its functions and outward normals",
          "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {true, false})
      check_faces<2>(rational, basis);
}



TEST_CASE("Faces of a body in space carry its functions and outward normals",
          "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {true, false})
      check_faces<3>(rational, basis);
}



TEST_CASE("Both C0 bases average by the same functions on a polynomial patch",
          "[iga]")
{
  const NURBSPatch<3> patch = general_patch<3>(false);
  const IGASpace<3>   lagrange({patch}, {}, Basis::Lagrange);
  const IGASpace<3>   bernstein({patch}, {}, Basis::Bernstein);
  const IGASurface<3> a(lagrange, 0, 0, 1), b(bernstein, 0, 0, 1);
  SurfaceShape<2>     from_a, from_b;
  for (const double u : {0., 0.17, 0.3, 0.9, 1.})
    {
      a.evaluate_averaging({{u, 1. + u}}, from_a);
      b.evaluate_averaging({{u, 1. + u}}, from_b);
      CHECK(from_a.lattice == from_b.lattice);
      CHECK(max_difference(from_a.value, from_b.value) < 1e-14); // rounding
    }
}



TEST_CASE("The faces of a quarter tube have their exact areas", "[iga]")
{
  const IGASpace<3> space({quarter_tube(1., 2., 3.)}, {}, Basis::NURBS);
  const double      ring           = 0.75 * dealii::numbers::PI;
  const double      expected[3][2] = {{1.5 * dealii::numbers::PI,
                                       3. * dealii::numbers::PI},
                                      {3., 3.},
                                      {ring, ring}};
  for (unsigned int direction = 0; direction < 3; ++direction)
    for (unsigned int side = 0; side < 2; ++side)
      {
        double area = 0.;
        // Rational integrand: ten points for rounding.
        for (const auto &q :
             IGASurface<3>(space, 0, direction, side).quadrature(10))
          area += q.area;
        INFO("face " << direction << side);
        CHECK(std::abs(area - expected[direction][side]) < 1e-12);
      }
}



TEST_CASE("Points on the mantle of a tube lie on the cylinder with its normal",
          "[iga]")
{
  const IGASpace<3>   space({quarter_tube(1., 2., 3.)}, {}, Basis::NURBS);
  const IGASurface<3> mantle(space, 0, 0, 1);
  double              error = 0.;
  for (const auto &q : mantle.quadrature(4))
    {
      SurfaceShape<2> shape;
      mantle.evaluate(q.u, 2, shape);
      Tensor<1, 3> a1, a2, a11;
      for (unsigned int l = 0; l < shape.lattice.size(); ++l)
        {
          const auto &P = mantle.reference_position(shape.lattice[l]);
          a1 += shape.first[0][l] * P;
          a2 += shape.first[1][l] * P;
          a11 += shape.second[0][l] * P;
        }
      Tensor<1, 3> n = cross_product_3d(a1, a2);
      n *= mantle.orientation() / n.norm();
      const Tensor<1, 3> radial({q.X[0] / 2., q.X[1] / 2., 0.});
      error = std::max({error,
                        (n - radial).norm(),
                        // Curvature -1/r along the angle.
                        std::abs(a11 * n / (a1 * a1) + 0.5)});
    }
  CHECK(error < 1e-13); // rounding
}



TEST_CASE("At a span boundary the wanted side's polynomial is evaluated",
          "[iga]")
{
  // Dir. 0 of the general patch is C^1 at the double knot 0.5.
  const IGASpace<2>   space({general_patch<2>(false)}, {}, Basis::NURBS);
  const IGASurface<2> surface(space, 0, 1, 1);
  const auto         &k = surface.knot_vector(0);
  REQUIRE(k.breaks()[2] == 0.5);
  std::array<std::vector<double>, 3> jump;
  SurfaceShape<1>                    left, right, automatic;
  const std::array<unsigned int, 1>  before = {{1}}, after = {{2}};
  surface.evaluate({{0.5}}, 2, left, &before);
  surface.evaluate({{0.5}}, 2, right, &after);
  surface.evaluate({{0.5}}, 2, automatic);
  const auto difference_of = [&](const std::vector<double> &a,
                                 const std::vector<double> &b) {
    return max_difference(on_lattice(surface, left.lattice, a),
                          on_lattice(surface, right.lattice, b));
  };
  CHECK(difference_of(left.value, right.value) < 1e-14);       // rounding
  CHECK(difference_of(left.first[0], right.first[0]) < 1e-12); // rounding
  CHECK(difference_of(left.second[0], right.second[0]) > 1.);
  CHECK(automatic.lattice == right.lattice);
  CHECK(automatic.second[0] == right.second[0]);
}



TEST_CASE("Rounded kinks make all functions C1 and change them nowhere else",
          "[iga]")
{
  const double alpha = 0.15;
  for (const Basis basis : {Basis::Bernstein, Basis::Lagrange})
    {
      const IGASpace<3>   space({general_patch<3>(false)}, {}, basis);
      const IGASurface<3> sharp(space, 0, 2, 1), round(space, 0, 2, 1, alpha);
      double              kink = 0., jump = 0., change = 0., sum_error = 0.;
      for (unsigned int a = 0; a < 2; ++a)
        {
          const auto &knots = sharp.knot_vector(a).breaks();
          REQUIRE(round.n_segments(a) == 2 * sharp.n_segments(a) - 1);
          for (unsigned int i = 1; i < round.n_segments(a); ++i)
            {
              CHECK(round.is_smooth(a, i));
              std::array<double, 2> u;
              u[a]     = round.segment_breaks(a)[i];
              u[1 - a] = 0.37;
              std::array<unsigned int, 2> before, after;
              before[1 - a] = after[1 - a] = round.find_segment(1 - a, 0.37);
              before[a]                    = i - 1;
              after[a]                     = i;
              SurfaceShape<2> left, right;
              round.evaluate(u, 1, left, &before);
              round.evaluate(u, 1, right, &after);
              jump = std::max(
                jump,
                max_difference(on_lattice(round, left.lattice, left.value),
                               on_lattice(round, right.lattice, right.value)));
              for (unsigned int k = 0; k < 2; ++k)
                jump =
                  std::max(jump,
                           max_difference(
                             on_lattice(round, left.lattice, left.first[k]),
                             on_lattice(round, right.lattice, right.first[k])));
            }
          for (unsigned int e = 1; e + 1 < knots.size(); ++e)
            {
              std::array<double, 2> u;
              u[a]     = knots[e];
              u[1 - a] = 0.37;
              std::array<unsigned int, 2> before, after;
              before[1 - a] = after[1 - a] = sharp.find_segment(1 - a, 0.37);
              before[a]                    = e - 1;
              after[a]                     = e;
              SurfaceShape<2> left, right;
              sharp.evaluate(u, 1, left, &before);
              sharp.evaluate(u, 1, right, &after);
              kink =
                std::max(kink,
                         max_difference(
                           on_lattice(sharp, left.lattice, left.first[a]),
                           on_lattice(sharp, right.lattice, right.first[a])));
            }
        }
      CHECK(kink > 1.);
      CHECK(jump < 1e-12 * kink); // rounding

      for (const double s : {0.01, 0.2, 0.33, 0.5, 0.77, 0.98})
        for (const double t : {0.02, 0.26, 0.51, 0.66, 0.9})
          {
            const std::array<double, 2> u = {{s, t}};
            SurfaceShape<2>             a, b;
            sharp.evaluate(u, 3, a);
            round.evaluate(u, 3, b);
            double sum = 0.;
            for (const double value : b.value)
              sum += value;
            sum_error   = std::max(sum_error, std::abs(sum - 1.));
            bool inside = false;
            for (unsigned int k = 0; k < 2; ++k)
              {
                const auto  &v    = sharp.knot_vector(k).breaks();
                const auto   e    = sharp.find_segment(k, u[k]);
                const double part = (u[k] - v[e]) / (v[e + 1] - v[e]);
                inside            = inside || (part < alpha && e > 0) ||
                         (part > 1. - alpha && e + 2 < v.size());
              }
            if (!inside)
              for (unsigned int k = 0; k < 4; ++k)
                change = std::max(
                  change,
                  max_difference(on_lattice(sharp, a.lattice, a.third[k]),
                                 on_lattice(round, b.lattice, b.third[k])));
          }
      CHECK(sum_error < 1e-14); // rounding
      CHECK(change == 0.);
      check_derivatives<2>(round);
    }
}



TEST_CASE("A rounded kink leaves the surface by a quarter of angle and width",
          "[iga]")
{
  // A roof of slope 0.1 over [-1, 1], rounded over 0.2 on either side.
  const KnotVector      knots(2, {-1., -1., -1., 0., 0., 1., 1., 1.});
  const KnotVector      thickness = KnotVector::uniform(2, 1);
  std::vector<Point<2>> points;
  for (unsigned int j = 0; j < 3; ++j)
    for (unsigned int i = 0; i < 5; ++i)
      points.emplace_back(knots.greville(i),
                          0.5 * j - 0.1 * std::abs(knots.greville(i)));
  const IGASpace<2>   space({NURBSPatch<2>({{knots, thickness}}, points)},
                          {},
                          Basis::NURBS);
  const IGASurface<2> surface(space, 0, 1, 1, 0.2);
  SurfaceShape<1>     shape;
  const auto          height = [&](const double u) {
    surface.evaluate({{u}}, 0, shape);
    Point<2> x;
    for (unsigned int l = 0; l < shape.lattice.size(); ++l)
      x += shape.value[l] * surface.reference_position(shape.lattice[l]);
    CHECK(std::abs(x[0] - u) < 1e-15);
    return x[1];
  };
  const double kink = 0.2; // jump of the slope
  CHECK(std::abs(height(0.) - (1. - kink * 0.2 / 4.)) < 1e-15);
  CHECK(std::abs(height(0.3) - (1. - 0.03)) < 1e-15);
}



TEST_CASE("A surface of too high a degree is refused with the reason", "[iga]")
{
  NURBSPatch<2> ring = quarter_ring(1., 2.);
  ring.elevate_degree(1, 5);
  const IGASpace<2> seven({ring}, {}, Basis::NURBS);
  CHECK(input_error([&]() { IGASurface<2>(seven, 0, 0, 0); }) == "(accepted)");
  ring.elevate_degree(1, 1);
  const IGASpace<2> eight({ring}, {}, Basis::NURBS);
  CHECK_THAT(input_error([&]() { IGASurface<2>(eight, 0, 0, 0); }),
             Contains("up to 7") && Contains("found 8"));
}
