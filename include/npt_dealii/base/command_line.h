// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the user asked for on the command line, and the texts of --help
// and --version.

#ifndef npt_dealii_base_command_line_h
#define npt_dealii_base_command_line_h

#include <functional>
#include <string>
#include <vector>

namespace NPT
{
  struct CommandLine
  {
    enum class Action
    {
      run,
      help,
      version,
      validate,       ///< Read and check the parameters, then stop.
      geometry,       ///< Write the geometry of the cell, then stop.
      print_defaults, ///< Write a documented parameter file, then stop.
      from_texgen,    ///< Turn a TexGen file into a parameter file.
      to_texgen,      ///< Turn a parameter file into a TexGen file.
      from_data_sheet ///< Turn a data sheet into a parameter file.
    };

    Action      action = Action::run;
    std::string parameter_file;   ///< May be empty only for the actions help,
                                  ///< version, print_defaults and
                                  ///< from_data_sheet. From_texgen: the TexGen
                                  ///< file; from_data_sheet: the data sheet.
    std::string output_directory; ///< Empty: the one of the parameter file.
    bool continues = false; ///< Go on where a run in the same directory ended.
    std::vector<std::string> overrides; ///< "Subsection/Entry=value", in order.

    /// Runs the program with other arguments and returns its exit status. It
    /// is for a forked process that ends with this status, as a case of a
    /// study does. Set by run_program(), not by parse_command_line().
    std::function<int(std::vector<std::string> arguments)> run_again;
  };

  /**
   * Read `npt_dealii FILE.prm [options]`; options may stand before or behind
   * the file, `--output=DIR` is the same as `--output DIR`.
   *
   * Throws InputError with one sentence and a pointer to --help for an unknown
   * option, a missing or second file, an option without its value or given
   * twice, two actions at once, --continue with an action, and a --set without
   * '=', name or value. (An empty value would rather be a shell variable that
   * was never set.) If --help or --version appears anywhere, nothing else is
   * looked at.
   */
  CommandLine
  parse_command_line(const int argc, const char *const *argv);

  std::string
  help_text();

  /// Version of the program and of the deal.II it was built with.
  std::string
  version_text(const std::string &program_version = "0.1.0");
} // namespace NPT

#endif
