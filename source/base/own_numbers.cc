// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how the value of an own number is found.

#include <npt_dealii/base/own_numbers.h>

namespace NPT
{
  double
  own_number(const OwnValues              &values,
             const std::vector<OwnNumber> &numbers,
             const std::string            &entry)
  {
    const auto given = values.find(entry);
    if (given != values.end())
      return given->second;
    for (const OwnNumber &number : numbers)
      if (number.entry == entry)
        return number.value;
    AssertThrow(false,
                dealii::ExcMessage("There is no number '" + entry + "'."));
    return 0.;
  }
} // namespace NPT
