// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines whether parallel bundles can come near each other in a plate test.

#ifndef npt_dealii_problems_load_programme_neighbor_distance_h
#define npt_dealii_problems_load_programme_neighbor_distance_h

#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/problems/load_programme/load_programme.h>

#include <string>

namespace NPT
{
  /**
   * Why the edges of parallel neighbors may touch, as a clause: "the lines of
   * the wefts come within ..."; empty if they stay apart.
   *
   * They may if nothing crosses between two neighbors, or if their lines come
   * nearer than 1.1 widths anywhere in the load programme. With the membrane
   * part F of the macroscopic deformation, F_11 = 1 + H1, F_22 = 1 + H2,
   * F_12 = F_21 = H3/2, the wefts, which run along Y2 and lie Lbar apart along
   * Y1, have the distance
   *
   * @f[ d = \bar L \, \frac{\det F}{|F e_2|} \, (1 - t |H_4|), @f]
   *
   * the last factor at the inner face of a bent layer; likewise the warps.
   * Where a resultant is prescribed, its gradient is bounded by what crimp can
   * take up; where there is no such bound (n < 0, shear by a force or in a
   * weave without mirror planes, moments), neighbors may touch.
   */
  std::string
  reason_for_side_contact(const CellParameters &cell,
                          const LoadProgramme  &programme);
} // namespace NPT

#endif
