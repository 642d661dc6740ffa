// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the geometry of micro cells.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/iga_values.h>
#include <npt_dealii/problems/material_test/fiber_array.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

namespace
{
  using namespace NPT;
  using dealii::Point;

  const std::array<Packing, 2> packings = {
    {Packing::square, Packing::hexagonal}};

  MicroCellParameters
  cell_of(const Packing      packing,
          const double       fraction,
          const unsigned int n_fibers = 1)
  {
    MicroCellParameters cell;
    cell.packing         = packing;
    cell.volume_fraction = fraction;
    cell.n_fibers        = n_fibers;
    return cell;
  }

  // Few cells: geometry is exact on any mesh.
  MicroMeshParameters
  coarse(const unsigned int elements_around = 3)
  {
    MicroMeshParameters mesh;
    mesh.elements_around = elements_around;
    mesh.elements_fiber = mesh.elements_matrix = 1;
    return mesh;
  }

  IGASpace<3>
  space_of(const FiberArray &array, const Basis basis = Basis::NURBS)
  {
    return IGASpace<3>(array.patches(),
                       std::vector<unsigned int>(array.patches().size(), 0),
                       basis);
  }

  struct Volumes
  {
    double fibers = 0, matrix = 0;
  };

  // By quadrature with enough points for the rational integrand.
  Volumes
  integrate(const FiberArray  &array,
            const IGASpace<3> &space,
            const unsigned int n_points = 6)
  {
    Volumes      volumes;
    IGAValues<3> values(space, n_points);
    for (const auto &span : space.triangulation().active_cell_iterators())
      {
        values.reinit(span); // throws where a cell is folded
        double &volume =
          array.is_fiber(span->material_id()) ? volumes.fibers : volumes.matrix;
        for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
          volume += values.JxW(q);
      }
    return volumes;
  }

  std::string
  error_of(const MicroCellParameters &cell)
  {
    try
      {
        FiberArray array(cell, coarse());
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "(accepted)";
  }
} // namespace



TEST_CASE("Cells of fibers have the volume and the fraction asked for",
          "[cell]")
{
  for (const Packing packing : packings)
    for (const double relative : {0.1, 0.6, 0.98, 0.999})
      for (const unsigned int n : {1, 2, 4})
        {
          if (n > 1 && relative != 0.6)
            continue;
          const double     fraction = relative * volume_fraction_limit(packing);
          const FiberArray array(cell_of(packing, fraction, n), coarse());
          const auto       space   = space_of(array);
          const Volumes    volumes = integrate(array, space);
          // Six Gauss points leave some 1e-9 of the arcs' rational functions.
          CHECK(volumes.fibers / array.volume() ==
                Approx(fraction).epsilon(1e-8));
          CHECK(volumes.fibers + volumes.matrix ==
                Approx(array.volume()).epsilon(1e-8));
        }
}



TEST_CASE("The surface of a fiber is a circle to round-off", "[cell]")
{
  for (const Packing packing : packings)
    for (const unsigned int degree : {2, 3})
      {
        MicroMeshParameters mesh = coarse();
        mesh.degree              = degree;
        const FiberArray array(cell_of(packing, 0.77), mesh);
        const double     R = array.parameters().fiber_radius;
        for (unsigned int b = 0; b < array.patches().size(); ++b)
          {
            const NURBSPatch<3> &patch = array.patches()[b];
            if (array.is_fiber(b) && !patch.is_rational())
              continue; // the core
            for (const double t : {0., 0.1, 0.37, 0.5, 0.93, 1.})
              {
                const Point<3> X =
                  patch.value(Point<3>(0.3, array.is_fiber(b) ? 1. : 0., t));
                CHECK(std::hypot(X[1], X[2]) == Approx(R).epsilon(1e-13));
              }
          }
      }
}



TEST_CASE("FE_Q on a micro cell converges to its circles", "[cell]")
{
  double previous = 0.01;
  for (const unsigned int n : {4, 8, 16})
    {
      const FiberArray array(cell_of(Packing::square, 0.77), coarse(n));
      const auto       space = space_of(array, Basis::Lagrange);
      const double     error =
        std::abs(integrate(array, space, 4).fibers / array.volume() - 0.77);
      // Isoparametric quadratics: order four in the length of an arc, once
      // the graded arcs are short.
      CHECK(error < previous / 7.);
      previous = error;
    }
  CHECK(previous < 2e-6);
}



TEST_CASE("Patches of a micro cell are joined along whole faces", "[cell]")
{
  // Joined without gap: the plane graph of control points of one layer obeys
  // Euler's formula. Easier to dispute: every inner face is shared, so the
  // number of unshared faces is that of the polygon's sides plus both ends.
  for (const Packing packing : packings)
    {
      const FiberArray array(cell_of(packing, 0.77), coarse());
      const auto       space = space_of(array);
      std::map<std::set<unsigned int>, unsigned int> faces;
      for (unsigned int b = 0; b < space.n_patches(); ++b)
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int side = 0; side < 2; ++side)
            {
              const auto            &patch = space.patch(b);
              std::set<unsigned int> face;
              for (unsigned int A = 0; A < patch.n_control_points(); ++A)
                if (patch.multi_index(A)[d] ==
                    side * (patch.n_control_points(d) - 1))
                  face.insert(space.control_point(b, A));
              ++faces[face];
            }
      unsigned int outer = 0;
      for (const auto &face : faces)
        {
          CHECK(face.second <= 2);
          outer += face.second == 1;
        }
      const unsigned int corners = packing == Packing::square ? 4 : 6;
      CHECK(outer == corners + 2 * array.patches().size());
    }
}



TEST_CASE("Patches of one body that meet without matching are refused",
          "[cell]")
{
  const FiberArray           array(cell_of(Packing::square, 0.6), coarse());
  std::vector<NURBSPatch<3>> patches = array.patches();
  patches[0].insert_knots(2, {0.123});
  CHECK_THROWS_WITH(IGASpace<3>(patches,
                                std::vector<unsigned int>(patches.size(), 0),
                                Basis::NURBS),
                    Catch::Contains("meet in a face") &&
                      Catch::Contains("do not coincide"));
  // As bodies of their own they need not match.
  CHECK_NOTHROW(IGASpace<3>(patches, {}, Basis::NURBS));
}



TEST_CASE("Overlapping fibers are refused with value and limit", "[cell]")
{
  CHECK_THAT(error_of(cell_of(Packing::square, 0.79)),
             Catch::Contains("Volume fraction is 0.79") &&
               Catch::Contains("0.785398") &&
               Catch::Contains("hexagonal packing"));
  CHECK_THAT(error_of(cell_of(Packing::hexagonal, 0.91)),
             Catch::Contains("Volume fraction is 0.91") &&
               Catch::Contains("0.9069"));
  CHECK_THAT(error_of(cell_of(Packing::square, 0.)), Catch::Contains("> 0"));
  CHECK(error_of(cell_of(Packing::hexagonal, 0.79)) == "(accepted)");

  MicroCellParameters cell;
  cell.fiber_spacing = 2.;
  cell.fiber_radius  = 1.;
  CHECK_THAT(error_of(cell),
             Catch::Contains("Fiber radius is 1") &&
               Catch::Contains("touch or overlap"));
  cell.fiber_radius = 0.5;
  CHECK(error_of(cell) == "(accepted)");
  CHECK(FiberArray(cell, MicroMeshParameters()).parameters().volume_fraction ==
        Approx(std::acos(-1.) / 16.));
}
