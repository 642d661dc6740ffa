// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the mean height of a bent cell, and the force that holds it.

#ifndef npt_dealii_problems_plate_test_mean_height_h
#define npt_dealii_problems_plate_test_mean_height_h

#include <npt_dealii/base/second_order.h>
#include <npt_dealii/homogenization/cylinder_motion.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace NPT
{
  /**
   * The mean height of a cell over the cylinder on which H1..H3 are measured,
   *
   * @f[ \bar d = \frac{1}{V} \int d(x) \, dV, \qquad
   *     d = \frac{q}{\sqrt{1 + k q} + 1}, \qquad
   *     q = 2 x_3 + k \left( x_3^2 + (b \cdot x)^2 \right), \qquad (A26) @f]
   *
   * with the curvature k and the direction b of CylinderMotion::circle(): d is
   * the distance of x from the axis less the radius 1/k, written so that k may
   * vanish. It is zero at all times. What holds it is a multiplier s,
   *
   * @f[ \Pi = E + c \, s \, \bar d , @f]
   *
   * that is a force c s along the normals, spread over the volume. A plate that
   * is bent under tension needs one: n : K per area, the pressure on a pulley.
   * Without it the tension along the curvature could only be zero.
   */
  class MeanHeight
  {
  public:
    static constexpr unsigned int dim      = 3;
    static constexpr unsigned int n_circle = 3; ///< k, b_1, b_2

    /// d at x, and its derivatives with respect to x_1..x_3, k, b_1, b_2.
    struct Height
    {
      static constexpr unsigned int n_variables = dim + n_circle;

      /// @param with_hessian Else the hessian is not set.
      Height(const std::array<double, n_circle> &circle,
             const dealii::Tensor<1, dim>       &x,
             const bool                          with_hessian);

      double                                                   value;
      std::array<double, n_variables>                          gradient;
      std::array<std::array<double, n_variables>, n_variables> hessian;
    };

    /// Nothing is held.
    MeanHeight() = default;

    /// @param stiffness c, which only scales the unknown s [N/mm].
    MeanHeight(const PlateCell            &cell,
               const dealii::Tensor<1, 2> &direction,
               const double                stiffness);

    /// @param cells The groups of the bodies in this system.
    void
    add_groups(const DeformableBodies::CellGroups &cells,
               ConstrainedSystem                  &system);
    double
    value(const dealii::Vector<double> &u) const;
    /// c s [N].
    double
    force(const dealii::Vector<double> &u) const;
    /// The derivatives of Pi - E; on all processes the same.
    void
    add_residual(const dealii::Vector<double> &u,
                 dealii::Vector<double>       &residual) const;
    /**
     * The parts of this process.
     *
     * @param force_scale Norm of the forces in the bundles [N]. Second
     *   derivatives of the mean height are left out where the force that holds
     *   it is below 1e-4 of it.
     */
    void
    add_tangent(const dealii::Vector<double> &u,
                const double                  force_scale,
                ConstrainedSystem            &system) const;

  private:
    using IsCounted = std::function<bool(const unsigned int cell)>;
    // The mean height and its derivatives with respect to u and H1..H6, of some
    // cells.
    double
    differentiate(const dealii::Vector<double> &u,
                  const IsCounted              &is_counted,
                  dealii::Vector<double>       &gradient) const;
    // k, b_1, b_2 as functions of H.
    std::array<SecondOrder<MacroModes::n>, n_circle>
    circle(const dealii::Vector<double> &u) const;
    // Of the control points of a cell, by component.
    void
    positions(const unsigned int            cell,
              const dealii::Vector<double> &u,
              std::vector<double>          &x) const;

    const PlateCell              *cell_ = nullptr;
    std::optional<CylinderMotion> motion_;
    double                        stiffness_ = 0., volume_ = 0.;
    DeformableBodies::CellGroups  groups_; // those of this process
  };
} // namespace NPT

#endif
