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
    double maximum_penetration; ///< deeper closest points are rejected [mm]

    /// A point that lies deeper is taken for one behind the body: it carries
    /// nothing.
    bool
    is_admissible(const ClosestPoint<dim> &c) const
    {
      return c.gap > -maximum_penetration;
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
} // namespace NPT

#endif
