// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the soft foundation that holds floating bundles during weaving.

#ifndef npt_dealii_problems_plate_test_weaving_foundation_h
#define npt_dealii_problems_plate_test_weaving_foundation_h

#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace NPT
{
  /**
   * Springs between every bundle and the macroscopic field, in those directions
   * i in which FabricCell::can_float() says that nothing but contact would hold
   * it,
   *
   * @f[ \delta W = \kappa \int (\delta w_i - \delta w_{m,i})
   *                            (w_i - w_{m,i}) \, dV , \qquad
   *     \kappa = 4.40704 \cdot 10^{-3} \, G / t^2 , (A23) @f]
   *
   * integrated with one point per control point. G is the lowest shear modulus
   * of the bundles at rest [MPa], t their mean thickness [mm]; w_m are the
   * membrane modes H1..H3. A bundle that moves by a tenth of t then takes a few
   * thousandths of the force that shears it as much, so that the foundation
   * moves nothing by itself, and results scale with units.
   */
  class WeavingFoundation
  {
  public:
    /// No foundation.
    WeavingFoundation() = default;
    explicit WeavingFoundation(const PlateCell &cell);

    /// Whether it holds anything.
    bool
    is_empty() const
    {
      return springs_.empty();
    }
    /// Announce the springs to a system before its pattern is built.
    void
    add_groups(ConstrainedSystem &system);
    /// Add `share` of its forces at u to a full residual.
    void
    add_residual(const dealii::Vector<double> &u,
                 const double                  share,
                 dealii::Vector<double>       &residual) const;
    void
    add_tangent(const double share, ConstrainedSystem &system) const;
    /// At full share [N mm].
    double
    energy(const dealii::Vector<double> &u) const;
    /// The largest sum of |force| on the control points of one bundle [N].
    double
    largest_force(const dealii::Vector<double> &u, const double share) const;

  private:
    // Energy 1/2 stiffness (sum_k factor_k u_k)^2.
    struct Spring
    {
      unsigned int              bundle;
      double                    stiffness; // [N/mm]
      std::vector<unsigned int> unknowns;
      std::vector<double>       factors;
      unsigned int              group = 0;

      double
      elongation(const dealii::Vector<double> &u) const;
    };
    std::vector<Spring> springs_;
  };
} // namespace NPT

#endif
