// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cells of a patch as rational Bezier solids, in which points can
// be found.

#ifndef npt_dealii_iga_bezier_body_h
#define npt_dealii_iga_bezier_body_h

#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/numerics/rtree.h>

#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace NPT
{
  /**
   * A patch in some configuration, cell by cell in rational Bezier form,
   *
   * @f[ x(\xi) = \frac{\sum_b w_b B_b(\xi) x_b}{\sum_b w_b B_b(\xi)}, \qquad
   *     \xi \in [0,1]^3 , @f]
   *
   * whatever the basis of the space. Answers whether a point lies in it, and
   * how far from its lateral faces: those of the directions across (1) and
   * through (2); the ends of the direction along (0) are cuts, not surfaces.
   */
  class BezierBody
  {
  public:
    /// A point of the body: cell and local coordinates.
    struct Place
    {
      std::array<unsigned int, 3> span;
      std::array<double, 3>       xi;
    };

    /// @param positions Of all control points of the space [mm].
    BezierBody(const IGASpace<3>                   &space,
               const unsigned int                   patch,
               const std::vector<dealii::Point<3>> &positions);

    /// The body under a map of points that is affine in each Bezier point's
    /// index: map(c, b, x_b) is the new Bezier point b of cell c.
    BezierBody
    mapped(const std::function<dealii::Point<3>(const unsigned int      cell,
                                                const unsigned int      b,
                                                const dealii::Point<3> &x)>
             &map) const;

    unsigned int
    n_cells() const
    {
      return points_.size();
    }
    unsigned int
    n_spans(const unsigned int direction) const
    {
      return n_spans_[direction];
    }
    const dealii::BoundingBox<3> &
    box() const
    {
      return box_;
    }
    const std::vector<dealii::Point<3>> &
    bezier_points(const unsigned int cell) const
    {
      return points_[cell];
    }

    dealii::Point<3>
    value(const Place &place) const;

    /// Where a point lies in the body; nothing if it is outside.
    std::optional<Place>
    find(const dealii::Point<3> &x) const;

    /**
     * Distance of a point of the body from the nearest lateral face, along
     * the parametric lines through it [mm].
     *
     * @param edge_radius Radius r of the edges where lateral faces meet [mm].
     *   Nearer than r to both, with the distances a and b from them, the depth
     *   is r - ((r - a)^2 + (r - b)^2)^(1/2), negative beyond the round edge.
     */
    double
    depth(const Place &place, const double edge_radius = 0.) const;

  private:
    using Entry = std::pair<dealii::BoundingBox<3>, unsigned int>;

    unsigned int
    cell_number(const std::array<unsigned int, 3> &span) const
    {
      return span[0] + n_spans_[0] * (span[1] + n_spans_[1] * span[2]);
    }
    // Boxes of the cells and of the body.
    void
    make_boxes();
    // x(xi) and its derivatives.
    dealii::Point<3>
    evaluate(const unsigned int                   cell,
             const std::array<double, 3>         &xi,
             std::array<dealii::Tensor<1, 3>, 3> *derivatives) const;
    // Newton's method for x(xi) = x; false if it leaves the cell.
    bool
    invert(const unsigned int      cell,
           const dealii::Point<3> &x,
           std::array<double, 3>  &xi) const;

    unsigned int                               degree_;
    std::array<unsigned int, 3>                n_spans_;
    std::vector<std::array<unsigned int, 3>>   spans_;  // by cell
    std::vector<std::vector<dealii::Point<3>>> points_; // by cell
    std::vector<std::vector<double>>           weights_;
    std::vector<dealii::BoundingBox<3>>        boxes_; // by cell
    dealii::BoundingBox<3>                     box_;
    dealii::RTree<Entry>                       tree_;
  };
} // namespace NPT

#endif
