// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading and cross-checking of the parameters of solid benchmarks.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/verification/solids/solid_benchmark_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;
  using dealii::Utilities::split_string_list;
  using Body = SolidBenchmarkParameters::Body;

  namespace
  {
    const std::vector<std::pair<std::string, Body>> bodies = {
      {"plate with hole", Body::plate_with_hole},
      {"cylinder", Body::cylinder},
      {"sphere", Body::sphere},
      {"block", Body::block}};

    void
    declare_benchmark(dealii::ParameterHandler &prm)
    {
      prm.enter_subsection("Benchmark");
      std::string names;
      for (const auto &body : bodies)
        names += (names.empty() ? "" : "|") + body.first;
      prm.declare_entry(
        "Case",
        "plate with hole",
        Patterns::Selection(names),
        "Plate with a circular hole under tension (Kirsch), thick-walled "
        "cylinder or sphere under inner pressure (Lame): rates of convergence "
        "of the law linearized at the natural state. Block: homogeneous "
        "states of the law at finite strain, in a distorted mesh.");
      prm.declare_entry("Inner radius",
                        "1",
                        Patterns::Double(1e-6),
                        "Radius of the hole, or inner radius [mm].");
      prm.declare_entry("Outer size",
                        "4",
                        Patterns::Double(1e-6),
                        "Half width of the plate, or outer radius [mm].");
      prm.declare_entry("Load",
                        "1",
                        Patterns::Double(1e-12),
                        "Tension T far from the hole, or inner pressure p "
                        "[MPa]. The problem is linear: errors do not depend on "
                        "it.");
      prm.declare_entry(
        "Bases",
        "NURBS, Bernstein, Lagrange",
        Patterns::List(Patterns::Selection("NURBS|Bernstein|Lagrange"), 1, 3),
        "Functions to be tested, see Mesh/Basis of a plate test: C^{p-1}, C0, "
        "and deal.II's FE_Q.");
      prm.declare_entry("Degrees",
                        "2, 3, 4",
                        Patterns::List(Patterns::Integer(2, 5), 1, 4),
                        "Polynomial degrees p [-].");
      prm.declare_entry("Elements",
                        "4, 8, 16",
                        Patterns::List(Patterns::Integer(1, 100), 1, 10),
                        "Knot spans per direction and patch of the meshes of a "
                        "series, increasing [-]; plate and cylinder are one "
                        "span thick.");
      prm.declare_entry("Radial factor",
                        "1",
                        Patterns::Integer(1, 10),
                        "Knot spans from the inner to the outer face per knot "
                        "span of Elements [-]. (A wall that is thick against "
                        "its radius reaches the rates of theory later.)");
      prm.declare_entry("Additional Gauss points",
                        "0",
                        Patterns::Integer(0, 5),
                        "Per direction, beyond p + 1 [-].");
      prm.declare_entry("Tolerance of rates",
                        "0.1",
                        Patterns::Double(0.),
                        "The run fails if the rate between the two finest "
                        "meshes of a series differs by more from p (energy "
                        "norm) or p + 1 (L2 norm) [-].");
      prm.leave_subsection();

      prm.enter_subsection("Homogeneous states");
      prm.declare_entry(
        "Modes",
        "uniaxial, equibiaxial, dilation, simple shear",
        Patterns::List(Patterns::Selection(
                         "uniaxial|equibiaxial|dilation|simple shear"),
                       1,
                       4),
        "Stretch along 1 with the sides free, along 1 and 2 with 3 free, in "
        "all directions; F = 1 + gamma e_1 (x) e_2.");
      prm.declare_entry("Fiber directions",
                        "1, 2",
                        Patterns::List(Patterns::Integer(1, 3), 1, 3),
                        "Axes along which the fiber of the fiber bundle law is "
                        "laid, one after the other.");
      prm.declare_entry("Stretch",
                        "1.1",
                        Patterns::Double(0.5, 3.),
                        "Of the driven directions [-].");
      prm.declare_entry("Shear",
                        "0.2",
                        Patterns::Double(-3., 3.),
                        "gamma of simple shear [-].");
      prm.declare_entry("Distortion",
                        "0.25",
                        Patterns::Double(0., 0.49),
                        "Largest shift of a control point over the distance to "
                        "its neighbors [-].");
      prm.declare_entry("Tolerance",
                        "1e-9",
                        Patterns::Double(0.),
                        "The run fails if the average stress differs by more "
                        "from the closed form, relative to its largest "
                        "component [-].");
      StepParameters steps;
      steps.initial_step = steps.maximum_step = 0.25;
      steps.declare_parameters(prm);
      prm.leave_subsection();
    }

    void
    declare_all(dealii::ParameterHandler &prm)
    {
      declare_problem(prm, "solid benchmark");
      declare_benchmark(prm);
      MaterialParameters::declare_parameters(prm, "Material");
      prm.enter_subsection("Material");
      prm.declare_entry("Law",
                        "neo-Hookean",
                        Patterns::Selection("fiber bundle|neo-Hookean"),
                        "Strain energy: the isotropic neo-Hookean law, Eq. "
                        "(51), or (block only) the transversely isotropic "
                        "law, Eqs. (50)-(53).");
      prm.leave_subsection();
      NewtonParameters::declare_parameters(prm);
      prm.enter_subsection("Newton");
      prm.declare_entry("Relative tolerance",
                        "1e-12",
                        Patterns::Double(1e-14, 1),
                        "Residual norm over the norm of the internal forces "
                        "before they cancel, at which Newton has converged "
                        "[-].");
      prm.declare_entry("Absolute tolerance",
                        "1e-14",
                        Patterns::Double(0),
                        "Residual norm that always counts as converged [N].");
      prm.leave_subsection();
      LinearSolverParameters::declare_parameters(prm);
      prm.enter_subsection("Output");
      prm.declare_entry("Directory",
                        "output-benchmark",
                        Patterns::DirectoryName(),
                        "Where all results go; created if missing. The option "
                        "--output of the program overrides it.");
      prm.declare_entry("Picture",
                        "true",
                        Patterns::Bool(),
                        "Draw convergence.svg with gnuplot at the end (not "
                        "for the block).");
      prm.leave_subsection();
    }

    template <typename Choice, typename Convert>
    std::vector<std::pair<std::string, Choice>>
    read_choices(const std::string &list,
                 const std::string &entry,
                 const Convert     &convert)
    {
      std::vector<std::pair<std::string, Choice>> choices;
      for (const std::string &name : split_string_list(list, ','))
        {
          for (const auto &other : choices)
            if (other.first == name)
              throw InputError(entry + " names " + name +
                               " twice; name it once.");
          choices.emplace_back(name, convert(name));
        }
      return choices;
    }

    std::vector<unsigned int>
    read_numbers(const std::string &list,
                 const std::string &entry,
                 const bool         increasing)
    {
      std::vector<unsigned int> numbers;
      std::set<unsigned int>    seen;
      for (const int n :
           dealii::Utilities::string_to_int(split_string_list(list, ',')))
        {
          if (increasing && !numbers.empty() &&
              static_cast<unsigned int>(n) <= numbers.back())
            throw InputError(entry + " has " + std::to_string(n) + " after " +
                             std::to_string(numbers.back()) +
                             "; the numbers must increase (subsection "
                             "Benchmark).");
          if (!seen.insert(n).second)
            throw InputError(entry + " names " + std::to_string(n) +
                             " twice; name it once.");
          numbers.push_back(n);
        }
      return numbers;
    }
  } // namespace



  SolidBenchmarkParameters
  SolidBenchmarkParameters::read(const ParameterText            &text,
                                 const std::vector<std::string> &overrides)
  {
    dealii::ParameterHandler prm;
    declare_all(prm);
    parse_parameter_text(prm, text, overrides);

    SolidBenchmarkParameters p;
    prm.enter_subsection("Benchmark");
    p.name = prm.get("Case");
    for (const auto &choice : bodies)
      if (choice.first == p.name)
        p.body = choice.second;
    p.inner_radius = prm.get_double("Inner radius");
    p.outer_size   = prm.get_double("Outer size");
    p.load         = prm.get_double("Load");
    p.bases   = read_choices<Basis>(prm.get("Bases"), "Bases", basis_from_name);
    p.degrees = read_numbers(prm.get("Degrees"), "Degrees", false);
    p.n_elements    = read_numbers(prm.get("Elements"), "Elements", true);
    p.radial_factor = prm.get_integer("Radial factor");
    p.additional_gauss_points = prm.get_integer("Additional Gauss points");
    p.rate_tolerance          = prm.get_double("Tolerance of rates");
    prm.leave_subsection();

    prm.enter_subsection("Homogeneous states");
    p.modes = read_choices<HomogeneousMode>(prm.get("Modes"),
                                            "Modes",
                                            homogeneous_mode_from_name);
    p.fiber_axes =
      read_numbers(prm.get("Fiber directions"), "Fiber directions", false);
    for (unsigned int &axis : p.fiber_axes)
      --axis;
    p.stretch          = prm.get_double("Stretch");
    p.shear            = prm.get_double("Shear");
    p.distortion       = prm.get_double("Distortion");
    p.stress_tolerance = prm.get_double("Tolerance");
    p.steps.parse_parameters(prm, "subsection Homogeneous states");
    prm.leave_subsection();

    p.material.parse_parameters(prm, "Material");
    p.newton.parse_parameters(prm);
    p.linear_solver.parse_parameters(prm);
    prm.enter_subsection("Output");
    p.directory = prm.get("Directory");
    p.picture   = prm.get_bool("Picture");
    prm.leave_subsection();

    std::ostringstream message;
    if (p.body != Body::block)
      {
        if (p.outer_size <= p.inner_radius)
          message << "Outer size is " << p.outer_size
                  << " mm; it must be larger than the inner radius of "
                  << p.inner_radius << " mm (subsection Benchmark).";
        else if (p.n_elements.size() < 2)
          message << "Elements names one mesh; a rate of convergence needs at "
                     "least two (subsection Benchmark).";
        else if (p.material.law != MaterialParameters::Law::neo_hookean)
          message << "Law is fiber bundle; the exact solution of the case '"
                  << p.name
                  << "' is the one of the neo-Hookean law (subsection "
                     "Material).";
      }
    if (!message.str().empty())
      throw InputError(message.str());

    std::ostringstream used;
    print_documented_parameters(prm, used);
    p.used_file = used.str();
    return p;
  }



  std::string
  SolidBenchmarkParameters::documented_defaults()
  {
    dealii::ParameterHandler prm;
    declare_all(prm);
    std::ostringstream out;
    print_documented_parameters(prm, out);
    return out.str();
  }
} // namespace NPT
