// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a weave that a parameter file chooses by its name is.

#ifndef npt_dealii_fabric_named_weave_h
#define npt_dealii_fabric_named_weave_h

#include <npt_dealii/base/registry.h>

#include <string>

namespace NPT
{
  /// A weave with a name; the names are those of Registry<NamedWeave>.
  struct NamedWeave
  {
    std::string table; ///< one repeat, see WeavePattern
  };
} // namespace NPT

#endif
