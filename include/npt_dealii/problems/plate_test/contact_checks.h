// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a plate test checks of its contact when a stage begins and ends.

#ifndef npt_dealii_problems_plate_test_contact_checks_h
#define npt_dealii_problems_plate_test_contact_checks_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <vector>

namespace NPT
{
  /// A load stage of a woven cell before its bundles are woven: says in the log
  /// what is tested instead.
  void
  warn_of_unwoven_bundles(const PlateCell           &cell,
                          const PlateTestParameters &parameters,
                          const unsigned int         stage,
                          RunLog                    &log);

  /// Says in the log if the mesh is too coarse for the averages of mortar
  /// contact, and what is done instead.
  void
  warn_of_coarse_averages(const PlateCell           &cell,
                          const PlateTestParameters &parameters,
                          RunLog                    &log);

  /**
   * When a stage ends: do bundles lie in each other anywhere (find_overlap()),
   * and do enough contact nodes carry load? Warns of an overlap of more than a
   * quarter of Contact / Maximum overlap, and of fewer than ten active contact
   * nodes per crossing.
   *
   * @param curve With the last step of the stage.
   *
   * Throws StageFailed, "bundles overlap" or "no contact", if the overlap is
   * larger than Contact / Maximum overlap times the thickness of the thinner
   * bundle, or if the bundles of a woven cell do not touch at all.
   */
  void
  check_contact(const PlateCell                     &cell,
                const PlateTestParameters           &parameters,
                const LoadStage                     &stage,
                const State                         &state,
                const std::vector<dealii::Point<3>> &woven,
                const std::vector<CurveRow>         &curve,
                RunLog                              &log);
} // namespace NPT

#endif
