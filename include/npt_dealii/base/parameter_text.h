// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the statements of parameter files: their lines, include files
// resolved.

#ifndef npt_dealii_base_parameter_text_h
#define npt_dealii_base_parameter_text_h

#include <string>
#include <vector>

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
   * keywords are all lower or all upper case. Two departures: a name behind
   * `include` is relative to the file it stands in, not to the folder the
   * program was started in, so that a folder of files can be moved (in a pipe
   * it is relative to the latter); and lines may end in '\r' alone.
   *
   * Throws InputError if a file is missing (with the nearest .prm files of that
   * folder), a directory, not text, or includes itself; and for a line that is
   * no statement, a `set` without `=`, an unbalanced `subsection`/`end`, and a
   * backslash that would make a statement a part of the line before it.
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
   * Call visit(path, statement) for every `set`, in reading order.
   *
   * @param text ParameterText, const or not: the visitor may change values.
   * @param visit The path is "Subsection/Subsection/Entry".
   */
  template <typename Text, typename Visitor>
  void
  visit_entries(Text &text, const Visitor &visit)
  {
    std::string path; // of the present subsection, with a slash behind it
    std::vector<std::size_t> lengths;
    for (auto &statement : text.statements)
      switch (statement.kind)
        {
          case ParameterText::Kind::subsection:
            lengths.push_back(path.size());
            path += statement.name + "/";
            break;
          case ParameterText::Kind::end:
            path.resize(lengths.back());
            lengths.pop_back();
            break;
          case ParameterText::Kind::set:
            visit(path + statement.name, statement);
            break;
        }
  }
} // namespace NPT

#endif
