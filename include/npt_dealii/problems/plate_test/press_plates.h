// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the two flat plates between which a fabric is compressed.

#ifndef npt_dealii_problems_plate_test_press_plates_h
#define npt_dealii_problems_plate_test_press_plates_h

#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace NPT
{
  /**
   * Two rigid planes at the heights c + T/2 and c - T/2, with the distance T
   * and the center c of MacroUnknowns, against the upper and the lower faces of
   * the bundles, without friction:
   *
   * @f[ E = \frac{\epsilon}{2} \int \langle -g \rangle^2 \, dA, \qquad
   *     g = c + T/2 - x_3 \text{ above}, \quad g = x_3 - c + T/2
   *     \text{ below}. @f]
   *
   * The integral is over the faces as they are at rest, with Gauss points. The
   * plates press with the force F = -dE/dT each, the mean of both; dE/dc = 0
   * makes both forces equal. In a cell with a glide plane, which exchanges
   * them, c = 0; in the others c is free, and a spring of 1e-11 of the
   * stiffness of the plates holds it where the fabric does not touch them, and
   * one each the layers above the first one, where they touch nothing.
   */
  class PressPlates
  {
  public:
    /// There are no plates.
    PressPlates() = default;

    /// @param penalty epsilon [N/mm^3].
    /// @param n_points Gauss points per direction and knot span; 0: degree + 1.
    PressPlates(const PlateCell   &cell,
                const double       penalty,
                const unsigned int n_points);

    bool
    are_used() const
    {
      return !patches_.empty();
    }

    /// Springs are free of forces at this state from now on.
    void
    rest_springs(const dealii::Vector<double> &u);

    /// Place the plates where they just touch the fabric, less an overlap [mm].
    void
    let_touch(const double overlap, dealii::Vector<double> &u) const;

    void
    add_groups(ConstrainedSystem &system);
    void
    add_residual(const dealii::Vector<double> &u,
                 dealii::Vector<double>       &residual) const;
    void
    add_tangent(const dealii::Vector<double> &u,
                ConstrainedSystem            &system) const;
    /// E [N mm].
    double
    energy(const dealii::Vector<double> &u) const;
    /// F of each plate [N]; positive in compression.
    double
    force(const dealii::Vector<double> &u) const;
    double
    largest_penetration(const dealii::Vector<double> &u) const;

  private:
    // The part of a face over one knot span.
    struct Patch
    {
      double                    side;     // +1: upper plate, -1: lower plate
      std::vector<unsigned int> unknowns; // heights, then T and c
      std::vector<double>       X3;       // of the control points
      std::vector<double>       areas;    // by point, with symmetry weights
      std::vector<double>       values;   // by point, then function
      unsigned int              group = 0;
    };
    // Of a point of a patch.
    double
    height(const Patch                  &patch,
           const unsigned int            q,
           const dealii::Vector<double> &u) const;
    double
    gap(const Patch                  &patch,
        const unsigned int            q,
        const dealii::Vector<double> &u) const;
    // dg by the unknowns of the patch.
    double
    gap_gradient(const Patch       &patch,
                 const unsigned int q,
                 const unsigned int k) const;
    void
    add_face(const PlateCell   &cell,
             const unsigned int bundle,
             const unsigned int side,
             const unsigned int n_points);

    std::vector<Patch> patches_;
    double             penalty_  = 0;
    unsigned int       distance_ = 0, center_ = 0;
    bool               is_centered_ = true; // by a glide plane

    struct Spring
    {
      unsigned int unknown;
      double       rest  = 0;
      unsigned int group = 0;
    };
    std::vector<Spring> springs_;
    double              spring_stiffness_ = 0; // [N/mm]
  };
} // namespace NPT

#endif
