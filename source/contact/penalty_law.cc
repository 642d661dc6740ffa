// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact pressure by a penalty and a multiplier.

#include <npt_dealii/contact/penalty_law.h>

namespace NPT
{
  PenaltyLaw::PenaltyLaw(const double penalty)
    : penalty_(penalty)
  {
    Assert(penalty > 0., dealii::ExcMessage("The penalty must be positive"));
  }



  double
  PenaltyLaw::penalty() const
  {
    return penalty_;
  }



  NormalLaw::Response
  PenaltyLaw::response(const double gap,
                       const double multiplier,
                       const double penalty_scale) const
  {
    const double penalty = penalty_scale * penalty_;
    const double p       = multiplier + penalty * gap;
    if (p < 0.)
      return {true,
              p,
              penalty,
              0.5 * (p * p - multiplier * multiplier) / penalty};
    return {false, 0., 0., -0.5 * multiplier * multiplier / penalty};
  }

  namespace
  {
    const Registry<NamedNormalLaw>::Registration penalty_law(
      "penalty",
      {"pressure = penalty times penetration, (23)",
       [](const ContactParameters &parameters) {
         return std::make_unique<PenaltyLaw>(parameters.normal_penalty);
       }});
  } // namespace
} // namespace NPT
