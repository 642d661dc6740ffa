// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what memory a plate test needs, before it is taken.

#ifndef npt_dealii_problems_plate_test_memory_need_h
#define npt_dealii_problems_plate_test_memory_need_h

#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <string>

namespace NPT
{
  /**
   * Memory that the matrix of a plate test takes at least [GB, 1e9 bytes], with
   * any solver.
   *
   * @f[ 0.4 \cdot 9 \cdot 2 n_\times \, n_A (2 p + 1) \, c(n_B) \, c(n_C)
   *     \cdot 24 \, \mathrm{bytes}, \quad
   *     c(n) = (n + p)(2 p + 1) - p (p + 1) @f]
   *
   * c(n): pairs of functions of n elements of degree p that meet. There are two
   * bundles of n_A x n_B x n_C elements in each of the @f$n_\times@f$ crossings
   * of the cell. Each pair has 9 entries, of a number and a column, and those
   * of the free unknowns, which the solver reads, stand there once more. 0.4: a
   * 2-fold axis may relate the unknowns in pairs, and some are held.
   */
  double
  least_gigabytes(const PlateTestParameters &parameters);

  /**
   * Whether that fits.
   *
   * @param available As available_gigabytes() [GB].
   * @return Nothing, or what is needed and what there is, in a sentence.
   */
  std::string
  obstacle_of_memory(const PlateTestParameters &parameters,
                     const double               available);
} // namespace NPT

#endif
