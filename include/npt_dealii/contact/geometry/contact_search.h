// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the broad phase: an R-tree over samples of the primary surfaces that
// gives start values for the closest point projection.

#ifndef npt_dealii_contact_geometry_contact_search_h
#define npt_dealii_contact_geometry_contact_search_h

#include <npt_dealii/contact/geometry/closest_point_projection.h>

#include <deal.II/numerics/rtree.h>

namespace NPT
{
  /**
   * Finds where on a set of primary surfaces to start a projection: the
   * nearest of a few sample points per knot span, by an R-tree. The answer
   * depends on the current positions only, never on earlier answers.
   */
  template <int dim>
  class ContactSearch
  {
  public:
    /**
     * @param positions Current control points of each surface.
     */
    ContactSearch(
      const std::vector<ContactSurface<dim>>             &surfaces,
      const std::vector<std::vector<dealii::Point<dim>>> &positions);

    /// The n nearest samples, nearest first.
    std::vector<ProjectionStart<dim>>
    nearest(const dealii::Point<dim> &point, const unsigned int n) const;

  private:
    using Entry = std::pair<dealii::Point<dim>, unsigned int>;
    std::vector<ProjectionStart<dim>> samples_;
    dealii::RTree<Entry>              tree_;
  };
} // namespace NPT

#endif
