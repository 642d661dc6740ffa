// SPDX-License-Identifier: LGPL-2.1-or-later
// Causes of failures that the state of a plate test shows.

#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/failure_advice.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace NPT
{
  namespace
  {
    // From here on a penalty is called far off. Shear of the default cell runs
    // from 0.01 to 1.5e3 times the stiffness (doc/studies.md), but weaving and
    // other loads need more care; the default is 15 times.
    constexpr double stiff_penalty = 300., soft_penalty = 0.5,
                     usual_penalty = 15.;

    // Bundles much stiffer along than across cannot follow a crimp at fixed
    // width: 7 for Table 1, hundreds for dry yarns.
    constexpr double stiff_fibers = 50.;



    std::string
    advice_on_width(const PlateTestParameters &parameters,
                    const unsigned int         index,
                    const State               &state)
    {
      const auto &stages = parameters.load_programme.stages;
      if (stages[index].is_test() || parameters.cell.type == "laminate")
        return "";
      std::vector<std::string> entries, values;
      const LoadStage         *weave = nullptr;
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        {
          const MacroMode &mode = MacroModes::table[n];
          if (!mode.is_extension())
            continue;
          bool held = true;
          for (const unsigned int k : path_to(stages, index))
            {
              held = (held || stages[k].H_targets.count(n) > 0) &&
                     stages[k].n_targets.count(n) == 0;
              if (stages[k].type == LoadStage::Type::weave)
                weave = &stages[k];
            }
          const bool            warp      = n == 0;
          const StiffnessAtRest stiffness = stiffness_at_rest(
            warp ? parameters.material : parameters.weft_material);
          const double t = warp ? parameters.cell.bundle_thickness.warp :
                                  parameters.cell.bundle_thickness.weft;
          if (!held || (state.reactions[n] < 0.5 * stiffness.E_T * t &&
                        stiffness.E_L < stiff_fibers * stiffness.E_T))
            continue;
          entries.push_back(std::string(mode.conjugate) + ": 0");
          values.push_back(std::string(mode.conjugate) + " = " +
                           short_number(state.reactions[n], 3) + " N/mm");
        }
      if (entries.empty() || weave == nullptr)
        return "";
      return "set Targets = " + joined(entries, ", ") + " in stage " +
             weave->name +
             ", so that the fabric may shorten while it is woven: held at "
             "fixed width, its stiff bundles are stretched, to " +
             joined(values, " and ") + " here";
    }



    std::string
    advice_on_penalty(const PlateTestParameters &parameters)
    {
      if (parameters.cell.type == "laminate")
        return "";
      const double ratio = penalty_over_stiffness(parameters);
      if (ratio >= soft_penalty && ratio <= stiff_penalty)
        return "";
      const double usual =
        parameters.contact.normal_penalty * usual_penalty / ratio;
      return std::string(ratio > stiff_penalty ? "lower" : "raise") +
             " Normal penalty and Tangential penalty to the order of " +
             short_number(std::pow(10., std::round(std::log10(usual)))) +
             " N/mm^3: the normal one is " + short_number(ratio, 2) +
             " times the stiffness of the bundles, E_T / thickness";
    }
  } // namespace



  bool
  tells_its_cause(const StageFailed &failure)
  {
    for (const std::string reason :
         {"interrupted", "out of memory", "bundles overlap", "no contact"})
      if (failure.reason() == reason)
        return true;
    return false;
  }



  std::string
  advice_for(const StageFailed         &failure,
             const PlateTestParameters &parameters,
             const unsigned int         stage,
             const State               &state,
             const bool                 is_elliptic)
  {
    if (tells_its_cause(failure))
      return failure.advice();
    const LoadStage &failed = parameters.load_programme.stages[stage];
    if (failed.type == LoadStage::Type::relax && failed.relaxed_fraction == 1.)
      return "set Initial step and Maximum step of stage " + failed.name +
             " to 1: bundles without stress lie where they lay before the "
             "stage, so that no way leads through states in which little holds "
             "them";
    const std::string width = advice_on_width(parameters, stage, state);
    if (!width.empty())
      return width;
    if (!is_elliptic)
      return "lower the target, for no shorter step leads beyond the loss of "
             "ellipticity; fields and picture of the last accepted step show "
             "where it is";
    const std::string penalty = advice_on_penalty(parameters);
    return penalty.empty() ? failure.advice() : penalty;
  }
} // namespace NPT
