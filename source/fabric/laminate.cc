// SPDX-License-Identifier: LGPL-2.1-or-later
// The plies of a laminate.

#include <npt_dealii/fabric/laminate.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // A brick of L1 x L2 between two heights.
    NURBSPatch<3>
    make_ply(const double          L1,
             const double          L2,
             const double          bottom,
             const double          top,
             const MeshParameters &mesh)
    {
      std::vector<Point<3>> points;
      for (const double z : {bottom, top})
        for (const double y : {-0.5 * L2, 0.5 * L2})
          for (const double x : {-0.5 * L1, 0.5 * L1})
            points.emplace_back(x, y, z);
      NURBSPatch<3> ply({{KnotVector::uniform(1, 1),
                          KnotVector::uniform(1, 1),
                          KnotVector::uniform(1, 1)}},
                        points);
      for (unsigned int d = 0; d < 3; ++d)
        ply.elevate_degree(d, mesh.degree - 1);
      ply.subdivide(0, mesh.elements_along);
      ply.subdivide(1, mesh.elements_across);
      ply.subdivide(2, mesh.elements_through);
      return ply;
    }
  } // namespace



  CellLayout
  make_laminate(const CellParameters &cell, const MeshParameters &mesh)
  {
    const double L1 = cell.crossing_spacing.weft;
    const double L2 = cell.crossing_spacing.warp;
    CellLayout   layout;
    layout.area = L1 * L2;

    const double thickness = cell.bundle_thickness.warp;
    const double t         = thickness / cell.plies.size();
    for (unsigned int k = 0; k < cell.plies.size(); ++k)
      {
        const double bottom = -0.5 * thickness + k * t;
        const double angle  = cell.plies[k] * dealii::numbers::PI / 180.;
        layout.bundles.push_back(
          {FiberBundle::Family::ply,
           make_ply(L1, L2, bottom, bottom + t, mesh),
           Tensor<1, 3>({std::cos(angle), std::sin(angle), 0.}),
           0});
        layout.repeat.push_back(
          {k, 0, SymmetryOperation::identity(), true, true});
      }
    for (int k = -1; k <= 1; ++k)
      for (int l = -1; l <= 1; ++l)
        if (k != 0 || l != 0)
          layout.operations.push_back(
            SymmetryOperation::translation("translation",
                                           Tensor<1, 3>({k * L1, l * L2, 0.})));
    return layout;
  }
} // namespace NPT
