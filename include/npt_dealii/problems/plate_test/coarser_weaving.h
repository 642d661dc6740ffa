// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines weaving on a coarser mesh first, whose woven state is a good start on
// the mesh that is wanted.

#ifndef npt_dealii_problems_plate_test_coarser_weaving_h
#define npt_dealii_problems_plate_test_coarser_weaving_h

#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <optional>

namespace NPT
{
  /**
   * The parameters of a test that only weaves, on half as many elements in
   * each direction; nothing where Mesh / Weave on coarser mesh says no:
   *
   * - The woven state of elastic bundles without friction does not depend on
   *   the way to it, so only a first stage without friction may be skipped.
   * - From how many unknowns on it pays: the coarser test takes an eighth of
   *   the cells and about all of the iterations.
   *
   * - With few contact nodes per crossing several states are in equilibrium,
   * and the coarser mesh would choose one. So the program by itself goes down
   * to 7 elements along and across at least, whatever the number of bundles.
   *
   * The coarser test follows the last rule, so that a fine mesh is reached by
   * several levels (nested iteration).
   */
  std::optional<PlateTestParameters>
  coarser_weaving(const PlateTestParameters &parameters, const PlateCell &cell);

  /**
   * The woven state of a coarser test on a finer cell: displacements
   * interpolated, see interpolate_field(), the same macro unknowns, and the
   * couplings of the cell obeyed. Not in equilibrium yet. Which points count as
   * behind their partner is decided in the straight state, as always.
   */
  State
  carry_over(const PlateCell &coarse,
             const State     &woven,
             const PlateCell &fine);
} // namespace NPT

#endif
