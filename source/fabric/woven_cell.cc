// SPDX-License-Identifier: LGPL-2.1-or-later
// The bundles of a weave's cell and the operations that relate them.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/layers.h>
#include <npt_dealii/fabric/woven_cell.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  WovenLattice::WovenLattice(const CellParameters &cell)
    : weave_(cell.weave)
    , translations_of_repeat_only_(cell.type == "unit cell")
    , with_glides_(cell.type == "sub-unit cell")
    , spacing_({{cell.crossing_spacing.weft, cell.crossing_spacing.warp}})
    , axis_(weave_.center_on_two_fold_axis())
  {
    if (with_glides_ && !weave_.has_glide())
      throw InputError("Type is sub-unit cell, but the weave '" + cell.weave +
                       "' has no glide plane: no shift exchanges over and "
                       "under; use Type = primitive cell or automatic "
                       "(subsection Cell).");
    if (cell.type == "two-crossing cell" && !weave_.is_plain())
      throw InputError("Type is two-crossing cell, but the weave '" +
                       cell.weave +
                       "' is not plain; use Type = primitive cell or automatic "
                       "(subsection Cell).");
  }



  int
  WovenLattice::shift_sign(const int warp, const int weft) const
  {
    if (translations_of_repeat_only_)
      return warp % static_cast<int>(weave_.n_warp()) == 0 &&
                 weft % static_cast<int>(weave_.n_weft()) == 0 ?
               1 :
               0;
    if (weave_.is_translation(warp, weft))
      return 1;
    return with_glides_ && weave_.is_glide(warp, weft) ? -1 : 0;
  }



  std::vector<SymmetryOperation>
  WovenLattice::shifts() const
  {
    const int                       n_warp = weave_.n_warp();
    const int                       n_weft = weave_.n_weft();
    std::vector<std::array<int, 2>> numbers;
    for (int p = -2 * n_warp - 1; p <= 2 * n_warp + 1; ++p)
      for (int q = -2 * n_weft - 1; q <= 2 * n_weft + 1; ++q)
        if (shift_sign(p, q) != 0)
          numbers.push_back({{p, q}});
    std::stable_sort(
      numbers.begin(), numbers.end(), [](const auto &a, const auto &b) {
        return std::make_pair(std::abs(a[0]) + std::abs(a[1]), std::abs(a[0])) <
               std::make_pair(std::abs(b[0]) + std::abs(b[1]), std::abs(b[0]));
      });

    std::vector<SymmetryOperation> result;
    for (const auto &[p, q] : numbers)
      {
        const std::string where =
          p == 0 ? " along Y1" :
          q == 0 ? " along Y2" :
                   " (" + std::to_string(q) + ", " + std::to_string(p) + ")";
        const Tensor<1, 3> a({q * spacing_[0], p * spacing_[1], 0.});
        result.push_back(
          p == 0 && q == 0 ?
            SymmetryOperation::identity() :
          shift_sign(p, q) < 0 ?
            SymmetryOperation::glide_plane("glide plane" + where, a) :
            SymmetryOperation::translation("translation" + where, a));
      }
    return result;
  }



  std::vector<SymmetryOperation>
  WovenLattice::turns(const bool with_axis, const bool with_mirrors) const
  {
    std::vector<SymmetryOperation> result;
    if (with_axis)
      result.push_back(SymmetryOperation::two_fold_axis());
    // Bundle i lies at (i - origin / 2) times the spacing. A mirror through
    // the axis is best: no shift of the repeat makes another one of it.
    // Mirrors with a shift along them, as of the crowfoot, are left out: they
    // do not keep bundles from floating, and the release of some sticks.
    const std::array<int, 2> origin =
      axis_.value_or(std::array<int, 2>{{0, 0}}); // twice
    const auto add_mirror = [&](const bool warp) {
      const int n_parallel = warp ? weave_.n_warp() : weave_.n_weft();
      const int first      = origin[warp ? 0 : 1];
      for (int k = 0; k < (translations_of_repeat_only_ ? 1 : n_parallel); ++k)
        if (weave_.is_mirror(warp, first + k))
          {
            const unsigned int across = warp ? 1 : 0;
            Tensor<1, 3>       a;
            a[across] = k * spacing_[across];
            result.push_back(
              SymmetryOperation::mirror_plane(warp ? "mirror plane along Y1" :
                                                     "mirror plane along Y2",
                                              across,
                                              a));
            return;
          }
    };
    for (const bool warp : {true, false})
      if (with_mirrors)
        add_mirror(warp);
    return result;
  }



  namespace
  {
    NURBSPatch<3>
    straight_bundle(const BundleSection  &section,
                    const double          spacing,
                    const unsigned int    n_crossings,
                    const MeshParameters &mesh)
    {
      const NURBSPatch<2> face =
        section.patch(mesh.degree, mesh.elements_across);
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
      // the sub-unit cell: all cells of a weave then are the same
      // discretization, and the 2-fold axes map control points onto control
      // points.
      const auto         &breaks = bundle.knot_vector(0).breaks();
      std::vector<double> joints;
      for (unsigned int k = 1; k < n_crossings; ++k)
        for (unsigned int m = 1; m < mesh.degree; ++m)
          joints.push_back(breaks[k * mesh.elements_along]);
      bundle.insert_knots(0, joints);
      bundle.subdivide(2, mesh.elements_through);
      return bundle;
    }



    // The lattice as the bundles of one family see it: shifts and positions
    // across and along them.
    class Family
    {
    public:
      Family(const WovenLattice &lattice, const bool is_warp)
        : lattice_(lattice)
        , is_warp_(is_warp)
        , n_parallel_(is_warp ? lattice.weave().n_warp() :
                                lattice.weave().n_weft())
        , n_along_(is_warp ? lattice.weave().n_weft() :
                             lattice.weave().n_warp())
        , has_axis_(lattice.axis().has_value())
        , across_L_(lattice.spacing(is_warp ? 1 : 0))
        , along_L_(lattice.spacing(is_warp ? 0 : 1))
      {
        const std::array<int, 2> twice_origin =
          lattice.axis().value_or(std::array<int, 2>{{0, 0}});
        origin_       = twice_origin[is_warp ? 0 : 1];
        origin_along_ = twice_origin[is_warp ? 1 : 0];
      }

      double
      spacing_along() const
      {
        return along_L_;
      }

      // The bundles that no shift maps onto one before.
      std::vector<int>
      different_bundles() const
      {
        std::vector<int> indices;
        for (int i = 0; i < n_parallel_; ++i)
          {
            bool is_new = true;
            for (const int other : indices)
              for (int q = 0; q < n_along_ && is_new; ++q)
                is_new = sign(i - other, q) == 0;
            if (is_new)
              indices.push_back(i);
          }
        return indices;
      }

      Strand
      strand(const int i) const
      {
        int n = 1;
        while (sign(0, n) == 0)
          ++n;
        Strand s;
        s.index       = i;
        s.position    = (i - 0.5 * origin_) * across_L_;
        s.first       = first_crossing(i, n);
        s.n_crossings = n;
        s.begin       = (s.first - 0.5 - 0.5 * origin_along_) * along_L_;
        s.length      = n * along_L_;
        return s;
      }

      // The axis after a translation (2 i - origin, q) maps the bundle onto
      // itself and keeps the place (origin_along + q) / 2, counted in
      // crossings.
      double
      axis_parameter(const Strand &s) const
      {
        const int n       = s.n_crossings;
        double    on_axis = 0.5, distance = 1.;
        for (int q = 2 * s.first - origin_along_;
             has_axis_ && q <= 2 * (s.first + n) - origin_along_;
             ++q)
          if (sign(2 * s.index - origin_, q) > 0)
            {
              const double xi = (0.5 * (origin_along_ + q) - s.first + 0.5) / n;
              if (xi > 0. && xi < 1. && std::abs(xi - 0.5) < distance - 1e-12)
                {
                  on_axis  = xi;
                  distance = std::abs(xi - 0.5);
                }
            }
        return on_axis;
      }

      // From the place of a straight bundle at the origin to its own. The weft
      // is the warp turned by +90 degrees.
      Point<3>
      place(const Strand &s, const Point<3> &P) const
      {
        return is_warp_ ? Point<3>(P[0] + s.begin, P[1] + s.position, P[2]) :
                          Point<3>(-P[1] + s.position, P[0] + s.begin, P[2]);
      }

    private:
      int
      sign(const int across, const int along) const
      {
        return is_warp_ ? lattice_.shift_sign(across, along) :
                          lattice_.shift_sign(along, across);
      }

      // If a 2-fold axis goes through the bundle, let it begin so that it maps
      // onto itself: then half of it need not be integrated. The axis takes
      // crossing j to crossing origin_along - j + q where (2 i - origin, q) is
      // a translation.
      int
      first_crossing(const int i, const int n) const
      {
        for (int candidate = 0; has_axis_ && candidate > -n; --candidate)
          if (sign(2 * i - origin_, 2 * candidate + n - 1 - origin_along_) > 0)
            return candidate;
        return 0;
      }

      const WovenLattice &lattice_;
      const bool          is_warp_;
      const int           n_parallel_, n_along_;
      const bool          has_axis_;
      const double        across_L_, along_L_;
      int                 origin_, origin_along_; // twice
    };



    // The middle of a bundle.
    Point<3>
    middle(const FiberBundle &bundle, const Strand &s)
    {
      const double along = s.begin + 0.5 * s.length;
      return bundle.family == FiberBundle::Family::warp ?
               Point<3>(along, s.position, 0.) :
               Point<3>(s.position, along, 0.);
    }



    class WovenCellMaker
    {
    public:
      WovenCellMaker(const CellParameters &cell, const MeshParameters &mesh)
        : parameters_(cell)
        , mesh_(mesh)
        , lattice_(cell)
        , shifts_(lattice_.shifts())
      {
        layout_.has_two_fold_axis =
          cell.two_fold_axis && lattice_.axis().has_value();
        layout_.has_mirror_planes =
          cell.mirror_planes == CellParameters::MirrorPlanes::yes;
        add_bundles(true);
        add_bundles(false);
        add_operations();
        layout_.contacts =
          find_contacts(cell, lattice_, shifts_, layout_.bundles, strands_);
        add_pieces_of_repeat(true);
        add_pieces_of_repeat(false);
        find_floating_bundles();
      }

      CellLayout
      layout() const
      {
        return layout_;
      }

    private:
      void
      add_bundles(const bool is_warp)
      {
        const Tensor<1, 3>  e1({1., 0., 0.}), e2({0., 1., 0.});
        const BundleSection section =
          is_warp ? parameters_.warp_section() : parameters_.weft_section();
        const Family family(lattice_, is_warp);
        for (const int i : family.different_bundles())
          {
            const Strand  s     = family.strand(i);
            NURBSPatch<3> patch = straight_bundle(section,
                                                  family.spacing_along(),
                                                  s.n_crossings,
                                                  mesh_);
            patch.transform(
              [&](const Point<3> &P) { return family.place(s, P); });
            FiberBundle bundle{
              is_warp ? FiberBundle::Family::warp : FiberBundle::Family::weft,
              patch,
              is_warp ? e1 : e2,
              static_cast<unsigned int>(layout_.bundles.size())};
            bundle.n_crossings    = s.n_crossings;
            bundle.middle         = s.begin + 0.5 * s.length;
            bundle.axis_parameter = family.axis_parameter(s);
            layout_.bundles.push_back(bundle);
            strands_.push_back(s);
            if (is_warp)
              layout_.area +=
                s.n_crossings * lattice_.spacing(0) * lattice_.spacing(1);
          }
      }

      // Whether an operation takes any point of a bundle to one of the cell,
      // by their boxes in plane.
      bool
      relates_points(const SymmetryOperation &g) const
      {
        const auto &bundles = layout_.bundles;
        for (unsigned int b = 0; b < bundles.size(); ++b)
          for (unsigned int c = 0; c < bundles.size(); ++c)
            {
              const bool warp = bundles[b].family == FiberBundle::Family::warp;
              const double   across_L = lattice_.spacing(warp ? 1 : 0);
              const Point<3> from     = g(middle(bundles[b], strands_[b]));
              const Point<3> to       = middle(bundles[c], strands_[c]);
              if (bundles[b].family == bundles[c].family &&
                  std::abs(from[warp ? 1 : 0] - to[warp ? 1 : 0]) <
                    1e-6 * across_L &&
                  std::abs(from[warp ? 0 : 1] - to[warp ? 0 : 1]) <
                    0.5 * (strands_[b].length + strands_[c].length) +
                      1e-6 * across_L)
                return true;
            }
        return false;
      }

      void
      add_operations()
      {
        for (const SymmetryOperation &g : shifts_)
          if (!g.name.empty() && relates_points(g))
            layout_.operations.push_back(g);
        for (const SymmetryOperation &turn :
             lattice_.turns(layout_.has_two_fold_axis,
                            layout_.has_mirror_planes))
          for (const SymmetryOperation &shift : shifts_)
            {
              SymmetryOperation g = turn.then(shift);
              g.name              = turn.name;
              if (!relates_points(g))
                continue;
              layout_.operations.push_back(g);
              if (!g.turns_over())
                add_counterparts(g);
            }
      }

      // The pieces of bundles that an operation takes to bundles of the cell.
      void
      add_counterparts(const SymmetryOperation &g)
      {
        const double tolerance =
          1e-6 * std::min(lattice_.spacing(0), lattice_.spacing(1));
        auto &bundles = layout_.bundles;
        for (unsigned int b = 0; b < bundles.size(); ++b)
          for (unsigned int c = 0; c < bundles.size(); ++c)
            {
              const int along =
                bundles[b].family == FiberBundle::Family::warp ? 0 : 1;
              const Point<3> image = g(middle(bundles[b], strands_[b]));
              if (bundles[b].family != bundles[c].family ||
                  std::abs(image[1 - along] - strands_[c].position) > tolerance)
                continue;
              // The ends of c, taken back to b: Q is its own inverse.
              const double from = g.Q[along] * (strands_[c].begin - g.a[along]);
              const double to   = from + g.Q[along] * strands_[c].length;
              const double begin =
                std::max(strands_[b].begin, std::min(from, to));
              const double end =
                std::min(strands_[b].begin + strands_[b].length,
                         std::max(from, to));
              const bool is_whole =
                end - begin > strands_[b].length - tolerance &&
                end - begin > strands_[c].length - tolerance;
              if (is_whole ||
                  (parameters_.integrate_pieces && end > begin + tolerance))
                {
                  bundles[b].counterparts.push_back({c, g, begin, end});
                  layout_.integrates_pieces |= !is_whole;
                }
            }
      }

      // A rigid motion w = e_i of a strand survives unless an operation maps
      // the strand onto itself with Q_i = -1, since w = Q w there. (Operations
      // that map it onto others tie their motions to its own.)
      void
      find_floating_bundles()
      {
        for (unsigned int b = 0; b < layout_.bundles.size(); ++b)
          {
            FiberBundle &bundle = layout_.bundles[b];
            const int    across =
              bundle.family == FiberBundle::Family::warp ? 1 : 0;
            const Point<3> center = middle(bundle, strands_[b]);
            bundle.can_float      = {{true, true, true}};
            for (const SymmetryOperation &g : layout_.operations)
              if (std::abs(g(center)[across] - center[across]) <
                  1e-6 * lattice_.spacing(across))
                for (unsigned int i = 0; i < 3; ++i)
                  bundle.can_float[i] = bundle.can_float[i] && g.Q[i] > 0;
          }
      }

      void
      add_pieces_of_repeat(const bool warp)
      {
        const WeavePattern &weave = lattice_.weave();
        const int           n_parallel =
          std::max(2u, warp ? weave.n_warp() : weave.n_weft());
        const int n_along =
          std::max(2u, warp ? weave.n_weft() : weave.n_warp());
        const int    along = warp ? 0 : 1, across = 1 - along;
        const double along_L  = lattice_.spacing(along);
        const double across_L = lattice_.spacing(across);
        // Crossings lie at whole or at half numbers of spacings.
        const auto number = [](const double position, const double L) {
          return static_cast<int>(std::floor(position / L + 0.25));
        };
        std::vector<bool> known(n_parallel * n_along, false);
        for (const SymmetryOperation &g : shifts_) // nearest first
          for (unsigned int b = 0; b < layout_.bundles.size(); ++b)
            {
              const Strand &s = strands_[b];
              const int     i = number(s.position + g.a[across], across_L);
              if ((layout_.bundles[b].family == FiberBundle::Family::warp) !=
                    warp ||
                  i < 0 || i >= n_parallel)
                continue;
              for (unsigned int k = 0; k < s.n_crossings; ++k)
                {
                  const int j =
                    number(s.begin + (k + 0.5) * along_L + g.a[along], along_L);
                  if (j < 0 || j >= n_along || known[i * n_along + j])
                    continue;
                  known[i * n_along + j] = true;
                  layout_.repeat.push_back({b, k, g, j == 0, j == n_along - 1});
                }
            }
      }

      const CellParameters                &parameters_;
      const MeshParameters                &mesh_;
      const WovenLattice                   lattice_;
      const std::vector<SymmetryOperation> shifts_;
      std::vector<Strand>                  strands_; // by bundle
      CellLayout                           layout_;
    };
  } // namespace



  CellLayout
  make_woven_cell(const CellParameters &cell, const MeshParameters &mesh)
  {
    if (cell.n_layers == 1)
      return WovenCellMaker(cell, mesh).layout();
    // The axes of shifted layers are not the same.
    CellParameters layer = cell;
    layer.two_fold_axis  = false;
    return stack_layers(WovenCellMaker(layer, mesh).layout(),
                        cell,
                        WovenLattice(layer).shifts());
  }
} // namespace NPT
