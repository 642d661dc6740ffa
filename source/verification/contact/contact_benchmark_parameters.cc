// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading and cross-checking of the parameters of contact benchmarks.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>

#include <cmath>
#include <limits>
#include <map>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  namespace
  {
    const double smallest = std::numeric_limits<double>::min();

    const std::map<std::string, ContactCase> cases = {
      {"patch test", ContactCase::patch_test},
      {"cylinders", ContactCase::cylinders},
      {"sphere", ContactCase::sphere},
      {"crossed cylinders", ContactCase::crossed_cylinders},
      {"partial slip", ContactCase::partial_slip},
      {"block", ContactCase::block},
      {"capstan", ContactCase::capstan},
      {"disc twist", ContactCase::disc_twist},
      {"sphere twist", ContactCase::sphere_twist},
      {"ironing", ContactCase::ironing}};

    void
    declare_body(dealii::ParameterHandler &prm, const std::string &subsection)
    {
      prm.enter_subsection(subsection);
      prm.declare_entry("Young modulus",
                        "1000",
                        Patterns::Double(smallest),
                        "Young's modulus E > 0 [MPa] of the neo-Hookean law, "
                        "Eq. (51). The rigid bodies of some cases ignore it.");
      prm.declare_entry("Poisson ratio",
                        "0.3",
                        Patterns::Double(-1., 0.5),
                        "Poisson's ratio -1 < nu < 0.5 [-].");
      prm.declare_entry("Radius",
                        "1",
                        Patterns::Double(smallest),
                        "Radius R [mm] of the contact surface; of the drum and "
                        "of the disc in those cases.");
      prm.declare_entry(
        "Elements",
        "8",
        Patterns::Integer(1, 1000),
        "Knot spans: per half width of the contact (cylinders, sphere, crossed "
        "cylinders, partial slip, sphere twist, ironing), per edge (patch "
        "test), through the height (block), along the arc (capstan), across "
        "the disc (disc twist).");
      prm.leave_subsection();
    }

    void
    parse_body(dealii::ParameterHandler    &prm,
               const std::string           &subsection,
               ContactCaseParameters::Body &body)
    {
      prm.enter_subsection(subsection);
      body.young_modulus = prm.get_double("Young modulus");
      body.poisson_ratio = prm.get_double("Poisson ratio");
      body.radius        = prm.get_double("Radius");
      body.n_elements    = prm.get_integer("Elements");
      prm.leave_subsection();
      if (!(body.poisson_ratio > -1. && body.poisson_ratio < 0.5))
        {
          std::ostringstream text;
          text << "Poisson ratio is " << body.poisson_ratio
               << "; it must be above -1 and below 0.5, where the material is "
                  "incompressible (subsection "
               << subsection << ").";
          throw InputError(text.str());
        }
    }
  } // namespace



  void
  ContactCaseParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    std::string names;
    for (const auto &item : cases)
      names += (names.empty() ? "" : "|") + item.first;

    prm.enter_subsection("Benchmark");
    {
      prm.declare_entry("Case",
                        "cylinders",
                        Patterns::Selection(names),
                        "Which problem with an exact solution is computed; "
                        "see doc/verification.md, section Contact.");
      prm.declare_entry("Half width",
                        "0.01",
                        Patterns::Double(smallest),
                        "Half width a [mm] of the Hertzian contact, along x; "
                        "the load follows from it. Strains grow with a/R.");
      prm.declare_entry("Body size",
                        "20",
                        Patterns::Double(2., 1e4),
                        "Half width and height of the bodies over the half "
                        "width of the Hertzian contact [-]. Large stands for a "
                        "half-space.");
      prm.declare_entry("Span growth",
                        "1.6",
                        Patterns::Double(1., 10.),
                        "Ratio of the lengths of neighboring knot spans away "
                        "from the Hertzian contact [-].");
      prm.declare_entry("Degree",
                        "2",
                        Patterns::Integer(2, 5),
                        "Degree of the functions in all directions.");
      prm.declare_entry("Pressure",
                        "1",
                        Patterns::Double(smallest),
                        "Nominal pressure [MPa] (patch test, block, disc "
                        "twist); for the capstan that of the slack end, "
                        "T_1/(R b) with the width b of the belt.");
      prm.declare_entry("Stick ratio",
                        "0.5",
                        Patterns::Double(0.01, 0.99),
                        "Half width of the sticking zone over that of the "
                        "contact, c/a, at the end of tangential loading "
                        "(partial slip, sphere twist).");
      prm.declare_entry("Distance",
                        "0.1",
                        Patterns::Double(smallest),
                        "Tangential path [mm] (block: to both sides, ironing, "
                        "capstan: of the tight end).");
      prm.declare_entry("Wrap angle",
                        "120",
                        Patterns::Double(1., 150.),
                        "Angle of the belt around the drum [degrees].");
      prm.declare_entry("Thickness",
                        "0.01",
                        Patterns::Double(smallest),
                        "Thickness of the belt [mm].");
      prm.declare_entry("Load steps",
                        "10",
                        Patterns::Integer(1, 100000),
                        "Steps of each tangential stage (half of a cycle).");
    }
    prm.leave_subsection();
    declare_body(prm, "Upper body");
    declare_body(prm, "Lower body");
  }



  void
  ContactCaseParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Benchmark");
    type        = cases.at(prm.get("Case"));
    half_width  = prm.get_double("Half width");
    body_size   = prm.get_double("Body size");
    span_growth = prm.get_double("Span growth");
    degree      = prm.get_integer("Degree");
    pressure    = prm.get_double("Pressure");
    stick_ratio = prm.get_double("Stick ratio");
    distance    = prm.get_double("Distance");
    wrap_angle  = prm.get_double("Wrap angle");
    thickness   = prm.get_double("Thickness");
    load_steps  = prm.get_integer("Load steps");
    prm.leave_subsection();
    parse_body(prm, "Upper body", upper);
    parse_body(prm, "Lower body", lower);

    const auto check_size = [&](const Body &body, const std::string &name) {
      if (half_width * body_size >= 0.9 * body.radius)
        {
          std::ostringstream text;
          text << "Half width times Body size is " << half_width * body_size
               << " mm; the body must end before 0.9 of its radius of "
               << body.radius << " mm (subsections Benchmark and " << name
               << ").";
          throw InputError(text.str());
        }
    };
    switch (type)
      {
        case ContactCase::cylinders:
        case ContactCase::crossed_cylinders:
        case ContactCase::partial_slip:
          check_size(upper, "Upper body");
          check_size(lower, "Lower body");
          break;
        case ContactCase::sphere:
        case ContactCase::sphere_twist:
        case ContactCase::ironing:
          check_size(upper, "Upper body");
          break;
        default:
          break;
      }
    if (type == ContactCase::partial_slip &&
        (upper.young_modulus != lower.young_modulus ||
         upper.poisson_ratio != lower.poisson_ratio ||
         upper.radius != lower.radius))
      throw InputError(
        "The bodies differ; the exact solution of partial slip needs equal "
        "materials and radii (subsections Upper body and Lower body).");
    if (type == ContactCase::capstan && thickness > 0.2 * lower.radius)
      {
        std::ostringstream text;
        text << "Thickness is " << thickness
             << " mm; a belt must be thinner than a fifth of the radius of the "
                "drum, "
             << lower.radius << " mm (subsections Benchmark and Lower body).";
        throw InputError(text.str());
      }
  }



  void
  ContactOutputParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    {
      prm.declare_entry("Directory",
                        "output-contact",
                        Patterns::DirectoryName(),
                        "Where all results go; created if missing. The option "
                        "--output of the program overrides it.");
      prm.declare_entry("Picture",
                        "true",
                        Patterns::Bool(),
                        "Draw result and exact solution with gnuplot.");
      prm.declare_entry("Fields",
                        "false",
                        Patterns::Bool(),
                        "Write the bodies (VTU) at the end of each stage.");
    }
    prm.leave_subsection();
  }



  void
  ContactOutputParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Output");
    directory = prm.get("Directory");
    picture   = prm.get_bool("Picture");
    fields    = prm.get_bool("Fields");
    prm.leave_subsection();
  }



  ContactBenchmarkParameters
  ContactBenchmarkParameters::read(const ParameterText            &text,
                                   const std::vector<std::string> &overrides)
  {
    dealii::ParameterHandler prm;
    prm.declare_entry(
      "Problem",
      "contact benchmark",
      Patterns::Selection("contact benchmark"),
      "What the program does: here contact problems with exact solutions. "
      "Other values have other entries.");
    ContactCaseParameters::declare_parameters(prm);
    ContactParameters::declare_parameters(prm);
    FrictionParameters::declare_parameters(prm);
    NewtonParameters::declare_parameters(prm);
    // Errors of the formulation are to be seen, not those of the iteration;
    // small bodies have small forces.
    prm.enter_subsection("Newton");
    prm.declare_entry("Relative tolerance",
                      "1e-9",
                      Patterns::Double(1e-14, 1),
                      "Residual norm over the norm of the internal forces "
                      "before they cancel, at which Newton has converged [-].");
    prm.declare_entry("Absolute tolerance",
                      "1e-20",
                      Patterns::Double(0.),
                      "Residual norm at which Newton has converged in any case "
                      "[N].");
    prm.leave_subsection();
    LinearSolverParameters::declare_parameters(prm);
    ContactOutputParameters::declare_parameters(prm);
    parse_parameter_text(prm, text, overrides);

    ContactBenchmarkParameters parameters;
    parameters.benchmark.parse_parameters(prm);
    parameters.contact.parse_parameters(prm);
    parameters.friction.parse_parameters(prm);
    parameters.newton.parse_parameters(prm);
    parameters.linear_solver.parse_parameters(prm);
    parameters.output.parse_parameters(prm);

    const ContactCase type = parameters.benchmark.type;
    if (parameters.friction.coefficient == 0. &&
        type != ContactCase::patch_test && type != ContactCase::cylinders &&
        type != ContactCase::sphere && type != ContactCase::crossed_cylinders &&
        type != ContactCase::ironing)
      throw InputError("Friction coefficient is 0; this case is about friction "
                       "and needs a positive one (subsections Benchmark and "
                       "Friction).");

    std::ostringstream used;
    print_documented_parameters(prm, used);
    parameters.used_file = used.str();
    return parameters;
  }
} // namespace NPT
