// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading and cross-checking of the parameters of material tests.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;
  using dealii::Utilities::split_string_list;

  namespace
  {
    const std::string default_tests =
      "tension 1, tension 2, tension 3, shear 12, shear 23, shear 31";

    // "tension 1" -> "H11: 0.2", "shear 12" -> "H12: 0.1, H21: 0.1".
    std::string
    default_targets(const std::string &name)
    {
      for (const char c : {'1', '2', '3'})
        if (name == std::string("tension ") + c)
          return std::string("H") + c + c + ": 0.2";
      for (const std::string plane : {"12", "23", "31"})
        if (name == "shear " + plane)
          return "H" + plane + ": 0.1, H" + plane[1] + plane[0] + ": 0.1";
      return "";
    }

    std::string
    component_name(const char letter, const unsigned int e)
    {
      return letter + std::to_string(e / 3 + 1) + std::to_string(e % 3 + 1);
    }

    void
    read_targets(const std::string &text, MaterialTest &test)
    {
      const std::string      place = " (subsection Test " + test.name + ").";
      std::set<unsigned int> named;
      for (const std::string &item : split_string_list(text, ','))
        {
          const auto pair = split_string_list(item, ':');
          AssertDimension(pair.size(), 2); // checked by the pattern
          const unsigned int e = 3 * (pair[0][1] - '1') + (pair[0][2] - '1');
          if (!named.insert(e).second)
            throw InputError("Targets names the component " +
                             pair[0].substr(1) +
                             " twice; of a component either H or P can be "
                             "prescribed, once" +
                             place);
          test.stress_controlled[e] = pair[0][0] == 'P';
          test.target[e] = dealii::Utilities::string_to_double(pair[1]);
        }
      if (named.empty())
        throw InputError("Targets is empty; name at least one component as in "
                         "'H11: 0.2, P22: 0'" +
                         place);
      for (const unsigned int e : {1u, 2u, 5u})
        {
          const unsigned int transposed = 3 * (e % 3) + e / 3;
          if (test.stress_controlled[e] && test.stress_controlled[transposed])
            throw InputError("Targets prescribes both " +
                             component_name('P', e) + " and " +
                             component_name('P', transposed) +
                             ", so that nothing holds the rotation of the "
                             "cell; prescribe one of them and leave the other "
                             "H at 0" +
                             place);
        }
    }

    // A constituent: the entries of any material, neo-Hookean by default.
    void
    declare_constituent(dealii::ParameterHandler &prm,
                        const std::string        &subsection,
                        const double              young_modulus)
    {
      MaterialParameters::declare_parameters(prm, subsection);
      prm.enter_subsection(subsection);
      prm.declare_entry("Law",
                        "neo-Hookean",
                        Patterns::Selection("fiber bundle|neo-Hookean"),
                        "Strain energy: the isotropic neo-Hookean law, Eq. "
                        "(51), or the transversely isotropic law, Eqs. "
                        "(50)-(53), with its axis along the fibers.");
      std::ostringstream text;
      text << young_modulus;
      prm.declare_entry("Young modulus",
                        text.str(),
                        Patterns::Double(),
                        "neo-Hookean: Young's modulus E > 0 [MPa] at small "
                        "strain, mu = E/(2 (1 + nu)) in Eq. (51).");
      prm.leave_subsection();
    }

    void
    declare_material_test(dealii::ParameterHandler       &prm,
                          const std::vector<std::string> &names)
    {
      declare_problem(prm, "material test");
      MicroCellParameters::declare_parameters(prm);
      MicroMeshParameters::declare_parameters(prm);
      declare_constituent(prm, "Fiber material", 100.);
      declare_constituent(prm, "Matrix material", 1.);
      MaterialTestProgramme::declare_parameters(prm, names);
      NewtonParameters::declare_parameters(prm);
      // A smooth problem: two more digits cost less than one iteration, and the
      // averages then agree with the reactions.
      prm.enter_subsection("Newton");
      prm.declare_entry("Relative tolerance",
                        "1e-10",
                        Patterns::Double(1e-14, 1),
                        "Residual norm over the norm of the internal forces "
                        "before they cancel, at which Newton has converged "
                        "[-].");
      // Fibers of a few micrometers have small forces.
      prm.declare_entry("Absolute tolerance",
                        "1e-18",
                        Patterns::Double(0.),
                        "Residual norm at which Newton has converged in any "
                        "case [N].");
      prm.leave_subsection();
      LinearSolverParameters::declare_parameters(prm);
      IdentificationParameters::declare_parameters(prm);
      MaterialOutputParameters::declare_parameters(prm, "output-nmt", true);
    }
  } // namespace



  std::vector<std::string>
  MaterialTestProgramme::read_test_names(
    const ParameterText            &text,
    const std::vector<std::string> &overrides)
  {
    const auto entry = get_entry(text, overrides, "Material tests/Tests");
    const auto names = split_string_list(entry ? *entry : default_tests, ',');
    return names.size() == 1 && names[0] == "none" ?
             std::vector<std::string>() :
             names;
  }



  void
  MaterialTestProgramme::declare_parameters(
    dealii::ParameterHandler       &prm,
    const std::vector<std::string> &names)
  {
    prm.enter_subsection("Material tests");
    prm.declare_entry("Tests",
                      default_tests,
                      Patterns::List(Patterns::Anything(), 1),
                      "Names of the tests, separated by commas; each has a "
                      "subsection 'Test NAME' and starts at the natural state. "
                      "`none` computes the small-strain moduli only.");
    prm.declare_entry("Uniform along fiber",
                      "true",
                      Patterns::Bool(),
                      "Assume that the fluctuation of the displacement does "
                      "not change along the fibers. Exact unless the fibers "
                      "buckle, and several times faster; false leaves only "
                      "periodicity in this direction too.");
    prm.declare_entry("Identify",
                      "true",
                      Patterns::Bool(),
                      "Fit the bundle law to the tests when they are done "
                      "(subsection Identification).");
    // The six default tests can be described even if they are not run, so that
    // one file serves with `--set "Material tests/Tests=tension 1"`.
    std::vector<std::string> all = names;
    for (const std::string &name : split_string_list(default_tests, ','))
      if (std::find(all.begin(), all.end(), name) == all.end())
        all.push_back(name);
    for (const std::string &name : all)
      {
        prm.enter_subsection("Test " + name);
        prm.declare_entry(
          "Targets",
          default_targets(name),
          Patterns::Map(Patterns::Selection("H11|H12|H13|H21|H22|H23|H31|H32|"
                                            "H33|P11|P12|P13|P21|P22|P23|P31|"
                                            "P32|P33"),
                        Patterns::Double(),
                        0,
                        9,
                        ",",
                        ":"),
          "Components at the end of the test, 'H11: 0.2, P22: 0': of the "
          "macroscopic displacement gradient H [-] or, instead, of the first "
          "Piola-Kirchhoff stress P [MPa]. Components not named have H = 0.");
        StepParameters steps;
        steps.initial_step = steps.maximum_step = 0.1;
        steps.declare_parameters(prm);
        prm.leave_subsection();
      }
    prm.leave_subsection();
  }



  void
  MaterialTestProgramme::parse_parameters(dealii::ParameterHandler       &prm,
                                          const std::vector<std::string> &names)
  {
    prm.enter_subsection("Material tests");
    tests.clear();
    std::set<std::string> seen;
    for (const std::string &name : names)
      {
        if (!seen.insert(name).second)
          throw InputError("Tests names '" + name +
                           "' twice; every test needs a name of its own "
                           "(subsection Material tests).");
        MaterialTest test;
        test.name = name;
        prm.enter_subsection("Test " + name);
        read_targets(prm.get("Targets"), test);
        test.steps.parse_parameters(prm, "subsection Test " + name);
        prm.leave_subsection();
        tests.push_back(test);
      }
    prm.leave_subsection();
  }



  MaterialTestParameters
  MaterialTestParameters::read(const ParameterText            &text,
                               const std::vector<std::string> &overrides)
  {
    const auto names = MaterialTestProgramme::read_test_names(text, overrides);
    dealii::ParameterHandler prm;
    declare_material_test(prm, names);
    parse_parameter_text(prm, text, overrides);

    MaterialTestParameters parameters;
    parameters.cell.parse_parameters(prm);
    parameters.mesh.parse_parameters(prm);
    parameters.fiber.parse_parameters(prm, "Fiber material");
    parameters.matrix.parse_parameters(prm, "Matrix material");
    prm.enter_subsection("Material tests");
    parameters.uniform_along_fiber = prm.get_bool("Uniform along fiber");
    parameters.identify            = prm.get_bool("Identify");
    prm.leave_subsection();
    parameters.programme.parse_parameters(prm, names);
    parameters.newton.parse_parameters(prm);
    parameters.linear_solver.parse_parameters(prm);
    parameters.identification.parse_parameters(prm);
    parameters.output.parse_parameters(prm, true);

    std::ostringstream used;
    print_documented_parameters(prm, used);
    parameters.used_file = used.str();
    return parameters;
  }



  std::string
  MaterialTestParameters::documented_defaults()
  {
    dealii::ParameterHandler prm;
    declare_material_test(prm, MaterialTestProgramme::read_test_names({}, {}));
    std::ostringstream out;
    print_documented_parameters(prm, out);
    return out.str();
  }
} // namespace NPT
