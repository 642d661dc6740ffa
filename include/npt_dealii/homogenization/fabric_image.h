// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines where the symmetry of a fabric puts the images of its cell.

#ifndef npt_dealii_homogenization_fabric_image_h
#define npt_dealii_homogenization_fabric_image_h

#include <npt_dealii/fabric/symmetry.h>
#include <npt_dealii/homogenization/cylinder_motion.h>

#include <optional>

namespace NPT
{
  /**
   * The image of a point of the base cell under an operation g Y = Q Y + a,
   *
   * @f[ x(QX + a) = Q\,x(X) + a + \sum_n H_n
   *       \left( w_m^n(QZ + a) - Q\,w_m^n(Z) \right), @f]
   *
   * or with objective jumps S_a Q x, see CylinderMotion. At most quadratic in
   * (x, Z).
   *
   * @param x Position [mm].
   * @param Z Its place of reference, to which bending and torsion refer [mm].
   * @param bends_along With objective jumps: the direction of curvature.
   */
  dealii::Point<3>
  image_in_fabric(const SymmetryOperation                   &g,
                  const dealii::Point<3>                    &x,
                  const dealii::Point<3>                    &Z,
                  const Gradients                           &H,
                  const std::optional<dealii::Tensor<1, 2>> &bends_along);
} // namespace NPT

#endif
