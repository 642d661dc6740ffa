// SPDX-License-Identifier: LGPL-2.1-or-later
// Cuts of planes through bundles.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_exports/yarn_sections.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Corners of the polygons per knot span across; each edge is divided by
    // half as many.
    const unsigned int corners_per_span = 4;

    /// Coordinates across and through, in knot spans.
    using Line = std::array<double, 2>;

    /// A bundle that goes on beyond the repeat.
    class EndlessStrand
    {
    public:
      explicit EndlessStrand(const FabricStrand &strand)
        : strand_(strand)
        , length_(strand.n_spans(0))
        , middle_({{0.5 * strand.n_spans(1), 0.5 * strand.n_spans(2)}})
      {
        const auto begin = inside(0., middle_), end = inside(length_, middle_);
        period_ = end.x - begin.x;
      }

      const Line &
      middle() const
      {
        return middle_;
      }
      const Tensor<1, 3> &
      period() const
      {
        return period_;
      }

      /// @param s Along, in knot spans, any number.
      FabricStrand::Sample
      at(const double s, const Line &line) const
      {
        const double periods = std::floor(s / length_);
        // Stations at the ends belong to the repeat.
        if (s == length_)
          return inside(s, line);
        FabricStrand::Sample sample = inside(s - periods * length_, line);
        sample.x += periods * period_;
        return sample;
      }

    private:
      FabricStrand::Sample
      inside(const double s, const Line &line) const
      {
        const std::array<double, 3> at = {{s, line[0], line[1]}};
        FabricStrand::Place         place;
        for (unsigned int d = 0; d < 3; ++d)
          {
            const double whole =
              std::min(std::floor(at[d]), strand_.n_spans(d) - 1.);
            place.span[d] = static_cast<unsigned int>(whole);
            place.xi[d]   = at[d] - whole;
          }
        return strand_.at(place);
      }

      const FabricStrand &strand_;
      const double        length_;
      const Line          middle_;
      Tensor<1, 3>        period_;
    };



    // Lines along the surface of a bundle, counterclockwise as seen against the
    // tangent from tangent x up, the side of the first edge.
    std::vector<Line>
    lines_around(const FabricStrand &strand)
    {
      const unsigned int n     = corners_per_span * strand.n_spans(1),
                         m     = corners_per_span / 2 * strand.n_spans(2);
      const double      across = strand.n_spans(1), through = strand.n_spans(2);
      std::vector<Line> lines;
      for (unsigned int k = m / 2; k < m; ++k)
        lines.push_back({{0., through * k / m}});
      for (unsigned int k = 0; k < n; ++k)
        lines.push_back({{across * k / n, through}});
      for (unsigned int k = m; k > 0; --k)
        lines.push_back({{across, through * k / m}});
      for (unsigned int k = n; k > 0; --k)
        lines.push_back({{across * k / n, 0.}});
      for (unsigned int k = 0; k < m / 2; ++k)
        lines.push_back({{0., through * k / m}});
      return lines;
    }



    // Where a line meets the plane through a point.
    Point<3>
    cut(const EndlessStrand &strand,
        const Line          &line,
        const Point<3>      &point,
        const Tensor<1, 3>  &normal,
        double               s,
        const std::string   &name)
    {
      for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const FabricStrand::Sample sample = strand.at(s, line);
          const double               height = (sample.x - point) * normal;
          const double               slope  = sample.tangent[0] * normal;
          if (!(slope > 0.))
            break;
          if (std::abs(height) < 1e-12 * sample.tangent[0].norm())
            return sample.x;
          s -= std::clamp(height / slope, -0.5, 0.5);
        }
      throw InputError("The bundle " + name +
                       " turns so sharply that a plane normal to it has no "
                       "section, so it cannot be written as a TexGen yarn "
                       "(subsection Output, entry Export).");
    }



    WovenTextile::Station
    station_at(const EndlessStrand     &strand,
               const std::vector<Line> &lines,
               const double             s,
               const std::string       &name)
    {
      const FabricStrand::Sample center = strand.at(s, strand.middle());
      WovenTextile::Station      station;
      station.position = center.x;
      station.tangent  = center.tangent[0] / center.tangent[0].norm();
      Tensor<1, 3> up({0., 0., 1.});
      up -= (up * station.tangent) * station.tangent;
      station.up              = up / up.norm();
      const Tensor<1, 3> side = cross_product_3d(station.tangent, station.up);
      for (const Line &line : lines)
        {
          const Tensor<1, 3> r =
            cut(strand, line, station.position, station.tangent, s, name) -
            station.position;
          station.section.push_back({{r * side, r * station.up}});
        }
      return station;
    }



    // Components that are round-off are none.
    Tensor<1, 3>
    along_axis(const Tensor<1, 3> &period, const unsigned int axis)
    {
      Tensor<1, 3> result;
      for (unsigned int c = 0; c < 3; ++c)
        if (c != axis && std::abs(period[c]) > 1e-6 * std::abs(period[axis]))
          throw InputError(
            "The repeat of the fabric does not go on along x and y by "
            "translations, because it is sheared or bent, so it cannot be "
            "written as a TexGen textile (subsection Output, entry Export).");
      result[axis] = period[axis];
      return result;
    }
  } // namespace



  WovenTextile
  make_woven_textile(const std::vector<FabricStrand> &strands,
                     const std::string               &name)
  {
    WovenTextile textile;
    textile.name         = name;
    const double largest = std::numeric_limits<double>::max();
    textile.box          = {{Point<3>(largest, largest, largest),
                             Point<3>(-largest, -largest, -largest)}};
    double margin        = 0;
    for (const FabricStrand &strand : strands)
      {
        if (strand.family() == FiberBundle::Family::ply)
          throw InputError(
            "A laminate has no yarns, so it cannot be written as a TexGen "
            "textile (subsection Output, entry Export).");
        const unsigned int axis =
          strand.family() == FiberBundle::Family::warp ? 0 : 1;
        const EndlessStrand     endless(strand);
        const std::vector<Line> lines = lines_around(strand);
        textile.repeats[axis]         = along_axis(endless.period(), axis);
        textile.yarns.emplace_back();
        for (unsigned int k = 0; k <= strand.n_spans(0); ++k)
          {
            const auto station = station_at(endless, lines, k, strand.name());
            textile.yarns.back().push_back(station);
            textile.box[0][2] =
              std::min(textile.box[0][2], station.position[2]);
            textile.box[1][2] =
              std::max(textile.box[1][2], station.position[2]);
            for (const auto &corner : station.section)
              margin = std::max(margin, std::abs(corner[1]));
          }
        const Point<3> &begin = textile.yarns.back().front().position;
        textile.box[0][axis]  = std::min(textile.box[0][axis], begin[axis]);
      }
    textile.box[0][2] -= margin;
    textile.box[1][2] += margin;
    for (unsigned int d = 0; d < 2; ++d)
      textile.box[1][d] = textile.box[0][d] + textile.repeats[d][d];
    return textile;
  }
} // namespace NPT
