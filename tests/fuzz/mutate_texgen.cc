// SPDX-License-Identifier: LGPL-2.1-or-later
// Changes to weaves of TexGen.

#include <utility>

#include "mutation.h"

namespace Fuzz
{
  namespace
  {
    using Range = std::pair<std::size_t, std::size_t>;

    // From '<' to '>', and from one quotation mark to the next.
    std::vector<Range>
    between(const std::string &text, const char open, const char close)
    {
      std::vector<Range> ranges;
      for (std::size_t begin = text.find(open); begin != std::string::npos;)
        {
          const std::size_t end = text.find(close, begin + 1);
          if (end == std::string::npos)
            break;
          ranges.emplace_back(begin, end + 1);
          begin = text.find(open, end + 1);
        }
      return ranges;
    }

    std::string
    repeated(const std::string &piece, const unsigned int n)
    {
      std::string result;
      for (unsigned int i = 0; i < n; ++i)
        result += piece;
      return result;
    }
  } // namespace



  Mutant
  mutate_texgen(const std::string &text, Dice &dice)
  {
    const auto values = between(text, '"', '"'), tags = between(text, '<', '>');
    if (values.empty() || tags.empty() || dice.one_of(6))
      return damage(text, dice);
    const Range value = dice.pick(values), tag = dice.pick(tags),
                other = dice.pick(tags);
    const auto piece  = [&](const Range &range) {
      return text.substr(range.first, range.second - range.first);
    };
    const auto with = [&](const Range &range, const std::string &replacement) {
      return text.substr(0, range.first) + replacement +
             text.substr(range.second);
    };
    switch (dice.below(9))
      {
        case 0:
          return {"element deleted", with(tag, "")};
        case 1:
          return {"element repeated", with(tag, piece(tag) + piece(tag))};
        case 2:
          return {"element of another place", with(tag, piece(other))};
        case 3:
          return {"attribute changed", with(value, piece(dice.pick(values)))};
        case 4:
          {
            const unsigned int n = dice.one_of(2) ? 90 : 200000;
            return {"deep elements",
                    with(tag, repeated("<a>", n) + repeated("</a>", n)),
                    n > 100 ? Expected::refusal : Expected::anything};
          }
        case 5:
          return {"odd attribute",
                  with(value,
                       "\"" +
                         dice.pick<std::string>({"",
                                                 "&lt;",
                                                 "&#0;",
                                                 "&#x110000;",
                                                 "&x;",
                                                 "\xFF",
                                                 "0, 0",
                                                 "1, nan, 2",
                                                 "1e300, 1e300, 1e300",
                                                 "ft",
                                                 "CSectionHybrid",
                                                 "CTextileLayerToLayer",
                                                 "\x1B[31m",
                                                 std::string(100000, '7'),
                                                 "1e308",
                                                 "64",
                                                 "1000",
                                                 "a\n  set x = 1\nend"}) +
                         "\"")};
        case 6:
          return {"entities",
                  "<!DOCTYPE a [<!ENTITY b \"&b;&b;\">]>" +
                    with(value, "\"&b;\"")};
        default:
          {
            bool              is_number = true;
            const std::string number    = odd_number(dice, is_number);
            return {"number changed", with(value, "\"" + number + "\"")};
          }
      }
  }
} // namespace Fuzz
