// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a contact pair remembers of the last accepted step.

#ifndef npt_dealii_contact_contact_state_h
#define npt_dealii_contact_contact_state_h

#include <npt_dealii/contact/geometry/closest_point_projection.h>

namespace NPT
{
  /**
   * Accepted contact state, a value: all that a load step must know of the ones
   * before it besides the displacement. Made by ContactPair::initial_state()
   * and ContactPair::accept() only.
   */
  template <int dim>
  struct ContactState
  {
    /// Friction acts, and its history has begun.
    bool friction_on = false;
    /// Friction traction of every friction node in the components of the slip
    /// measure: t^a_n on the tangents of the secondary surface or t_{a,n} on
    /// those of the primary one.
    std::vector<std::array<double, dim - 1>> traction;
    /// Multiplier of the augmented Lagrangian of every node [MPa].
    std::vector<double> multiplier;
    /// What is added to the gap of every contact node [mm], because the
    /// pressure of what it was has relaxed; empty: nothing.
    std::vector<double> gap_shift;
    /// Length of the slip of every friction node since it last opened [mm], if
    /// the friction coefficient depends on it; else empty.
    std::vector<double> slip_path;
    /// Pressure by which the friction law limits the traction of every friction
    /// node [MPa], with the factor of (A38); empty: not known.
    std::vector<double> law_pressure;
    /// Factor by which the augmented Lagrangian has let both penalties grow.
    double penalty_scale = 1.;
    /// Closest point of every Gauss point; not known behind the body.
    std::vector<ProjectionStart<dim>> closest;
    /// Gauss points behind the body. Decided by the depth before the first
    /// step; from then on a point comes back only by leaving the body, and none
    /// gets there: a step in which a point sinks too deep is no solution.
    /// Empty before the first step.
    std::vector<bool> behind;
  };
} // namespace NPT

#endif
