// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a contact pressure that stiffens with depth, an example of a further
// normal law.

#ifndef npt_dealii_doc_extending_stiffening_law_h
#define npt_dealii_doc_extending_stiffening_law_h

#include <npt_dealii/contact/normal_law.h>

namespace NPT
{
  /**
   * The penalty law with a stiffness that grows with the penetration,
   *
   * @f[ p = \min(0, \lambda + \pi(g)), \qquad
   *     \pi(g) = \epsilon_N \, g \left( 1 + \frac{\max(0, -g)}{d} \right) , @f]
   *
   * as fibers that are pressed together do: at the depth d the secant stiffness
   * is twice that of the first touch.
   */
  class StiffeningLaw : public NormalLaw
  {
  public:
    /// @param penalty epsilon_N > 0 [N/mm^3].
    /// @param depth d > 0 [mm].
    StiffeningLaw(const double penalty, const double depth);

    double
    penalty() const override;

  protected:
    Response
    response(const double gap,
             const double multiplier,
             const double penalty_scale) const override;

  private:
    const double penalty_, depth_;
  };
} // namespace NPT

#endif
