// SPDX-License-Identifier: LGPL-2.1-or-later
// Changes that know nothing of what is in a file.

#include <algorithm>
#include <sstream>

#include "mutation.h"

namespace Fuzz
{
  std::vector<std::string>
  lines_of(const std::string &text)
  {
    std::vector<std::string> lines;
    std::istringstream       in(text);
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }



  std::string
  text_of(const std::vector<std::string> &lines)
  {
    std::string text;
    for (const std::string &line : lines)
      text += line + "\n";
    return text;
  }



  std::string
  odd_number(Dice &dice, bool &is_number)
  {
    static const std::vector<std::string> numbers = {"0",
                                                     "-0",
                                                     "-1",
                                                     "1e12",
                                                     "1e-12",
                                                     "-1e12",
                                                     "1e308",
                                                     "-1.7e308",
                                                     "2.3e-308",
                                                     "1e154",
                                                     "2147483647",
                                                     "2147483648",
                                                     "4294967296",
                                                     "18446744073709551616",
                                                     "+5",
                                                     "007",
                                                     ".5",
                                                     "5.",
                                                     "1E3",
                                                     "0.1",
                                                     "0.999999999999999999",
                                                     "200",
                                                     "1"};
    static const std::vector<std::string> others  = {"nan",
                                                     "NaN",
                                                     "-nan",
                                                     "inf",
                                                     "-Infinity",
                                                     "1e400",
                                                     "-1e999",
                                                     "1e-400",
                                                     "5e-324",
                                                     "1 mm",
                                                     "1mm",
                                                     "50 %",
                                                     "1.2.3",
                                                     "--1",
                                                     "1e",
                                                     "1e+",
                                                     "0x10",
                                                     "1_000",
                                                     "1 000",
                                                     "1d3",
                                                     "\xE2\x88\x92"
                                                      "1",
                                                     "\xC2\xBD",
                                                     "\xD9\xA3",
                                                     "1/2",
                                                     "2*3",
                                                     "pi",
                                                     "1e1e1",
                                                     "'1'",
                                                     "{1",
                                                     "()",
                                                     "NULL"};
    is_number                                     = dice.one_of(2);
    return dice.pick(is_number ? numbers : others);
  }



  Mutant
  damage(const std::string &text, Dice &dice)
  {
    Mutant            mutant{"", text, Expected::anything};
    const std::size_t at    = dice.below(text.size() + 1);
    const std::size_t size  = 1 + dice.below(40);
    const std::string piece = text.substr(at, size);
    switch (dice.below(8))
      {
        case 0:
          mutant.mutation = "damaged, cut short";
          mutant.text.resize(at);
          break;
        case 1:
          mutant.mutation = "damaged, bytes lost";
          mutant.text.erase(at, size);
          break;
        case 2:
          mutant.mutation = "damaged, bytes repeated";
          for (unsigned int i = 0; i < 20; ++i)
            mutant.text.insert(at, piece);
          break;
        case 3:
          mutant.mutation = "damaged, bit flipped";
          if (at < text.size())
            mutant.text[at] ^= static_cast<char>(1 << dice.below(8));
          break;
        case 4:
          mutant.mutation = "damaged, random bytes";
          for (std::size_t i = 0; i < size; ++i)
            mutant.text.insert(at, 1, static_cast<char>(1 + dice.below(255)));
          break;
        case 5:
          mutant.mutation = "damaged, zero byte";
          mutant.text.insert(at, 1, '\0');
          mutant.expected = Expected::refusal;
          break;
        case 6:
          mutant.mutation = "damaged, halves swapped";
          mutant.text     = text.substr(at) + text.substr(0, at);
          break;
        default:
          mutant.mutation = "damaged, empty file";
          mutant.text     = dice.one_of(2) ? "" : "\n\n";
      }
    return mutant;
  }
} // namespace Fuzz
