// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines jumps that turn with a bent plate: displacements in frames that the
// motions of a cylinder carry along.

#ifndef npt_dealii_homogenization_objective_jumps_h
#define npt_dealii_homogenization_objective_jumps_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/cylinder_motion.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/periodic_image.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/linear_algebra/unknown_map.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <vector>

namespace NPT
{
  /// H1..H6 of a vector of unknowns.
  Gradients
  gradients_of(const MacroUnknowns &macro, const dealii::Vector<double> &u);

  /**
   * The displacements v of all control points in frames that move with the
   * plate,
   *
   * @f[ X + u = S_p ( X - p + v ), \qquad (A25) @f]
   *
   * with the motions S_p of CylinderMotion. Every control point has its frame
   * at a place p of the mid-plane, that of an image gX at gp. Since a plate
   * bent about one axis is mapped onto itself by the S_p, an image turned with
   * the plate, x(gY) = S_a Q x(Y), is
   *
   * @f[ v(gY) = Q v(Y) : @f]
   *
   * couplings of v contain neither rotations nor jumps.
   *
   * The place p is that of the control point itself; with a smooth closure
   * that of the seam for the neighbors of a seam, so that (A18) holds for v.
   *
   * The motions know the height 0, at which H1..H3 stretch the plate. So they
   * do not leave the cell free to move along the normal.
   */
  class ObjectiveJumps : public UnknownMap
  {
  public:
    /// @param direction Of the curvature, see CylinderMotion.
    ObjectiveJumps(const FabricCell                 &cell,
                   const IGASpace<3>                &space,
                   const MacroUnknowns              &macro,
                   const std::vector<PeriodicImage> &images,
                   const dealii::Tensor<1, 2>       &direction);

    void
    apply(const dealii::Vector<double> &v,
          dealii::Vector<double>       &u) const override;
    void
    invert(const dealii::Vector<double> &u,
           dealii::Vector<double>       &v) const override;
    std::vector<std::vector<unsigned int>>
    arguments() const override;
    void
    gradients(const dealii::Vector<double> &v,
              std::vector<double>          &values) const override;

    /// Place of the frame of a control point.
    const dealii::Tensor<1, 2> &
    frame(const unsigned int A) const
    {
      return places_[points_[A].place];
    }

    /// Move everything along the normals [mm], which in a plane state is a
    /// rigid motion.
    void
    raise(const double height, dealii::Vector<double> &u) const;

    /// The unknowns v of each control point and image point, then H1..H6.
    std::vector<std::vector<unsigned int>>
    groups() const;
    /// For each group with a force the matrix sum_i f_i d^2 u_i / dv^2 of
    /// forces f on u.
    void
    second_derivatives(
      const dealii::Vector<double>                                 &v,
      const dealii::Vector<double>                                 &forces,
      const std::function<void(const unsigned int         group,
                               const std::vector<double> &matrix)> &visit)
      const;

    /// Work of forces on u with H1..H6 where v stays [N mm].
    Gradients
    work_with_gradients(const dealii::Vector<double> &u,
                        const dealii::Vector<double> &forces) const;

    /// Sum over all points of the forces on u, turned back into their frames.
    dealii::Tensor<1, 3>
    sum_in_frames(const dealii::Vector<double> &u,
                  const dealii::Vector<double> &forces) const;

  private:
    struct FramedPoint
    {
      unsigned int         unknown; // first of three
      unsigned int         place;   // number of its frame
      dealii::Tensor<1, 3> X;       // reference position
    };
    // X - p.
    dealii::Tensor<1, 3>
    reference_in_frame(const FramedPoint &point) const;
    std::vector<RigidMotion>
    motions(const dealii::Vector<double> &u) const;
    std::vector<CylinderMotion::Derivatives>
    derivatives(const dealii::Vector<double> &u) const;

    const MacroUnknowns               macro_;
    const CylinderMotion              motion_;
    std::vector<dealii::Tensor<1, 2>> places_;
    std::vector<FramedPoint>          points_; // control points, then images
  };
} // namespace NPT

#endif
