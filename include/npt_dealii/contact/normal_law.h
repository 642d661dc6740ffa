// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what every normal law answers to the gap of a contact node.

#ifndef npt_dealii_contact_normal_law_h
#define npt_dealii_contact_normal_law_h

#include <npt_dealii/base/registry.h>
#include <npt_dealii/contact/contact_parameters.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * The pressure p(g, lambda) <= 0 of a contact node [MPa] by its gap g > 0
   * (open) and the multiplier lambda <= 0 of the augmented Lagrangian, which
   * is fixed during Newton's method (zero: none).
   */
  class NormalLaw
  {
  public:
    virtual ~NormalLaw() = default;

    struct Response
    {
      bool   active;
      double pressure; ///< p <= 0, the sign of (23)
      double slope;    ///< dp/dg
      double energy;   ///< per area, with dE/dg = p [N/mm]
    };

    /// @param penalty_scale Factor by which the penalty has grown.
    Response
    operator()(const double gap,
               const double multiplier    = 0.,
               const double penalty_scale = 1.) const
    {
      return response(gap, multiplier, penalty_scale);
    }

    /// Stiffness that turns an error of pressure into one of the gap [N/mm^3].
    virtual double
    penalty() const = 0;

  protected:
    virtual Response
    response(const double gap,
             const double multiplier,
             const double penalty_scale) const = 0;
  };

  /// A normal law by its name, for Registry.
  struct NamedNormalLaw
  {
    std::string text; ///< one line for the user
    std::function<std::unique_ptr<const NormalLaw>(const ContactParameters &)>
      make;
    /// Beyond the penalty; entries of subsection "Contact".
    std::vector<OwnNumber> numbers = {};
  };
} // namespace NPT

#endif
