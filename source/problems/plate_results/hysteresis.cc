// SPDX-License-Identifier: LGPL-2.1-or-later
// Rigidity and hysteresis of closed loops, as numbers, as text, as a table.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/problems/plate_results/driving_component.h>
#include <npt_dealii/problems/plate_results/hysteresis.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace NPT
{
  namespace
  {
    // n_k at a value of H_k on the rows [first, last], along which H_k is
    // monotone.
    double
    interpolate(const std::vector<CurveRow> &curve,
                const std::size_t            first,
                const std::size_t            last,
                const unsigned int           k,
                const double                 H)
    {
      for (std::size_t i = first; i < last; ++i)
        {
          const double a = curve[i].H[k], b = curve[i + 1].H[k];
          if ((H - a) * (H - b) <= 0. && a != b)
            return curve[i].n[k] +
                   (H - a) / (b - a) * (curve[i + 1].n[k] - curve[i].n[k]);
        }
      return std::numeric_limits<double>::quiet_NaN();
    }

    // The rows of a loop of one component: its begin, its turn at the opposite
    // value, its end.
    struct LoopRows
    {
      std::size_t start, turn, end;
    };

    // The loop of H_k with which a curve ends, or nothing.
    std::optional<LoopRows>
    find_loop(const std::vector<CurveRow> &curve, const unsigned int k)
    {
      const std::size_t end       = curve.size() - 1;
      const double      amplitude = std::abs(curve[end].H[k]);
      const double      tolerance = 1e-9 * amplitude;
      // Walk back along the last branch and the one before.
      const auto branch_start = [&](std::size_t i) {
        const double sign = curve[i].H[k] > curve[i - 1].H[k] ? 1. : -1.;
        while (i > 0 && sign * (curve[i].H[k] - curve[i - 1].H[k]) > 0.)
          --i;
        return i;
      };
      const std::size_t turn = branch_start(end);
      if (turn == 0 || !(amplitude > 0.) ||
          std::abs(curve[turn].H[k] + curve[end].H[k]) > tolerance)
        return {};
      const std::size_t begin = branch_start(turn);
      // The first branch may begin before the loop does.
      std::size_t start = turn;
      while (start > begin &&
             std::abs(curve[start].H[k] - curve[end].H[k]) > tolerance)
        --start;
      if (std::abs(curve[start].H[k] - curve[end].H[k]) > tolerance)
        return {};
      return LoopRows{start, turn, end};
    }

    // Rigidity and width, from the branches [start, turn] and [turn, end].
    HysteresisLoop
    figures_of_branches(const std::vector<CurveRow> &curve,
                        const unsigned int           k,
                        const std::size_t            start,
                        const std::size_t            turn,
                        const std::size_t            end)
    {
      const double   amplitude = std::abs(curve[end].H[k]);
      HysteresisLoop loop{};
      loop.component = k;
      loop.amplitude = amplitude;
      loop.n_steps   = end - start;
      for (const double sign : {-1., 1.})
        {
          for (const auto &branch :
               {std::make_pair(start, turn), std::make_pair(turn, end)})
            {
              const auto n_at = [&](const double fraction) {
                return interpolate(curve,
                                   branch.first,
                                   branch.second,
                                   k,
                                   sign * fraction * amplitude);
              };
              loop.rigidity +=
                0.25 * sign * (n_at(0.6) - n_at(0.2)) / (0.4 * amplitude);
            }
          loop.width +=
            0.5 * std::abs(
                    interpolate(curve, start, turn, k, sign * 0.4 * amplitude) -
                    interpolate(curve, turn, end, k, sign * 0.4 * amplitude));
        }
      return loop;
    }
  } // namespace



  std::optional<HysteresisLoop>
  last_loop(const std::vector<CurveRow> &curve, const double area)
  {
    if (curve.size() < 5)
      return {};
    // Gradients that follow the driven one may close a loop too, such as those
    // that couple with it; they do less work.
    std::optional<LoopRows> rows;
    unsigned int            k    = 0;
    double                  work = 0;
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      if (const auto found = find_loop(curve, n))
        {
          const double of_mode =
            amount_of_work(curve, found->start, found->end, n);
          if (!rows || of_mode > work)
            {
              rows = found;
              k    = n;
              work = of_mode;
            }
        }
    if (!rows)
      return {};
    const auto [start, turn, end] = *rows;
    HysteresisLoop loop = figures_of_branches(curve, k, start, turn, end);
    // Work is that of all components: others may be held by resultants.
    loop.loop_area =
      (curve[end].external_work - curve[start].external_work) / area;
    loop.dissipation =
      (curve[end].dissipation - curve[start].dissipation) / area;
    const auto energy = [&curve, area](const std::size_t i) {
      return (curve[i].stored_energy + curve[i].contact_energy +
              curve[i].friction_energy) /
             area;
    };
    loop.energy_growth = energy(end) - energy(start);
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      loop.work += amount_of_work(curve, start, end, n);
    return loop;
  }



  bool
  HysteresisLoop::is_balanced() const
  {
    return std::abs(imbalance()) <=
           0.03 * std::max(std::abs(loop_area),
                           std::abs(dissipation + energy_growth));
  }



  namespace
  {
    std::string
    describe_losses(const HysteresisLoop &loop)
    {
      const auto number = [](const double value) {
        return short_number(value, 4);
      };
      std::string text = "loop area " + number(loop.loop_area) + " N/mm";
      if (loop.is_balanced())
        return text + " = dissipation " + number(loop.dissipation) +
               " + growth of the stored energy " + number(loop.energy_growth);
      text += ", dissipation " + number(loop.dissipation) +
              " N/mm, growth of the stored energy " +
              number(loop.energy_growth) + " N/mm. The area should be the " +
              "sum of the others, but is off by " +
              number(std::abs(loop.imbalance())) + " N/mm, " +
              short_number(100. * std::abs(loop.imbalance()) / loop.work, 2) +
              " % of the work done and taken back";
      // Without friction nothing is left of the loop but this error.
      if (std::abs(loop.imbalance()) > 1e-3 * loop.work)
        text += ": the " + std::to_string(loop.n_steps) +
                " steps of the loop are too long to integrate the work, and "
                "perhaps for rigidity and hysteresis. What to try: a smaller "
                "Maximum step of its stages";
      return text;
    }
  } // namespace



  std::string
  describe(const HysteresisLoop &loop)
  {
    const MacroMode &mode  = MacroModes::table[loop.component];
    const auto       value = [](const double number, const char *unit) {
      return short_number(number, 4) + " " + unit;
    };
    return std::string("Loop of ") + mode.conjugate + " over " + mode.name +
           " to +-" +
           MacroModes::with_unit(short_number(loop.amplitude, 4), mode.unit()) +
           ": rigidity " + mode.rigidity + " = " +
           value(loop.rigidity, mode.rigidity_unit()) + ", hysteresis " +
           mode.hysteresis + " = " + value(loop.width, mode.conjugate_unit()) +
           ", " + describe_losses(loop);
  }



  void
  write_hysteresis(const std::string &filename, const HysteresisLoop &loop)
  {
    replace_file(filename, [&](std::ostream &file) {
      file.precision(10);
      const MacroMode &mode = MacroModes::table[loop.component];
      file << "# Last closed loop of n over H: rigidity at 0.2 to 0.6 of the "
              "amplitude, width at 0.4 of it, after Kawabata.\n"
           << "# Units: amplitude " << mode.unit() << ", rigidity "
           << mode.rigidity_unit() << ", width " << mode.conjugate_unit()
           << ", the others N/mm. Loop area = dissipation + energy growth but "
              "for the error of the trapezoidal rule.\n"
              "component,amplitude,rigidity,width,loop_area,dissipation,"
              "energy_growth\n"
           << mode.name << ',' << loop.amplitude << ',' << loop.rigidity << ','
           << loop.width << ',' << loop.loop_area << ',' << loop.dissipation
           << ',' << loop.energy_growth << '\n';
    });
  }
} // namespace NPT
