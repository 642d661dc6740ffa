// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the search for control points by their reference position.

#ifndef npt_dealii_homogenization_point_finder_h
#define npt_dealii_homogenization_point_finder_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/point.h>
#include <deal.II/numerics/rtree.h>

#include <array>
#include <map>
#include <utility>
#include <vector>

namespace NPT
{
  /// Finds numbered points by position, up to a tolerance.
  class PointFinder
  {
  public:
    using Entry = std::pair<dealii::Point<3>, unsigned int>;

    PointFinder(const std::vector<Entry> &entries, const double tolerance);

    /// Number of a point at a position, or -1.
    int
    find(const dealii::Point<3> &P) const;

  private:
    double tolerance_;
    boost::geometry::index::rtree<Entry, boost::geometry::index::rstar<16>>
      tree_;
  };

  /// Finds control points of a family of bundles of a cell.
  class BundlePointFinder
  {
  public:
    BundlePointFinder(const FabricCell &cell, const IGASpace<3> &space);

    /// Control point at a position, or -1.
    int
    find(const FiberBundle::Family family, const dealii::Point<3> &P) const;

    /// Whether a position lies inside the box of a bundle of the base cell.
    bool
    inside_base_cell(const FiberBundle::Family family,
                     const dealii::Point<3>   &P) const;

  private:
    using Box = std::pair<dealii::Point<3>, dealii::Point<3>>;

    const double                                    tolerance_;
    std::map<FiberBundle::Family, PointFinder>      finders_;
    std::map<FiberBundle::Family, std::vector<Box>> boxes_;
  };
} // namespace NPT

#endif
