// SPDX-License-Identifier: LGPL-2.1-or-later
// Tolerances from parameter files, and the sentences on those that are missed.

#include <npt_dealii/base/describe_pattern.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/verification/comparison.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <cctype>
#include <cstdlib>

namespace NPT
{
  std::optional<double>
  parse_tolerance(const std::string &value,
                  const std::string &entry,
                  const std::string &subsection)
  {
    const std::string text = dealii::Utilities::trim(value);
    if (text == "none")
      return {};
    char             *end       = nullptr;
    const double      tolerance = std::strtod(text.c_str(), &end);
    const std::string rest      = dealii::Utilities::trim(end);
    if (end == text.c_str() || !(tolerance >= 0.) ||
        !std::isfinite(tolerance) || (!rest.empty() && rest != "%") ||
        text.find_first_of("xX") != std::string::npos) // of 0x10
      throw InputError(entry + " is '" + value +
                       "'; it must be none, a number >= 0, or one in per cent "
                       "like 1 % (subsection " +
                       subsection + ").");
    if (const std::string fault = number_beyond_doubles(text); !fault.empty())
      throw InputError(entry + " is " + fault + " (subsection " + subsection +
                       ").");
    return rest == "%" ? tolerance / 100. : tolerance;
  }



  std::string
  tolerance_entry(const std::string &quantity)
  {
    std::string entry = quantity;
    entry[0]          = std::toupper(static_cast<unsigned char>(entry[0]));
    const std::size_t slash = entry.find('/');
    if (slash != std::string::npos)
      entry.replace(slash, 1, " over ");
    return entry;
  }



  void
  declare_tolerances(dealii::ParameterHandler            &prm,
                     const std::vector<ComparedQuantity> &quantities)
  {
    prm.enter_subsection("Tolerances");
    for (const ComparedQuantity &quantity : quantities)
      if (quantity.has_exact_value)
        prm.declare_entry(
          tolerance_entry(quantity.name),
          "none",
          dealii::Patterns::Anything(),
          "Largest error of the " + quantity.name +
            ": relative to the exact value (a number or per cent), or in [" +
            quantity.unit +
            "] where zero is exact. The run fails if it is exceeded. none: "
            "the error is reported only.");
    prm.leave_subsection();
  }



  Tolerances
  parse_tolerances(dealii::ParameterHandler            &prm,
                   const std::vector<ComparedQuantity> &quantities)
  {
    Tolerances tolerances;
    prm.enter_subsection("Tolerances");
    for (const ComparedQuantity &quantity : quantities)
      if (quantity.has_exact_value)
        {
          const std::string entry = tolerance_entry(quantity.name);
          if (const auto value =
                parse_tolerance(prm.get(entry), entry, "Tolerances"))
            tolerances[quantity.name] = *value;
        }
    prm.leave_subsection();
    return tolerances;
  }



  std::string
  Comparison::sentence() const
  {
    const std::string with_unit = unit == "-" ? "" : " " + unit;
    std::string text = quantity + " is " + short_number(computed) + with_unit;
    if (!exact)
      return text;
    text += ", exact " + short_number(*exact) + with_unit;
    const bool relative = *exact != 0.;
    if (relative)
      text += ": off by " + short_number(100. * error(), 3) + " %";
    if (allowed)
      text +=
        ", allowed " + (relative ? short_number(100. * *allowed, 3) + " %" :
                                   short_number(*allowed, 3) + with_unit);
    return text;
  }



  void
  judge(const std::vector<Comparison> &comparisons)
  {
    std::string misses;
    for (const Comparison &comparison : comparisons)
      if (comparison.is_missed())
        misses += (misses.empty() ? "" : "; ") + comparison.sentence();
    if (!misses.empty())
      throw ToleranceMissed(
        "The comparison with the exact solution failed: " + misses + ".");
  }



  void
  write_comparisons(const std::string             &filename,
                    const std::vector<Comparison> &comparisons)
  {
    TableWriter table(
      filename,
      {"quantity", "unit", "computed", "exact", "error", "allowed"},
      {"Error: relative, absolute where zero is exact. No value of a quantity "
       "that is only reported, or not judged."});
    const auto cell = [](const std::optional<double> &value) {
      return value ? TableCell(*value) : TableCell("");
    };
    for (const Comparison &item : comparisons)
      table.add_row({item.quantity,
                     item.unit,
                     item.computed,
                     cell(item.exact),
                     item.exact ? TableCell(item.error()) : TableCell(""),
                     cell(item.allowed)});
  }
} // namespace NPT
