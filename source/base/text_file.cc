// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading whole text files, and what keeps one from being read.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/text_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace NPT
{
  std::string
  with_plain_lines(const std::string &text)
  {
    std::string result;
    result.reserve(text.size());
    const std::string mark = "\xEF\xBB\xBF";
    for (std::size_t i = text.compare(0, 3, mark) == 0 ? 3 : 0; i < text.size();
         ++i)
      if (text[i] != '\r')
        result += text[i];
      else
        {
          // "\r\r\n" is what some transfers make of "\r\n".
          const std::size_t next = text.find_first_not_of('\r', i);
          if (next != std::string::npos && text[next] == '\n')
            i = next;
          result += '\n';
        }
    return result;
  }



  std::string
  read_text_file(const std::string &filename, const std::string &what)
  {
    const int file = open(filename.c_str(), O_RDONLY | O_CLOEXEC);
    if (file < 0)
      throw InputError(what + " cannot be read: " + std::strerror(errno));
    std::string             content;
    std::array<char, 65536> part;
    ssize_t                 n = 0;
    do
      {
        n = read(file, part.data(), part.size());
        if (n > 0)
          content.append(part.data(), n);
      }
    while ((n > 0 && content.size() <= largest_text_file) ||
           (n < 0 && errno == EINTR));
    const std::string reason = n < 0 ? std::strerror(errno) : "";
    close(file);
    if (!reason.empty())
      throw InputError(what + " cannot be read: " + reason);
    if (content.size() > largest_text_file)
      throw InputError(what + " is larger than " +
                       std::to_string(largest_text_file >> 20) +
                       " MB; it is another file than it should be");
    if (content.find('\0') != std::string::npos)
      throw InputError(what + " is not plain text, save it in UTF-8 encoding");
    return with_plain_lines(content);
  }



  std::string
  obstacle_to_file(const std::string &filename)
  {
    std::error_code error;
    const auto      status = std::filesystem::status(filename, error);
    return status.type() == std::filesystem::file_type::none ? error.message() :
                                                               "";
  }



  bool
  is_stream(const std::string &filename)
  {
    std::error_code error;
    const auto      status = std::filesystem::status(filename, error);
    return std::filesystem::exists(status) && is_other(status);
  }



  std::string
  home_folder_hint(const std::string &filename)
  {
    if (filename != "~" && filename.compare(0, 2, "~/") != 0)
      return "";
    const char *const home = std::getenv("HOME");
    return "; '~' is the home folder for shells only, write " +
           (home == nullptr ? std::string("its whole name") :
                              in_quotes(home + filename.substr(1)));
  }
} // namespace NPT
