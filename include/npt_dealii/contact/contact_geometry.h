// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a contact pair consists of: surfaces, Gauss points, averages,
// and where all that is at a displacement.

#ifndef npt_dealii_contact_contact_geometry_h
#define npt_dealii_contact_contact_geometry_h

#include <npt_dealii/contact/averaging.h>
#include <npt_dealii/contact/geometry/closest_point_projection.h>

namespace NPT
{
  /// Current control points of the surfaces of a contact pair.
  template <int dim>
  struct ContactPositions
  {
    std::vector<dealii::Point<dim>>              secondary;
    std::vector<std::vector<dealii::Point<dim>>> primaries;
  };

  /// The parts of a contact pair, constant during a run.
  template <int dim>
  struct ContactGeometry
  {
    ContactSurface<dim>                                    secondary;
    std::vector<ContactSurface<dim>>                       primaries;
    std::vector<typename IGASurface<dim>::QuadraturePoint> points;
    Averaging                                              averaging;
    /// Of the friction nodes: the same, or the Gauss points, (A27).
    Averaging friction_averaging;
    /// Deeper than this a point cannot be told from one behind the body [mm].
    double maximum_penetration;
    /// Of the thinner body [mm]: the reach beside the end of a surface.
    double thickness;

    bool
    is_deep(const ClosestPoint<dim> &c) const
    {
      return !(c.gap > -maximum_penetration);
    }

    void
    update_positions(const dealii::Vector<double> &displacement,
                     ContactPositions<dim>        &positions) const
    {
      secondary.update_positions(displacement, positions.secondary);
      positions.primaries.resize(primaries.size());
      for (unsigned int s = 0; s < primaries.size(); ++s)
        primaries[s].update_positions(displacement, positions.primaries[s]);
    }

    /// Current position x^s of a Gauss point.
    dealii::Point<dim>
    position(const ContactPositions<dim> &positions, const unsigned int q) const
    {
      dealii::Point<dim> x;
      const auto        &shape = points[q].shape;
      for (unsigned int l = 0; l < shape.lattice.size(); ++l)
        x += shape.value[l] * positions.secondary[shape.lattice[l]];
      return x;
    }
  };

  /**
   * Which Gauss points take part in contact during a load step, and with which
   * share: 1 for a point that has a partner, 0 for one beside the end of the
   * surface or behind the body, and between them a linear fading, (A20) of
   * doc/theory.md. Fixed during the step, so that the averages are those of
   * Averaging with other weights.
   */
  struct ContactReach
  {
    std::vector<double> of_point;         ///< omega_q, by Gauss point
    std::vector<double> of_node;          ///< s_I = sum_q A_Iq omega_q, by node
    std::vector<double> of_friction_node; ///< the same, by friction node

    bool
    has(const unsigned int q) const
    {
      return of_point[q] > 0.;
    }

    /// Weight of a point in the mean of node I, which has a point in reach.
    double
    weight(const unsigned int I, const Averaging::Entry &entry) const
    {
      return entry.weight * of_point[entry.point] / of_node[I];
    }

    /// Weight of a point in the mean of friction node J.
    double
    friction_weight(const unsigned int J, const Averaging::Entry &entry) const
    {
      return entry.weight * of_point[entry.point] / of_friction_node[J];
    }
  };
} // namespace NPT

#endif
