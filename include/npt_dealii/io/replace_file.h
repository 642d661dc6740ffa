// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the one way in which files of the output room are replaced as a
// whole.

#ifndef npt_dealii_io_replace_file_h
#define npt_dealii_io_replace_file_h

#include <deal.II/base/exceptions.h>

#include <cstdio>
#include <fstream>
#include <string>

namespace NPT
{
  /**
   * Write a file beside @p filename and move it there when it is complete, so
   * that an interrupted run leaves either the old or the new file, never half.
   *
   * @param write Callable with a `std::ostream &`.
   *
   * Throws ExcFileNotOpen if the folder does not exist or is not writable,
   * and a message if the disk is full.
   */
  template <typename Write>
  void
  replace_file(const std::string &filename, const Write &write)
  {
    // Removes what is left if `write` throws; after the move there is nothing.
    struct Temporary
    {
      const std::string name;

      ~Temporary()
      {
        std::remove(name.c_str());
      }
    };
    const Temporary temporary{filename + ".part"};
    {
      std::ofstream out(temporary.name, std::ios::binary);
      AssertThrow(out, dealii::ExcFileNotOpen(temporary.name));
      write(out);
      out.flush();
      AssertThrow(out,
                  dealii::ExcMessage("Writing " + temporary.name +
                                     " failed; is the disk full?"));
    }
    AssertThrow(std::rename(temporary.name.c_str(), filename.c_str()) == 0,
                dealii::ExcMessage("Cannot move " + temporary.name + " to " +
                                   filename + "; is it a folder?"));
  }
} // namespace NPT

#endif
