// SPDX-License-Identifier: LGPL-2.1-or-later
// Words and lists for messages.

#include <npt_dealii/base/message_words.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace NPT
{
  std::string
  trim(const std::string &text)
  {
    return dealii::Utilities::trim(text);
  }



  std::string
  lower_case(std::string text)
  {
    std::transform(text.begin(), text.end(), text.begin(), [](const char c) {
      return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return text;
  }



  std::string
  printable(std::string text)
  {
    for (char &c : text)
      if (static_cast<unsigned char>(c) < ' ' || c == '\x7F')
        c = '?';
    return text;
  }



  std::string
  in_quotes(const std::string &text)
  {
    // Nobody reads more of a line that should have been many.
    constexpr std::size_t longest = 500;
    if (text.size() > longest)
      return "'" + printable(text.substr(0, longest)) + "...'";
    return "'" + printable(text) + "'";
  }



  std::string
  joined(const std::vector<std::string> &words, const std::string &separator)
  {
    std::string result;
    for (std::size_t i = 0; i < words.size(); ++i)
      result += (i == 0 ? "" : separator) + words[i];
    return result;
  }



  std::string
  listed(const std::vector<std::string> &names)
  {
    constexpr std::size_t    max_names = 12;
    std::vector<std::string> shown(names.begin(),
                                   names.begin() +
                                     std::min(names.size(), max_names));
    if (names.size() > max_names)
      shown.push_back("...");
    return joined(shown, ", ");
  }



  std::string
  at_line(const std::string &file, const unsigned int line)
  {
    return file + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
  }



  std::string
  pasted_character_hint(const std::string &text)
  {
    static const std::vector<std::pair<std::string, std::string>> characters = {
      {"\xC2\xA0", "a non-breaking space"},
      {"\xE2\x80\xAF", "a narrow non-breaking space"},
      {"\xE2\x80\x8B", "a zero-width space"},
      {"\xE2\x88\x92", "a typographic minus sign"},
      {"\xE2\x80\x93", "a typographic dash"}};
    for (const auto &[bytes, name] : characters)
      if (text.find(bytes) != std::string::npos)
        return "; it contains " + name + ", type it anew on the keyboard";
    return "";
  }
} // namespace NPT
