// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines which curvatures make sense for a cell.

#ifndef npt_dealii_problems_plate_test_curvature_range_h
#define npt_dealii_problems_plate_test_curvature_range_h

#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <string>
#include <vector>

namespace NPT
{
  /**
   * What is doubtful about the curvatures k (or half the torsions) to which a
   * load programme bends, one sentence each; empty if nothing is. With the
   * thickness t of the layer and the spacing Lbar of the crossings along the
   * curvature:
   *
   * - k t / 2 > 0.2: the faces of the layer are stretched and shortened by more
   *   than a fifth, so that moment and curvature of a plate mean little;
   * - k Lbar > 1: the radius is smaller than the distance of neighboring
   *   crossings, and the fabric is a chain of hinges and no plate;
   * - k Lbar > 0.1 with linear jumps: the slopes count as strains, see
   *   Homogenization / Jumps.
   *
   * Curvatures whose moment is prescribed are not known in advance.
   */
  std::vector<std::string>
  doubts_of_curvature(const PlateTestParameters &parameters);
} // namespace NPT

#endif
