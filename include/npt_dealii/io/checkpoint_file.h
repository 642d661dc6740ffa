// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the file around the contents of a checkpoint: what it is, how long it
// is, and whether it is whole.

#ifndef npt_dealii_io_checkpoint_file_h
#define npt_dealii_io_checkpoint_file_h

#include <optional>
#include <string>

namespace NPT
{
  /**
   * Replace a checkpoint; until the new one is complete on the disk, the old
   * one stays. Throws OutputError.
   *
   * The file begins with a line "npt_dealii checkpoint VERSION" and one with
   * the number of bytes of the contents and their checksum (CRC-32).
   *
   * @param version Of the contents; to be raised whenever they change.
   */
  void
  write_checkpoint_file(const std::string &filename,
                        const unsigned int version,
                        const std::string &contents);

  /**
   * The contents of a checkpoint, or nothing if there is no such file.
   *
   * Throws InputError, with the file and the reason, if it is no checkpoint, of
   * another version, cut short or damaged.
   */
  std::optional<std::string>
  read_checkpoint_file(const std::string &filename, const unsigned int version);

  /// Why a checkpoint cannot be used, as InputError.
  [[noreturn]] void
  refuse_checkpoint(const std::string &filename, const std::string &reason);
} // namespace NPT

#endif
