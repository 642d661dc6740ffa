// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the view of a cell before anything is computed.

#ifndef npt_dealii_problems_plate_test_cell_preview_h
#define npt_dealii_problems_plate_test_cell_preview_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>

#include <string>

namespace NPT
{
  /**
   * Say the sizes of a cell in the log and write geometry.vtu (straight bundles
   * that just touch) and images.vtu (pieces of neighboring cells that are
   * candidates for contact) into the directory, unless that is empty.
   */
  void
  preview_cell(const PlateCell           &cell,
               const PlateTestParameters &parameters,
               const std::string         &directory,
               RunLog                    &log);
} // namespace NPT

#endif
