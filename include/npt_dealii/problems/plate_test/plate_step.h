// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a column of curves.csv can be computed from.

#ifndef npt_dealii_problems_plate_test_plate_step_h
#define npt_dealii_problems_plate_test_plate_step_h

#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>

namespace NPT
{
  /// An accepted load step of a plate test.
  struct PlateStep
  {
    const PlateCell    &cell;
    const AcceptedStep &step;
  };
} // namespace NPT

#endif
