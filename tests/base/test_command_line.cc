// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the command line: what each option does and what each mistake
// says.

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/exceptions.h>

#include <deal.II/base/config.h>

#include <catch2/catch.hpp>

using namespace NPT;
using Action = CommandLine::Action;

namespace
{
  CommandLine
  parse(std::vector<const char *> arguments)
  {
    arguments.insert(arguments.begin(), "./npt_dealii");
    return parse_command_line(arguments.size(), arguments.data());
  }

  std::string
  message(const std::vector<const char *> &arguments)
  {
    try
      {
        parse(arguments);
      }
    catch (const InputError &error)
      {
        const std::string text   = error.what();
        const std::string ending = " (see npt_dealii --help)";
        REQUIRE_THAT(text, Catch::EndsWith(ending));
        return text.substr(0, text.size() - ending.size());
      }
    return "no InputError";
  }
} // namespace



TEST_CASE("A file name alone is a run with the file's own settings", "[base]")
{
  const CommandLine line = parse({"shear.prm"});
  CHECK(line.action == Action::run);
  CHECK(line.parameter_file == "shear.prm");
  CHECK(line.output_directory.empty());
  CHECK(line.overrides.empty());
}



TEST_CASE("Options may stand before and behind the file", "[base]")
{
  const CommandLine line = parse({"--set",
                                  "A/B=1",
                                  "shear.prm",
                                  "--output",
                                  "out dir",
                                  "--set=A/C d=x=y",
                                  "--validate"});
  CHECK(line.action == Action::validate);
  CHECK(line.parameter_file == "shear.prm");
  CHECK(line.output_directory == "out dir");
  CHECK(line.overrides == std::vector<std::string>{"A/B=1", "A/C d=x=y"});
  CHECK(parse({"a.prm", "--output=b"}).output_directory == "b");
}



TEST_CASE("Help, version and defaults need no file", "[base]")
{
  CHECK(parse({"--help"}).action == Action::help);
  CHECK(parse({"-h"}).action == Action::help);
  CHECK(parse({"--version"}).action == Action::version);
  CHECK(parse({"a.prm", "--geometry-only"}).action == Action::geometry);
  CHECK(parse({"--print-defaults"}).action == Action::print_defaults);
  CHECK(parse({"a.prm", "--print-defaults"}).parameter_file == "a.prm");
  // Who asks for help gets it, whatever else is wrong.
  CHECK(parse({"--nonsense", "a", "b", "--help"}).action == Action::help);
}



TEST_CASE("Each mistake on the command line has its own sentence", "[base]")
{
  CHECK(message({}) ==
        "the parameter file is missing, write npt_dealii FILE.prm");
  CHECK(message({"--validate"}) ==
        "the parameter file is missing, write npt_dealii FILE.prm");
  CHECK_THAT(message({"a.prm", "b.prm"}),
             Catch::StartsWith("two parameter files, 'a.prm' and 'b.prm'"));
  CHECK(message({"a.prm", "--otput", "x"}) ==
        "unknown option '--otput'; did you mean '--output'?");
  CHECK(message({"a.prm", "-output=x"}) ==
        "unknown option '-output'; did you mean '--output'?");
  CHECK(message({"a.prm", "--defaults"}) ==
        "unknown option '--defaults'; did you mean '--print-defaults'?");
  CHECK(message({"a.prm", "--banana"}) == "unknown option '--banana'");
  CHECK(message({"a.prm", "--output"}) ==
        "--output needs the name of a directory");
  CHECK(message({"a.prm", "--output", "--validate"}) ==
        "--output needs the name of a directory");
  CHECK(message({"a.prm", "--output="}) ==
        "--output needs the name of a directory");
  CHECK(message({"a.prm", "--output", "x", "--output=y"}) ==
        "--output is given twice, 'x' and 'y'");
  CHECK(message({"a.prm", "--set"}) ==
        "--set needs an entry and a value, write --set "
        "'Subsection/Entry=value'");
  CHECK(message({"a.prm", "--set", "A/B"}) ==
        "--set 'A/B': '=' is missing, write --set 'Subsection/Entry=value'");
  CHECK(message({"a.prm", "--set", "A/B= "}) ==
        "--set 'A/B= ': the value is missing, write --set "
        "'Subsection/Entry=value'");
  CHECK(message({"a.prm", "--set", "=1"}) ==
        "--set '=1': the name of the entry is missing, write --set "
        "'Subsection/Entry=value'");
  CHECK(message({"a.prm", "--validate", "--print-defaults"}) ==
        "--validate and --print-defaults exclude each other; choose one");
  CHECK(message({"a.prm", "--validate=yes"}) ==
        "--validate takes no value, found '--validate=yes'");
  CHECK_THAT(message({""}), Catch::StartsWith("an argument is empty"));
}



TEST_CASE("The help names every option and the version names deal.II", "[base]")
{
  for (const char *option : {"--output",
                             "--set",
                             "--validate",
                             "--print-defaults",
                             "--help",
                             "--version"})
    CHECK_THAT(help_text(), Catch::Contains(option));
  CHECK(version_text("1.2.3") == std::string("npt_dealii 1.2.3 (deal.II ") +
                                   DEAL_II_PACKAGE_VERSION + ")\n");
}
