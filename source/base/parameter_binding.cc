// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the texts of numbers, truth values and lists in a parameter file.

#include <npt_dealii/base/parameter_binding.h>

#include <deal.II/base/utilities.h>

#include <cstdlib>
#include <sstream>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  std::string
  EntryValue<double>::text(const double value)
  {
    std::string result;
    for (unsigned int digits = 6; digits <= 17; ++digits)
      {
        std::ostringstream out;
        out.precision(digits);
        out << value;
        result = out.str();
        if (std::strtod(result.c_str(), nullptr) == value)
          break;
      }
    // "2e-05" as people write it.
    const std::size_t e = result.find('e');
    if (e != std::string::npos)
      {
        std::size_t first_digit = e + 2;
        while (first_digit + 1 < result.size() && result[first_digit] == '0')
          ++first_digit;
        result = result.substr(0, e + 1) + (result[e + 1] == '-' ? "-" : "") +
                 result.substr(first_digit);
      }
    return result;
  }



  double
  EntryValue<double>::value(const std::string &text)
  {
    return dealii::Utilities::string_to_double(text);
  }



  std::unique_ptr<Patterns::PatternBase>
  EntryValue<double>::pattern()
  {
    return std::make_unique<Patterns::Double>();
  }



  std::string
  EntryValue<unsigned int>::text(const unsigned int value)
  {
    return std::to_string(value);
  }



  unsigned int
  EntryValue<unsigned int>::value(const std::string &text)
  {
    const int number = dealii::Utilities::string_to_int(text);
    AssertThrow(number >= 0,
                dealii::ExcMessage("The pattern of a count admits " + text +
                                   "."));
    return number;
  }



  std::unique_ptr<Patterns::PatternBase>
  EntryValue<unsigned int>::pattern()
  {
    return std::make_unique<Patterns::Integer>(0);
  }



  std::string
  EntryValue<bool>::text(const bool value)
  {
    return value ? "true" : "false";
  }



  bool
  EntryValue<bool>::value(const std::string &text)
  {
    return text == "true";
  }



  std::unique_ptr<Patterns::PatternBase>
  EntryValue<bool>::pattern()
  {
    return std::make_unique<Patterns::Bool>();
  }



  std::string
  EntryValue<std::string>::text(const std::string &value)
  {
    return value;
  }



  std::string
  EntryValue<std::string>::value(const std::string &text)
  {
    return text;
  }



  std::unique_ptr<Patterns::PatternBase>
  EntryValue<std::string>::pattern()
  {
    return std::make_unique<Patterns::Anything>();
  }



  std::vector<std::string>
  split_list(const std::string &text)
  {
    return dealii::Utilities::split_string_list(text, ',');
  }



  void
  add_parameter(dealii::ParameterHandler                       &prm,
                const std::string                              &entry,
                const std::string                              &text,
                const std::function<void(const std::string &)> &read,
                const std::string                              &documentation,
                const Patterns::PatternBase                    &pattern)
  {
    prm.declare_entry(entry, text, pattern, documentation);
    prm.add_action(entry, read);
  }
} // namespace NPT
