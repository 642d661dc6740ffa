// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the figures with which the log of a plate test begins: sizes of the
// cell, stiffness at rest, penalties against it.

#ifndef npt_dealii_problems_plate_test_cell_sizes_h
#define npt_dealii_problems_plate_test_cell_sizes_h

#include <npt_dealii/problems/plate_test/plate_cell.h>

#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /// Thickness of the layer [mm]: of warp and weft on each other at a crossing;
  /// of a laminate its own.
  double
  layer_thickness(const CellParameters &cell);

  /// Moduli at rest [MPa], from the small-strain stiffness of any law; L along
  /// the fiber, T across.
  struct StiffnessAtRest
  {
    double E_L, E_T, G_L, G_T;
  };

  StiffnessAtRest
  stiffness_at_rest(const MaterialParameters &material);

  /**
   * The normal penalty against the stiffness of the bundles across their
   * thickness [-],
   *
   * @f[ \epsilon_N \, \frac{1}{2} \left( \frac{t}{E_T}|_{warp}
   *     + \frac{t}{E_T}|_{weft} \right) , @f]
   *
   * which is epsilon_N t / E_T for equal bundles: the compression of the
   * bundles under a pressure over their penetration.
   */
  double
  penalty_over_stiffness(const PlateTestParameters &parameters);

  /**
   * The penalty that penalty_over_stiffness() calls 50 [N/mm^3], (A43): bundles
   * under a pressure are pressed in by a fiftieth of what they are compressed.
   */
  double
  automatic_penalty(const PlateTestParameters &parameters);

  /// Names and values for the head of the log.
  std::vector<std::pair<std::string, std::string>>
  describe_sizes(const PlateCell &cell, const PlateTestParameters &parameters);
} // namespace NPT

#endif
