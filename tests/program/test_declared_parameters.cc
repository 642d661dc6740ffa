// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines claims about all entries of all problems: each is the member that
// declares it, and a printed file restores what was read.

#include <npt_dealii/base/declared_parameters.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/problems/identification/identification_run.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>
#include <npt_dealii/problems/parameter_study/study_parameters.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/solids/solid_benchmark_parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <catch2/catch.hpp>

#include <map>
#include <set>

using namespace NPT;

namespace
{
  using Entries = std::map<std::string, DeclaredEntry>; // by path

  void
  collect(const DeclaredSection &section,
          const std::string     &path,
          Entries               &entries)
  {
    for (const DeclaredEntry &entry : section.entries)
      entries[path + entry.name] = entry;
    for (const DeclaredSection &subsection : section.subsections)
      collect(subsection, path + subsection.name + "/", entries);
  }

  Entries
  entries_of(const dealii::ParameterHandler &prm)
  {
    Entries entries;
    collect(declared_parameters(prm), "", entries);
    return entries;
  }

  /// What the members hold, as the defaults that they declare.
  template <typename Parameters>
  Entries
  members_of(Parameters &parameters)
  {
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    return entries_of(prm);
  }

  /// A choice among one registered thing: there is no other value.
  bool
  is_fixed(const DeclaredEntry &entry)
  {
    return entry.pattern.find("[Selection ") == 0 &&
           entry.pattern.find('|') == std::string::npos;
  }

  /// A value that the entry allows and does not have.
  std::string
  another_value(const DeclaredEntry &entry)
  {
    std::vector<std::string> candidates = {"0.25",
                                           "0.5",
                                           "0.05",
                                           "3",
                                           "4",
                                           "1",
                                           "0.75",
                                           "H1: 0.5",
                                           "H11: 0.5",
                                           "45: 0.25",
                                           "0.25, 0.5",
                                           "gmsh",
                                           "word"};
    for (const std::string list : {"true|false", "NURBS|Bernstein", "dilation"})
      for (const auto &word : dealii::Utilities::split_string_list(list, '|'))
        candidates.push_back(word);
    const std::string selection = "[Selection ";
    if (entry.pattern.compare(0, selection.size(), selection) == 0)
      candidates = dealii::Utilities::split_string_list(
        entry.pattern.substr(selection.size(),
                             entry.pattern.size() - selection.size() - 1),
        '|');
    const auto pattern = dealii::Patterns::pattern_factory(entry.pattern);
    for (const std::string &candidate : candidates)
      if (candidate != entry.value && pattern->match(candidate))
        return candidate;
    return "";
  }

  /// Entries that decide which others there are; their members are those.
  const std::set<std::string> structural = {"Problem",
                                            "Load programme/Stages",
                                            "Load programme/Further stages",
                                            "Material tests/Tests"};

  /// Entries that reading fills in where the file leaves it to the program.
  const std::set<std::string> completed = {"Cell/Type",
                                           "Cell/Side contact",
                                           "Cell/Smooth closure",
                                           "Cell/Mirror planes",
                                           "Contact/Penetration tolerance",
                                           "Contact/Stick tolerance",
                                           "Weft material/Law",
                                           "Micro cell/Fiber radius"};

  template <typename Parameters>
  void
  check_defaults()
  {
    Parameters    defaults;
    const Entries declared = members_of(defaults);
    Parameters    read     = Parameters::read({});
    const Entries members  = members_of(read);
    REQUIRE(members.size() == declared.size());
    for (const auto &[path, entry] : declared)
      {
        CAPTURE(path);
        CHECK_FALSE(entry.documentation.empty());
        if (completed.count(path) == 0)
          CHECK(members.at(path).value == entry.value);
      }
  }

  /// Set one entry after the other to another value.
  template <typename Parameters>
  void
  check_every_entry()
  {
    Parameters    untouched;
    const Entries defaults = members_of(untouched);
    for (const auto &[path, entry] : defaults)
      if (structural.count(path) == 0 && !is_fixed(entry))
        {
          const std::string value = another_value(entry);
          CAPTURE(path, entry.pattern, value);
          REQUIRE_FALSE(value.empty());

          Parameters               parameters;
          dealii::ParameterHandler prm;
          parameters.add_parameters(prm);
          parse_parameter_text(prm, {}, {path + "=" + value});
          const Entries members = members_of(parameters);
          unsigned int  changed = 0;
          for (const auto &[other, member] : members)
            changed += member.value != defaults.at(other).value;
          CHECK(members.at(path).value == value);
          CHECK(changed == 1);

          Parameters               again;
          dealii::ParameterHandler prm_again;
          again.add_parameters(prm_again);
          const std::string printed = documented_parameters(prm);
          parse_parameter_text(prm_again,
                               make_parameter_text(printed, "printed.prm"));
          CHECK(members_of(again).at(path).value == value);
          CHECK(documented_parameters(prm_again) == printed);
        }
  }
} // namespace



TEMPLATE_TEST_CASE("An empty file gives the defaults of the members",
                   "[program]",
                   PlateTestParameters,
                   MaterialTestParameters,
                   IdentificationRunParameters,
                   StudyParameters,
                   SolidBenchmarkParameters,
                   ContactBenchmarkParameters)
{
  check_defaults<TestType>();
}



TEMPLATE_TEST_CASE("Every entry changes its own member and no other, and a "
                   "printed file restores it",
                   "[program]",
                   PlateTestParameters,
                   MaterialTestParameters,
                   IdentificationRunParameters,
                   StudyParameters,
                   SolidBenchmarkParameters,
                   ContactBenchmarkParameters)
{
  check_every_entry<TestType>();
}



TEST_CASE("What an entry finds wrong itself is reported with its place",
          "[program]")
{
  const auto text =
    make_parameter_text("subsection Load programme\nsubsection Stage shear\n"
                        "set Targets = H3: 0.1, H3: 0.2\nend\nend\n",
                        "twice.prm");
  CHECK_THROWS_WITH(PlateTestParameters::read(text),
                    Catch::StartsWith("twice.prm:3: Targets names H3 twice"));
}
