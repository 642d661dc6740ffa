// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the problem "plate test": one run, and summary.csv that says how it
// ended.

#ifndef npt_dealii_problems_plate_test_plate_test_h
#define npt_dealii_problems_plate_test_plate_test_h

#include <npt_dealii/problems/plate_test/plate_test_checkpoint.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <optional>
#include <ostream>
#include <string>

namespace NPT
{
  /**
   * Run all stages and write summary.csv: `running` at the start, and how the
   * run ended, also if a stage fails; then StageFailed is thrown on.
   *
   * @param directory Existing folder for all results; empty on all processes
   *   but the first.
   * @param ranks The processes that compute the run together.
   * @param checkpoint Where to go on; else the run begins at its start.
   */
  void
  run_plate_test(const PlateTestParameters         &parameters,
                 const std::string                 &directory,
                 std::ostream                      &screen,
                 const Ranks                       &ranks      = {},
                 std::optional<PlateTestCheckpoint> checkpoint = {});
} // namespace NPT

#endif
