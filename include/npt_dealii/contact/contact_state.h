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
    /// Friction traction of every contact node in the components of the slip
    /// measure: t^a_n on the tangents of the secondary surface or t_{a,n} on
    /// those of the primary one.
    std::vector<std::array<double, dim - 1>> traction;
    /// Multiplier of the augmented Lagrangian of every node [MPa].
    std::vector<double> multiplier;
    /// Factor by which the augmented Lagrangian has let both penalties grow.
    double penalty_scale = 1.;
    /// Closest point of every Gauss point; not known where it was too deep.
    std::vector<ProjectionStart<dim>> closest;
  };
} // namespace NPT

#endif
