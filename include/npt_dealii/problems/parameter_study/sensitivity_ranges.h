// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines ranges in the values of a parameter file, {a .. b}, and the loops
// that sample them.

#ifndef npt_dealii_problems_parameter_study_sensitivity_ranges_h
#define npt_dealii_problems_parameter_study_sensitivity_ranges_h

#include <npt_dealii/base/parameter_file.h>

#include <string>
#include <vector>

namespace NPT
{
  /// An input of a sensitivity study.
  struct InputRange
  {
    std::string path; ///< of the entry
    double      low = 0, high = 0;
    bool        logarithmic = false; ///< the logarithm is uniform

    /// The value at a place between 0 and 1.
    double
    value(const double place) const;
  };

  /**
   * The inputs of a sensitivity study, written as ranges in the values of its
   * entries:
   *
   * - `{0.1 .. 0.4}`: an input, uniform between the two.
   * - `{0.1 .. 10 log}`: its logarithm is uniform.
   * - `{{0 .. 1}}`: goes along with the last input before it, from end to end.
   *
   * A value may hold several, `n1: {0 .. 1}, n2: {{0 .. 1}}`. An entry set
   * several times counts with its last value.
   */
  class SensitivityRanges
  {
  public:
    /// Throws InputError with file and line for braces that are no range, and
    /// if there is no range, or more than 20 inputs.
    explicit SensitivityRanges(const ParameterText &text);

    /// In the order of the file.
    const std::vector<InputRange> &
    inputs() const
    {
      return inputs_;
    }

    /// The text with every range replaced by an array {{...}}, ParameterLoops,
    /// of its values at the points of sensitivity_points().
    ParameterText
    sampled(const unsigned int n_rows) const;

  private:
    // A value with ranges: what stands between them, and which they are.
    struct Piece
    {
      std::string  text_before;
      InputRange   range;
      unsigned int input;
    };
    struct Value
    {
      std::size_t        statement; // its number
      std::vector<Piece> pieces;
      std::string        text_behind;
    };

    void
    read_value(const std::string &path,
               const std::string &value,
               const std::string &where,
               Value             &result);

    ParameterText           text_;
    std::vector<InputRange> inputs_;
    std::vector<Value>      values_;
  };
} // namespace NPT

#endif
