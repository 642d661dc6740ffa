// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines loops in the values of a parameter file: {a | b} and {{a | b}}, and
// the files of the single cases that they stand for.

#ifndef npt_dealii_problems_parameter_study_parameter_loops_h
#define npt_dealii_problems_parameter_study_parameter_loops_h

#include <npt_dealii/base/parameter_file.h>

#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /// One entry whose value is a loop.
  struct ParameterLoop
  {
    /// Subsections and entry, joined by '/': "Contact/Normal penalty".
    std::string path;

    /// Complete values, what stands before and behind the braces included.
    std::vector<std::string> values;

    /// Loops with the same axis go through their values together.
    unsigned int axis = 0;

    /// {{...}} rather than {...}.
    bool is_array = false;

    /// Shortest name that no other loop has: the entry, or more of the path.
    std::string name;
  };

  /**
   * All cases of a parameter file with loops, in the syntax of deal.II's
   * MultipleParameterLoop:
   *
   * - `set A = {1 | 2 | 5}`: an axis of its own; all combinations are cases,
   *   the first loop of the file changing fastest.
   * - `set B = {{x | y | z}}`: an array, which goes along with another loop.
   *   As in deal.II, an array with as many values as there are cases is taken
   *   by the number of the case. Beyond deal.II, an array with as many values
   *   as some {...} goes along with that one (of several the last before it,
   *   else the first behind it), and arrays of one length without any {...}
   *   go along with each other.
   *
   * Text before and behind the braces belongs to every value: `H3: {0.1 | 0.2}`
   * means "H3: 0.1" and "H3: 0.2". An entry set several times (a file refines
   * what it includes) counts with its last value.
   *
   * deal.II's own class is not used because it wants all entries declared
   * before it looks for loops, while here the values decide which entries there
   * are (stages), because it reports an array of a wrong length on the screen
   * and goes on with an empty value, and because it runs all cases within one
   * process.
   */
  class ParameterLoops
  {
  public:
    /// Throws InputError with file and line for braces that are no loop and
    /// for an array that fits to no loop.
    explicit ParameterLoops(const ParameterText &text);

    unsigned int
    n_cases() const;

    /// In the order of the file.
    const std::vector<ParameterLoop> &
    loops() const;

    /// Number of values of every axis; the first changes fastest.
    const std::vector<unsigned int> &
    axis_sizes() const;

    /// Position of a case on every axis.
    std::vector<unsigned int>
    position(const unsigned int c) const;

    /// Value of a loop in a case.
    const std::string &
    value(const unsigned int loop, const unsigned int c) const;

    /// The parameter file of a case: all loops replaced by their values.
    ParameterText
    text_of_case(const unsigned int c) const;

    /**
     * Return the loop that a user means: by its name, its entry or its path.
     * Throws InputError with the nearest name, ending in @p place.
     */
    unsigned int
    find(const std::string &name, const std::string &place) const;

  private:
    static constexpr unsigned int by_number = -1; // axis of deal.II's arrays

    /// Fill loops_ but for axes and names.
    /// @return By loop, where it stands.
    std::vector<std::string>
    find_loops();

    void
    name_loops();

    void
    join_arrays(const std::vector<std::string> &places);

    unsigned int
    axis_of_array(const unsigned int l,
                  const unsigned int n_combinations,
                  const std::string &where) const;

    ParameterText              text_;
    std::vector<ParameterLoop> loops_;
    std::vector<unsigned int>  axis_sizes_;
  };

  /**
   * Split the value of an entry into the values of a loop; a value without
   * braces gives one value.
   *
   * @return The values, and whether it is an array {{...}}.
   *
   * Throws InputError, beginning with @p where, if braces do not match, are
   * repeated within a value, or contain an empty choice.
   */
  std::pair<std::vector<std::string>, bool>
  split_loop(const std::string &value, const std::string &where);

  /// Append overrides 'Subsection/Entry=value' to a text as if they were
  /// written at its end.
  ParameterText
  with_overrides(const ParameterText            &text,
                 const std::vector<std::string> &overrides);

  /**
   * Take the statements of a subsection (subsections joined by '/') out of a
   * text.
   *
   * @return What was inside, now at the top level, and the rest.
   */
  std::pair<ParameterText, ParameterText>
  extract_subsection(const ParameterText &text, const std::string &path);

  /// The statements as a parameter file, without the comments they had.
  std::string
  print_parameter_text(const ParameterText &text);
} // namespace NPT

#endif
