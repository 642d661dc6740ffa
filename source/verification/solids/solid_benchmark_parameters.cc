// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines reading and cross-checking of the parameters of solid benchmarks.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/verification/comparison.h>
#include <npt_dealii/verification/solids/solid_benchmark_parameters.h>
#include <npt_dealii/verification/solids/solid_case.h>

#include <algorithm>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  void
  SolidBenchmarkParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "solid benchmark");
    add_convergence_parameters(prm);
    add_block_parameters(prm);
    material.add_parameters(prm, "Material");
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);

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
                  "Draw convergence.svg with gnuplot at the end (not "
                  "for the block).");
  }



  void
  SolidBenchmarkParameters::add_convergence_parameters(
    dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Benchmark");
    add_parameter(
      prm,
      "Case",
      name,
      "Plate with a circular hole under tension (Kirsch), thick-walled "
      "cylinder or sphere under inner pressure (Lame): rates of convergence "
      "of the law linearized at the natural state. Block: homogeneous "
      "states of the law at finite strain, in a distorted mesh.",
      Patterns::Selection(SolidCases::instance().selection()));
    add_parameter(prm,
                  "Inner radius",
                  inner_radius,
                  "Radius of the hole, or inner radius [mm].",
                  Patterns::Double(1e-6));
    add_parameter(prm,
                  "Outer size",
                  outer_size,
                  "Half width of the plate, or outer radius [mm].",
                  Patterns::Double(1e-6));
    add_parameter(prm,
                  "Load",
                  load,
                  "Tension T far from the hole, or inner pressure p "
                  "[MPa]. The problem is linear: errors do not depend on "
                  "it.",
                  Patterns::Double(1e-12));
    add_parameter(
      prm,
      "Bases",
      bases,
      "Functions to be tested, see Mesh/Basis of a plate test: C^{p-1}, C0, "
      "and deal.II's FE_Q.",
      Patterns::List(Patterns::Selection(selection<Basis>()), 1, 3));
    add_parameter(prm,
                  "Degrees",
                  degrees,
                  "Polynomial degrees p [-].",
                  Patterns::List(Patterns::Integer(2, 5), 1, 4));
    add_parameter(prm,
                  "Elements",
                  n_elements,
                  "Knot spans per direction and patch of the meshes of a "
                  "series, increasing [-]; plate and cylinder are one "
                  "span thick.",
                  Patterns::List(Patterns::Integer(1, 100), 1, 10));
    add_parameter(prm,
                  "Radial factor",
                  radial_factor,
                  "Knot spans from the inner to the outer face per knot "
                  "span of Elements [-]. (A wall that is thick against "
                  "its radius reaches the rates of theory later.)",
                  Patterns::Integer(1, 10));
    add_parameter(prm,
                  "Additional Gauss points",
                  additional_gauss_points,
                  "Per direction, beyond p + 1 [-].",
                  Patterns::Integer(0, 5));
    add_parameter(prm,
                  "Tolerance of rates",
                  rate_tolerance,
                  "The run fails if the rate between the two finest "
                  "meshes of a series differs by more from p (energy "
                  "norm) or p + 1 (L2 norm) [-].",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Stiffness factor",
                  stiffness_factor,
                  "Factor on the constants of the law in the computation "
                  "only: the exact solution does not know of it. Not 1 "
                  "to see that a comparison can fail [-].",
                  Patterns::Double(1e-6));
  }



  void
  SolidBenchmarkParameters::add_block_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Homogeneous states");
    add_parameter(
      prm,
      "Modes",
      modes,
      "Stretch along 1 with the sides free, along 1 and 2 with 3 free, in "
      "all directions; F = 1 + gamma e_1 (x) e_2.",
      Patterns::List(Patterns::Selection(selection<HomogeneousMode>()), 1, 4));

    std::vector<unsigned int> from_one;
    for (const unsigned int axis : fiber_axes)
      from_one.push_back(axis + 1);
    add_parameter(
      prm,
      "Fiber directions",
      EntryValue<decltype(from_one)>::text(from_one),
      [this](const std::string &text) {
        fiber_axes = EntryValue<decltype(fiber_axes)>::value(text);
        for (unsigned int &axis : fiber_axes)
          --axis;
      },
      "Axes along which the fiber of the fiber bundle law is "
      "laid, one after the other.",
      Patterns::List(Patterns::Integer(1, 3), 1, 3));
    add_parameter(prm,
                  "Stretch",
                  stretch,
                  "Of the driven directions [-].",
                  Patterns::Double(0.5, 3.));
    add_parameter(prm,
                  "Shear",
                  shear,
                  "gamma of simple shear [-].",
                  Patterns::Double(-3., 3.));
    add_parameter(prm,
                  "Distortion",
                  distortion,
                  "Largest shift of a control point over the distance to "
                  "its neighbors [-].",
                  Patterns::Double(0., 0.49));
    add_parameter(prm,
                  "Tolerance",
                  stress_tolerance,
                  "The run fails if the average stress differs by more "
                  "from the closed form, relative to its largest "
                  "component [-].",
                  Patterns::Double(0.));
    add_parameter(
      prm,
      "Tolerance at a point",
      pointwise_tolerance ? EntryValue<double>::text(*pointwise_tolerance) :
                            "none",
      [this](const std::string &text) {
        pointwise_tolerance =
          parse_tolerance(text, "Tolerance at a point", "Homogeneous states");
      },
      "The same for the stress at the worst quadrature "
      "point; none: it is reported only [-].",
      Patterns::Anything());
    steps.add_parameters(prm);
  }



  namespace
  {
    // Values of a list that stand there twice would be computed twice.
    template <typename Value>
    void
    check_distinct(const std::vector<Value> &values, const std::string &entry)
    {
      for (std::size_t i = 0; i < values.size(); ++i)
        if (std::count(values.begin(), values.begin() + i, values[i]) > 0)
          throw InputError(entry + " names " +
                           EntryValue<Value>::text(values[i]) +
                           " twice; name it once.");
    }
  } // namespace



  void
  SolidBenchmarkParameters::check() const
  {
    check_distinct(bases, "Bases");
    check_distinct(degrees, "Degrees");
    for (std::size_t i = 1; i < n_elements.size(); ++i)
      if (n_elements[i] <= n_elements[i - 1])
        throw InputError("Elements has " + std::to_string(n_elements[i]) +
                         " after " + std::to_string(n_elements[i - 1]) +
                         "; the numbers must increase (subsection "
                         "Benchmark).");
    check_distinct(modes, "Modes");
    std::vector<unsigned int> from_one = fiber_axes;
    for (unsigned int &axis : from_one)
      ++axis;
    check_distinct(from_one, "Fiber directions");
    steps.check("subsection Homogeneous states");
    if (SolidCases::instance().get(name).is_homogeneous())
      {
        if (!material.selected<NeoHookeanParameters>() &&
            !material.selected<FiberBundleParameters>())
          throw InputError("Law is " + material.law +
                           "; closed forms of homogeneous states are those of "
                           "the laws fiber bundle and neo-Hookean (subsection "
                           "Material).");
        return;
      }

    std::ostringstream message;
    if (outer_size <= inner_radius)
      message << "Outer size is " << outer_size
              << " mm; it must be larger than the inner radius of "
              << inner_radius << " mm (subsection Benchmark).";
    else if (n_elements.size() < 2)
      message << "Elements names one mesh; a rate of convergence needs at "
                 "least two (subsection Benchmark).";
    else if (!material.selected<NeoHookeanParameters>())
      message << "Law is " << material.law
              << "; the exact solution of the case '" << name
              << "' is the one of the neo-Hookean law (subsection Material).";
    if (!message.str().empty())
      throw InputError(message.str());
  }



  SolidBenchmarkParameters
  SolidBenchmarkParameters::read(const ParameterText            &text,
                                 const std::vector<std::string> &overrides)
  {
    SolidBenchmarkParameters parameters;
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    parameters.material.check("Material");
    parameters.check();
    parameters.used_file = documented_parameters(prm);
    return parameters;
  }



  std::string
  SolidBenchmarkParameters::documented_defaults()
  {
    return read({}).used_file;
  }
} // namespace NPT
