// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the one way in which files of the output room are replaced as a
// whole.

#ifndef npt_dealii_io_replace_file_h
#define npt_dealii_io_replace_file_h

#include <npt_dealii/io/output_file.h>

#include <string>

namespace NPT
{
  /**
   * Write a file as a whole, see ReplacedFile.
   *
   * @param write Callable with a `std::ostream &`.
   *
   * Throws OutputError.
   */
  template <typename Write>
  void
  replace_file(const std::string &filename, const Write &write)
  {
    ReplacedFile file(filename);
    write(file.stream());
    file.finish();
  }
} // namespace NPT

#endif
