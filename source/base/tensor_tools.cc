// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the parts of the tensor helpers that are not needed inline.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/tensor_tools.h>

#include <sstream>

namespace NPT
{
  void
  throw_inverted_cell(const double determinant)
  {
    std::ostringstream text;
    text << "det F = " << determinant << "; it must be positive and finite";
    throw InvertedCell(text.str());
  }
} // namespace NPT
