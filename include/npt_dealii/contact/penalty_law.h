// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the penalty law of contact pressure.

#ifndef npt_dealii_contact_penalty_law_h
#define npt_dealii_contact_penalty_law_h

#include <npt_dealii/contact/normal_law.h>

namespace NPT
{
  /**
   * Penalty law (23), (39), with a multiplier for the augmented Lagrangian,
   *
   * @f[ p = \min(0, \lambda + \epsilon_N g) \le 0 \; [MPa]. @f]
   */
  class PenaltyLaw : public NormalLaw
  {
  public:
    /// @param penalty epsilon_N > 0 [N/mm^3].
    explicit PenaltyLaw(const double penalty);

    double
    penalty() const override;

  protected:
    Response
    response(const double gap,
             const double multiplier,
             const double penalty_scale) const override;

  private:
    const double penalty_;
  };
} // namespace NPT

#endif
