// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines numbers in messages and labels.

#ifndef npt_dealii_base_short_number_h
#define npt_dealii_base_short_number_h

#include <string>

namespace NPT
{
  /// A number in as few digits as needed, at most the given ones: 0.01, 1e-05,
  /// 12.5.
  std::string
  short_number(const double value, const unsigned int digits = 6);
} // namespace NPT

#endif
