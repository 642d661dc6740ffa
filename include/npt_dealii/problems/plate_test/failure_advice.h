// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a user may try after a stage of a plate test has failed.

#ifndef npt_dealii_problems_plate_test_failure_advice_h
#define npt_dealii_problems_plate_test_failure_advice_h

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/state.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <string>

namespace NPT
{
  /// Whether a failure is no question of the material or of the load step.
  bool
  tells_its_cause(const StageFailed &failure);

  /**
   * What to try, half a sentence: the cause where the state shows one, the
   * failure's own advice else. Causes in this order:
   *
   * - the failure tells its cause (memory, interruption, contact): its own;
   * - bundles held at fixed width in weaving, which lengthens them: n1 or n2
   *   exceeds E_T t / 2, or they are much stiffer along than across;
   * - ellipticity is lost: then no shorter step leads on;
   * - a penalty far above or below the stiffness of the bundles.
   *
   * @param stage       Number of the stage in the load programme.
   * @param state       The last accepted one.
   * @param is_elliptic Of the material, in that state.
   */
  std::string
  advice_for(const StageFailed         &failure,
             const PlateTestParameters &parameters,
             const unsigned int         stage,
             const State               &state,
             const bool                 is_elliptic);
} // namespace NPT

#endif
