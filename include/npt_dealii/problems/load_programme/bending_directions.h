// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines about which axis the stages of a load program bend the plate.

#ifndef npt_dealii_problems_load_programme_bending_directions_h
#define npt_dealii_problems_load_programme_bending_directions_h

#include <npt_dealii/problems/load_programme/load_programme.h>

#include <string>
#include <vector>

namespace NPT
{
  /**
   * Set LoadStage::bends_along of the first stage that bends the plate, and of
   * all after it: the unit vector n of a curvature K = k n (x) n during the
   * whole stage. Stages before it have none.
   *
   * H4, H5 and H6 must keep one ratio, with H6^2 = 4 H4 H5, during a stage. A
   * curvature whose resultant is prescribed may have any value, so it must be
   * H4 or H5, and the only one. The direction may change where the plate is
   * flat.
   *
   * @return Empty; or a clause why there is no such direction, and no stage
   *   has one then.
   */
  std::string
  set_bending_directions(std::vector<LoadStage> &stages);
} // namespace NPT

#endif
