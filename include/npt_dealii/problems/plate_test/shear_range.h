// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines up to which shear angle a cell has all of its contact.

#ifndef npt_dealii_problems_plate_test_shear_range_h
#define npt_dealii_problems_plate_test_shear_range_h

#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <string>
#include <vector>

namespace NPT
{
  /**
   * The shear angle [rad] up to which two crossing bundles touch within half a
   * spacing of their crossing, where the contact surfaces of the sub-unit cell
   * end. The corner of the rhombus in which bands of the widths w and w' lie on
   * each other is (w' / cos g + w tan g)/2 from its center, along the band of
   * width w, so
   *
   * @f[ g = \arccos \frac{w'}{(\bar L^2 + w^2)^{1/2}}
   *         - \arctan \frac{w}{\bar L}, @f]
   *
   * the smaller one of both directions, and at least 0. Sections are thin at
   * their edges, so that resultants change later, see doc/fabrics.md.
   */
  double
  shear_angle_of_sub_unit_cell(const CellParameters &cell);

  /**
   * What is doubtful about the shear of a load programme, one sentence per
   * stage: a sub-unit cell that is sheared beyond the angle above. Shears whose
   * resultant is prescribed are not known in advance.
   */
  std::vector<std::string>
  doubts_of_shear(const PlateTestParameters &parameters);
} // namespace NPT

#endif
