// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines reading and cross-checking of the parameters of material tests.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/base/unused_sections.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

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
  } // namespace



  MaterialTest::MaterialTest(const std::string &given_name)
    : name(given_name)
  {
    steps.initial_step = steps.maximum_step = 0.1;
    set_targets(default_targets(name));
  }



  void
  MaterialTest::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Test " + name);
    add_parameter(
      prm,
      "Targets",
      targets(),
      [this](const std::string &text) { set_targets(text); },
      "Components at the end of the test, 'H11: 0.2, P22: 0': of the "
      "macroscopic displacement gradient H [-] or, instead, of the first "
      "Piola-Kirchhoff stress P [MPa]. Components not named have H = 0.",
      Patterns::Map(Patterns::Selection("H11|H12|H13|H21|H22|H23|H31|H32|"
                                        "H33|P11|P12|P13|P21|P22|P23|P31|"
                                        "P32|P33"),
                    Patterns::Double(),
                    0,
                    9,
                    ",",
                    ":"));
    steps.add_parameters(prm);
  }



  std::string
  MaterialTest::targets() const
  {
    std::string text;
    for (unsigned int e = 0; e < 9; ++e)
      if (is_named_[e])
        text += (text.empty() ? "" : ", ") +
                component_name(stress_controlled[e] ? 'P' : 'H', e) + ": " +
                EntryValue<double>::text(target[e]);
    return text;
  }



  void
  MaterialTest::set_targets(const std::string &text)
  {
    is_named_.fill(false);
    stress_controlled.fill(false);
    target.fill(0.);
    for (const std::string &item : split_list(text))
      {
        const auto pair = dealii::Utilities::split_string_list(item, ':');
        AssertDimension(pair.size(), 2); // checked by the pattern
        const unsigned int e = 3 * (pair[0][1] - '1') + (pair[0][2] - '1');
        if (is_named_[e])
          throw InputError("Targets names the component " + pair[0].substr(1) +
                           " twice; of a component either H or P can be "
                           "prescribed, once (subsection Test " +
                           name + ").");
        is_named_[e]         = true;
        stress_controlled[e] = pair[0][0] == 'P';
        target[e]            = EntryValue<double>::value(pair[1]);
      }
  }



  void
  MaterialTest::check() const
  {
    const std::string place = " (subsection Test " + name + ").";
    if (std::none_of(is_named_.begin(), is_named_.end(), [](const bool named) {
          return named;
        }))
      throw InputError("Targets is empty; name at least one component as in "
                       "'H11: 0.2, P22: 0'" +
                       place);
    for (const unsigned int e : {1u, 2u, 5u})
      {
        const unsigned int transposed = 3 * (e % 3) + e / 3;
        if (stress_controlled[e] && stress_controlled[transposed])
          throw InputError("Targets prescribes both " + component_name('P', e) +
                           " and " + component_name('P', transposed) +
                           ", so that nothing holds the rotation of the "
                           "cell; prescribe one of them and leave the other "
                           "H at 0" +
                           place);
      }
    steps.check("subsection Test " + name);
  }



  namespace
  {
    // Names become parts of the names of files, and every test has a dozen
    // entries.
    void
    check_list(const std::vector<std::string> &names)
    {
      const std::size_t most = 1000, longest = 100;
      if (names.size() > most)
        throw InputError("Tests names " + std::to_string(names.size()) +
                         " tests; there may be at most " +
                         std::to_string(most) +
                         " (subsection Material tests).");
      for (const std::string &name : names)
        if (name.size() > longest)
          throw InputError("Tests names " + in_quotes(name) + ", which has " +
                           std::to_string(name.size()) +
                           " characters; a name may have at most " +
                           std::to_string(longest) +
                           " (subsection Material tests).");
    }
  } // namespace



  MaterialTestProgramme::MaterialTestProgramme(const std::string &given_names)
  {
    const auto defaults = split_list(default_tests);
    const auto names = given_names.empty() ? defaults : split_list(given_names);
    check_list(names);
    if (names != std::vector<std::string>{"none"})
      for (const std::string &name : names)
        tests.emplace_back(name);
    // So that one file serves with `--set "Material tests/Tests=tension 1"`.
    for (const std::string &name : defaults)
      if (std::find(names.begin(), names.end(), name) == names.end())
        others_.emplace_back(name);
  }



  void
  MaterialTestProgramme::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Material tests");
    for (auto *list : {&tests, &others_})
      for (MaterialTest &test : *list)
        test.add_parameters(prm);
  }



  void
  MaterialTestProgramme::check() const
  {
    std::set<std::string> seen;
    for (const MaterialTest &test : tests)
      {
        if (!seen.insert(test.name).second)
          throw InputError("Tests names '" + test.name +
                           "' twice; every test needs a name of its own "
                           "(subsection Material tests).");
        test.check();
      }
  }



  MaterialTestParameters::MaterialTestParameters()
  {
    matrix.constants<NeoHookeanParameters>().young_modulus = 1.;
  }



  void
  MaterialTestParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "material test");
    cell.add_parameters(prm);
    mesh.add_parameters(prm);
    fiber.add_parameters(prm, "Fiber material");
    matrix.add_parameters(prm, "Matrix material");
    {
      const ParameterSubsection subsection(prm, "Material tests");
      // The tests stand already: their names decide what there is to declare.
      add_parameter(
        prm,
        "Tests",
        default_tests,
        [](const std::string &) {},
        "Names of the tests, separated by commas; each has a "
        "subsection 'Test NAME' and starts at the natural state. "
        "`none` computes the small-strain moduli only.",
        Patterns::List(Patterns::Anything(), 1));
      add_parameter(prm,
                    "Uniform along fiber",
                    uniform_along_fiber,
                    "Assume that the fluctuation of the displacement does "
                    "not change along the fibers. Exact unless the fibers "
                    "buckle, and several times faster; false leaves only "
                    "periodicity in this direction too.");
      add_parameter(prm,
                    "Identify",
                    identify,
                    "Fit the bundle law to the tests when they are done "
                    "(subsection Identification).");
    }
    programme.add_parameters(prm);
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);
    identification.add_parameters(prm);
    output.add_parameters(prm, true);
  }



  MaterialTestParameters
  MaterialTestParameters::read(const ParameterText            &given_text,
                               const std::vector<std::string> &overrides)
  {
    MaterialTestParameters parameters;
    ParameterText          text = given_text;
    parameters.remarks          = remove_unused_sections(
      text,
      overrides,
      {"Material tests", "Tests", "Test ", split_list(default_tests)});
    parameters.programme = MaterialTestProgramme(
      get_entry(text, overrides, "Material tests/Tests").value_or(""));
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    parameters.cell.check();
    parameters.fiber.check("Fiber material");
    parameters.matrix.check("Matrix material");
    parameters.programme.check();
    parameters.used_file = documented_parameters(prm);
    return parameters;
  }



  std::string
  MaterialTestParameters::documented_defaults()
  {
    return read({}).used_file;
  }
} // namespace NPT
