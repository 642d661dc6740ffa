// SPDX-License-Identifier: LGPL-2.1-or-later
// Head and checksum of checkpoints.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/checkpoint_file.h>
#include <npt_dealii/io/output_file.h>

#include <boost/crc.hpp>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace NPT
{
  namespace
  {
    const std::string checkpoint_title = "npt_dealii checkpoint ";

    unsigned int
    checksum(const std::string &contents)
    {
      boost::crc_32_type crc;
      crc.process_bytes(contents.data(), contents.size());
      return crc.checksum();
    }
  } // namespace



  void
  write_checkpoint_file(const std::string &filename,
                        const unsigned int version,
                        const std::string &contents)
  {
    ReplacedFile file(filename);
    file.stream() << checkpoint_title << version << '\n'
                  << contents.size() << ' ' << checksum(contents) << '\n'
                  << contents;
    file.finish(true);
  }



  std::optional<std::string>
  read_checkpoint_file(const std::string &filename, const unsigned int version)
  {
    std::error_code error;
    if (!std::filesystem::exists(filename, error) && !error)
      return {};
    std::ifstream in(filename, std::ios::binary);
    if (!in || std::filesystem::is_directory(filename, error))
      refuse_checkpoint(filename, "cannot be read");

    std::string title, size_and_checksum;
    std::getline(in, title);
    if (title.compare(0, checkpoint_title.size(), checkpoint_title) != 0)
      refuse_checkpoint(filename,
                        title.empty() ?
                          "is empty" :
                          "is no checkpoint of a plate test: it begins with "
                          "something else");
    const std::string its_version = title.substr(checkpoint_title.size());
    if (its_version != std::to_string(version))
      refuse_checkpoint(filename,
                        "has version " + its_version +
                          ", and this program reads version " +
                          std::to_string(version));
    std::getline(in, size_and_checksum);
    std::istringstream numbers(size_and_checksum);
    std::size_t        size = 0;
    unsigned int       sum  = 0;
    const bool         has_numbers(numbers >> size >> sum);
    if (in.eof() || !has_numbers)
      refuse_checkpoint(filename, "is cut short or damaged in its head");
    std::ostringstream rest;
    rest << in.rdbuf();
    const std::string contents = rest.str();
    if (contents.size() < size)
      refuse_checkpoint(filename,
                        "is cut short: " + std::to_string(contents.size()) +
                          " of " + std::to_string(size) + " bytes are there");
    if (contents.size() > size || checksum(contents) != sum)
      refuse_checkpoint(filename, "is damaged: its checksum is wrong");
    return contents;
  }



  void
  refuse_checkpoint(const std::string &filename, const std::string &reason)
  {
    throw InputError("The checkpoint '" + filename + "' " + reason +
                     ". Start the run without --continue, or mend that.");
  }
} // namespace NPT
