// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines reading and cross-checking of the parameters of contact benchmarks.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_case.h>

#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  void
  ContactCaseParameters::Body::add_parameters(dealii::ParameterHandler &prm,
                                              const std::string &subsection)
  {
    const ParameterSubsection scope(prm, subsection);
    add_parameter(prm,
                  "Young modulus",
                  young_modulus,
                  "Young's modulus E > 0 [MPa] of the neo-Hookean law, "
                  "Eq. (51). The rigid bodies of some cases ignore it.",
                  positive_number());
    add_parameter(prm,
                  "Poisson ratio",
                  poisson_ratio,
                  "Poisson's ratio -1 < nu < 0.5 [-].",
                  Patterns::Double(-1., 0.5));
    add_parameter(prm,
                  "Radius",
                  radius,
                  "Radius R [mm] of the contact surface; of the drum and "
                  "of the disc in those cases.",
                  positive_number());
    add_parameter(
      prm,
      "Elements",
      n_elements,
      "Knot spans: per half width of the contact (cylinders, sphere, crossed "
      "cylinders, partial slip, sphere twist, ironing), per edge (patch "
      "test), through the height (block), along the arc (capstan), across "
      "the disc (disc twist).",
      Patterns::Integer(1, 1000));
  }



  void
  ContactCaseParameters::Body::check(const std::string &subsection) const
  {
    if (poisson_ratio > -1. && poisson_ratio < 0.5)
      return;
    std::ostringstream text;
    text << "Poisson ratio is " << poisson_ratio
         << "; it must be above -1 and below 0.5, where the material is "
            "incompressible (subsection "
         << subsection << ").";
    throw InputError(text.str());
  }



  void
  ContactCaseParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    {
      const ParameterSubsection subsection(prm, "Benchmark");
      add_parameter(prm,
                    "Case",
                    name,
                    "Which problem with an exact solution is computed; "
                    "see doc/verification.md, section Contact.",
                    Patterns::Selection(ContactCases::instance().selection()));
      add_parameter(prm,
                    "Half width",
                    half_width,
                    "Half width a [mm] of the Hertzian contact, along x; "
                    "the load follows from it. Strains grow with a/R.",
                    positive_number());
      add_parameter(prm,
                    "Body size",
                    body_size,
                    "Half width and height of the bodies over the half "
                    "width of the Hertzian contact [-]. Large stands for a "
                    "half-space.",
                    Patterns::Double(2., 1e4));
      add_parameter(prm,
                    "Span growth",
                    span_growth,
                    "Ratio of the lengths of neighboring knot spans away "
                    "from the Hertzian contact [-].",
                    Patterns::Double(1., 10.));
      add_parameter(prm,
                    "Degree",
                    degree,
                    "Degree of the functions in all directions.",
                    Patterns::Integer(2, 5));
      add_parameter(prm,
                    "Pressure",
                    pressure,
                    "Nominal pressure [MPa] (patch test, block, disc "
                    "twist); for the capstan that of the slack end, "
                    "T_1/(R b) with the width b of the belt.",
                    positive_number());
      add_parameter(prm,
                    "Stick ratio",
                    stick_ratio,
                    "Half width of the sticking zone over that of the "
                    "contact, c/a, at the end of tangential loading "
                    "(partial slip, sphere twist).",
                    Patterns::Double(0.01, 0.99));
      add_parameter(prm,
                    "Distance",
                    distance,
                    "Tangential path [mm] (block: to both sides, ironing, "
                    "capstan: of the tight end).",
                    positive_number());
      add_parameter(prm,
                    "Wrap angle",
                    wrap_angle,
                    "Angle of the belt around the drum [degrees].",
                    Patterns::Double(1., 150.));
      add_parameter(prm,
                    "Thickness",
                    thickness,
                    "Thickness of the belt [mm].",
                    positive_number());
      add_parameter(prm,
                    "Load steps",
                    load_steps,
                    "Steps of each tangential stage (half of a cycle).",
                    Patterns::Integer(1, 100000));
      add_parameter(prm,
                    "Stiffness factor",
                    stiffness_factor,
                    "Factor on Young's modulus of the upper body in the "
                    "computation only: the exact solution does not know of "
                    "it. Not 1 to see that a comparison can fail [-].",
                    positive_number());
      add_parameter(prm,
                    "Friction factor",
                    friction_factor,
                    "The same for the friction coefficient [-].",
                    positive_number());
    }
    upper.add_parameters(prm, "Upper body");
    lower.add_parameters(prm, "Lower body");
  }



  void
  ContactCaseParameters::check() const
  {
    upper.check("Upper body");
    lower.check("Lower body");
  }



  void
  ContactOutputParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Output");
    add_parameter(prm,
                  "Directory",
                  directory,
                  "Where all results go; created if missing. The option "
                  "--output of the program overrides it.",
                  Patterns::DirectoryName());
    add_parameter(prm,
                  "Picture",
                  picture,
                  "Draw result and exact solution with gnuplot.");
    add_parameter(prm,
                  "Fields",
                  fields,
                  "Write the bodies (VTU) at the end of each stage.");
  }



  void
  ContactBenchmarkParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    prm.declare_entry(
      "Problem",
      "contact benchmark",
      Patterns::Selection("contact benchmark"),
      "What the program does: here contact problems with exact solutions. "
      "Other values have other entries.");
    benchmark.add_parameters(prm);
    contact.add_parameters(prm);
    friction.add_parameters(prm);
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);
    output.add_parameters(prm);
  }



  ContactBenchmarkParameters
  ContactBenchmarkParameters::read(const ParameterText            &text,
                                   const std::vector<std::string> &overrides)
  {
    ContactBenchmarkParameters parameters;
    dealii::ParameterHandler   prm;
    parameters.add_parameters(prm);
    // What is compared depends on the case.
    const std::string name = get_entry(text, overrides, "Benchmark/Case")
                               .value_or(parameters.benchmark.name);
    std::vector<ComparedQuantity> quantities;
    if (ContactCases::instance().contains(name))
      quantities = all_quantities(*ContactCases::instance().get(name));
    declare_tolerances(prm, quantities);
    parse_parameter_text(prm, text, overrides);
    parameters.benchmark.check();
    parameters.tolerances = parse_tolerances(prm, quantities);

    const ContactCase &contact_case = *ContactCases::instance().get(name);
    contact_case.check(parameters);
    parameters.friction.check();
    if (parameters.friction.coefficient == 0. && contact_case.needs_friction())
      throw InputError("Friction coefficient is 0; this case is about friction "
                       "and needs a positive one (subsections Benchmark and "
                       "Friction).");

    if (parameters.contact.automatic_penalties)
      throw InputError("Automatic penalties is true, but only a plate test has "
                       "bundles that they follow from; set Normal penalty and "
                       "Tangential penalty instead (subsection Contact).");

    parameters.used_file = documented_parameters(prm);
    return parameters;
  }
} // namespace NPT
