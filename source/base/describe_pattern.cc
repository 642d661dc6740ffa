// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines patterns in words, and values that may have been meant. The words of
// deal.II (PatternBase::description(Text)) are not enough for a sentence: of a
// number > 0 they say "2.22507e-308 <= v <= MAX_DOUBLE".

#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>
#include <utility>
#include <vector>

namespace NPT
{
  namespace
  {
    void
    replace_all(std::string       &text,
                const std::string &old_part,
                const std::string &new_part)
    {
      for (std::size_t pos = text.find(old_part); pos != std::string::npos;
           pos             = text.find(old_part, pos + new_part.size()))
        text.replace(pos, old_part.size(), new_part);
    }

    /// The names in "[Selection a|b ]".
    std::vector<std::string>
    choices_of(const std::string &pattern)
    {
      if (pattern == "[Bool]")
        return {"true", "false"};
      const std::string start = "[Selection ";
      if (pattern.compare(0, start.size(), start) == 0)
        return dealii::Utilities::split_string_list(
          pattern.substr(start.size(), pattern.size() - start.size() - 1), '|');
      return {};
    }

    /**
     * The text between the first "<" behind @p start and its closing ">",
     * descriptions within descriptions skipped; @p start moves behind it.
     * Brackets tell the depth: a separator such as <;> has none.
     */
    std::string
    text_in_angles(const std::string &text, std::size_t &start)
    {
      const std::size_t begin = text.find('<', start);
      if (begin == std::string::npos)
        return "";
      int depth = 0;
      for (std::size_t i = begin + 1; i < text.size(); ++i)
        {
          if (text[i] == '[')
            ++depth;
          else if (text[i] == ']')
            --depth;
          else if (text[i] == '>' && depth == 0)
            {
              start = i + 1;
              return text.substr(begin + 1, i - begin - 1);
            }
        }
      return "";
    }

    std::string
    separator_of(const std::string &text,
                 std::size_t        start,
                 const std::string &default_separator)
    {
      const std::string words = "separated by ";
      const std::size_t pos   = text.find(words, start);
      if (pos == std::string::npos)
        return in_quotes(default_separator);
      start = pos + words.size();
      return in_quotes(text_in_angles(text, start));
    }

    /// "exactly 2 values" from "... of length 2...2 (inclusive)".
    std::string
    count_of(const std::string &text, const std::size_t start)
    {
      const std::string words = " of length ";
      const std::size_t pos   = text.find(words, start);
      if (pos == std::string::npos)
        return "values";
      std::istringstream in(text.substr(pos + words.size()));
      unsigned long      min = 0, max = 0;
      in >> min;
      in.ignore(3);
      in >> max;

      const bool has_max = max < std::numeric_limits<unsigned int>::max();
      const auto values  = [](const unsigned long n) {
        return std::to_string(n) + (n == 1 ? " value" : " values");
      };
      if (has_max && min == max)
        return "exactly " + values(min);
      if (has_max && min > 0)
        return std::to_string(min) + " to " + values(max);
      if (has_max)
        return "at most " + values(max);
      if (min > 0)
        return "at least " + values(min);
      return "any number of values";
    }

    /// The separator itself, without quotes.
    std::string
    separator_in(const std::string &text, const std::size_t start)
    {
      const std::string quoted = separator_of(text, start, ",");
      return quoted.size() == 3 ? quoted.substr(1, 1) : ",";
    }

    bool
    matches(const std::string &value, const std::string &pattern)
    {
      return dealii::Patterns::pattern_factory(pattern)->match(value);
    }

    // Of names like H1 to H6 all are as near to H7.
    std::string
    only_nearest(const std::string &name, const std::vector<std::string> &names)
    {
      const auto nearest = nearest_names(name, names, 2);
      if (nearest.empty() ||
          (nearest.size() == 2 &&
           edit_distance(name, nearest[0]) == edit_distance(name, nearest[1])))
        return "";
      return "; did you mean " + in_quotes(nearest[0]) + "?";
    }

    /// For the first of several values that does not match.
    std::string
    suggestion_for_list(const std::string &value, const std::string &pattern)
    {
      std::size_t       pos       = 0;
      const std::string inner     = text_in_angles(pattern, pos);
      const std::string separator = separator_in(pattern, pos);
      for (const std::string &part :
           dealii::Utilities::split_string_list(value, separator))
        if (!matches(part, inner))
          return suggestion_for_value(part, inner);
      return "";
    }

    /// The same for pairs 'key:value'.
    std::string
    suggestion_for_map(const std::string &value, const std::string &pattern)
    {
      std::size_t       pos           = 0;
      const std::string key_pattern   = text_in_angles(pattern, pos);
      const std::string value_pattern = text_in_angles(pattern, pos);
      const std::string separator     = separator_in(pattern, pos);
      std::string       before; // what was right so far
      for (const std::string &part :
           dealii::Utilities::split_string_list(value, separator))
        {
          const auto pair = dealii::Utilities::split_string_list(part, ':');
          if (pair.size() != 2)
            {
              // "H3: 0,2": the comma of the number ends the pair.
              const std::string mended = before + "." + part;
              return !before.empty() && matches(mended, pattern) ?
                       "; did you mean " + in_quotes(mended) + "?" :
                       "";
            }
          if (!matches(pair[0], key_pattern))
            return only_nearest(pair[0], choices_of(key_pattern));
          if (!matches(pair[1], value_pattern))
            return suggestion_for_value(pair[1], value_pattern);
          before += (before.empty() ? "" : separator + " ") + part;
        }
      return "";
    }

