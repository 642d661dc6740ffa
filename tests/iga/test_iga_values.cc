// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the values at the Gauss points of a cell.

#include <npt_dealii/iga/iga_values.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_q_cache.h>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;
using Catch::Matchers::Contains;

namespace
{


  // Against the functions without extraction, their derivatives by
  // differences, at all Gauss points of some cells.
  template <int dim>
  void
  check_values(const bool rational, const Basis basis)
  {
    INFO("dim " << dim << ", " << name(basis) << ", rational " << rational);
    const NURBSPatch<dim>     patch = general_patch<dim>(rational);
    const IGASpace<dim>       space({patch}, {}, basis);
    IGAValues<dim>            values(space, 2);
    const dealii::QGauss<dim> gauss(2);

    double position_error = 0., patch_error = 0., value_error = 0.,
           gradient_error = 0., gradient_size = 0.;
    for (unsigned int c = 0; c < space.cells().size(); c += dim == 2 ? 1 : 5)
      {
        values.reinit(cell_of(space, c));
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
          }
      }
    CHECK(position_error < 1e-13); // rounding
    CHECK(value_error < 1e-13);    // rounding
    if (basis != Basis::Lagrange || !rational)
      CHECK(patch_error < 1e-13); // elevation to degree 3
    // Rounding 1e-16/h; for rational functions h^4/30 times fifth derivatives,
    // some 1e5.
    CHECK(gradient_size > 1.);
    CHECK(gradient_error < 1e-8);
  }



  template <int dim>
  double
  volume(const IGASpace<dim> &space, const unsigned int n_points)
  {
    IGAValues<dim> values(space, n_points);
    double         sum = 0.;
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        values.reinit(cell_of(space, c));
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
      IGAValues<3>      values(space, 2);
      double            error = 0.;
      for (unsigned int c = 0; c < space.cells().size(); ++c)
        {
          values.reinit(cell_of(space, c));
          for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
            {
              double       one = 0.;
              Tensor<1, 3> zero;
              Tensor<2, 3> identity;
              for (unsigned int A = 0; A < values.dofs_per_cell(); ++A)
                {
                  const auto &P =
                    space.control_points()[values.control_points()[A]];
                  one += values.shape_value(A, q);
                  zero += values.shape_grad(A, q);
                  identity +=
                    outer_product(Tensor<1, 3>(P), values.shape_grad(A, q));
                }
              for (unsigned int i = 0; i < 3; ++i)
                identity[i][i] -= 1.;
              error = std::max(
                {error, std::abs(one - 1.), zero.norm(), identity.norm()});
            }
        }
      INFO(name(basis));
      CHECK(error < 1e-12); // gradients of size 8 cancel
    }
}



