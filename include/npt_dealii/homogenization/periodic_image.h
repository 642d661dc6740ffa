// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the image of a face in a neighboring cell.

#ifndef npt_dealii_homogenization_periodic_image_h
#define npt_dealii_homogenization_periodic_image_h

#include <npt_dealii/fabric/symmetry.h>

#include <deal.II/base/point.h>

#include <vector>

namespace NPT
{
  /**
   * Control points of a face seen through an operation of the cell. They have
   * unknowns of their own, which AffineConstraints tie to the base cell, the
   * macro unknowns and the weaving offset omega,
   *
   * @f[ w(QY+a) = Q\,w(Y) + w_m(QY+a) - Q\,w_m(Y) \pm \omega e_3 , @f]
   *
   * so that contact with an image needs nothing special anywhere else.
   */
  struct PeriodicImage
  {
    std::vector<unsigned int>     control_points; ///< of the base cell
    SymmetryOperation             operation;
    double                        offset_sign;
    unsigned int                  first_unknown; ///< three per control point
    std::vector<dealii::Point<3>> reference;     ///< QX + a
  };
} // namespace NPT

#endif
