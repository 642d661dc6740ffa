// SPDX-License-Identifier: LGPL-2.1-or-later
// The periodic cell of a woven fabric.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/cell/fabric_cell.h>

#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  Tensor<1, 3>
  macroscopic_displacement(const unsigned int n, const Point<3> &Y)
  {
    Tensor<1, 3> w;
    switch (n)
      {
        case 0:
          w[0] = Y[0];
          break;
        case 1:
          w[1] = Y[1];
          break;
        case 2:
          w[0] = 0.5 * Y[1];
          w[1] = 0.5 * Y[0];
          break;
        case 3:
          w[0] = Y[2] * Y[0];
          w[2] = -0.5 * Y[0] * Y[0];
          break;
        case 4:
          w[1] = Y[2] * Y[1];
          w[2] = -0.5 * Y[1] * Y[1];
          break;
        case 5:
          w[0] = 0.5 * Y[2] * Y[1];
          w[1] = 0.5 * Y[2] * Y[0];
          w[2] = -0.5 * Y[0] * Y[1];
          break;
        default:
          Assert(false, dealii::ExcIndexRange(n, 0, 6));
      }
    return w;
  }



  bool
  SymmetryOperation::keeps_mode(const unsigned int n) const
  {
    // In-plane components 11, 22, 12 of strain (n < 3) or curvature.
    const double in_plane  = (n % 3 == 2) ? Q[0] * Q[1] : 1.;
    const double thickness = n < 3 ? 1. : Q[2];
    return in_plane * thickness > 0;
  }



  FabricCell::FabricCell(const CellParameters &cell, const MeshParameters &mesh)
    : parameters_(cell)
    , area_(cell.crossing_spacing * cell.crossing_spacing)
  {
    const double L = cell.crossing_spacing;

    // A straight bundle along Y1: the section extruded.
    const NURBSPatch<2> section =
      lens_section(cell.bundle_width,
                   cell.bundle_thickness,
                   cell.blunt_tip * cell.bundle_thickness);
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (unsigned int l = 0; l < section.n_control_points(); ++l)
      for (const double end : {-0.5, 0.5})
        {
          const Point<2> &P = section.control_points()[l];
          points.emplace_back(end * L, P[0], P[1]);
          weights.push_back(section.weights()[l]);
        }
    NURBSPatch<3> warp({{KnotVector::uniform(1, 1),
                         section.knot_vector(0),
                         section.knot_vector(1)}},
                       points,
                       weights);
    for (unsigned int d = 0; d < 3; ++d)
      {
        if (mesh.degree < warp.knot_vector(d).degree())
          throw InputError("Degree is " + std::to_string(mesh.degree) +
                           "; this section needs at least " +
                           std::to_string(warp.knot_vector(d).degree()) +
                           " (subsection Mesh).");
        warp.elevate_degree(d, mesh.degree - warp.knot_vector(d).degree());
      }
    warp.subdivide(0, mesh.elements_along);
    warp.subdivide(1, mesh.elements_across);
    warp.subdivide(2, mesh.elements_through);

    NURBSPatch<3> weft = warp;
    weft.transform(
      [](const Point<3> &P) { return Point<3>(-P[1], P[0], P[2]); });

    const Tensor<1, 3> e1({1., 0., 0.}), e2({0., 1., 0.});
    bundles_.push_back({FiberBundle::Family::warp, warp, e1, +1.});
    bundles_.push_back({FiberBundle::Family::weft, weft, e2, -1.});

    operations_.push_back(
      {"glide plane along Y1", Tensor<1, 3>({1., 1., -1.}), L * e1});
    operations_.push_back(
      {"glide plane along Y2", Tensor<1, 3>({1., 1., -1.}), L * e2});
    if (cell.two_fold_axis)
      operations_.push_back(
        {"2-fold axis along Y3", Tensor<1, 3>({-1., -1., 1.}), Tensor<1, 3>()});

    // Secondary: top of the weft; primary: bottom of the warp.
    contacts_.push_back({1, 1, {{0, 0}}});
  }



  bool
  FabricCell::represents_mode(const unsigned int n) const
  {
    return obstacle(n).empty();
  }



  std::string
  FabricCell::obstacle(const unsigned int n) const
  {
    for (const SymmetryOperation &operation : operations_)
      if (!operation.keeps_mode(n))
        return operation.name;
    return "";
  }



  unsigned int
  FabricCell::multiplicity(const Point<3> &Y) const
  {
    if (!parameters_.two_fold_axis)
      return 1;
    const double tolerance = 1e-8 * parameters_.crossing_spacing;
    const double key       = std::abs(Y[0]) > tolerance ? Y[0] : Y[1];
    if (std::abs(key) <= tolerance)
      return 1;
    return key > 0 ? 2 : 0;
  }
} // namespace NPT
