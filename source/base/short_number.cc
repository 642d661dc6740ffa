// SPDX-License-Identifier: LGPL-2.1-or-later
// Numbers in messages and labels.

#include <npt_dealii/base/short_number.h>

#include <iomanip>
#include <sstream>

namespace NPT
{
  std::string
  short_number(const double value, const unsigned int digits)
  {
    std::ostringstream text;
    text << std::setprecision(digits) << value;
    return text.str();
  }
} // namespace NPT
