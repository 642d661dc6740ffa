// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact and friction entries of the parameter file.

#include <npt_dealii/contact/contact_parameters.h>

#include <limits>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  void
  ContactParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    {
      prm.declare_entry(
        "Method",
        "mortar",
        Patterns::Selection("mortar|KTS"),
        "Where the contact conditions are posed: mortar averages gap and slip "
        "over the support of each control point of the secondary surface, "
        "Eqs. (37)-(43); KTS (standard knot-to-surface) takes every Gauss "
        "point by itself, Eqs. (23)-(27).");
      prm.declare_entry(
        "Normal penalty",
        "100",
        Patterns::Double(std::numeric_limits<double>::min()),
        "Penalty epsilon_N of Eq. (23) [N/mm^3]: pressure per penetration. "
        "Larger is more accurate (the error falls with 1/epsilon_N) and "
        "harder for Newton's method.");
      prm.declare_entry(
        "Quadrature points",
        "0",
        Patterns::Integer(0, 20),
        "Gauss points per knot span and direction on the secondary surface; 0 "
        "takes degree + 1.");
      prm.declare_entry(
        "Maximum penetration",
        "0.5",
        Patterns::Double(0.01, 1.),
        "A closest point that lies deeper than this fraction of the bundle "
        "thickness inside the primary body is taken for its far side and "
        "rejected [-].");
    }
    prm.leave_subsection();
  }



  void
  ContactParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    method              = prm.get("Method");
    normal_penalty      = prm.get_double("Normal penalty");
    n_quadrature_points = prm.get_integer("Quadrature points");
    maximum_penetration = prm.get_double("Maximum penetration");
    prm.leave_subsection();
  }



  void
  FrictionParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Friction");
    {
      prm.declare_entry("Friction coefficient",
                        "0.3",
                        Patterns::Double(0.),
                        "Coulomb friction coefficient mu of Eq. (12) [-]; 0 "
                        "skips all friction work.");
      prm.declare_entry(
        "Tangential penalty",
        "100",
        Patterns::Double(std::numeric_limits<double>::min()),
        "Penalty epsilon_T of Eq. (24) [N/mm^3]: traction per elastic slip "
        "while sticking.");
    }
    prm.leave_subsection();
  }



  void
  FrictionParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Friction");
    coefficient        = prm.get_double("Friction coefficient");
    tangential_penalty = prm.get_double("Tangential penalty");
    prm.leave_subsection();
  }
} // namespace NPT
