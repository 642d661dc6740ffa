// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the reading of .prm files with messages a user can act on: file and
// line, what was found, what is allowed, and the nearest valid name.

#ifndef npt_dealii_base_parameter_file_h
#define npt_dealii_base_parameter_file_h

#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_text.h>

#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace dealii
{
  class ParameterHandler;
}

namespace NPT
{
  /**
   * Check every statement and override against the declared entries and store
   * the values.
   *
   * @param prm       All entries declared, no subsection entered. A later value
   *   of an entry replaces an earlier one from another file (a file may refine
   *   what it includes); twice in the same file is an error.
   * @param text      What read_parameter_text() returned.
   * @param overrides Strings `Subsection/Sub sub/Entry=value` of the command
   *   line's --set, stored after the file.
   *
   * Throws InputError at the first unknown entry or subsection, value that does
   * not match its pattern, or repeated entry; then @p prm holds the values up
   * to there and must not be used. Not-a-number and infinity never match a
   * number. Unlike ParameterHandler::parse_input(), a value with a brace `{` is
   * checked as well: this program has no loops over values.
   */
  void
  parse_parameter_text(dealii::ParameterHandler       &prm,
                       const ParameterText            &text,
                       const std::vector<std::string> &overrides = {});

  /**
   * Find the raw text of an entry before it is declared, for declarations that
   * depend on it (the number of stages decides how many subsections there are).
   *
   * @param path `Subsection/Sub sub/Entry`.
   * @return The last value, overrides after the file; nothing if it is not set.
   *
   * Nothing is checked here. A caller that cannot use the text should declare
   * with the default: parse_parameter_text() then reports the bad value.
   */
  std::optional<std::string>
  get_entry(const ParameterText            &text,
            const std::vector<std::string> &overrides,
            const std::string              &path);

  /**
   * Write all entries in declaration order as a parameter file: documentation
   * and allowed values as comments, wrapped at 80 characters, then the current
   * value. Before parsing these are the defaults; where a value differs from
   * its default, the comment gives the default. Reading the result back
   * restores every value.
   */
  void
  print_documented_parameters(const dealii::ParameterHandler &prm,
                              std::ostream                   &out);

  /// The same as a text.
  std::string
  documented_parameters(const dealii::ParameterHandler &prm);
} // namespace NPT

#endif
