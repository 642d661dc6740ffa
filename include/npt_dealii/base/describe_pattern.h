// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what messages say about the values that an entry allows.

#ifndef npt_dealii_base_describe_pattern_h
#define npt_dealii_base_describe_pattern_h

#include <string>

namespace NPT
{
  /**
   * Put deal.II's description of a pattern into words that continue "it must
   * be": "[Double 0...1 (inclusive)]" becomes "a number in [0, 1]". Patterns
   * that no entry of this program has are returned as they are.
   */
  std::string
  describe_pattern(const std::string &pattern_description);

  /**
   * Find a value that the pattern accepts and that was probably meant by
   * @p value, or what is wrong with it: "; did you mean 'true'?". Empty if
   * nothing comes to mind.
   */
  std::string
  suggestion_for_value(const std::string &value,
                       const std::string &pattern_description);

  /**
   * Half a sentence on the first number of a text, or of a list in it, that is
   * too large or too close to 0 to be stored, as 1e400 and 1e-400; empty if
   * there is none. (0 itself is none.)
   */
  std::string
  number_beyond_doubles(const std::string &value);
} // namespace NPT

#endif
