// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines Coulomb friction with a tangential penalty: return mapping in surface
// coordinates, and its derivatives.

#ifndef npt_dealii_contact_coulomb_friction_h
#define npt_dealii_contact_coulomb_friction_h

#include <npt_dealii/iga/iga_surface.h>

#include <array>

namespace NPT
{
  /**
   * Coulomb's law (12)-(14), regularized by a tangential penalty (24)-(27), in
   * covariant components on the primary surface:
   *
   * @f[ t^{trial}_a = t_{a,n} + \epsilon_T a_{ab} \Delta\xi^b, \quad
   *     \|t\|^2 = t_a a^{ab} t_b, \quad
   *     t_a = t^{trial}_a \min(1, \mu |p| / \|t^{trial}\|). @f]
   *
   * The sign of the slip branch is + ((27) and (42) misprint it): traction
   * here is work-conjugate to the slip of the secondary relative to the
   * primary side, as in (22).
   */
  template <int m>
  struct CoulombFriction
  {
    double coefficient; ///< mu [-]
    double penalty;     ///< epsilon_T [N/mm^3]

    static constexpr unsigned int n_metric = SymmetricIndices<m>::n_second;

    struct Response
    {
      bool                  slipping    = false;
      std::array<double, m> traction    = {}; ///< t_a [N/mm^2 * mm]
      double                dissipation = 0;  ///< per area, this increment
      double                energy      = 0;  ///< stored by the penalty
      // Derivatives of t_a by Delta xi^b, |p| and the metric a_11, a_12, a_22
      // (off-diagonal terms counted once, for the symmetric pair).
      std::array<std::array<double, m>, m>        by_slip     = {};
      std::array<double, m>                       by_pressure = {};
      std::array<std::array<double, n_metric>, m> by_metric   = {};
    };

    /**
     * @param traction_n Traction t_{a,n} at the last accepted step.
     * @param slip Increment Delta xi^b since then.
     * @param metric a_11, a_12, a_22 (averaged).
     * @param pressure |p| >= 0 [MPa]; zero gives no traction.
     */
    Response
    operator()(const std::array<double, m>        &traction_n,
               const std::array<double, m>        &slip,
               const std::array<double, n_metric> &metric,
               const double                        pressure) const;
  };
} // namespace NPT

#endif
