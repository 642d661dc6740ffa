// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the failure of a load step that left the path of equilibria.

#ifndef npt_dealii_load_step_branch_left_h
#define npt_dealii_load_step_branch_left_h

#include <npt_dealii/base/exceptions.h>

namespace NPT
{
  /// A step ended on another equilibrium path than it began on: its balance of
  /// energy does not close, see EnergyChange.
  class BranchLeft : public LoadStepFailure
  {
  public:
    explicit BranchLeft(const std::string &detail)
      : LoadStepFailure("jump to another branch", detail)
    {}
  };
} // namespace NPT

#endif
