// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about bundles that lie in each other.

#include <npt_dealii/homogenization/bundle_overlap.h>

#include <catch2/catch.hpp>

namespace
{
  using namespace NPT;
  using dealii::Point;
  using dealii::Vector;

  // Straight bundles of a cell, the warp lifted, the weft moved sideways.
  BundleOverlap
  overlap(const std::string &weave,
          const double       lift,
          const double       offset   = 0.,
          const double       sideways = 0.,
          const double       H1       = 0.)
  {
    CellParameters cell_parameters;
    cell_parameters.type          = "primitive cell";
    cell_parameters.weave         = weave;
    cell_parameters.two_fold_axis = false;
    MeshParameters mesh;
    mesh.elements_along = mesh.elements_across = 4;
    mesh.elements_through                      = 1;
    const FabricCell           cell(cell_parameters, mesh);
    std::vector<NURBSPatch<3>> patches;
    for (const FiberBundle &bundle : cell.bundles())
      patches.push_back(bundle.patch);
    const IGASpace<3>   space(patches, {}, Basis::NURBS);
    const MacroUnknowns macro(space.n_control_points());
    Vector<double>      u(macro.n_unknowns());
    bool                odd = false;
    for (unsigned int b = 0; b < space.n_patches(); ++b)
      {
        const bool warp = cell.bundles()[b].family == FiberBundle::Family::warp;
        odd             = !warp && !odd;
        for (unsigned int l = 0; l < patches[b].n_control_points(); ++l)
          {
            const unsigned int A = space.control_point(b, l);
            u[3 * A] += H1 * space.control_points()[A][0];
            u[3 * A + (warp ? 2 : 0)] += warp ? lift : odd ? sideways : 0.;
          }
      }
    u[macro.weaving_offset()] = offset;
    u[macro.mode(0)]          = H1;
    return find_overlap(cell, space, macro, u, {});
  }
} // namespace



TEST_CASE("Bundles that cross in one plane overlap by their whole thickness, "
          "lifted ones by what is left, lifted by a thickness not at all",
          "[homogenization]")
{
  CHECK(overlap("plain", 0.).depth == Approx(1.2));
  CHECK(overlap("plain", 0.9).depth == Approx(0.3));
  CHECK(overlap("plain", 1.1).depth == Approx(0.1));
  CHECK(overlap("plain", 1.2).depth < 1e-9);
  CHECK(overlap("plain", 1.3).depth == 0.);
}



TEST_CASE("Before weaving only bundles of one family are compared",
          "[homogenization]")
{
  CHECK(overlap("plain", 0., 1.2).depth == 0.);
}



TEST_CASE("Neighbors in one place are seen, in the cell and in images, also in "
          "a stretched cell",
          "[homogenization]")
{
  // Wefts of a rib, 5 mm apart and 4 mm wide.
  const std::string rib = "ou/ou/uo/uo";
  CHECK(overlap(rib, 2., 0., 0.9).depth == 0.);
  const BundleOverlap one_place = overlap(rib, 2., 0., 5.);
  CHECK(one_place.depth == Approx(1.2));
  CHECK(one_place.bundle != one_place.other);
  // The spacing is 4.5 mm now, and the bundles in it 3.6 mm wide.
  CHECK(overlap(rib, 2., 0., 0.8, -0.1).depth == 0.);
  CHECK(overlap(rib, 2., 0., 4.5, -0.1).depth == Approx(1.2));
}
