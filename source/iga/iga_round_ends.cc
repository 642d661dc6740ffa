// SPDX-License-Identifier: LGPL-2.1-or-later
// Round ends of surfaces: the functions of the body along the curve by which
// the surface turns into it.

#include <npt_dealii/iga/iga_surface.h>
#include <npt_dealii/iga/round_end.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  const Powers &
  RoundEnd::way()
  {
    static const Powers y = {0., 1., 1., -1.};
    return y;
  }



  const Powers &
  RoundEnd::depth()
  {
    static const Powers z = {0., 0., 0.75, 0.25};
    return z;
  }



  namespace
  {
    // The parameter of the face along the curve, and that through the body, as
    // polynomials of tau. Of both, end or side 0 lies at `first`.
    Powers
    from_end(const double       first,
             const double       last,
             const unsigned int end,
             const double       length,
             const Powers      &inward)
    {
      Powers result = inward;
      for (double &c : result)
        c *= end == 0 ? length : -length;
      result[0] += end == 0 ? first : last;
      return result;
    }



    // 1 - y: from the end back to where the curve has left the face.
    Powers
    way_from_end()
    {
      Powers result = RoundEnd::way();
      for (double &c : result)
        c = -c;
      result[0] += 1.;
      return result;
    }



    // The tau at which a polynomial that is monotonic on [0, 1] has a value.
    double
    tau_of(const Powers &polynomial, const double value)
    {
      const bool rises = value_of(polynomial, 1.) > value_of(polynomial, 0.);
      double     low = 0., high = 1.;
      for (unsigned int i = 0; i < 60; ++i)
        {
          const double middle = 0.5 * (low + high);
          ((value_of(polynomial, middle) < value) == rises ? low : high) =
            middle;
        }
      return 0.5 * (low + high);
    }



    // The functions of one span along a curve: powers of the curve's parameter.
    std::vector<Powers>
    along_curve(const std::vector<Powers> &functions,
                const double               begin,
                const double               end,
                Powers                     parameter)
    {
      parameter[0] -= begin;
      for (double &c : parameter)
        c /= end - begin;
      std::vector<Powers> result;
      for (const Powers &function : functions)
        result.push_back(composition_of(function, parameter));
      return result;
    }
  } // namespace



  template <int dim>
  unsigned int
  IGASurface<dim>::row_on_lattice(const unsigned int j,
                                  const unsigned int layer)
  {
    const auto row = std::make_pair(j, layer);
    const auto it  = std::find(rows_.begin(), rows_.end(), row);
    if (it != rows_.end())
      return it - rows_.begin();
    rows_.push_back(row);
    return rows_.size() - 1;
  }



  template <int dim>
  std::vector<std::pair<double, bool>>
  IGASurface<dim>::cuts_of_round_end(const unsigned int direction,
                                     const unsigned int side,
                                     const unsigned int end) const
  {
    const KnotVector &across  = knots_[m - 1];
    const KnotVector &through = space_->patch(patch_).knot_vector(direction);
    std::vector<std::pair<double, bool>> cuts = {{0., true}, {1., false}};
    const auto add = [&](const KnotVector &knots, const Powers &parameter) {
      const double low  = std::min(parameter[0], value_of(parameter, 1.));
      const double high = std::max(parameter[0], value_of(parameter, 1.));
      const double round_off =
        1e-10 * (knots.breaks().back() - knots.breaks().front());
      for (const double knot : knots.breaks())
        if (knot > low + round_off && knot < high - round_off)
          cuts.emplace_back(tau_of(parameter, knot),
                            knots.multiplicity(knot) < knots.degree());
    };
    add(across,
        from_end(across.breaks().front(),
                 across.breaks().back(),
                 end,
                 end_rounding_,
                 way_from_end()));
    add(through,
        from_end(through.breaks().front(),
                 through.breaks().back(),
                 side,
                 0.5 * (through.breaks().back() - through.breaks().front()),
                 RoundEnd::depth()));
    std::sort(cuts.begin(), cuts.end());
    // Knots of both directions that are met at once.
    for (unsigned int i = 1; i < cuts.size();)
      if (cuts[i].first - cuts[i - 1].first < 1e-8)
        {
          cuts[i - 1].second = cuts[i - 1].second && cuts[i].second;
          if (i + 1 == cuts.size())
            cuts[i - 1].first = 1.;
          cuts.erase(cuts.begin() + i);
        }
      else
        ++i;
    return cuts;
  }



  template <int dim>
  typename IGASurface<dim>::Segment
  IGASurface<dim>::round_segment(const unsigned int direction,
                                 const unsigned int side,
                                 const unsigned int end,
                                 const double       tau_begin,
                                 const double       tau_end)
  {
    const KnotVector &across  = knots_[m - 1];
    const KnotVector &through = space_->patch(patch_).knot_vector(direction);
    const double      first   = across.breaks().front();
    const double      last    = across.breaks().back();
    const double height = through.breaks().back() - through.breaks().front();
    const Powers v = from_end(first, last, end, end_rounding_, way_from_end());
    const Powers w = from_end(through.breaks().front(),
                              through.breaks().back(),
                              side,
                              0.5 * height,
                              RoundEnd::depth());

    const double       middle = 0.5 * (tau_begin + tau_end);
    const unsigned int e      = across.find_span(value_of(v, middle));
    const unsigned int f      = through.find_span(value_of(w, middle));

    Segment segment;
    segment.length = end_rounding_ * (tau_end - tau_begin);
    segment.origin = end == 0 ? first + end_rounding_ * (1. - tau_end) :
                                last - end_rounding_ * (1. - tau_begin);
    // tau falls with the parameter at the begin and rises with it at the end.
    const Powers tau       = end == 0 ? Powers{tau_end, tau_begin - tau_end} :
                                        Powers{tau_begin, tau_end - tau_begin};
    const auto   functions = [&](const unsigned int line,
                               const KnotVector  &knots,
                               const unsigned int span,
                               const Powers      &parameter) {
      return along_curve(
        power_coefficients(space_->extraction_operator(patch_, line, span),
                           space_->local_polynomials(patch_)),
        knots.breaks()[span],
        knots.breaks()[span + 1],
        composition_of(parameter, tau));
    };
    const auto N_v         = functions((direction + m) % dim, across, e, v);
    const auto N_w         = functions(direction, through, f, w);
    segment.first_function = across.first_function(e);
    for (unsigned int k = 0; k < N_w.size(); ++k)
      for (unsigned int j = 0; j < N_v.size(); ++j)
        {
          const unsigned int l = through.first_function(f) + k;
          segment.coefficients.push_back(product_of(N_v[j], N_w[k]));
          segment.rows.push_back(
            row_on_lattice(across.first_function(e) + j,
                           side == 0 ? l : through.n_functions() - 1 - l));
        }
    return segment;
  }



  template <int dim>
  void
  IGASurface<dim>::append_round_end(const unsigned int direction,
                                    const unsigned int side,
                                    const unsigned int end)
  {
    Segments          &segments = segments_[m - 1];
    const auto         cuts     = cuts_of_round_end(direction, side, end);
    const unsigned int n        = cuts.size() - 1;
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int piece   = end == 0 ? n - 1 - i : i;
        const Segment      segment = round_segment(
          direction, side, end, cuts[piece].first, cuts[piece + 1].first);
        segments.append(segment,
                        segment.origin,
                        segment.origin + segment.length);
        segments.smooth.back() =
          end == 0 ? cuts[piece].second : cuts[piece + 1].second;
      }
  }



  template <int dim>
  void
  IGASurface<dim>::round_ends(const unsigned int direction,
                              const unsigned int side)
  {
    Segments      &segments = segments_[m - 1];
    const Segments flat     = segments;
    const double   first = flat.breaks.front(), last = flat.breaks.back();
    const double   low = first + end_rounding_, high = last - end_rounding_;
    const double   round_off = 1e-10 * (last - first);
    Assert(low + round_off < high,
           dealii::ExcMessage("Round ends must not overlap."));

    // C1 where the round end begins, unless there is a C0 knot.
    const auto smooth_at = [&](const double u) {
      for (unsigned int i = 0; i < flat.breaks.size(); ++i)
        if (std::abs(flat.breaks[i] - u) < round_off)
          return static_cast<bool>(flat.smooth[i]);
      return true;
    };
    segments = Segments();
    append_round_end(direction, side, 0);
    segments.smooth.back() = smooth_at(low);
    for (unsigned int e = 0; e < flat.segments.size(); ++e)
      {
        const bool   is_last = flat.breaks[e + 1] > high - round_off;
        const double end     = is_last ? high : flat.breaks[e + 1];
        if (end < low + round_off || flat.breaks[e] > high - round_off)
          continue;
        segments.append(flat.segments[e], segments.breaks.back(), end);
        segments.smooth.back() = smooth_at(end);
      }
    append_round_end(direction, side, 1);
    // The sum of lengths may have missed the last knot by round-off.
    segments.breaks.front() = first;
    segments.breaks.back()  = last;
  }



#define NPT_INSTANTIATE(dim)                                    \
  template void IGASurface<dim>::round_ends(const unsigned int, \
                                            const unsigned int);
  NPT_INSTANTIATE(2)
  NPT_INSTANTIATE(3)
#undef NPT_INSTANTIATE
} // namespace NPT
