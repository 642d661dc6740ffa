// SPDX-License-Identifier: LGPL-2.1-or-later
// The balance of work, energies and dissipation, in numbers and in words.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/load_step/energy_balance.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace NPT
{
  EnergyChange::EnergyChange(const Energies &before, const Energies &after)
    : work(after.work - before.work)
    , growth(after.content() - before.content())
    , dissipation(after.dissipation - before.dissipation)
    , uncertainty(after.work_uncertainty - before.work_uncertainty)
    , release(after.release_uncertainty - before.release_uncertainty)
    , content(std::max(std::abs(before.content()), std::abs(after.content())))
  {}



  bool
  EnergyChange::is_jump(const double tolerance) const
  {
    return std::abs(missing()) > uncertainty + tolerance * content;
  }



  double
  EnergyBalance::Stage::deviation() const
  {
    const double scale = std::max(throughput, 0.01 * total.content);
    const double missing =
      std::max(std::abs(total.missing()) - total.release, 0.);
    return scale > 0. ? missing / scale : 0.;
  }



  void
  EnergyBalance::add_step(const std::string &name,
                          const Energies    &before,
                          const Energies    &after)
  {
    if (stages_.empty() || stages_.back().name != name)
      {
        stages_.push_back({name, {}, 0.});
        starts_.push_back(before);
      }
    Stage             &stage = stages_.back();
    const EnergyChange step(before, after);
    stage.throughput += std::max(
      {std::abs(step.work), std::abs(step.growth), std::abs(step.dissipation)});
    const double content = std::max(stage.total.content, step.content);
    stage.total          = EnergyChange(starts_.back(), after);
    stage.total.content  = content;
  }



  std::vector<std::string>
  EnergyBalance::table() const
  {
    char line[256];
    std::snprintf(line,
                  sizeof(line),
                  "%-16s %12s %12s %12s %12s %7s",
                  "energies [N mm]",
                  "work",
                  "stored",
                  "dissipated",
                  "missing",
                  "off by");
    std::vector<std::string> lines = {line};
    for (const Stage &stage : stages_)
      {
        std::snprintf(line,
                      sizeof(line),
                      "%-16s %12.4e %12.4e %12.4e %12.4e %5.1f %%",
                      stage.name.c_str(),
                      stage.total.work,
                      stage.total.growth,
                      stage.total.dissipation,
                      stage.total.missing(),
                      100. * stage.deviation());
        lines.emplace_back(line);
      }
    return lines;
  }



  std::vector<std::string>
  EnergyBalance::warnings(const double tolerance) const
  {
    std::vector<std::string> result;
    for (const Stage &stage : stages_)
      if (stage.deviation() > tolerance)
        {
          const bool long_steps =
            std::abs(stage.total.missing()) <= stage.total.uncertainty;
          result.push_back(
            "The energy balance of stage " + stage.name + " is off by " +
            short_number(100. * stage.deviation(), 2) + " %: the work " +
            short_number(stage.total.work, 3) +
            " N mm is not the growth of the energies " +
            short_number(stage.total.growth, 3) + " plus the dissipation " +
            short_number(stage.total.dissipation, 3) +
            (long_steps ?
               ". The steps are so long that their work is not known better. "
               "What to try: a shorter Maximum step of the stage." :
               ". The length of the steps does not explain that: the cell has "
               "snapped to another state, or contact was lost. What to try: "
               "look at the fields and at the penetration, a shorter Maximum "
               "step of the stage, a finer mesh."));
        }
    return result;
  }
} // namespace NPT
