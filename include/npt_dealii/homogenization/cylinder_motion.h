// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the rigid motions that map a plate that is bent about one axis onto
// itself.

#ifndef npt_dealii_homogenization_cylinder_motion_h
#define npt_dealii_homogenization_cylinder_motion_h

#include <npt_dealii/base/first_order.h>
#include <npt_dealii/base/second_order.h>
#include <npt_dealii/fabric/symmetry.h>
#include <npt_dealii/homogenization/macro_modes.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace NPT
{
  /// Values of H1..H6.
  using Gradients = std::array<double, MacroModes::n>;

  /// x -> R x + t.
  struct RigidMotion
  {
    dealii::Tensor<2, 3> R;
    dealii::Tensor<1, 3> t;

    dealii::Tensor<1, 3>
    operator()(const dealii::Tensor<1, 3> &x) const
    {
      return R * x + t;
    }
  };

  /**
   * Rigid motions S_p that take the piece of a stretched and bent plate at the
   * origin to the one at the place p of the undeformed mid-plane,
   *
   * @f[ S_p = \exp \xi(p), \qquad \xi(p): x \mapsto \omega \times x + V, \qquad
   *     V = U p, \qquad \omega = e_3 \times R_U K p \qquad (A24) @f]
   * @f[ U = \begin{pmatrix} 1 + H_1 & H_3/2 \\ H_3/2 & 1 + H_2 \end{pmatrix},
   *     \qquad
   *     K = \begin{pmatrix} H_4 & H_6/2 \\ H_6/2 & H_5 \end{pmatrix}. @f]
   *
   * If the plate bends about one axis, K = k n (x) n, all S_p are rotations
   * about the axis of a cylinder and shifts along it, and S_p S_q = S_{p+q}.
   * R_U is the rotation in the plane that turns the straight lines of the
   * cylinder, m normal to n, into their direction U m in the sheared plate, and
   * one if that is m. K is the angle per undeformed length. For other K there
   * is no such group; the motions are defined still, so that they can be
   * differentiated with respect to all of H1..H6.
   */
  class CylinderMotion
  {
  public:
    /// @param direction n, a unit vector of the mid-plane.
    explicit CylinderMotion(const dealii::Tensor<1, 2> &direction);

    RigidMotion
    at(const Gradients &H, const dealii::Tensor<1, 2> &p) const;

    /// R and t with their derivatives with respect to H.
    struct Derivatives
    {
      std::array<std::array<SecondOrder<MacroModes::n>, 3>, 3> R;
      std::array<SecondOrder<MacroModes::n>, 3>                t;
    };
    Derivatives
    derivatives_at(const Gradients &H, const dealii::Tensor<1, 2> &p) const;

    /// The same without second derivatives.
    struct FirstDerivatives
    {
      std::array<std::array<FirstOrder<MacroModes::n>, 3>, 3> R;
      std::array<FirstOrder<MacroModes::n>, 3>                t;
    };
    FirstDerivatives
    first_derivatives_at(const Gradients            &H,
                         const dealii::Tensor<1, 2> &p) const;

    /// The section of the cylinder: its curvature [1/mm], per length of the
    /// stretched plate, and the direction in the plane in which it runs at the
    /// origin, R_U n.
    struct Circle
    {
      SecondOrder<MacroModes::n>                curvature;
      std::array<SecondOrder<MacroModes::n>, 2> direction;
    };
    Circle
    circle(const Gradients &H) const;

  private:
    dealii::Tensor<1, 2> n_;
  };

  /// Where an operation g of the cell, Y -> Q Y + a, puts the image of a point
  /// x of a plate bent about one axis: S_a Q x. g must keep the bending modes.
  dealii::Tensor<1, 3>
  image_on_cylinder(const dealii::Tensor<1, 2> &direction,
                    const Gradients            &H,
                    const SymmetryOperation    &g,
                    const dealii::Point<3>     &x);
} // namespace NPT

#endif
