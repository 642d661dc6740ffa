// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the contact and friction entries of the parameter file.

#ifndef npt_dealii_contact_contact_parameters_h
#define npt_dealii_contact_contact_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <string>

namespace NPT
{
  /// Subsection "Contact".
  struct ContactParameters
  {
    std::string  method              = "mortar"; ///< mortar or KTS
    double       normal_penalty      = 100.;     ///< epsilon_N [N/mm^3]
    unsigned int n_quadrature_points = 0;        ///< 0: degree + 1
    double       maximum_penetration = 0.5;      ///< fraction of thickness
    double       edge_radius         = 0.25;     ///< fraction of thickness
    double       kink_rounding       = 0.1;      ///< fraction of a span
    /// "penalty" or "augmented Lagrangian"
    std::string  enforcement           = "penalty";
    double       penetration_tolerance = 2e-5; ///< augmented Lagrangian [mm]
    double       stick_tolerance       = 2e-5; ///< augmented Lagrangian [mm]
    unsigned int max_augmentations     = 50;

    bool
    augmented() const
    {
      return enforcement == "augmented Lagrangian";
    }

    static void
    declare_parameters(dealii::ParameterHandler &prm);
    void
    parse_parameters(dealii::ParameterHandler &prm);
  };

  /// Subsection "Friction".
  struct FrictionParameters
  {
    double coefficient        = 0.3;  ///< mu [-]
    double tangential_penalty = 100.; ///< epsilon_T [N/mm^3]
    /// "relative displacement" or "closest point", see ContactAssembler
    std::string slip_measure = "relative displacement";

    static void
    declare_parameters(dealii::ParameterHandler &prm);
    void
    parse_parameters(dealii::ParameterHandler &prm);
  };
} // namespace NPT

#endif
