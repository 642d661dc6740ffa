// SPDX-License-Identifier: LGPL-2.1-or-later
// The periodic cell of a woven fabric.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/cell/fabric_cell.h>
#include <npt_dealii/cell/weave_pattern.h>

#include <algorithm>
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



  SymmetryOperation
  SymmetryOperation::then(const SymmetryOperation &next) const
  {
    SymmetryOperation result;
    result.name = name.empty()      ? next.name :
                  next.name.empty() ? name :
                                      name + ", then " + next.name;
    for (unsigned int i = 0; i < 3; ++i)
      {
        result.Q[i] = next.Q[i] * Q[i];
        result.a[i] = next.Q[i] * a[i] + next.a[i];
      }
    return result;
  }



  std::string
  FabricCell::smallest_type(const CellParameters            &cell,
                            const std::vector<unsigned int> &modes)
  {
    if (!WeavePattern(cell.weave).is_plain())
      return "unit cell";
    for (const unsigned int n : modes)
      if (n >= 3)
        return "two-crossing cell";
    return "sub-unit cell";
  }



  FabricCell::FabricCell(const CellParameters &cell, const MeshParameters &mesh)
    : parameters_(cell)
  {
    const double       L = cell.crossing_spacing;
    const Tensor<1, 3> e1({1., 0., 0.}), e2({0., 1., 0.});
    const Tensor<1, 3> glide({1., 1., -1.}), none({1., 1., 1.});

    if (cell.type == "laminate")
      {
        area_ = L * L;
        add_plies(mesh);
        add_operations({{{"translation along Y1", none, L * e1},
                         {"translation along Y2", none, L * e2}}});
        return;
      }

    WeavePattern weave(cell.weave);
    const bool   has_axis = weave.center_on_two_fold_axis();
    two_fold_axis_        = cell.two_fold_axis && has_axis;
    const auto warp       = [&](const double position, const unsigned int n) {
      bundles_.push_back({FiberBundle::Family::warp,
                          NURBSPatch<3>(lens_bundle(n, mesh)),
                          e1,
                          static_cast<unsigned int>(bundles_.size())});
      strands_.push_back({position, -0.5 * L, n});
    };
    const auto weft = [&](const double position, const unsigned int n) {
      bundles_.push_back({FiberBundle::Family::weft,
                          NURBSPatch<3>(lens_bundle(n, mesh)),
                          e2,
                          static_cast<unsigned int>(bundles_.size())});
      strands_.push_back({position, -0.5 * L, n});
    };

    if (cell.type == "sub-unit cell" || cell.type == "two-crossing cell")
      {
        if (!weave.is_plain())
          throw InputError("Type is " + cell.type + ", but the weave '" +
                           cell.weave +
                           "' is not plain; use Type = unit cell or automatic "
                           "(subsection Cell).");
        const bool         one = cell.type == "sub-unit cell";
        const unsigned int n   = one ? 1 : 2;
        area_                  = n * L * L;
        warp(0., n);
        weft(0., n);
        if (one)
          add_operations({{{"glide plane along Y1", glide, L * e1},
                           {"glide plane along Y2", glide, L * e2}}});
        else
          add_operations({{{"translation (L, L)", none, L * (e1 + e2)},
                           {"translation (L, -L)", none, L * (e1 - e2)}}});
      }
    else
      {
        area_ = weave.n_warp() * weave.n_weft() * L * L;
        for (unsigned int i = 0; i < weave.n_warp(); ++i)
          warp(i * L, weave.n_weft());
        for (unsigned int j = 0; j < weave.n_weft(); ++j)
          weft(j * L, weave.n_warp());
        add_operations(
          {{{"translation along Y1", none, weave.n_weft() * L * e1},
            {"translation along Y2", none, weave.n_warp() * L * e2}}});
      }

    // Put the bundles in their places.
    for (unsigned int b = 0; b < bundles_.size(); ++b)
      {
        const Strand &s      = strands_[b];
        const bool along_one = bundles_[b].family == FiberBundle::Family::warp;
        bundles_[b].patch.transform([&](const Point<3> &P) {
          return along_one ? Point<3>(P[0] + s.begin, P[1] + s.position, P[2]) :
                             Point<3>(-P[1] + s.position, P[0] + s.begin, P[2]);
        });
      }

    // Where the 2-fold axis takes the bundles as a whole: the middle of a
    // bundle onto the middle of another one.
    mirror_.assign(bundles_.size(), -1);
    mirror_operation_.resize(bundles_.size());
    if (two_fold_axis_)
      for (unsigned int b = 0; b < bundles_.size(); ++b)
        for (const SymmetryOperation &g : operations_)
          for (unsigned int c = 0; c < bundles_.size(); ++c)
            {
              const auto middle = [&](const unsigned int k) {
                const double along =
                  strands_[k].begin + 0.5 * strands_[k].n_crossings * L;
                return bundles_[k].family == FiberBundle::Family::warp ?
                         Point<3>(along, strands_[k].position, 0.) :
                         Point<3>(strands_[k].position, along, 0.);
              };
              if (g.Q[0] < 0 && g.Q[2] > 0 &&
                  bundles_[b].family == bundles_[c].family &&
                  g(middle(b)).distance(middle(c)) < 1e-9 * L)
                {
                  mirror_[b]           = c;
                  mirror_operation_[b] = g;
                }
            }
    add_contacts(weave);
  }



  NURBSPatch<3>
  FabricCell::lens_bundle(const unsigned int    n_crossings,
                          const MeshParameters &mesh) const
  {
    const double        L = parameters_.crossing_spacing * n_crossings;
    const NURBSPatch<2> section =
      lens_section(parameters_.bundle_width,
                   parameters_.bundle_thickness,
                   parameters_.blunt_tip * parameters_.bundle_thickness);
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (unsigned int l = 0; l < section.n_control_points(); ++l)
      for (const double end : {0., 1.})
        {
          const Point<2> &P = section.control_points()[l];
          points.emplace_back(end * L, P[0], P[1]);
          weights.push_back(section.weights()[l]);
        }
    NURBSPatch<3> bundle({{KnotVector::uniform(1, 1),
                           section.knot_vector(0),
                           section.knot_vector(1)}},
                         points,
                         weights);
    for (unsigned int d = 0; d < 3; ++d)
      {
        if (mesh.degree < bundle.knot_vector(d).degree())
          throw InputError("Degree is " + std::to_string(mesh.degree) +
                           "; this section needs at least " +
                           std::to_string(bundle.knot_vector(d).degree()) +
                           " (subsection Mesh).");
        bundle.elevate_degree(d, mesh.degree - bundle.knot_vector(d).degree());
      }
    bundle.subdivide(0, mesh.elements_along * n_crossings);
    // Between crossings the bundle is C0, as it is over the periodic faces of
    // the sub-unit cell: all cells of a weave then are the same discretization,
    // and the 2-fold axes map control points onto control points.
    const auto         &breaks = bundle.knot_vector(0).breaks();
    std::vector<double> joints;
    for (unsigned int k = 1; k < n_crossings; ++k)
      for (unsigned int m = 1; m < mesh.degree; ++m)
        joints.push_back(breaks[k * mesh.elements_along]);
    bundle.insert_knots(0, joints);
    bundle.subdivide(1, mesh.elements_across);
    bundle.subdivide(2, mesh.elements_through);
    return bundle;
  }



  void
  FabricCell::add_plies(const MeshParameters &mesh)
  {
    const double L = parameters_.crossing_spacing;
    const double t = parameters_.bundle_thickness / parameters_.plies.size();
    for (unsigned int k = 0; k < parameters_.plies.size(); ++k)
      {
        const double bottom = -0.5 * parameters_.bundle_thickness + k * t;
        std::vector<Point<3>> points;
        for (const double z : {bottom, bottom + t})
          for (const double y : {-0.5 * L, 0.5 * L})
            for (const double x : {-0.5 * L, 0.5 * L})
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
        const double angle = parameters_.plies[k] * dealii::numbers::PI / 180.;
        bundles_.push_back(
          {FiberBundle::Family::ply,
           ply,
           Tensor<1, 3>({std::cos(angle), std::sin(angle), 0.}),
           0});
        strands_.push_back({0., -0.5 * L, 1});
      }
    mirror_.assign(bundles_.size(), -1);
    mirror_operation_.resize(bundles_.size());
  }



  void
  FabricCell::add_operations(const std::array<SymmetryOperation, 2> &generators)
  {
    const Tensor<1, 3>      none({1., 1., 1.});
    const SymmetryOperation identity{"", none, Tensor<1, 3>()};
    const auto              inverse = [](const SymmetryOperation &g) {
      SymmetryOperation result = g;
      for (unsigned int i = 0; i < 3; ++i)
        result.a[i] = -g.Q[i] * g.a[i];
      return result;
    };
    // Powers -2..2 of both generators reach every neighbor that a bundle of
    // the base cell can be mapped onto or can touch.
    lattice_ = {identity};
    for (int k = -2; k <= 2; ++k)
      for (int l = -2; l <= 2; ++l)
        {
          SymmetryOperation g = identity;
          for (int i = 0; i < std::abs(k); ++i)
            g = g.then(k > 0 ? generators[0] : inverse(generators[0]));
          for (int i = 0; i < std::abs(l); ++i)
            g = g.then(l > 0 ? generators[1] : inverse(generators[1]));
          g.name = k != 0 ? generators[0].name : generators[1].name;
          if (k != 0 || l != 0)
            lattice_.push_back(g);
        }
    operations_.assign(lattice_.begin() + 1, lattice_.end());
    if (two_fold_axis_)
      {
        const SymmetryOperation axis{"2-fold axis along Y3",
                                     Tensor<1, 3>({-1., -1., 1.}),
                                     Tensor<1, 3>()};
        for (const SymmetryOperation &g : lattice_)
          {
            operations_.push_back(axis.then(g));
            operations_.back().name = g.name.empty() ? axis.name : g.name;
          }
      }
  }



  void
  FabricCell::add_contacts(const WeavePattern &weave)
  {
    // Every crossing of every weft bundle: there the weft's top touches the
    // bottom of a warp strand that is over it, or its bottom the top of one
    // that is under it.
    const double L = parameters_.crossing_spacing;
    for (unsigned int weft = 0; weft < bundles_.size(); ++weft)
      {
        if (bundles_[weft].family != FiberBundle::Family::weft)
          continue;
        ContactCandidates pairs[2] = {{weft, 0, {}}, {weft, 1, {}}};
        for (unsigned int k = 0; k < strands_[weft].n_crossings; ++k)
          {
            const int    warp_number = k;
            const int    weft_number = std::lround(strands_[weft].position / L);
            const bool   over  = weave.warp_is_over(warp_number, weft_number);
            const double Y1    = strands_[weft].position;
            const double Y2    = warp_number * L;
            auto        &faces = pairs[over ? 1 : 0].primaries;
            for (unsigned int b = 0; b < bundles_.size(); ++b)
              for (const SymmetryOperation &g : lattice_)
                {
                  if (bundles_[b].family != FiberBundle::Family::warp ||
                      std::abs(strands_[b].position + g.a[1] - Y2) > 1e-9 * L)
                    continue;
                  const double length = strands_[b].n_crossings * L;
                  const double begin  = strands_[b].begin + g.a[0];
                  // The piece that crosses, and its continuations as far as
                  // a sheared contact zone can reach: half a spacing beyond.
                  const bool crosses = begin < Y1 && Y1 < begin + length;
                  const bool near =
                    begin < Y1 + 0.9 * L && begin + length > Y1 - 0.9 * L;
                  if (!crosses && !(near && parameters_.images))
                    continue;
                  SurfaceImage image;
                  image.bundle = b;
                  // A glide turns top and bottom over.
                  image.side        = (over ? 0 : 1) ^ (g.Q[2] < 0 ? 1 : 0);
                  image.operation   = g;
                  image.offset_sign = over ? 1. : -1.;
                  image.period =
                    crosses ? 0 :
                              std::lround((begin + 0.5 * length - Y1) / length);
                  if (!crosses && image.period == 0)
                    image.period = begin > Y1 ? 1 : -1;
                  image.strand = k;
                  faces.push_back(image);
                }
          }
        for (ContactCandidates &pair : pairs)
          if (!pair.primaries.empty())
            contacts_.push_back(pair);
      }
  }



  bool
  FabricCell::needs_vertical_pin() const
  {
    for (const SymmetryOperation &g : operations_)
      if (g.Q[2] < 0)
        return false;
    return true;
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
  FabricCell::multiplicity(const unsigned int bundle, const Point<3> &Y) const
  {
    const int partner = mirror_[bundle];
    if (partner < 0)
      return 1;
    if (partner != static_cast<int>(bundle))
      return partner > static_cast<int>(bundle) ? 2 : 0;
    const Point<3> image     = mirror_operation_[bundle](Y);
    const double   tolerance = 1e-8 * parameters_.crossing_spacing;
    for (unsigned int i = 0; i < 2; ++i)
      if (std::abs(Y[i] - image[i]) > tolerance)
        return Y[i] > image[i] ? 2 : 0;
    return 1;
  }
} // namespace NPT
