// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines "did you mean": which of the valid names a person may have meant.

#ifndef npt_dealii_base_nearest_name_h
#define npt_dealii_base_nearest_name_h

#include <string>
#include <vector>

namespace NPT
{
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
