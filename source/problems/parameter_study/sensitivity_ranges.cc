// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading ranges and replacing them by their samples.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/parameter_study/sensitivity_indices.h>
#include <npt_dealii/problems/parameter_study/sensitivity_ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

namespace NPT
{
  namespace
  {
    constexpr unsigned int most_inputs = 20;

    const std::string range_syntax =
      "write a range as {0.1 .. 0.4}, with a uniform logarithm as "
      "{0.1 .. 10 log}, or, to go along with the range before it, as "
      "{{0 .. 1}}";

    double
    number_of(const std::string &text, const std::string &message)
    {
      char        *end    = nullptr;
      const double number = std::strtod(text.c_str(), &end);
      if (text.empty() || *end != '\0' || !std::isfinite(number))
        throw InputError(message);
      return number;
    }

    InputRange
    parse_range(const std::string &inner, const std::string &where)
    {
      const std::string message =
        where + in_quotes("{" + inner + "}") + " is no range; " + range_syntax;
      const std::size_t dots = inner.find("..");
      if (dots == std::string::npos)
        throw InputError(message);
      InputRange  range;
      std::string high = trim(inner.substr(dots + 2));
      range.logarithmic =
        high.size() > 3 && high.compare(high.size() - 3, 3, "log") == 0;
      if (range.logarithmic)
        high = trim(high.substr(0, high.size() - 3));
      range.low  = number_of(trim(inner.substr(0, dots)), message);
      range.high = number_of(high, message);
      if (!(range.low < range.high))
        throw InputError(where + "the range from " + short_number(range.low) +
                         " to " + short_number(range.high) +
                         " does not grow; write the smaller number first");
      if (range.logarithmic && !(range.low > 0.))
        throw InputError(where + "the range from " + short_number(range.low) +
                         " has no logarithm; it must begin above 0");
      return range;
    }
  } // namespace



  double
  InputRange::value(const double place) const
  {
    return logarithmic ? low * std::pow(high / low, place) :
                         low + place * (high - low);
  }



  SensitivityRanges::SensitivityRanges(const ParameterText &text)
    : text_(text)
  {
    std::map<std::string, const ParameterText::Statement *> last;
    const auto remember = [&](const std::string              &path,
                              const ParameterText::Statement &statement) {
      last[path] = &statement;
    };
    visit_entries(static_cast<const ParameterText &>(text_), remember);
    const auto read = [&](const std::string              &path,
                          const ParameterText::Statement &statement) {
      if (last[path] != &statement ||
          statement.value.find_first_of("{}") == std::string::npos)
        return;
      Value value;
      value.statement = &statement - text_.statements.data();
      read_value(path,
                 statement.value,
                 at_line(statement.file, statement.line),
                 value);
      values_.push_back(value);
    };
    visit_entries(static_cast<const ParameterText &>(text_), read);
    if (inputs_.empty())
      throw InputError("A sensitivity study needs ranges in its values; " +
                       range_syntax + " (subsection Study).");
    if (inputs_.size() > most_inputs)
      throw InputError("A sensitivity study may have " +
                       std::to_string(most_inputs) + " ranges, found " +
                       std::to_string(inputs_.size()) + " (subsection Study).");
  }



  void
  SensitivityRanges::read_value(const std::string &path,
                                const std::string &value,
                                const std::string &where,
                                Value             &result)
  {
    std::size_t begin = 0;
    for (std::size_t open = value.find_first_of("{}");
         open != std::string::npos;
         open = value.find_first_of("{}", begin))
      {
        const bool        follows = value.compare(open, 2, "{{") == 0;
        const std::size_t inside  = open + (follows ? 2 : 1);
        const std::size_t close   = value.find_first_of("{}", inside);
        const std::string closing = follows ? "}}" : "}";
        if (value[open] != '{' || close == std::string::npos ||
            value.compare(close, closing.size(), closing) != 0)
          throw InputError(where + "the braces of " + in_quotes(value) +
                           " do not match; " + range_syntax);
        Piece piece;
        piece.text_before = value.substr(begin, open - begin);
        piece.range = parse_range(value.substr(inside, close - inside), where);
        piece.range.path = path;
        if (!follows)
          inputs_.push_back(piece.range);
        else if (inputs_.empty())
          throw InputError(where + in_quotes(value) +
                           " goes along with a range before it, but there is "
                           "none; " +
                           range_syntax);
        piece.input = inputs_.size() - 1;
        result.pieces.push_back(piece);
        begin = close + closing.size();
      }
    result.text_behind = value.substr(begin);
  }



  ParameterText
  SensitivityRanges::sampled(const unsigned int n_rows) const
  {
    const auto    points = sensitivity_points(inputs_.size(), n_rows);
    ParameterText result = text_;
    for (const Value &value : values_)
      {
        std::string choices;
        for (const std::vector<double> &point : points)
          {
            std::string choice;
            for (const Piece &piece : value.pieces)
              choice += piece.text_before +
                        short_number(piece.range.value(point[piece.input]));
            choices +=
              (choices.empty() ? "" : " | ") + choice + value.text_behind;
          }
        result.statements[value.statement].value = "{{" + choices + "}}";
      }
    // Ranges that a later value of the same entry has replaced.
    auto &statements = result.statements;
    statements.erase(
      std::remove_if(statements.begin(),
                     statements.end(),
                     [](const ParameterText::Statement &statement) {
                       return statement.value.find("..") != std::string::npos &&
                              statement.value.find('{') != std::string::npos;
                     }),
      statements.end());
    return result;
  }
} // namespace NPT
