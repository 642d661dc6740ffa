// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what every friction law answers to the slip of a contact node.

#ifndef npt_dealii_contact_friction_law_h
#define npt_dealii_contact_friction_law_h

#include <npt_dealii/base/registry.h>
#include <npt_dealii/contact/contact_parameters.h>
#include <npt_dealii/iga/iga_surface.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /// Answer of a friction law at a contact node.
  template <int m>
  struct FrictionResponse
  {
    static constexpr unsigned int n_metric = SymmetricIndices<m>::n_second;

    bool                  slipping = false;
    std::array<double, m> traction = {}; ///< t_a [N/mm^2 * mm]
    /// Per area, of this increment: traction at its end times slip.
    double dissipation = 0;
    double energy      = 0; ///< stored by the penalty
    // Derivatives of t_a by Delta xi^b, |p| and the metric a_11, a_12, a_22
    // (off-diagonal terms counted once, for the symmetric pair).
    std::array<std::array<double, m>, m>        by_slip     = {};
    std::array<double, m>                       by_pressure = {};
    std::array<std::array<double, n_metric>, m> by_metric   = {};
  };

  /**
   * Friction traction t_a by slip increment Delta xi^a, metric a_ab and
   * pressure |p|, work-conjugate to the slip of the secondary relative to the
   * primary side, as in (22). A law knows no surface; the slip measure tells
   * which components it sees, see SlipMeasure.
   */
  template <int m>
  class FrictionLaw
  {
  public:
    static constexpr unsigned int n_metric = SymmetricIndices<m>::n_second;
    using Response                         = FrictionResponse<m>;

    virtual ~FrictionLaw() = default;

    /**
     * @param traction_n Traction t_{a,n} at the last accepted step.
     * @param slip Increment Delta xi^b since then.
     * @param metric a_11, a_12, a_22 (averaged).
     * @param pressure |p| >= 0 [MPa]; zero gives no traction.
     * @param penalty_scale Factor by which the penalty has grown.
     */
    Response
    operator()(const std::array<double, m>        &traction_n,
               const std::array<double, m>        &slip,
               const std::array<double, n_metric> &metric,
               const double                        pressure,
               const double                        penalty_scale = 1.) const
    {
      Assert(pressure >= 0.,
             dealii::ExcMessage("Pressure must not be negative"));
      return response(traction_n, slip, metric, pressure, penalty_scale);
    }

    /// False if there is no traction whatever the slip: then none of the
    /// friction machinery is ever touched.
    virtual bool
    exerts_traction() const = 0;

    /// Stiffness that turns an error of traction into one of slip [N/mm^3].
    virtual double
    penalty() const = 0;

  protected:
    virtual Response
    response(const std::array<double, m>        &traction_n,
             const std::array<double, m>        &slip,
             const std::array<double, n_metric> &metric,
             const double                        pressure,
             const double                        penalty_scale) const = 0;
  };

  /// A friction law by its name, for Registry.
  template <int m>
  struct NamedFrictionLaw
  {
    std::string text; ///< one line for the user
    std::function<std::unique_ptr<const FrictionLaw<m>>(
      const FrictionParameters &)>
      make;
    /// Beyond coefficient and penalty; entries of subsection "Friction".
    std::vector<OwnNumber> numbers = {};
  };
} // namespace NPT

#endif