TEST_CASE("The C0 bases without weights have the values, gradients and volumes "
          "of FEValues on the mapping through their points",
          "[iga]")
{
  const NURBSPatch<3> patch = general_patch<3>(false);
  for (const Basis basis : {Basis::Bernstein, Basis::Lagrange})
    {
      INFO(name(basis));
      const IGASpace<3>  space({patch}, {}, basis);
      const auto        &dof_handler = space.dof_handler();
      const unsigned int p           = space.degree(0);
      REQUIRE(dof_handler.n_dofs() == space.n_control_points());

      // Both bases are polynomials of degree p: so is the mapping.
      const dealii::FE_Q<3>    nodes(p);
      dealii::MappingQCache<3> mapping(p);
      mapping.initialize(
        space.triangulation(),
        [&](const dealii::Triangulation<3>::cell_iterator &cell) {
          const unsigned int    c = cell->active_cell_index();
          std::vector<Point<3>> X;
          for (const Point<3> &t : nodes.get_unit_support_points())
            X.push_back(
              direct_position(space, c, parameter_in_cell(space, c, t)));
          return X;
        });

      const dealii::QGauss<3> gauss(p + 1);
      dealii::FEValues<3>     fe_values(mapping,
                                    dof_handler.get_fe(),
                                    gauss,
                                    dealii::update_values |
                                      dealii::update_gradients |
                                      dealii::update_JxW_values |
                                      dealii::update_quadrature_points);
      IGAValues<3>            values(space);
      const auto order       = lexicographic_numbering(dof_handler.get_fe());
      double     value_error = 0., gradient_error = 0., volume_error = 0.,
             position_error = 0.;
      for (const auto &cell : dof_handler.active_cell_iterators())
        {
          fe_values.reinit(cell);
          values.reinit(cell);
          std::vector<dealii::types::global_dof_index> dofs(order.size());
          cell->get_dof_indices(dofs);
          for (unsigned int q = 0; q < gauss.size(); ++q)
            {
              volume_error =
                std::max(volume_error,
                         std::abs(values.JxW(q) / fe_values.JxW(q) - 1.));
              position_error = std::max(position_error,
                                        values.quadrature_point(q).distance(
                                          fe_values.quadrature_point(q)));
              for (unsigned int a = 0; a < order.size(); ++a)
                {
                  value_error =
                    std::max(value_error,
                             std::abs(values.shape_value(a, q) -
                                      fe_values.shape_value(order[a], q)));
                  gradient_error = std::max(gradient_error,
                                            (values.shape_grad(a, q) -
                                             fe_values.shape_grad(order[a], q))
                                              .norm());
                }
            }
          for (unsigned int a = 0; a < order.size(); ++a)
            CHECK(dofs[order[a]] == values.control_points()[a]);
        }
      CHECK(value_error == 0.); // the same table
      // Gradients up to 30; the mapping interpolates once more.
      CHECK(gradient_error < 1e-11);
      CHECK(volume_error < 1e-12);
      CHECK(position_error < 1e-14);
    }
}



TEST_CASE("The quarter ring and tube have their exact volume", "[iga]")
{
  for (const Basis basis : {Basis::NURBS, Basis::Bernstein})
    {
      NURBSPatch<2> ring = quarter_ring(1., 2.);
      ring.subdivide(1, 3);
      // The integrand is rational; eight points integrate it to rounding.
      CHECK(std::abs(volume(IGASpace<2>({ring}, {}, basis), 8) -
                     0.75 * dealii::numbers::PI) < 1e-13);
      NURBSPatch<3> tube = quarter_tube(1., 2., 3.);
      tube.subdivide(1, 2);
      // As above.
      CHECK(std::abs(volume(IGASpace<3>({tube}, {}, basis), 8) -
                     2.25 * dealii::numbers::PI) < 1e-12);
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
      error.push_back(
        std::abs(volume(IGASpace<2>({ring}, {}, Basis::Lagrange), 3) -
                 0.75 * dealii::numbers::PI));
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
  values.reinit(cell_of(space, 0));
  CHECK(values.dofs_per_cell() == 9);
  CHECK(values.n_quadrature_points() == 9);
  values.reinit(cell_of(space, 1));
  CHECK(values.dofs_per_cell() == 16);
  CHECK(values.n_quadrature_points() == 16);
  for (unsigned int q = 0; q < 16; ++q)
    CHECK(values.quadrature_point(q).norm() > 2.);
  values.reinit(cell_of(space, 0));
  CHECK(values.n_quadrature_points() == 9);
  for (unsigned int q = 0; q < 9; ++q)
    CHECK(values.quadrature_point(q).norm() < 2.);
  // Quarter turns in one span: twelve points for rounding.
  CHECK(std::abs(volume(space, 12) - 2. * dealii::numbers::PI) < 1e-12);
}



TEST_CASE("A folded patch is an inverted cell", "[iga]")
{
  NURBSPatch<2> ring = quarter_ring(1., 2.);
  ring.transform([](const Point<2> &X) { return Point<2>(X[1], X[0]); });
  const IGASpace<2> space({ring}, {}, Basis::NURBS);
  IGAValues<2>      values(space);
  CHECK_THROWS_AS(values.reinit(cell_of(space, 0)), InvertedCell);
  CHECK_THROWS_WITH(values.reinit(cell_of(space, 0)),
                    Contains("cell 0") && Contains("folded"));
}
