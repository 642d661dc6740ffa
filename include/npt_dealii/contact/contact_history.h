// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a contact pair remembers of the last accepted step.

#ifndef npt_dealii_contact_contact_history_h
#define npt_dealii_contact_contact_history_h

#include <npt_dealii/contact/closest_point_projection.h>

namespace NPT
{
  /**
   * Committed contact state. It changes only when a load step is accepted, so
   * a step is a pure function of (accepted state, increment).
   */
  template <int dim>
  struct ContactHistory
  {
    /// Friction traction of every contact node: t^a_n on the tangents of the
    /// secondary surface or t_{a,n} on those of the primary one, by the measure
    /// of slip.
    std::vector<std::array<double, dim - 1>> traction;
    /// Multiplier of the augmented Lagrangian of every node [MPa].
    std::vector<double> multiplier;
    /// Factor by which the augmented Lagrangian has let both penalties grow.
    double penalty_scale = 1.;
    /// Closest point of every Gauss point: reference of the slip increment.
    std::vector<ProjectionStart<dim>> closest;
  };
} // namespace NPT

#endif
