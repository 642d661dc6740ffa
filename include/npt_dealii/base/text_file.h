// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the one way in which text files of users are read, whatever editor,
// system or pipe they come from.

#ifndef npt_dealii_base_text_file_h
#define npt_dealii_base_text_file_h

#include <cstddef>
#include <string>

namespace NPT
{
  /// More than any parameter file or table of test data has [bytes]; a name
  /// like /dev/zero has no end.
  constexpr std::size_t largest_text_file = 64u << 20;

  /**
   * The text of a file or of a pipe: lines end in '\n', whether the file ends
   * them so, in "\r\n", or in '\r' alone; a UTF-8 mark at its begin is gone.
   *
   * @param filename An existing file, not a directory.
   * @param what     Begin of messages, as "file 'shear.prm'".
   *
   * Throws InputError if it cannot be read (with the reason of the system),
   * is larger than largest_text_file, or holds zero bytes.
   */
  std::string
  read_text_file(const std::string &filename, const std::string &what);

  /// The same for a text in memory: line ends and UTF-8 mark.
  std::string
  with_plain_lines(const std::string &text);

  /// Why nothing can be said of a file, as "Permission denied"; empty if it
  /// exists or surely does not.
  std::string
  obstacle_to_file(const std::string &filename);

  /// Whether there is something of this name that can be read only once: a
  /// pipe, a device.
  bool
  is_stream(const std::string &filename);

  /// For a name that begins with '~': only shells know the home folder by it.
  /// Else empty. Half a sentence, "; '~' is ..., write ...".
  std::string
  home_folder_hint(const std::string &filename);
} // namespace NPT

#endif
