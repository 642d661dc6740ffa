// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the contact and friction entries of the parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/contact/contact_parameters.h>
#include <npt_dealii/contact/friction_law.h>
#include <npt_dealii/contact/normal_law.h>
#include <npt_dealii/contact/slip_measure.h>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  template <>
  const EnumNames<ContactParameters::Method> &
  enum_names<ContactParameters::Method>()
  {
    using Method                         = ContactParameters::Method;
    static const EnumNames<Method> names = {{Method::mortar, "mortar"},
                                            {Method::KTS, "KTS"}};
    return names;
  }



  template <>
  const EnumNames<ContactParameters::Enforcement> &
  enum_names<ContactParameters::Enforcement>()
  {
    using Enforcement                         = ContactParameters::Enforcement;
    static const EnumNames<Enforcement> names = {
      {Enforcement::penalty, "penalty"},
      {Enforcement::augmented_lagrangian, "augmented Lagrangian"}};
    return names;
  }



  template <>
  const EnumNames<ContactParameters::RoundEdges> &
  enum_names<ContactParameters::RoundEdges>()
  {
    using RoundEdges                         = ContactParameters::RoundEdges;
    static const EnumNames<RoundEdges> names = {{RoundEdges::automatic,
                                                 "automatic"},
                                                {RoundEdges::yes, "true"},
                                                {RoundEdges::no, "false"}};
    return names;
  }



  template <>
  const EnumNames<FrictionParameters::Nodes> &
  enum_names<FrictionParameters::Nodes>()
  {
    using Nodes                         = FrictionParameters::Nodes;
    static const EnumNames<Nodes> names = {
      {Nodes::contact_nodes, "contact nodes"},
      {Nodes::Gauss_points, "Gauss points"}};
    return names;
  }



  namespace
  {
    /// "NAME: TEXT. NAME: TEXT." of all that is registered.
    template <typename Entry>
    std::string
    descriptions()
    {
      const auto &registry = Registry<Entry>::instance();
      std::string text;
      for (const std::string &name : registry.names())
        text += (text.empty() ? "" : " ") + name + ": " +
                registry.get(name).text + ".";
      return text;
    }
  } // namespace



  void
  ContactParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Contact");
    add_parameter(
      prm,
      "Method",
      method,
      "Where the contact conditions are posed: mortar averages gap and slip "
      "over the support of each control point of the secondary surface, "
      "Eqs. (37)-(43); KTS (standard knot-to-surface) takes every Gauss "
      "point by itself, Eqs. (23)-(27).");
    const auto &laws = Registry<NamedNormalLaw>::instance();
    add_parameter(prm,
                  "Normal law",
                  normal_law,
                  "Pressure by the gap of a contact node. " +
                    descriptions<NamedNormalLaw>(),
                  Patterns::Selection(laws.selection()));
    add_own_numbers(prm, normal_law_numbers, laws);
    add_parameter(
      prm,
      "Normal penalty",
      normal_penalty,
      "Penalty epsilon_N of Eq. (23) [N/mm^3]: pressure per penetration. "
      "Larger is more accurate (the error falls with 1/epsilon_N) and "
      "harder for Newton's method.",
      positive_number());
    add_parameter(
      prm,
      "Automatic penalties",
      automatic_penalties,
      "Plate test: Normal penalty and Tangential penalty are both 50 times the "
      "stiffness of the bundles, E_T / thickness, (A43) of doc/theory.md; what "
      "the file says of them does not count then.");
    add_parameter(
      prm,
      "Quadrature points",
      n_quadrature_points,
      "Gauss points per knot span and direction on the secondary surface; 0 "
      "takes degree + 1.",
      Patterns::Integer(0, 20));
    add_parameter(
      prm,
      "Maximum penetration",
      maximum_penetration,
      "A load step in which a contact point gets deeper than this fraction of "
      "the bundle thickness into the other body is cut [-]: such a point could "
      "as well come from the far side. Results do not depend on it.",
      Patterns::Double(0.01, 1.));
    add_parameter(
      prm,
      "Maximum overlap",
      maximum_overlap,
      "Plate test: bundles that lie deeper in each other than this fraction of "
      "their thickness when a stage ends, wherever and whether contact is "
      "posed there or not, end the run with exit status 1, or with a warning "
      "if it is 1. A quarter of it gives a warning [-].",
      Patterns::Double(0.01, 1.));
    add_parameter(
      prm,
      "Edge radius",
      edge_radius,
      "Rounding of the edges of the contact surfaces as a fraction of the "
      "bundle thickness, (A15) of doc/theory.md [-]: a contact point that "
      "slides over the edge of a bundle loses its pressure over about this "
      "length. 0: sharp, pressure is lost at once, and Newton's method may "
      "fail there. Curves hardly depend on it: with 0.25 and 0.5 n1 differs "
      "by 8e-4 after weaving and by 1e-4 at 20 % tension.",
      Patterns::Double(0., 1.));
    add_parameter(
      prm,
      "Round edges",
      round_edges,
      "Plate test: whether wide faces meet other bundles as far as the middle "
      "of their blunt edges, around a half circle over the height of the edge, "
      "(A47) of doc/theory.md. false: as far as the corner of the edge, which "
      "then bears what presses beside it; in bundles with thick edges no mesh "
      "is fine enough for that. automatic: true in woven cells with a Blunt "
      "tip above 0.25.");
    add_parameter(
      prm,
      "Kink rounding",
      kink_rounding,
      "C0 bases: primary surfaces are rounded over this fraction of the knot "
      "spans on either side of a kink, (A19) of doc/theory.md [-]. With 0 a "
      "contact point that the load holds between the two normals of a kink "
      "has no equilibrium, and the run ends there. No effect on the basis "
      "NURBS, which has no kinks.",
      Patterns::Double(0., 0.5));
    add_enforcement_parameters(prm);
  }



  void
  ContactParameters::add_enforcement_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(
      prm,
      "Enforcement",
      enforcement,
      "penalty: pressure = penalty times penetration, as in the paper. "
      "augmented Lagrangian: each load step is repeated with multipliers "
      "until penetration and drift while sticking are below the tolerances "
      "that follow, whatever the penalty. For Method mortar: KTS poses more "
      "conditions than the surfaces can meet and needs many more steps.");
    add_parameter(prm,
                  "Penetration tolerance",
                  penetration_tolerance,
                  "Augmented Lagrangian: largest gap, in absolute value, "
                  "that is left at a closed contact node [mm]. 0: 1.7e-5 of "
                  "the thickness.",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Stick tolerance",
                  stick_tolerance,
                  "Augmented Lagrangian: largest change of the elastic "
                  "part of the slip in the last repetition [mm]. 0: 1.7e-5 "
                  "of the thickness.",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Maximum augmentations",
                  max_augmentations,
                  "Repetitions of a load step after which it counts as "
                  "failed [-].",
                  Patterns::Integer(1, 1000));
  }



  void
  ContactParameters::set_thickness(const double thickness)
  {
    for (double *tolerance : {&penetration_tolerance, &stick_tolerance})
      if (*tolerance == 0.)
        *tolerance = default_tolerance * thickness;
  }



  void
  FrictionParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Friction");
    const auto               &laws = Registry<NamedFrictionLaw<2>>::instance();
    add_parameter(prm,
                  "Law",
                  law,
                  "Friction traction by the slip of a contact node. " +
                    descriptions<NamedFrictionLaw<2>>(),
                  Patterns::Selection(laws.selection()));
    add_own_numbers(prm, law_numbers, laws);
    add_parameter(prm,
                  "Friction coefficient",
                  coefficient,
                  "Coulomb friction coefficient mu of Eq. (12) [-]; 0 "
                  "skips all friction work.",
                  Patterns::Double(0.));
    add_parameter(
      prm,
      "Tangential penalty",
      tangential_penalty,
      "Penalty epsilon_T of Eq. (24) [N/mm^3]: traction per elastic slip "
      "while sticking.",
      positive_number());
    add_parameter(
      prm,
      "Nodes",
      nodes,
      "Where the law is posed. contact nodes: to the slip averaged as the gap "
      "is, Eqs. (41), (42) of the paper; Method mortar then misses a spin of "
      "the surfaces within the support of a control point. Gauss points: to "
      "the slip of each, with the pressure that the mortar method finds there, "
      "(A27) of doc/theory.md. The same for Method KTS, whose contact nodes "
      "are Gauss points.");
    add_yarn_parameters(prm);
    add_parameter(prm,
                  "Slip measure",
                  slip_measure,
                  descriptions<NamedSlipMeasure<3>>(),
                  Patterns::Selection(
                    Registry<NamedSlipMeasure<3>>::instance().selection()));
  }



  void
  FrictionParameters::add_yarn_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(
      prm,
      "Coefficient by angle",
      by_angle,
      "Static friction coefficient mu_s by the angle between the fibers of the "
      "two surfaces where they touch, in the deformed state, (A38) of "
      "doc/theory.md: a list of 'angle: coefficient', as 0: 0.35, 45: 0.27, "
      "90: 0.22, angles rising from 0 to 90 [degree], coefficients >= 0 [-]; "
      "linear between, constant beyond. It takes the place of Friction "
      "coefficient, which must be > 0. Empty: the same at every angle.");
    add_parameter(
      prm,
      "Dynamic friction ratio",
      dynamic_ratio,
      "Dynamic over static friction coefficient, mu_d / mu_s of (A38) [-]: "
      "where a contact point has slid by several slip lengths since it last "
      "opened, friction has fallen to this part. 1: no decay.",
      Patterns::Double(0., 1.));
    add_parameter(prm,
                  "Slip length",
                  slip_length,
                  "Slip over which the difference between static and dynamic "
                  "friction falls to 1/e of it, (A38) [mm]. Without effect if "
                  "Dynamic friction ratio is 1.",
                  positive_number());
  }



  void
  FrictionParameters::check() const
  {
    if (coefficient > 0. || (by_angle.values.empty() && dynamic_ratio == 1.))
      return;
    throw InputError(
      "Friction coefficient is 0, which turns friction off, but " +
      std::string(by_angle.values.empty() ? "Dynamic friction ratio" :
                                            "Coefficient by angle") +
      " is given; use a Friction coefficient > 0 or leave the other entry out "
      "(subsection Friction).");
  }
} // namespace NPT
