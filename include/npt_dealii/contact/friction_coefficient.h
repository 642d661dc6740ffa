// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a friction coefficient that depends on the angle between the fibers
// and on how far the surfaces have slid.

#ifndef npt_dealii_contact_friction_coefficient_h
#define npt_dealii_contact_friction_coefficient_h

#include <npt_dealii/contact/contact_parameters.h>

namespace NPT
{
  /**
   * Coefficient by the angle theta between the fibers of both surfaces and the
   * length s of the slip so far, (A38),
   *
   * @f[ \mu(\theta, s) = \mu_s(\theta)
   *       \left( r + (1 - r) \, e^{-s/\ell} \right), \qquad
   *     \cos\theta = |f^s \cdot f^m| , @f]
   *
   * with the static coefficient mu_s, linear between the angles of a table and
   * constant beyond them, the ratio r of the dynamic to the static one, and the
   * slip length l. Both angle and slip are those of the accepted state, so that
   * mu is a constant of the load step.
   *
   * What a friction law takes for its pressure is |p| mu / mu_0 with mu_0, the
   * entry Friction coefficient, so that its limit mu_0 |p| becomes mu |p|.
   */
  class FrictionCoefficient
  {
  public:
    explicit FrictionCoefficient(const FrictionParameters &parameters);

    bool
    depends_on_angle() const
    {
      return !by_angle_.empty();
    }
    bool
    depends_on_slip() const
    {
      return ratio_ != 1.;
    }
    bool
    varies() const
    {
      return depends_on_angle() || depends_on_slip();
    }

    /// mu_s(theta) / mu_0 [-]. @param cosine Of theta, 0 to 1 but for
    /// round-off.
    double
    static_factor(const double cosine) const;
    /// mu / mu_s [-]. @param slip_path s >= 0 [mm].
    double
    decay(const double slip_path) const;
    /// Slip of a load step [mm], from its dissipation per area and the pressure
    /// that the law was given.
    double
    slip_of_step(const double dissipation, const double law_pressure) const;

  private:
    const double                coefficient_, ratio_, slip_length_;
    const FrictionTable::Values by_angle_;
  };
} // namespace NPT

#endif
