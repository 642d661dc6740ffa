// SPDX-License-Identifier: LGPL-2.1-or-later
// Rigidity and hysteresis of closed loops, as numbers, as text, as a table.

#include <npt_dealii/problems/plate_results/hysteresis.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

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
  } // namespace



  std::optional<HysteresisLoop>
  last_loop(const std::vector<CurveRow> &curve, const double area)
  {
    if (curve.size() < 5)
      return {};
    const std::size_t end = curve.size() - 1;

    // Which component moves, and where it turned: walk back along the last
    // branch and the one before.
    unsigned int k = 0;
    for (unsigned int n = 1; n < MacroModes::n; ++n)
      if (std::abs(curve[end].H[n] - curve[end - 1].H[n]) >
          std::abs(curve[end].H[k] - curve[end - 1].H[k]))
        k = n;
    const double amplitude    = std::abs(curve[end].H[k]);
    const double tolerance    = 1e-9 * amplitude;
    const auto   branch_start = [&](std::size_t i) {
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
    HysteresisLoop loop;
    loop.component = k;
    loop.amplitude = amplitude;
    loop.rigidity = loop.width = loop.loop_area = 0.;
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
          0.5 *
          std::abs(interpolate(curve, start, turn, k, sign * 0.4 * amplitude) -
                   interpolate(curve, turn, end, k, sign * 0.4 * amplitude));
      }
    // Work is that of all components: others may be held by resultants.
    loop.loop_area =
      (curve[end].external_work - curve[start].external_work) / area;
    loop.dissipation =
      (curve[end].dissipation - curve[start].dissipation) / area;
    const auto energy = [&](const std::size_t i) {
      return (curve[i].stored_energy + curve[i].contact_energy +
              curve[i].friction_energy) /
             area;
    };
    loop.energy_growth = energy(end) - energy(start);
    return loop;
  }



  std::string
  describe(const HysteresisLoop &loop)
  {
    const MacroMode   &mode = MacroModes::table[loop.component];
    std::ostringstream text, amplitude;
    text.precision(4);
    amplitude.precision(4);
    amplitude << loop.amplitude;
    text << "Loop of " << mode.conjugate << " over " << mode.name << " to +-"
         << MacroModes::with_unit(amplitude.str(), mode.unit()) << ": rigidity "
         << mode.rigidity << " = " << loop.rigidity << " "
         << mode.rigidity_unit() << ", hysteresis " << mode.hysteresis << " = "
         << loop.width << " " << mode.conjugate_unit() << ", loop area "
         << loop.loop_area << " N/mm = dissipation " << loop.dissipation
         << " + growth of the stored energy " << loop.energy_growth;
    return text.str();
  }



  void
  write_hysteresis(const std::string &filename, const HysteresisLoop &loop)
  {
    std::ofstream file(filename);
    file.precision(10);
    file << "# Last closed loop of n over H: rigidity at 0.2 to 0.6 of the "
            "amplitude, width at 0.4 of it, after Kawabata.\n"
            "component,amplitude,rigidity,width,loop_area,dissipation,"
            "energy_growth\n"
         << MacroModes::table[loop.component].name << ',' << loop.amplitude
         << ',' << loop.rigidity << ',' << loop.width << ',' << loop.loop_area
         << ',' << loop.dissipation << ',' << loop.energy_growth << '\n';
  }
} // namespace NPT
