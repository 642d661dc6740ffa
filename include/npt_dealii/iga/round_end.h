// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the curve by which a surface turns into the body at a round edge.

#ifndef npt_dealii_iga_round_end_h
#define npt_dealii_iga_round_end_h

#include <npt_dealii/iga/powers.h>

namespace NPT
{
  /**
   * A quarter of a circle, nearly, as a polynomial curve of 0 <= tau <= 1,
   * (A47) of doc/theory.md,
   *
   * @f[ y = \tau + \tau^2 - \tau^3, \qquad
   *     z = \tfrac34 \tau^2 + \tfrac14 \tau^3 . @f]
   *
   * y: way along the face from where the curve leaves it, over the length of
   * the rounded part. z: depth below the face over half of the body's height.
   * At tau = 0 the curve leaves the face C1, with the speed of the face's
   * parameter, and at tau = 1 it has reached the side in the middle of the
   * height, y = z = 1, and runs down along it. Its distance from the center
   * (0, 1) is 1 within 0.9 %.
   */
  struct RoundEnd
  {
    static const Powers &
    way();
    static const Powers &
    depth();
  };
} // namespace NPT

#endif