    /// "a number in [0, 1]" from the bounds as deal.II writes them.
    std::string
    describe_range(const std::string &noun,
                   const std::string &lower,
                   const std::string &upper)
    {
      const auto is_unlimited = [](const std::string &bound) {
        return bound.find("MAX_DOUBLE") != std::string::npos ||
               bound == std::to_string(std::numeric_limits<int>::max()) ||
               bound == std::to_string(std::numeric_limits<int>::min());
      };
      const bool has_lower = !is_unlimited(lower),
                 has_upper = !is_unlimited(upper);

      // The smallest positive double as lower bound is the usual way to
      // exclude zero.
      const double lower_value = std::strtod(lower.c_str(), nullptr);
      const bool   is_positive = lower_value > 0 && lower_value < 1e-300;
      if (has_lower && has_upper)
        return noun + " in " + (is_positive ? "(0" : "[" + lower) + ", " +
               upper + "]";
      if (has_lower)
        return noun + (is_positive ? " > 0" : " >= " + lower);
      if (has_upper)
        return noun + " <= " + upper;
      return noun;
    }
  } // namespace



  std::string
  describe_pattern(const std::string &description)
  {
    const auto begins_with = [&](const std::string &start) {
      return description.compare(0, start.size(), start) == 0;
    };

    for (const auto &[start, noun] :
         {std::pair<std::string, std::string>{"[Double", "a number"},
          std::pair<std::string, std::string>{"[Integer", "an integer"}})
      if (begins_with(start))
        {
          // "[Double LOWER...UPPER (inclusive)]", integers with " range"
          const std::size_t dots = description.find("...");
          const std::size_t end  = description.find(" (inclusive)");
          if (dots == std::string::npos || end == std::string::npos)
            return noun;
          const std::size_t begin = description.rfind(' ', dots) + 1;
          return describe_range(noun,
                                description.substr(begin, dots - begin),
                                description.substr(dots + 3, end - dots - 3));
        }

    if (begins_with("[Bool"))
      return "true or false";
    if (begins_with("[Selection"))
      return "one of: " + joined(choices_of(description), ", ");
    if (begins_with("[List"))
      {
        std::size_t       pos   = 0;
        const std::string inner = text_in_angles(description, pos);
        return count_of(description, pos) + " separated by " +
               separator_of(description, pos, ",") + ", each " +
               describe_pattern(inner);
      }
    if (begins_with("[Map"))
      {
        std::size_t       pos   = 0;
        const std::string key   = text_in_angles(description, pos);
        const std::string value = text_in_angles(description, pos);
        return "pairs 'key:value' separated by " +
               separator_of(description, pos, ",") +
               " (key: " + describe_pattern(key) +
               "; value: " + describe_pattern(value) + ")";
      }
    if (begins_with("[DirectoryName"))
      return "the name of a directory";
    if (begins_with("[Anything"))
      return "any text";
    return description;
  }



  std::string
  suggestion_for_value(const std::string &value, const std::string &pattern)
  {
    if (pattern.compare(0, 5, "[List") == 0)
      return suggestion_for_list(value, pattern);
    if (pattern.compare(0, 4, "[Map") == 0)
      return suggestion_for_map(value, pattern);
    const auto choices = choices_of(pattern);
    if (!choices.empty())
      {
        if (pattern == "[Bool]")
          for (const auto &[word, meaning] :
               std::map<std::string, std::string>{{"yes", "true"},
                                                  {"on", "true"},
                                                  {"1", "true"},
                                                  {"no", "false"},
                                                  {"off", "false"},
                                                  {"0", "false"}})
            if (lower_case(value) == word)
              return "; did you mean " + in_quotes(meaning) + "?";
        return did_you_mean(value, choices);
      }

    const bool is_integer = pattern.compare(0, 8, "[Integer") == 0;
    const bool is_number  = pattern.compare(0, 7, "[Double") == 0;
    if (!is_integer && !is_number)
      return "";

    // A pasted minus sign, a decimal comma, Fortran's exponent, and for an
    // integer "3.0" or "1e3".
    std::string number = value;
    replace_all(number, "\xE2\x88\x92", "-");
    if (std::count(number.begin(), number.end(), ',') == 1)
      replace_all(number, ",", ".");
    std::replace(number.begin(), number.end(), 'd', 'e');
    std::replace(number.begin(), number.end(), 'D', 'e');
    if (is_integer)
      {
        char        *end = nullptr;
        const double x   = std::strtod(number.c_str(), &end);
        if (!number.empty() && *end == '\0' && std::abs(x) < 1e9 &&
            x == std::floor(x))
          number = std::to_string(static_cast<long>(x));
      }
    if (number != value && matches(number, pattern))
      return "; did you mean " + in_quotes(number) + "?";

    // Words like nan and inf are read by other programs, so say it.
    std::string word = lower_case(value);
    word.erase(0, word.find_first_not_of("+-"));
    if (word == "nan" || word == "inf" || word == "infinity")
      return "; nan and inf are not accepted";
    return pasted_character_hint(value);
  }



  std::string
  number_beyond_doubles(const std::string &value)
  {
    std::istringstream words(value);
    for (std::string list; words >> list;)
      {
        std::replace(list.begin(), list.end(), ':', ',');
        for (const std::string &word :
             dealii::Utilities::split_string_list(list, ','))
          {
            char *end      = nullptr;
            errno          = 0;
            const double x = std::strtod(word.c_str(), &end);
            if (errno == ERANGE && *end == '\0')
              return in_quotes(word) +
                     (std::abs(x) > 1. ?
                        " is larger than all numbers of a computer (1.8e308)" :
                        " is too close to 0 for a computer (2.3e-308)");
          }
      }
    return "";
  }
} // namespace NPT
