// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines numbers that something chosen by name brings along as further entries
// of a subsection.

#ifndef npt_dealii_base_own_numbers_h
#define npt_dealii_base_own_numbers_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/registry.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /// A number of its own that a section or a law has, beside those that all of
  /// its kind share.
  struct OwnNumber
  {
    std::string entry;
    double      value; ///< default
    /// Begins with the name of what it belongs to: "Power ellipse only: ...".
    std::string                                          documentation;
    std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
  };

  /// Values by entry.
  using OwnValues = std::map<std::string, double>;

  /// The value that was given, or else the default.
  double
  own_number(const OwnValues              &values,
             const std::vector<OwnNumber> &numbers,
             const std::string            &entry);

  /// Bind the numbers of all registered things to entries of the present
  /// subsection. Entries share it, so that names must differ.
  template <typename Entry>
  void
  add_own_numbers(dealii::ParameterHandler &prm,
                  OwnValues                &values,
                  const Registry<Entry>    &registry)
  {
    for (const std::string &name : registry.names())
      for (const OwnNumber &number : registry.get(name).numbers)
        add_parameter(prm,
                      number.entry,
                      values.emplace(number.entry, number.value).first->second,
                      number.documentation,
                      *number.pattern);
  }
} // namespace NPT

#endif
