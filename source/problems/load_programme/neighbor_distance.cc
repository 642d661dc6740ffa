// SPDX-License-Identifier: LGPL-2.1-or-later
// Whether parallel bundles can come near each other in a plate test.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/homogenization/yarn_frame.h>
#include <npt_dealii/problems/load_programme/neighbor_distance.h>
#include <npt_dealii/problems/load_programme/tester_targets.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace NPT
{
  namespace
  {
    // Neighbors whose lines are nearer than this many widths may touch, since
    // bundles widen and wave.
    const double reach = 1.1;

    constexpr unsigned int shear = MacroModes::number_of("H3");

    using Gradients = std::array<double, MacroModes::n>;

    // Distance of the lines of a family over that at rest; direction 0 is that
    // of the warp.
    double
    relative_distance(const Gradients &H, const bool warp, const double t)
    {
      const double F_11 = 1. + H[0], F_22 = 1. + H[1], F_12 = 0.5 * H[shear];
      const double determinant = F_11 * F_22 - F_12 * F_12;
      const double length      = std::hypot(F_12, warp ? F_11 : F_22);
      const double bending     = std::abs(H[warp ? shear + 2 : shear + 1]);
      return determinant / length * (1. - t * bending);
    }

    // How much a bundle of wavelength 2 L contracts, at most, where it is
    // crimped by the amplitude a.
    double
    crimp(const double a, const double L)
    {
      const double slope = dealii::numbers::PI * a / L;
      return 0.25 * slope * slope;
    }

    // What the resultants in force leave of the gradients, or why that is not
    // known.
    class FreedGradients
    {
    public:
      FreedGradients(const CellParameters &cell)
        : cell_(cell)
        , shears_by_itself_(!WeavePattern(cell.weave).has_mirror())
      {}

      // Follow the targets of a stage.
      void
      follow(const LoadStage &stage)
      {
        if (stage.leads_yarns())
          for (unsigned int n = 0; n < TesterTargets::n_membrane; ++n)
            force_[n] = {};
        for (const auto &[mode, target] : stage.H_targets)
          force_[mode] = {};
        for (const auto &[mode, target] : stage.n_targets)
          force_[mode] = target;
      }

      std::string
      unknown() const
      {
        for (unsigned int n = 0; n < MacroModes::n; ++n)
          {
            const auto &mode = MacroModes::table[n];
            if (!force_[n])
              continue;
            const std::string what = std::string(mode.conjugate) + " = " +
                                     short_number(*force_[n]) + ' ' +
                                     mode.conjugate_unit();
            if (mode.is_extension() && *force_[n] < 0.)
              return "how far " + what + " compresses is not known in advance";
            if (!mode.is_extension() && *force_[n] != 0.)
              return "how far " + what + " goes is not known in advance";
            if (n == shear && shears_by_itself_)
              return "a weave without mirror planes shears by itself at " +
                     what;
          }
        return "";
      }

      bool
      is_free(const unsigned int n) const
      {
        return force_[n].has_value();
      }

      // Of an extension: half of the crimp each if warp and weft are loaded
      // alike, else one of them may take the whole of it.
      double
      lowest(const unsigned int n) const
      {
        const unsigned int other = 1 - n;
        const double       L =
          n == 0 ? cell_.crossing_spacing.weft : cell_.crossing_spacing.warp;
        const bool   alike = force_[other] && *force_[other] == *force_[n];
        const double t     = cell_.bundle_thickness.mean();
        return -crimp(alike ? 0.5 * t : t, L);
      }

    private:
      const CellParameters                            &cell_;
      const bool                                       shears_by_itself_;
      std::array<std::optional<double>, MacroModes::n> force_;
    };

    std::string
    too_near(const CellParameters &cell,
             const Gradients      &H,
             const std::string    &stage)
    {
      for (const bool warp : {true, false})
        {
          const double spacing =
            warp ? cell.crossing_spacing.warp : cell.crossing_spacing.weft;
          const double width =
            warp ? cell.bundle_width.warp : cell.bundle_width.weft;
          const double distance =
            spacing * relative_distance(H, warp, cell.bundle_thickness.mean());
          if (distance < reach * width)
            return std::string("the lines of ") + (warp ? "warp" : "weft") +
                   " bundles come as near as " + short_number(distance, 3) +
                   " mm in stage " + stage + ", at a width of " +
                   short_number(width, 3) + " mm";
        }
      return "";
    }
  } // namespace



  std::string
  reason_for_side_contact(const CellParameters &cell,
                          const LoadProgramme  &programme)
  {
    if (cell.type == "laminate")
      return "";
    const WeavePattern weave(cell.weave);
    for (const bool warp : {true, false})
      if (weave.has_equal_neighbors(warp))
        return std::string("nothing crosses between neighboring ") +
               (warp ? "warp" : "weft") + " bundles on the same side";

    // At the ends of the stages.
    std::vector<std::pair<FreedGradients, Gradients>> ends;
    for (unsigned int i = 0; i < programme.stages.size(); ++i)
      {
        const LoadStage &stage  = programme.stages[i];
        const auto       before = stage_before(programme.stages, i);
        auto [freed, H] =
          before ? ends[*before] :
                   std::pair<FreedGradients, Gradients>(FreedGradients(cell),
                                                        Gradients{});
        freed.follow(stage);
        const std::string unknown = freed.unknown();
        if (!unknown.empty())
          return unknown;
        Gradients end = H;
        if (stage.leads_yarns())
          {
            // Beside the angle the change of the yarns is small.
            const auto g = TesterTargets::expected_shear_angle(stage);
            if (!g)
              return "how far stage " + stage.name +
                     " shears is not known in advance";
            const Membrane at = YarnFrames::gradients({1., 1., *g});
            std::copy(at.begin(), at.end(), end.begin());
          }
        for (const auto &[mode, target] : stage.H_targets)
          end[mode] = target;
        for (unsigned int n = 0; n < 2; ++n)
          if (freed.is_free(n))
            end[n] = std::min(end[n], freed.lowest(n));
        // The path is straight, the distance along it is not.
        const unsigned int n_places = 20;
        for (unsigned int k = 0; k <= n_places; ++k)
          {
            Gradients at;
            for (unsigned int n = 0; n < MacroModes::n; ++n)
              at[n] = H[n] + (end[n] - H[n]) * k / n_places;
            const std::string reason = too_near(cell, at, stage.name);
            if (!reason.empty())
              return reason;
          }
        ends.emplace_back(freed, end);
      }
    return "";
  }
} // namespace NPT
