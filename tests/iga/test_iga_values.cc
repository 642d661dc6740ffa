// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the values at the Gauss points of a cell.

#include <npt_dealii/iga/iga_values.h>

#include <deal.II/base/quadrature_lib.h>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;
using Catch::Matchers::Contains;

namespace
{
  const double pi = std::acos(-1.);



  // Against the functions without extraction, their derivatives by
  // differences, at all Gauss points of some cells.
  template <int dim>
  void
  check_values(const bool rational, const Basis basis)
  {
    INFO("dim " << dim << ", " << name(basis) << ", rational " << rational);
    const NURBSPatch<dim>     patch = general_patch<dim>(rational);
    const IGASpace<dim>       space({patch}, {}, basis);
    IGAValues<dim>            values(space, 2, true);
    const dealii::QGauss<dim> gauss(2);

    double position_error = 0., patch_error = 0., value_error = 0.,
           gradient_error = 0., hessian_error = 0., gradient_size = 0.,
           hessian_size = 0.;
    for (unsigned int c = 0; c < space.cells().size(); c += dim == 2 ? 1 : 5)
      {
        values.reinit(c);
        const auto &indices = values.control_points();
        REQUIRE(values.n_quadrature_points() == gauss.size());
        REQUIRE(values.dofs_per_cell() == indices.size());
        REQUIRE(indices == space.control_points_of_cell(c));

        // Functions, then positions, in one vector.
        const auto direct = [&](const Point<dim> &v) {
          std::vector<double> all = direct_functions(space, c, v);
          const Point<dim>    X   = direct_position(space, c, v);
          for (unsigned int i = 0; i < dim; ++i)
            all.push_back(X[i]);
          return all;
        };
        for (unsigned int q = 0; q < gauss.size(); q += dim == 2 ? 1 : 3)
          {
            const Point<dim> u = parameter_in_cell(space, c, gauss.point(q));
            const Point<dim> X = values.quadrature_point(q);
            position_error     = std::max(position_error,
                                      X.distance(direct_position(space, c, u)));
            patch_error = std::max(patch_error, X.distance(patch.value(u)));

            // Small against the smallest span, 0.2.
            const double                         h = 5e-4;
            const unsigned int                   n = indices.size();
            const auto                           R = direct(u);
            std::array<std::vector<double>, dim> first;
            for (unsigned int a = 0; a < dim; ++a)
              first[a] = difference<dim>(direct, u, a, h);
            const auto x_derivative = [&](const std::vector<double> &f) {
              Tensor<1, dim> x;
              for (unsigned int i = 0; i < dim; ++i)
                x[i] = f[n + i];
              return x;
            };
            for (unsigned int A = 0; A < n; ++A)
              {
                value_error =
                  std::max(value_error,
                           std::abs(R[A] - values.shape_value(A, q)));
                gradient_size =
                  std::max(gradient_size, values.shape_grad(A, q).norm());
                // Chain rule dR/du = Grad R . dX/du.
                for (unsigned int a = 0; a < dim; ++a)
                  gradient_error = std::max(gradient_error,
                                            std::abs(values.shape_grad(A, q) *
                                                       x_derivative(first[a]) -
                                                     first[a][A]));
              }
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = a; b < dim; ++b)
                {
                  const auto first_b = [&](const Point<dim> &v) {
                    return difference<dim>(direct, v, b, h);
                  };
                  const auto second = difference<dim>(first_b, u, a, h);
                  for (unsigned int A = 0; A < n; ++A)
                    {
                      const auto &H = values.shape_hessian(A, q);
                      hessian_size  = std::max(hessian_size, H.norm());
                      // d2R = dX . H . dX + Grad R . d2X.
                      hessian_error =
                        std::max(hessian_error,
                                 std::abs(x_derivative(first[a]) *
                                            (H * x_derivative(first[b])) +
                                          values.shape_grad(A, q) *
                                            x_derivative(second) -
                                          second[A]));
                    }
                }
          }
      }
    CHECK(position_error < 1e-13); // rounding
    CHECK(value_error < 1e-13);    // rounding
    if (basis != Basis::Lagrange || !rational)
      CHECK(patch_error < 1e-13); // elevation to degree 3
    // Rounding 1e-16/h and 1e-16/h^2; for rational functions h^4/30 times
    // fifth and sixth derivatives, some 1e5 and 1e6.
    CHECK(gradient_size > 1.);
    CHECK(hessian_size > 10.);
    CHECK(gradient_error < 1e-8);
    CHECK(hessian_error < 1e-6);
  }



  template <int dim>
  double
  volume(const IGASpace<dim> &space, const unsigned int n_points)
  {
    IGAValues<dim> values(space, n_points);
    double         sum = 0.;
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        values.reinit(c);
        for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
          sum += values.JxW(q);
      }
    return sum;
  }
} // namespace



TEST_CASE("Values at Gauss points are those of the plane patch", "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {true, false})
      check_values<2>(rational, basis);
}



