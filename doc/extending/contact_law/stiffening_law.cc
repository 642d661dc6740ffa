// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the stiffening contact law, its entry in a parameter
// file, and its name there.

#include "stiffening_law.h"

#include <algorithm>
#include <memory>

namespace NPT
{
  StiffeningLaw::StiffeningLaw(const double penalty, const double depth)
    : penalty_(penalty)
    , depth_(depth)
  {
    Assert(penalty > 0. && depth > 0.,
           dealii::ExcMessage("Penalty and depth must be positive"));
  }



  double
  StiffeningLaw::penalty() const
  {
    return penalty_;
  }



  NormalLaw::Response
  StiffeningLaw::response(const double gap,
                          const double multiplier,
                          const double penalty_scale) const
  {
    const double penalty     = penalty_scale * penalty_;
    const double penetration = std::max(0., -gap);
    const double p = multiplier + penalty * gap * (1. + penetration / depth_);
    if (p < 0.)
      return {true,
              p,
              penalty * (1. + 2. * penetration / depth_),
              multiplier * gap +
                penalty * (0.5 * gap * gap + penetration * penetration *
                                               penetration / (3. * depth_))};
    // The energy where contact ends, at the gap -multiplier/penalty >= 0.
    return {false, 0., 0., -0.5 * multiplier * multiplier / penalty};
  }



  namespace
  {
    const std::vector<OwnNumber> numbers = {
      {"Stiffening depth",
       0.01,
       "stiffening only: penetration d at which the pressure is twice that of "
       "the penalty law [mm].",
       std::make_shared<dealii::Patterns::Double>(1e-6)}};

    const Registry<NamedNormalLaw>::Registration
      stiffening("stiffening",
                 {"the penalty grows with the penetration",
                  [](const ContactParameters &parameters) {
                    return std::make_unique<StiffeningLaw>(
                      parameters.normal_penalty,
                      own_number(parameters.normal_law_numbers,
                                 numbers,
                                 "Stiffening depth"));
                  },
                  numbers});
  } // namespace
} // namespace NPT
