// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading .prm files with messages a user can act on: file and line, what was
// found, what is allowed, and the nearest valid name.

#ifndef npt_dealii_base_parameter_file_h
#define npt_dealii_base_parameter_file_h

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
   * The statements of a parameter file in reading order, include files
   * resolved, comments gone, each with the place it came from.
   *
   * Subsections are balanced: every function that makes such a text has
   * checked that, file by file.
   */
  struct ParameterText
  {
    enum class Kind
    {
      subsection, ///< `subsection NAME`
      set,        ///< `set NAME = VALUE`
      end         ///< `end`
    };

    struct Statement
    {
      Kind         kind;
      std::string  name;  ///< Subsection or entry; empty for `end`.
      std::string  value; ///< Of a `set`, blanks at both ends removed.
      std::string  file;  ///< As a person would write it: relative if possible.
      unsigned int line;  ///< First physical line of the statement, from 1.
    };

    std::vector<Statement> statements;
  };

  /**
   * Read a parameter file and the files it includes.
   *
   * Lines are understood as dealii::ParameterHandler does: `#` begins a
   * comment, a backslash at the end joins the next line, tabs count as blanks,
   * keywords are all lower or all upper case. The one departure: a name
   * behind `include` is relative to the file it stands in, not to the folder
   * the program was started in, so that a folder of files can be moved.
   *
   * Throws InputError if a file is missing (with the nearest .prm files of that
   * folder), a directory, not text, or includes itself; and for a line that is
   * no statement, a `set` without `=`, and an unbalanced `subsection`/`end`.
   */
  ParameterText
  read_parameter_text(const std::string &filename);

  /**
   * The same for a text already in memory.
   *
   * @param content  The lines of the file.
   * @param filename Name for messages; included files are relative to it.
   */
  ParameterText
  make_parameter_text(const std::string &content, const std::string &filename);

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

  /**
   * Put deal.II's description of a pattern into words that continue "it must
   * be": "[Double 0...1 (inclusive)]" becomes "a number in [0, 1]". An unknown
   * description is returned as it is.
   */
  std::string
  describe_pattern(const std::string &pattern_description);

  /**
   * Number of insertions, deletions, replacements and swaps of neighboring
   * characters that turn one word into the other (Damerau-Levenshtein, optimal
   * string alignment), upper and lower case being the same.
   */
  unsigned int
  edit_distance(const std::string &a, const std::string &b);

  /**
   * Pick the candidates a person may have meant by @p name: those within
   * 1 + length/4 edits, nearest first, then those that contain the name as a
   * part. Empty if nothing is near: a far-fetched guess misleads.
   */
  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &candidates,
                const unsigned int              max_names = 1);

  /// "; did you mean 'X'?" for the nearest candidate, or nothing.
  std::string
  did_you_mean(const std::string              &name,
               const std::vector<std::string> &candidates);
} // namespace NPT

#endif
