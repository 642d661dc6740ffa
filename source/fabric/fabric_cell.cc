// SPDX-License-Identifier: LGPL-2.1-or-later
// The periodic cell of a woven fabric.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/fabric/weave_pattern.h>

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



  Tensor<1, 3>
  macroscopic_jump(const unsigned int       n,
                   const SymmetryOperation &g,
                   const Point<3>          &Y)
  {
    const Tensor<1, 3> here = macroscopic_displacement(n, Y);
    Tensor<1, 3>       jump = macroscopic_displacement(n, g(Y));
    for (unsigned int i = 0; i < 3; ++i)
      jump[i] -= g.Q[i] * here[i];
    return jump;
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



  std::pair<std::string, std::string>
  FabricCell::smallest_type(const CellParameters            &cell,
                            const std::vector<unsigned int> &modes)
  {
    const WeavePattern weave(cell.weave);
    const std::string  by_translations =
      weave.is_plain() ? "two-crossing cell" : "primitive cell";
    if (!weave.has_glide())
      return {by_translations,
              "because no glide plane exchanges over and under in this weave"};
    for (const unsigned int n : modes)
      if (n >= 3)
        return {by_translations,
                "because H" + std::to_string(n + 1) + " or n" +
                  std::to_string(n + 1) +
                  " is prescribed, which glide planes forbid"};
    return {"sub-unit cell",
            "because only modes 1 to 3 are prescribed, which glide planes "
            "allow"};
  }



  FabricCell::FabricCell(const CellParameters &cell, const MeshParameters &mesh)
    : parameters_(cell)
    , L1_(cell.crossing_spacing.weft)
    , L2_(cell.crossing_spacing.warp)
  {
    if (cell.type == "laminate")
      {
        const Tensor<1, 3> none({1., 1., 1.});
        area_ = L1_ * L2_;
        add_plies(mesh);
        for (int k = -1; k <= 1; ++k)
          for (int l = -1; l <= 1; ++l)
            if (k != 0 || l != 0)
              operations_.push_back(
                {"translation", none, Tensor<1, 3>({k * L1_, l * L2_, 0.})});
        return;
      }

    WeavePattern weave(cell.weave);
    axis_          = weave.center_on_two_fold_axis();
    two_fold_axis_ = cell.two_fold_axis && axis_.has_value();
    if (cell.type == "sub-unit cell" && !weave.has_glide())
      throw InputError("Type is sub-unit cell, but the weave '" + cell.weave +
                       "' has no glide plane: no shift exchanges over and "
                       "under; use Type = primitive cell or automatic "
                       "(subsection Cell).");
    if (cell.type == "two-crossing cell" && !weave.is_plain())
      throw InputError("Type is two-crossing cell, but the weave '" +
                       cell.weave +
                       "' is not plain; use Type = primitive cell or automatic "
                       "(subsection Cell).");

    // All shifts of this cell within reach of its bundles, nearest first.
    const Tensor<1, 3>              glide({1., 1., -1.}), none({1., 1., 1.});
    const int                       n_warp = weave.n_warp();
    const int                       n_weft = weave.n_weft();
    std::vector<std::array<int, 2>> shifts;
    for (int p = -2 * n_warp - 1; p <= 2 * n_warp + 1; ++p)
      for (int q = -2 * n_weft - 1; q <= 2 * n_weft + 1; ++q)
        if (shift_sign(weave, p, q) != 0)
          shifts.push_back({{p, q}});
    std::stable_sort(
      shifts.begin(), shifts.end(), [](const auto &a, const auto &b) {
        return std::make_pair(std::abs(a[0]) + std::abs(a[1]), std::abs(a[0])) <
               std::make_pair(std::abs(b[0]) + std::abs(b[1]), std::abs(b[0]));
      });
    for (const auto &[p, q] : shifts)
      {
        const bool        is_glide = shift_sign(weave, p, q) < 0;
        const std::string where =
          p == 0 ? " along Y1" :
          q == 0 ? " along Y2" :
                   " (" + std::to_string(q) + ", " + std::to_string(p) + ")";
        lattice_.push_back(
          {p == 0 && q == 0 ?
             "" :
             (is_glide ? "glide plane" : "translation") + where,
           is_glide ? glide : none,
           Tensor<1, 3>({q * L1_, p * L2_, 0.})});
      }

    add_strands(weave, mesh);
    add_operations();
    add_contacts(weave);
    if (parameters_.side_contact == CellParameters::SideContact::on)
      add_side_contacts();
  }



  int
  FabricCell::shift_sign(const WeavePattern &weave,
                         const int           warp,
                         const int           weft) const
  {
    if (parameters_.type == "unit cell")
      return warp % static_cast<int>(weave.n_warp()) == 0 &&
                 weft % static_cast<int>(weave.n_weft()) == 0 ?
               1 :
               0;
    if (weave.is_translation(warp, weft))
      return 1;
    return parameters_.type == "sub-unit cell" && weave.is_glide(warp, weft) ?
             -1 :
             0;
  }



  void
  FabricCell::add_strands(const WeavePattern &weave, const MeshParameters &mesh)
  {
    const Tensor<1, 3>       e1({1., 0., 0.}), e2({0., 1., 0.});
    const std::array<int, 2> twice_origin =
      axis_ ? *axis_ : std::array<int, 2>{{0, 0}};
    area_ = 0;
    for (const bool is_warp : {true, false})
      {
        // Shifts (across, along) of a bundle of this family.
        const auto sign = [&](const int across, const int along) {
          return is_warp ? shift_sign(weave, across, along) :
                           shift_sign(weave, along, across);
        };
        const int    n_parallel   = is_warp ? weave.n_warp() : weave.n_weft();
        const int    n_along      = is_warp ? weave.n_weft() : weave.n_warp();
        const int    origin       = twice_origin[is_warp ? 0 : 1];
        const int    origin_along = twice_origin[is_warp ? 1 : 0];
        const double across_L     = is_warp ? L2_ : L1_;
        const double along_L      = is_warp ? L1_ : L2_;
        const BundleSection section =
          is_warp ? parameters_.warp_section() : parameters_.weft_section();

        std::vector<int> indices;
        for (int i = 0; i < n_parallel; ++i)
          {
            bool is_new = true;
            for (const int other : indices)
              for (int q = 0; q < n_along && is_new; ++q)
                is_new = sign(i - other, q) == 0;
            if (!is_new)
              continue;
            indices.push_back(i);

            int n = 1;
            while (sign(0, n) == 0)
              ++n;
            // If a 2-fold axis goes through the bundle, let it begin so that
            // it maps onto itself: then half of it need not be integrated. The
            // axis takes crossing j to crossing origin_along - j + q where
            // (2 i - origin, q) is a translation.
            int first = 0;
            for (int candidate = 0; axis_ && candidate > -n; --candidate)
              if (sign(2 * i - origin, 2 * candidate + n - 1 - origin_along) >
                  0)
                {
                  first = candidate;
                  break;
                }

            NURBSPatch<3> patch = straight_bundle(section, along_L, n, mesh);
            Strand        s;
            s.index       = i;
            s.position    = (i - 0.5 * origin) * across_L;
            s.first       = first;
            s.n_crossings = n;
            s.begin       = (first - 0.5 - 0.5 * origin_along) * along_L;
            s.length      = n * along_L;
            s.held        = false;
            for (int q = 0; axis_ && q < n_along; ++q)
              s.held = s.held || sign(2 * i - origin, q) != 0;
            // The axis after a translation (2 i - origin, q) maps the bundle
            // onto itself and keeps the place (origin_along + q) / 2, counted
            // in crossings.
            double on_axis = 0.5, distance = 1.;
            for (int q = 2 * first - origin_along;
                 axis_ && q <= 2 * (first + n) - origin_along;
                 ++q)
              if (sign(2 * i - origin, q) > 0)
                {
                  const double xi =
                    (0.5 * (origin_along + q) - first + 0.5) / n;
                  if (xi > 0. && xi < 1. &&
                      std::abs(xi - 0.5) < distance - 1e-12)
                    {
                      on_axis  = xi;
                      distance = std::abs(xi - 0.5);
                    }
                }
            axis_parameter_.push_back(on_axis);
            patch.transform([&](const Point<3> &P) {
              return is_warp ?
                       Point<3>(P[0] + s.begin, P[1] + s.position, P[2]) :
                       Point<3>(-P[1] + s.position, P[0] + s.begin, P[2]);
            });
            bundles_.push_back(
              {is_warp ? FiberBundle::Family::warp : FiberBundle::Family::weft,
               patch,
               is_warp ? e1 : e2,
               static_cast<unsigned int>(bundles_.size())});
            strands_.push_back(s);
            if (is_warp)
              area_ += n * L1_ * L2_;
          }
      }
  }



  Point<3>
  FabricCell::middle(const unsigned int bundle) const
  {
    const Strand &s     = strands_[bundle];
    const double  along = s.begin + 0.5 * s.length;
    return bundles_[bundle].family == FiberBundle::Family::warp ?
             Point<3>(along, s.position, 0.) :
             Point<3>(s.position, along, 0.);
  }



  NURBSPatch<3>
  FabricCell::straight_bundle(const BundleSection  &section,
                              const double          spacing,
                              const unsigned int    n_crossings,
                              const MeshParameters &mesh) const
  {
    const NURBSPatch<2> face = section.patch(mesh.degree, mesh.elements_across);
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (unsigned int l = 0; l < face.n_control_points(); ++l)
      for (const double end : {0., 1.})
        {
          const Point<2> &P = face.control_points()[l];
          points.emplace_back(end * spacing * n_crossings, P[0], P[1]);
          weights.push_back(face.weights()[l]);
        }
    NURBSPatch<3> bundle(
      {{KnotVector::uniform(1, 1), face.knot_vector(0), face.knot_vector(1)}},
      points,
      weights);
    bundle.make_isotropic();
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
    bundle.subdivide(2, mesh.elements_through);
    return bundle;
  }



  void
  FabricCell::add_plies(const MeshParameters &mesh)
  {
    const double thickness = parameters_.bundle_thickness.warp;
    const double t         = thickness / parameters_.plies.size();
    for (unsigned int k = 0; k < parameters_.plies.size(); ++k)
      {
        const double          bottom = -0.5 * thickness + k * t;
        std::vector<Point<3>> points;
        for (const double z : {bottom, bottom + t})
          for (const double y : {-0.5 * L2_, 0.5 * L2_})
            for (const double x : {-0.5 * L1_, 0.5 * L1_})
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
        strands_.push_back({0, 0., 0, 1, -0.5 * L1_, L1_, false});
        axis_parameter_.push_back(0.5);
      }
    mirror_.assign(bundles_.size(), -1);
    mirror_operation_.resize(bundles_.size());
  }



  void
  FabricCell::add_operations()
  {
    // Boxes of the bundles in plane, to find which operations relate any of
    // their points.
    const auto touches = [&](const SymmetryOperation &g) {
      for (unsigned int b = 0; b < bundles_.size(); ++b)
        for (unsigned int c = 0; c < bundles_.size(); ++c)
          {
            const bool   warp = bundles_[b].family == FiberBundle::Family::warp;
            const double across_L = warp ? L2_ : L1_;
            const Point<3> from = g(middle(b)), to = middle(c);
            if (bundles_[b].family == bundles_[c].family &&
                std::abs(from[warp ? 1 : 0] - to[warp ? 1 : 0]) <
                  1e-6 * across_L &&
                std::abs(from[warp ? 0 : 1] - to[warp ? 0 : 1]) <
                  0.5 * (strands_[b].length + strands_[c].length) +
                    1e-6 * across_L)
              return true;
          }
      return false;
    };
    for (const SymmetryOperation &g : lattice_)
      if (!g.name.empty() && touches(g))
        operations_.push_back(g);

    mirror_.assign(bundles_.size(), -1);
    mirror_operation_.resize(bundles_.size());
    if (!two_fold_axis_)
      return;
    const SymmetryOperation axis{"2-fold axis along Y3",
                                 Tensor<1, 3>({-1., -1., 1.}),
                                 Tensor<1, 3>()};
    for (const SymmetryOperation &shift : lattice_)
      {
        SymmetryOperation g = axis.then(shift);
        g.name              = shift.name.empty() ? axis.name : shift.name;
        if (!touches(g))
          continue;
        operations_.push_back(g);
        // Where it takes whole bundles: the middle of one to that of another.
        for (unsigned int b = 0; b < bundles_.size(); ++b)
          for (unsigned int c = 0; c < bundles_.size(); ++c)
            if (g.Q[2] > 0 && bundles_[b].family == bundles_[c].family &&
                g(middle(b)).distance(middle(c)) < 1e-9 * (L1_ + L2_))
              {
                mirror_[b]           = c;
                mirror_operation_[b] = g;
              }
      }
  }



  void
  FabricCell::add_contacts(const WeavePattern &weave)
  {
    // Every crossing of every secondary bundle: there the weft's top touches
    // the bottom of a warp strand that is over it, or its bottom the top of one
    // that is under it; the other way round if the warp is secondary.
    const bool by_warp = parameters_.warp_secondary;
    const auto secondary =
      by_warp ? FiberBundle::Family::warp : FiberBundle::Family::weft;
    // Component along the secondary bundle, and spacings of its crossings and
    // of those of a primary strand.
    const unsigned int along   = by_warp ? 0 : 1;
    const unsigned int across  = 1 - along;
    const double       along_L = by_warp ? L1_ : L2_;
    const double       other_L = by_warp ? L2_ : L1_;
    const int          origin =
      axis_ ? (*axis_)[by_warp ? 1 : 0] : 0; // twice, along the secondary

    for (unsigned int s = 0; s < bundles_.size(); ++s)
      {
        if (bundles_[s].family != secondary)
          continue;
        ContactCandidates pairs[2] = {{s, 0, {}}, {s, 1, {}}};
        for (unsigned int k = 0; k < strands_[s].n_crossings; ++k)
          {
            const int  crossing = strands_[s].first + static_cast<int>(k);
            const bool warp_over =
              by_warp ? weave.warp_is_over(strands_[s].index, crossing) :
                        weave.warp_is_over(crossing, strands_[s].index);
            // Whether the primary strand is above.
            const bool   above       = by_warp ? !warp_over : warp_over;
            const double Y_secondary = strands_[s].position;
            const double Y_primary   = (crossing - 0.5 * origin) * along_L;
            auto        &faces       = pairs[above ? 1 : 0].primaries;
            for (unsigned int b = 0; b < bundles_.size(); ++b)
              for (const SymmetryOperation &g : lattice_)
                {
                  if (bundles_[b].family == secondary ||
                      std::abs(strands_[b].position + g.a[along] - Y_primary) >
                        1e-6 * along_L)
                    continue;
                  const double length = strands_[b].length;
                  const double begin  = strands_[b].begin + g.a[across];
                  // The piece that crosses, and its continuations as far as
                  // a sheared contact zone can reach: half a spacing beyond.
                  const bool crosses =
                    begin < Y_secondary && Y_secondary < begin + length;
                  const bool near =
                    begin < Y_secondary + 0.9 * other_L &&
                    begin + length > Y_secondary - 0.9 * other_L;
                  if (!crosses && !(near && parameters_.images))
                    continue;
                  SurfaceImage image;
                  image.bundle = b;
                  // A glide turns top and bottom over.
                  image.side        = (above ? 0 : 1) ^ (g.Q[2] < 0 ? 1 : 0);
                  image.operation   = g;
                  image.offset_sign = above ? 1. : -1.;
                  image.period =
                    crosses ? 0 :
                              std::lround((begin + 0.5 * length - Y_secondary) /
                                          length);
                  if (!crosses && image.period == 0)
                    image.period = begin > Y_secondary ? 1 : -1;
                  image.strand = k;
                  faces.push_back(image);
                }
          }
        for (ContactCandidates &pair : pairs)
          if (!pair.primaries.empty())
            contacts_.push_back(pair);
      }
  }



  void
  FabricCell::add_side_contacts()
  {
    // The edge at the end of the direction across of every bundle against the
    // other edge of the next parallel strand. The edge at the begin needs no
    // pair of its own: a shift of the cell makes it the primary side here. Each
    // bundle counts once, since the 2-fold axis exchanges the roles.
    for (unsigned int s = 0; s < bundles_.size(); ++s)
      {
        const bool   warp     = bundles_[s].family == FiberBundle::Family::warp;
        const int    along    = warp ? 0 : 1;
        const int    across   = 1 - along;
        const double across_L = warp ? L2_ : L1_;
        const double along_L  = warp ? L1_ : L2_;
        // The weft is the warp turned by +90 degrees: its direction across
        // points to -Y1.
        const double position =
          strands_[s].position + (warp ? across_L : -across_L);
        const double begin = strands_[s].begin, length = strands_[s].length;
        ContactCandidates pair{s, 1, {}, 1};
        for (unsigned int b = 0; b < bundles_.size(); ++b)
          for (const SymmetryOperation &g : lattice_)
            {
              const double other_begin = strands_[b].begin + g.a[along];
              if (bundles_[b].family != bundles_[s].family ||
                  std::abs(strands_[b].position + g.a[across] - position) >
                    1e-6 * across_L ||
                  other_begin > begin + length + 0.9 * along_L ||
                  other_begin + strands_[b].length < begin - 0.9 * along_L)
                continue;
              SurfaceImage image;
              image.bundle      = b;
              image.side        = 0;
              image.direction   = 1;
              image.operation   = g;
              image.offset_sign = 0.;
              image.strand      = 0;
              image.period =
                std::lround((other_begin - begin) / strands_[b].length);
              pair.primaries.push_back(image);
            }
        if (!pair.primaries.empty())
          contacts_.push_back(pair);
      }
  }



  std::vector<CrossingPiece>
  FabricCell::repeat() const
  {
    std::vector<CrossingPiece> pieces;
    if (parameters_.type == "laminate")
      {
        const SymmetryOperation identity{"",
                                         Tensor<1, 3>({1., 1., 1.}),
                                         Tensor<1, 3>()};
        for (unsigned int b = 0; b < bundles_.size(); ++b)
          pieces.push_back({b, 0, identity, true, true});
        return pieces;
      }

    const WeavePattern weave(parameters_.weave);
    for (const bool warp : {true, false})
      {
        const int n_parallel =
          std::max(2u, warp ? weave.n_warp() : weave.n_weft());
        const int n_along =
          std::max(2u, warp ? weave.n_weft() : weave.n_warp());
        const int    along = warp ? 0 : 1, across = 1 - along;
        const double along_L  = warp ? L1_ : L2_;
        const double across_L = warp ? L2_ : L1_;
        // Crossings lie at whole or at half numbers of spacings.
        const auto number = [](const double position, const double L) {
          return static_cast<int>(std::floor(position / L + 0.25));
        };
        std::vector<bool> known(n_parallel * n_along, false);
        for (const SymmetryOperation &g : lattice_) // nearest first
          for (unsigned int b = 0; b < bundles_.size(); ++b)
            {
              const Strand &s = strands_[b];
              const int     i = number(s.position + g.a[across], across_L);
              if ((bundles_[b].family == FiberBundle::Family::warp) != warp ||
                  i < 0 || i >= n_parallel)
                continue;
              for (unsigned int k = 0; k < s.n_crossings; ++k)
                {
                  const int j =
                    number(s.begin + (k + 0.5) * along_L + g.a[along], along_L);
                  if (j < 0 || j >= n_along || known[i * n_along + j])
                    continue;
                  known[i * n_along + j] = true;
                  pieces.push_back({b, k, g, j == 0, j == n_along - 1});
                }
            }
      }
    return pieces;
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
  FabricCell::has_floating_bundles() const
  {
    bool result = false;
    for (const Strand &strand : strands_)
      result = result || !strand.held;
    return result && two_fold_axis_;
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
  FabricCell::symmetry_weight(const unsigned int bundle,
                              const Point<3>    &Y) const
  {
    const int partner = mirror_[bundle];
    if (partner < 0)
      return 1;
    if (partner != static_cast<int>(bundle))
      return partner > static_cast<int>(bundle) ? 2 : 0;
    const Point<3> image     = mirror_operation_[bundle](Y);
    const double   tolerance = 1e-8 * std::min(L1_, L2_);
    for (unsigned int i = 0; i < 2; ++i)
      if (std::abs(Y[i] - image[i]) > tolerance)
        return Y[i] > image[i] ? 2 : 0;
    return 1;
  }
} // namespace NPT
