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
      prm.declare_entry(
        "Edge radius",
        "0.25",
        Patterns::Double(0., 1.),
        "Rounding of the edges of the contact surfaces as a fraction of the "
        "bundle thickness, (A15) of doc/theory.md [-]: a contact point that "
        "slides over the edge of a bundle loses its pressure over about this "
        "length. 0: sharp, pressure is lost at once, and Newton's method may "
        "fail there. Curves hardly depend on it: with 0.25 and 0.5 n1 differs "
        "by 8e-4 after weaving and by 1e-4 at 20 % tension.");
      prm.declare_entry(
        "Kink rounding",
        "0.1",
        Patterns::Double(0., 0.5),
        "C0 bases: primary surfaces are rounded over this fraction of the knot "
        "spans on either side of a kink, (A19) of doc/theory.md [-]. With 0 a "
        "contact point that the load holds between the two normals of a kink "
        "has no equilibrium, and the run ends there. No effect on the basis "
        "NURBS, which has no kinks.");
      prm.declare_entry(
        "Enforcement",
        "penalty",
        Patterns::Selection("penalty|augmented Lagrangian"),
        "penalty: pressure = penalty times penetration, as in the paper. "
        "augmented Lagrangian: each load step is repeated with multipliers "
        "until penetration and drift while sticking are below the tolerances "
        "that follow, whatever the penalty. For Method mortar: KTS poses more "
        "conditions than the surfaces can meet and needs many more steps.");
      prm.declare_entry("Penetration tolerance",
                        "2e-5",
                        Patterns::Double(std::numeric_limits<double>::min()),
                        "Augmented Lagrangian: largest gap, in absolute value, "
                        "that is left at a closed contact node [mm].");
      prm.declare_entry("Stick tolerance",
                        "2e-5",
                        Patterns::Double(std::numeric_limits<double>::min()),
                        "Augmented Lagrangian: largest change of the elastic "
                        "part of the slip in the last repetition [mm].");
      prm.declare_entry("Maximum augmentations",
                        "50",
                        Patterns::Integer(1, 1000),
                        "Repetitions of a load step after which it counts as "
                        "failed [-].");
    }
    prm.leave_subsection();
  }



  void
  ContactParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Contact");
    method                = prm.get("Method");
    normal_penalty        = prm.get_double("Normal penalty");
    n_quadrature_points   = prm.get_integer("Quadrature points");
    maximum_penetration   = prm.get_double("Maximum penetration");
    edge_radius           = prm.get_double("Edge radius");
    kink_rounding         = prm.get_double("Kink rounding");
    enforcement           = prm.get("Enforcement");
    penetration_tolerance = prm.get_double("Penetration tolerance");
    stick_tolerance       = prm.get_double("Stick tolerance");
    max_augmentations     = prm.get_integer("Maximum augmentations");
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
      prm.declare_entry(
        "Slip measure",
        "relative displacement",
        Patterns::Selection("relative displacement|closest point"),
        "relative displacement: slip of a point against the material point of "
        "the other surface that it touched when the load step began, (A16); "
        "smooth at edges, kinks and seams. closest point: increments of the "
        "closest point's parameters, Eqs. (20), (24) of the paper; both agree "
        "as the load steps become small.");
    }
    prm.leave_subsection();
  }



  void
  FrictionParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Friction");
    coefficient        = prm.get_double("Friction coefficient");
    tangential_penalty = prm.get_double("Tangential penalty");
    slip_measure       = prm.get("Slip measure");
    prm.leave_subsection();
  }
} // namespace NPT
