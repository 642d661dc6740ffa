// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the answer of a contact node to its gap.

#ifndef npt_dealii_contact_normal_law_h
#define npt_dealii_contact_normal_law_h

namespace NPT
{
  /**
   * Penalty law (23), (39), with a multiplier for the augmented Lagrangian,
   *
   * @f[ p = \min(0, \lambda + \epsilon_N g) \le 0 \; [MPa], @f]
   *
   * where lambda <= 0 is fixed during Newton's method (zero: pure penalty).
   */
  struct NormalLaw
  {
    double penalty; ///< epsilon_N [N/mm^3]

    struct Response
    {
      bool   active;
      double pressure; ///< p <= 0, the sign of (23)
      double slope;    ///< dp/dg
      double energy;   ///< per area, with dE/dg = p [N/mm]
    };

    Response
    operator()(const double gap, const double multiplier = 0.) const
    {
      const double p = multiplier + penalty * gap;
      if (p < 0.)
        return {true,
                p,
                penalty,
                0.5 * (p * p - multiplier * multiplier) / penalty};
      return {false, 0., 0., -0.5 * multiplier * multiplier / penalty};
    }
  };
} // namespace NPT

#endif
