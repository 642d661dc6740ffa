// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the figures of a closed loop of a curve: rigidity, hysteresis,
// losses.

#ifndef npt_dealii_problems_plate_results_hysteresis_h
#define npt_dealii_problems_plate_results_hysteresis_h

#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * Figures of the last closed loop of n_k over H_k between -A and A, in the
   * way of the fabric testers after Kawabata: rigidity (B for bending, G for
   * shear) from the straight part of the branches, hysteresis (2HB, 2HG) as
   * the distance between them. The instrument's curvatures 0.5, 1 and 1.5 /cm
   * at an amplitude of 2.5 /cm are kept as fractions of the amplitude.
   *
   * @f[ B = \frac{1}{2} \sum_{\pm} \frac{n_k(0.6 A) - n_k(0.2 A)}{0.4 A},
   * \qquad 2HB = \frac{1}{2} \left( \Delta n_k(0.4 A) + \Delta n_k(-0.4 A)
   * \right)
   * @f]
   *
   * B is the mean over both branches and both signs of H_k. Reference: S.
   * Kawabata, The Standardization and Analysis of Hand Evaluation, 1980.
   */
  struct HysteresisLoop
  {
    unsigned int component; ///< k, row of MacroModes::table
    double       amplitude; ///< A
    double       rigidity;  ///< B, in the mode's rigidity_unit()
    double       width;     ///< 2HB, in the mode's conjugate_unit()
    /// Work of the loop per area [N/mm], by the trapezoidal rule.
    double loop_area;
    /// Frictional dissipation and growth of the energies in the loop [N/mm].
    double dissipation, energy_growth;
    /// Amount of work in the loop, of all modes [N/mm]; amount_of_work().
    double       work;
    unsigned int n_steps; ///< in the loop

    /// Loop area less dissipation and growth [N/mm]: zero but for the error of
    /// the trapezoidal rule.
    double
    imbalance() const
    {
      return loop_area - dissipation - energy_growth;
    }
    /// Whether the loop area is the dissipation and the growth, to 3 % of the
    /// larger.
    bool
    is_balanced() const;
  };

  /**
   * Find the closed loop with which a curve ends: a component H_k goes from A
   * to -A and back (or the other way round). If several do, the one that does
   * most work, which is the one that is driven.
   *
   * @param area Of the cell [mm^2]: the energies of a row are those of a cell.
   * @return Nothing if the curve does not end with such a loop.
   */
  std::optional<HysteresisLoop>
  last_loop(const std::vector<CurveRow> &curve, const double area);

  /// One sentence for the log. It says so where the loop is not balanced.
  std::string
  describe(const HysteresisLoop &loop);

  /// Write the figures of a loop as a table of one row.
  void
  write_hysteresis(const std::string &filename, const HysteresisLoop &loop);
} // namespace NPT

#endif
