// SPDX-License-Identifier: LGPL-2.1-or-later
// Copies of a woven cell on each other, and their contact.

#include <npt_dealii/fabric/layers.h>

#include <array>
#include <cmath>
#include <map>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Begin and end along Y1 and Y2.
    struct Box
    {
      std::array<double, 2> begin, end;

      explicit Box(const FiberBundle &bundle)
        : begin({{1e99, 1e99}})
        , end({{-1e99, -1e99}})
      {
        for (const Point<3> &P : bundle.patch.control_points())
          for (unsigned int i = 0; i < 2; ++i)
            {
              begin[i] = std::min(begin[i], P[i]);
              end[i]   = std::max(end[i], P[i]);
            }
      }

      bool
      is_near(const Box          &other,
              const Tensor<1, 3> &shift,
              const double        reach) const
      {
        for (unsigned int i = 0; i < 2; ++i)
          if (other.begin[i] + shift[i] > end[i] + reach ||
              other.end[i] + shift[i] < begin[i] - reach)
            return false;
        return true;
      }
    };



    // All pieces of the next layer above one bundle.
    std::vector<SurfaceImage>
    pieces_above(const FiberBundle                    &bundle,
                 const CellLayout                     &layout,
                 const std::vector<SymmetryOperation> &translations,
                 const double                          reach)
    {
      const Box                 box(bundle);
      std::vector<SurfaceImage> pieces;
      // Lines of a family by their place across, in millionths of the reach.
      std::map<std::pair<bool, long>, int> strands;
      for (unsigned int c = 0; c < layout.bundles.size(); ++c)
        {
          const FiberBundle &other = layout.bundles[c];
          if (other.layer != bundle.layer + 1)
            continue;
          const Box  of_other(other);
          const bool is_warp       = other.family == FiberBundle::Family::warp;
          const unsigned int along = is_warp ? 0 : 1, across = 1 - along;
          const double length = of_other.end[along] - of_other.begin[along];
          for (const SymmetryOperation &g : translations)
            {
              if (!box.is_near(of_other, g.a, reach))
                continue;
              const double place = of_other.begin[across] + g.a[across];
              const auto   line =
                std::make_pair(is_warp, std::lround(1e6 * place / reach));
              const int strand =
                strands.emplace(line, strands.size()).first->second;
              // Pieces of one line begin at whole lengths from each other.
              const int period = std::floor(
                (of_other.begin[along] + g.a[along]) / length + 1e-6);
              pieces.push_back({c, 0, g, 0., strand, period});
            }
        }
      return pieces;
    }
  } // namespace



  CellLayout
  stack_layers(const CellLayout                     &layer,
               const CellParameters                 &cell,
               const std::vector<SymmetryOperation> &translations)
  {
    const double height =
      3. * (cell.bundle_thickness.warp + cell.bundle_thickness.weft) / 2.;
    const unsigned int n      = layer.bundles.size();
    CellLayout         layout = layer;
    for (unsigned int k = 1; k < cell.n_layers; ++k)
      {
        const Tensor<1, 3> shift(
          {k * cell.layer_shift[0], k * cell.layer_shift[1], k * height});
        for (FiberBundle bundle : layer.bundles)
          {
            bundle.patch.transform(
              [&](const Point<3> &P) { return P + shift; });
            bundle.body += k * n;
            bundle.layer = k;
            layout.bundles.push_back(bundle);
          }
        for (ContactCandidates pair : layer.contacts)
          {
            pair.secondary_bundle += k * n;
            for (SurfaceImage &image : pair.primaries)
              image.bundle += k * n;
            layout.contacts.push_back(pair);
          }
        for (CrossingPiece piece : layer.repeat)
          {
            piece.bundle += k * n;
            layout.repeat.push_back(piece);
          }
      }
    const double reach = 0.5 * cell.crossing_spacing.smaller();
    for (unsigned int b = 0; b + n < layout.bundles.size(); ++b)
      {
        ContactCandidates pair{b, 1, {}};
        pair.primaries =
          pieces_above(layout.bundles[b], layout, translations, reach);
        pair.between_layers = true;
        layout.contacts.push_back(pair);
      }
    return layout;
  }
} // namespace NPT
