// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the couplings of cells that are periodic in three directions.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/solid_couplings.h>
#include <npt_dealii/problems/material_test/fiber_array.h>

#include <deal.II/lac/vector.h>

#include <catch2/catch.hpp>

#include <random>

namespace
{
  using namespace NPT;
  using dealii::Tensor;
  using dealii::Vector;

  IGASpace<3>
  space_of(const FiberArray &array, const Basis basis)
  {
    return IGASpace<3>(array.patches(),
                       std::vector<unsigned int>(array.patches().size(), 0),
                       basis);
  }
} // namespace



TEST_CASE("A homogeneous deformation obeys the couplings of a micro cell",
          "[homogenization]")
{
  std::mt19937                           generator(5);
  std::uniform_real_distribution<double> entry(-0.3, 0.3);
  for (const Packing packing : {Packing::square, Packing::hexagonal})
    for (const unsigned int n_fibers : {1, 2, 4})
      for (const Basis basis : {Basis::NURBS, Basis::Lagrange})
        for (const int uniform : {-1, 0})
          {
            MicroCellParameters cell;
            cell.packing  = packing;
            cell.n_fibers = n_fibers;
            MicroMeshParameters mesh;
            mesh.elements_around = 2;
            mesh.elements_fiber = mesh.elements_matrix = 1;
            mesh.elements_along                        = 2;
            const FiberArray         array(cell, mesh);
            const auto               space = space_of(array, basis);
            const SolidMacroUnknowns macro(space.n_control_points());
            const auto               constraints =
              make_solid_couplings(space, macro, array.periods(), uniform);

            Tensor<2, 3> H;
            for (unsigned int e = 0; e < 9; ++e)
              H[e / 3][e % 3] = entry(generator);
            Vector<double> u(macro.n_unknowns());
            for (unsigned int A = 0; A < space.n_control_points(); ++A)
              {
                // The held control point is the first.
                const Tensor<1, 3> w =
                  H * (space.control_points()[A] - space.control_points()[0]);
                for (unsigned int i = 0; i < 3; ++i)
                  u[3 * A + i] = w[i];
              }
            for (unsigned int e = 0; e < 9; ++e)
              u[macro.first + e] = H[e / 3][e % 3];
            Vector<double> distributed = u;
            constraints.distribute(distributed);
            distributed -= u;
            CHECK(distributed.linfty_norm() < 1e-13);
            for (unsigned int e = 0; e < 9; ++e)
              CHECK(!constraints.is_constrained(macro.first + e));
          }
}



TEST_CASE("Every point on the boundary of a cell follows its partner",
          "[homogenization]")
{
  // Corner of the hexagon: three polygons meet, so a corner is related to two
  // others; corner and sides together leave 1 + 3 (n - 2) unknown points where
  // there were 6 (n - 1), n control points to a side.
  for (const Packing packing : {Packing::square, Packing::hexagonal})
    {
      MicroCellParameters cell;
      cell.packing = packing;
      MicroMeshParameters      mesh;
      const FiberArray         array(cell, mesh);
      const auto               space = space_of(array, Basis::NURBS);
      const SolidMacroUnknowns macro(space.n_control_points());
      const auto               constraints =
        make_solid_couplings(space, macro, array.periods());

      const unsigned int sides  = packing == Packing::square ? 4 : 6;
      const unsigned int n      = mesh.elements_around + mesh.degree;
      const unsigned int layers = 1 + mesh.degree; // one span along
      const unsigned int layer  = space.n_control_points() / layers;
      const unsigned int saved =
        sides * (n - 1) -
        ((packing == Packing::square ? 1 : 2) + sides / 2 * (n - 2));
      CHECK(macro.first - constraints.n_constraints() ==
            3 * ((layers - 1) * (layer - saved) - 1));
    }
}



TEST_CASE("A cell that does not repeat is refused", "[homogenization]")
{
  const FiberArray         array{MicroCellParameters(), MicroMeshParameters()};
  const auto               space = space_of(array, Basis::NURBS);
  const SolidMacroUnknowns macro(space.n_control_points());
  auto                     periods = array.periods();
  periods[2] *= 1.01;
  CHECK_THROWS_WITH(make_solid_couplings(space, macro, periods),
                    Catch::Contains("not periodic"));
}
