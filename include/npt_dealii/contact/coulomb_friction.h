// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines Coulomb friction with a tangential penalty: return mapping in surface
// coordinates, and its derivatives.

#ifndef npt_dealii_contact_coulomb_friction_h
#define npt_dealii_contact_coulomb_friction_h

#include <npt_dealii/contact/friction_law.h>

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
   * The sign of the slip branch is + ((27) and (42) misprint it).
   */
  template <int m>
  class CoulombFriction : public FrictionLaw<m>
  {
  public:
    using Response                         = FrictionResponse<m>;
    static constexpr unsigned int n_metric = FrictionLaw<m>::n_metric;

    /// @param coefficient mu >= 0 [-].
    /// @param penalty epsilon_T > 0 [N/mm^3].
    CoulombFriction(const double coefficient, const double penalty);

    bool
    exerts_traction() const override;
    double
    penalty() const override;

  protected:
    Response
    response(const std::array<double, m>        &traction_n,
             const std::array<double, m>        &slip,
             const std::array<double, n_metric> &metric,
             const double                        pressure,
             const double                        penalty_scale) const override;

  private:
    // The trial traction t_a, t^a = a^{ab} t_b and its square.
    struct Trial
    {
      std::array<double, m> covariant, contravariant;
      double                norm_square = 0;
    };
    // Scale the trial traction, and its derivatives in the response, to the
    // limit.
    void
    slide(const Trial &trial,
          const double pressure,
          const double penalty,
          Response    &answer) const;

    const double coefficient_;
    const double penalty_;
  };
} // namespace NPT

#endif
