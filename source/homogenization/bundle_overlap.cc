// SPDX-License-Identifier: LGPL-2.1-or-later
// Sample points of bundles in other bundles and in images around the cell.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/homogenization/bundle_overlap.h>
#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/homogenization/objective_jumps.h>
#include <npt_dealii/iga/bezier_body.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    struct Image
    {
      unsigned int bundle;
      bool         is_base; // the bundle of the cell itself
      BezierBody   body;
    };

    class OverlapSearch
    {
    public:
      OverlapSearch(const FabricCell                  &cell,
                    const IGASpace<3>                 &space,
                    const MacroUnknowns               &macro,
                    const Vector<double>              &u,
                    const std::vector<Point<3>>       &woven,
                    const std::optional<Tensor<1, 2>> &bends_along,
                    const bool                         round_edges)
        : cell_(cell)
        , round_edges_(round_edges)
        , is_woven_(std::abs(u[macro.weaving_offset()]) <
                    1e-6 * cell.weaving_offset())
        , bends_along_(bends_along)
      {
        H_                      = gradients_of(macro, u);
        std::vector<Point<3>> x = space.control_points();
        for (unsigned int A = 0; A < x.size(); ++A)
          for (unsigned int i = 0; i < 3; ++i)
            x[A][i] += u[3 * A + i];
        for (unsigned int b = 0; b < cell.bundles().size(); ++b)
          {
            bodies_.emplace_back(space, b, x);
            places_.emplace_back(
              space, b, woven.empty() ? space.control_points() : woven);
          }
        add_images();
      }

      // Each process looks at some of the samples.
      BundleOverlap
      deepest(const Ranks &ranks) const
      {
        BundleOverlap result;
        unsigned int  n = 0, n_inside = 0;
        for (unsigned int b = 0; b < bodies_.size(); ++b)
          for (const auto &place : samples(bodies_[b]))
            {
              if (!ranks.has(n++))
                continue;
              const Point<3>        x = bodies_[b].value(place);
              std::optional<double> own;
              bool                  is_inside = false;
              for (const Image &image : images_)
                {
                  if (!compared(b, image))
                    continue;
                  const auto found = image.body.find(x);
                  if (!found)
                    continue;
                  if (!own)
                    own = bodies_[b].depth(place, edge_radius(b));
                  const double other =
                    image.body.depth(*found, edge_radius(image.bundle));
                  if (*own < 0. || other < 0.) // beyond a round edge
                    continue;
                  if (!is_inside)
                    ++n_inside;
                  is_inside = true;
                  // On the surface of its own bundle a point is as deep as it
                  // is in the other one; inside, about it a ball fits into
                  // both.
                  const double depth = *own > 1e-9 * cell_.weaving_offset() ?
                                         2. * std::min(*own, other) :
                                         other;
                  if (depth > result.depth)
                    result = {depth, 0., b, image.bundle, x};
                }
            }
        if (!ranks.is_alone())
          result = deepest_of(result, ranks);
        result.share = ranks.sum(static_cast<double>(n_inside)) / n;
        return result;
      }

    private:
      static BundleOverlap
      deepest_of(const BundleOverlap &own, const Ranks &ranks)
      {
        const auto numbers = ranks.of_lowest({-own.depth,
                                              static_cast<double>(own.bundle),
                                              static_cast<double>(own.other),
                                              own.place[0],
                                              own.place[1],
                                              own.place[2]});
        return {-numbers[0],
                0.,
                static_cast<unsigned int>(numbers[1]),
                static_cast<unsigned int>(numbers[2]),
                dealii::Point<3>(numbers[3], numbers[4], numbers[5])};
      }

      // A round edge is as wide as half of its height.
      double
      edge_radius(const unsigned int bundle) const
      {
        if (!round_edges_)
          return 0.;
        const bool warp =
          cell_.bundles()[bundle].family == FiberBundle::Family::warp;
        return (warp ? cell_.parameters().warp_section() :
                       cell_.parameters().weft_section())
          .tip;
      }

      bool
      compared(const unsigned int b, const Image &image) const
      {
        if (image.is_base && image.bundle == b)
          return false;
        return is_woven_ || cell_.bundles()[b].family ==
                              cell_.bundles()[image.bundle].family;
      }

      // Two points per span and direction, and the last face, but none on the
      // cuts at the ends, where the next piece of the strand begins.
      static std::vector<BezierBody::Place>
      samples(const BezierBody &body)
      {
        std::array<std::vector<std::pair<unsigned int, double>>, 3> lines;
        for (unsigned int d = 0; d < 3; ++d)
          {
            for (unsigned int e = 0; e < body.n_spans(d); ++e)
              for (const double t : {0., 0.5})
                if (d > 0 || e > 0 || t > 0.)
                  lines[d].emplace_back(e, t);
            if (d > 0)
              lines[d].emplace_back(body.n_spans(d) - 1, 1.);
          }
        std::vector<BezierBody::Place> result;
        for (const auto &k : lines[2])
          for (const auto &j : lines[1])
            for (const auto &i : lines[0])
              result.push_back({{{i.first, j.first, k.first}},
                                {{i.second, j.second, k.second}}});
        return result;
      }

      // All pieces of the repeat and of the repeats around it that come near a
      // bundle of the cell.
      void
      add_images()
      {
        const CellParameters &parameters = cell_.parameters();
        const WeavePattern    weave(parameters.weave);
        const double          repeat[2] = {std::max(2u, weave.n_weft()) *
                                             parameters.crossing_spacing.weft,
                                           std::max(2u, weave.n_warp()) *
                                             parameters.crossing_spacing.warp};
        std::vector<std::pair<unsigned int, SymmetryOperation>> known;
        for (const CrossingPiece &piece : cell_.repeat())
          for (int p = -2; p <= 2; ++p)
            for (int q = -2; q <= 2; ++q)
              {
                const SymmetryOperation g =
                  piece.operation.then(SymmetryOperation::translation(
                    "repeat",
                    Tensor<1, 3>({p * repeat[0], q * repeat[1], 0.})));
                const bool is_known =
                  std::any_of(known.begin(), known.end(), [&](const auto &k) {
                    return k.first == piece.bundle && same(k.second, g);
                  });
                if (is_known)
                  continue;
                known.emplace_back(piece.bundle, g);
                add_image(piece.bundle, g);
              }
      }

      void
      add_image(const unsigned int bundle, const SymmetryOperation &g)
      {
        const auto map =
          [&](const unsigned int c, const unsigned int b, const Point<3> &x) {
            if (bends_along_)
              return Point<3>(image_on_cylinder(*bends_along_, H_, g, x));
            Point<3> result = g(x);
            for (unsigned int n = 0; n < H_.size(); ++n)
              if (H_[n] != 0.)
                result +=
                  H_[n] *
                  macroscopic_jump(n, g, places_[bundle].bezier_points(c)[b]);
            return result;
          };
        if (!is_near(map(0, 0, bodies_[bundle].bezier_points(0)[0]), bundle))
          return;
        Image image{bundle,
                    same(g, SymmetryOperation::identity()),
                    bodies_[bundle].mapped(map)};
        for (unsigned int b = 0; b < bodies_.size(); ++b)
          if (compared(b, image) && touch(bodies_[b].box(), image.body.box()))
            {
              images_.push_back(std::move(image));
              return;
            }
      }

      // Whether an image whose first corner is at x may reach the cell.
      bool
      is_near(const Point<3> &x, const unsigned int bundle) const
      {
        const auto size = [](const BezierBody &body) {
          const auto &corners = body.box().get_boundary_points();
          return corners.first.distance(corners.second);
        };
        for (const BezierBody &body : bodies_)
          if (x.distance(body.box().center()) <
              0.5 * size(body) + 1.5 * size(bodies_[bundle]))
            return true;
        return false;
      }

      static bool
      touch(const dealii::BoundingBox<3> &a, const dealii::BoundingBox<3> &b)
      {
        const auto &of_a = a.get_boundary_points();
        const auto &of_b = b.get_boundary_points();
        for (unsigned int i = 0; i < 3; ++i)
          if (of_a.first[i] > of_b.second[i] || of_b.first[i] > of_a.second[i])
            return false;
        return true;
      }

      bool
      same(const SymmetryOperation &g, const SymmetryOperation &h) const
      {
        return (g.Q - h.Q).norm() < 1e-9 &&
               (g.a - h.a).norm() <
                 1e-9 * cell_.parameters().crossing_spacing.smaller();
      }

      const FabricCell                 &cell_;
      const bool                        round_edges_;
      const bool                        is_woven_;
      const std::optional<Tensor<1, 2>> bends_along_;
      Gradients                         H_;
      std::vector<BezierBody>           bodies_; // of the cell, current
      std::vector<BezierBody>           places_; // to which jumps refer
      std::vector<Image>                images_;
    };
  } // namespace



  BundleOverlap
  find_overlap(const FabricCell                  &cell,
               const IGASpace<3>                 &space,
               const MacroUnknowns               &macro,
               const Vector<double>              &u,
               const std::vector<Point<3>>       &woven,
               const std::optional<Tensor<1, 2>> &bends_along,
               const bool                         round_edges,
               const Ranks                       &ranks)
  {
    if (cell.parameters().type == "laminate")
      return {};
    return OverlapSearch(cell, space, macro, u, woven, bends_along, round_edges)
      .deepest(ranks);
  }



  std::string
  describe(const BundleOverlap &overlap, const FabricCell &cell)
  {
    const auto name = [&](const unsigned int b) {
      return std::string(cell.bundles()[b].family == FiberBundle::Family::warp ?
                           "warp" :
                           "weft") +
             " bundle " + std::to_string(b);
    };
    return name(overlap.bundle) + " and " + name(overlap.other) + " at (" +
           short_number(overlap.place[0], 3) + ", " +
           short_number(overlap.place[1], 3) + ", " +
           short_number(overlap.place[2], 3) + ") mm";
  }
} // namespace NPT
