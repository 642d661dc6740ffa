// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the wording that messages share: quotes, lists, places.

#ifndef npt_dealii_base_message_words_h
#define npt_dealii_base_message_words_h

#include <string>
#include <vector>

namespace NPT
{
  /// Without blanks at both ends.
  std::string
  trim(const std::string &text);

  std::string
  lower_case(std::string text);

  /// With question marks for what would change the screen instead of being
  /// shown on it.
  std::string
  printable(std::string text);

  /// Printable and not longer than a sentence can bear.
  std::string
  in_quotes(const std::string &text);

  std::string
  joined(const std::vector<std::string> &words, const std::string &separator);

  /// All names in a message, unless that would bury the message.
  std::string
  listed(const std::vector<std::string> &names);

  /// "file:line: "; statements without a line come from the command line.
  std::string
  at_line(const std::string &file, const unsigned int line);

  /**
   * What is pasted from a document often holds characters that look like plain
   * blanks or signs; two names that look equal need this explanation. Empty if
   * there is none.
   */
  std::string
  pasted_character_hint(const std::string &text);
} // namespace NPT

#endif
