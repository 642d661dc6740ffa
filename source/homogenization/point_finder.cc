// SPDX-License-Identifier: LGPL-2.1-or-later
// The search for control points by position.

#include <npt_dealii/homogenization/point_finder.h>

#include <boost/geometry/geometries/box.hpp>

#include <algorithm>
#include <iterator>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  PointFinder::PointFinder(const std::vector<Entry> &entries,
                           const double              tolerance)
    : tolerance_(tolerance)
    , tree_(entries.begin(), entries.end())
  {}



  int
  PointFinder::find(const Point<3> &P) const
  {
    const Tensor<1, 3> d({tolerance_, tolerance_, tolerance_});
    std::vector<Entry> found;
    tree_.query(boost::geometry::index::intersects(
                  boost::geometry::model::box<Point<3>>(P - d, P + d)),
                std::back_inserter(found));
    return found.empty() ? -1 : static_cast<int>(found[0].second);
  }



  BundlePointFinder::BundlePointFinder(const FabricCell  &cell,
                                       const IGASpace<3> &space)
    : tolerance_(1e-7 * cell.parameters().crossing_spacing.smaller())
  {
    std::map<FiberBundle::Family, std::vector<PointFinder::Entry>> entries;
    for (unsigned int b = 0; b < space.n_patches(); ++b)
      {
        const FiberBundle::Family family = cell.bundles()[b].family;
        Box box(Point<3>(1e99, 1e99, 1e99), Point<3>(-1e99, -1e99, -1e99));
        for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
          {
            const unsigned int A = space.control_point(b, l);
            const Point<3>    &P = space.control_points()[A];
            entries[family].emplace_back(P, A);
            for (unsigned int i = 0; i < 3; ++i)
              {
                box.first[i]  = std::min(box.first[i], P[i]);
                box.second[i] = std::max(box.second[i], P[i]);
              }
          }
        boxes_[family].push_back(box);
      }
    for (const auto &[family, points] : entries)
      finders_.emplace(family, PointFinder(points, tolerance_));
  }



  int
  BundlePointFinder::find(const FiberBundle::Family family,
                          const Point<3>           &P) const
  {
    return finders_.at(family).find(P);
  }



  bool
  BundlePointFinder::inside_base_cell(const FiberBundle::Family family,
                                      const Point<3>           &P) const
  {
    for (const Box &box : boxes_.at(family))
      {
        bool inside = true;
        for (unsigned int i = 0; i < 3; ++i)
          inside = inside && P[i] > box.first[i] + tolerance_ &&
                   P[i] < box.second[i] - tolerance_;
        if (inside)
          return true;
      }
    return false;
  }
} // namespace NPT