TEST_CASE("Values at Gauss points are those of the body in space", "[iga]")
{
  for (const Basis basis : all_bases)
    for (const bool rational : {true, false})
      check_values<3>(rational, basis);
}



TEST_CASE("Constant and linear fields have exact derivatives", "[iga]")
{
  for (const Basis basis : all_bases)
    {
      const IGASpace<3> space({general_patch<3>(true)}, {}, basis);
      IGAValues<3>      values(space, 2, true);
      double            error = 0., second_error = 0.;
      for (unsigned int c = 0; c < space.cells().size(); ++c)
        {
          values.reinit(c);
          for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
            {
              double                              one = 0.;
              Tensor<1, 3>                        zero;
              Tensor<2, 3>                        identity, zero_2;
              std::array<dealii::Tensor<2, 3>, 3> second;
              for (unsigned int A = 0; A < values.dofs_per_cell(); ++A)
                {
                  const auto &P =
                    space.control_points()[values.control_points()[A]];
                  one += values.shape_value(A, q);
                  zero += values.shape_grad(A, q);
                  zero_2 += values.shape_hessian(A, q);
                  identity +=
                    outer_product(Tensor<1, 3>(P), values.shape_grad(A, q));
                  for (unsigned int i = 0; i < 3; ++i)
                    second[i] += P[i] * values.shape_hessian(A, q);
                }
              for (unsigned int i = 0; i < 3; ++i)
                identity[i][i] -= 1.;
              error = std::max(
                {error, std::abs(one - 1.), zero.norm(), identity.norm()});
              second_error = std::max({second_error,
                                       zero_2.norm(),
                                       second[0].norm(),
                                       second[1].norm(),
                                       second[2].norm()});
            }
        }
      INFO(name(basis));
      CHECK(error < 1e-12);        // gradients of size 8 cancel
      CHECK(second_error < 1e-10); // second derivatives of size 300 cancel
    }
}



TEST_CASE("The quarter ring and tube have their exact volume", "[iga]")
{
  for (const Basis basis : {Basis::NURBS, Basis::Bernstein})
    {
      NURBSPatch<2> ring = quarter_ring(1., 2.);
      ring.subdivide(1, 3);
      // The integrand is rational; eight points integrate it to rounding.
      CHECK(std::abs(volume(IGASpace<2>({ring}, {}, basis), 8) - 0.75 * pi) <
            1e-13);
      NURBSPatch<3> tube = quarter_tube(1., 2., 3.);
      tube.subdivide(1, 2);
      // As above.
      CHECK(std::abs(volume(IGASpace<3>({tube}, {}, basis), 8) - 2.25 * pi) <
            1e-12);
    }
}



TEST_CASE("A ring of quadratic Lagrange elements converges with order four",
          "[iga]")
{
  std::vector<double> error;
  for (const unsigned int parts : {2, 4, 8})
    {
      NURBSPatch<2> ring = quarter_ring(1., 2.);
      ring.subdivide(1, parts);
      error.push_back(std::abs(
        volume(IGASpace<2>({ring}, {}, Basis::Lagrange), 3) - 0.75 * pi));
    }
  // Area of an isoparametric circle: h^{2p} = h^4.
  CHECK(error[0] > 1e-5);
  CHECK(std::log2(error[0] / error[1]) > 3.7);
  CHECK(std::log2(error[1] / error[2]) > 3.7);
}



TEST_CASE("Patches of different degrees have their own points", "[iga]")
{
  NURBSPatch<2> cubic = quarter_ring(2., 3.);
  cubic.elevate_degree(0, 2);
  const IGASpace<2> space({quarter_ring(1., 2.), cubic}, {}, Basis::NURBS);
  IGAValues<2>      values(space);
  values.reinit(0);
  CHECK(values.dofs_per_cell() == 9);
  CHECK(values.n_quadrature_points() == 9);
  values.reinit(1);
  CHECK(values.dofs_per_cell() == 16);
  CHECK(values.n_quadrature_points() == 16);
  for (unsigned int q = 0; q < 16; ++q)
    CHECK(values.quadrature_point(q).norm() > 2.);
  values.reinit(0);
  CHECK(values.n_quadrature_points() == 9);
  for (unsigned int q = 0; q < 9; ++q)
    CHECK(values.quadrature_point(q).norm() < 2.);
  // Quarter turns in one span: twelve points for rounding.
  CHECK(std::abs(volume(space, 12) - 2. * pi) < 1e-12);
}



TEST_CASE("A folded patch is an inverted cell", "[iga]")
{
  NURBSPatch<2> ring = quarter_ring(1., 2.);
  ring.transform([](const Point<2> &X) { return Point<2>(X[1], X[0]); });
  const IGASpace<2> space({ring}, {}, Basis::NURBS);
  IGAValues<2>      values(space);
  CHECK_THROWS_AS(values.reinit(0), InvertedCell);
  CHECK_THROWS_WITH(values.reinit(0), Contains("cell 0") && Contains("folded"));
}
