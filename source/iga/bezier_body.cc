// SPDX-License-Identifier: LGPL-2.1-or-later
// Points of rational Bezier solids, and where a point lies in them.

#include <npt_dealii/iga/bezier_body.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NPT
{
  using dealii::BoundingBox;
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Bernstein polynomials of degree p at t, and their derivatives.
    struct Bernstein
    {
      std::vector<double> value, derivative;

      Bernstein(const unsigned int p, const double t)
        : value(p + 1, 0.)
        , derivative(p + 1, 0.)
      {
        value[0] = 1.;
        for (unsigned int k = 1; k <= p; ++k)
          {
            if (k == p)
              for (unsigned int a = 0; a <= p; ++a)
                derivative[a] =
                  p * ((a > 0 ? value[a - 1] : 0.) - (a < p ? value[a] : 0.));
            for (unsigned int a = k; a > 0; --a)
              value[a] = t * value[a - 1] + (1. - t) * value[a];
            value[0] *= 1. - t;
          }
      }
    };

    BoundingBox<3>
    box_around(const std::vector<Point<3>> &points)
    {
      std::pair<Point<3>, Point<3>> corners(points[0], points[0]);
      for (const Point<3> &x : points)
        for (unsigned int i = 0; i < 3; ++i)
          {
            corners.first[i]  = std::min(corners.first[i], x[i]);
            corners.second[i] = std::max(corners.second[i], x[i]);
          }
      return BoundingBox<3>(corners);
    }
  } // namespace



  BezierBody::BezierBody(const IGASpace<3>           &space,
                         const unsigned int           patch,
                         const std::vector<Point<3>> &positions)
    : degree_(space.degree(patch))
  {
    AssertDimension(positions.size(), space.n_control_points());
    for (unsigned int d = 0; d < 3; ++d)
      n_spans_[d] = space.patch(patch).knot_vector(d).n_spans();
    const unsigned int n_cells = n_spans_[0] * n_spans_[1] * n_spans_[2];
    spans_.resize(n_cells);
    points_.resize(n_cells);
    weights_.resize(n_cells);
    for (unsigned int c = 0; c < space.cells().size(); ++c)
      {
        if (space.cells()[c].patch != patch)
          continue;
        std::vector<std::vector<double>> coefficients;
        for (const unsigned int A : space.control_points_of_cell(c))
          coefficients.push_back(
            {positions[A][0], positions[A][1], positions[A][2]});
        const unsigned int number = cell_number(space.cells()[c].span);
        spans_[number]            = space.cells()[c].span;
        for (const auto &x :
             space.bezier_coefficients(c, coefficients, weights_[number]))
          points_[number].emplace_back(x[0], x[1], x[2]);
      }
    make_boxes();
  }



  BezierBody
  BezierBody::mapped(const std::function<Point<3>(const unsigned int,
                                                  const unsigned int,
                                                  const Point<3> &)> &map) const
  {
    BezierBody result(*this);
    for (unsigned int c = 0; c < n_cells(); ++c)
      for (unsigned int b = 0; b < points_[c].size(); ++b)
        result.points_[c][b] = map(c, b, points_[c][b]);
    result.make_boxes();
    return result;
  }



  void
  BezierBody::make_boxes()
  {
    // A rational Bezier solid lies in the convex hull of its points.
    boxes_.clear();
    std::vector<Entry> entries;
    for (unsigned int c = 0; c < n_cells(); ++c)
      {
        boxes_.push_back(box_around(points_[c]));
        entries.emplace_back(boxes_.back(), c);
      }
    box_ = boxes_[0];
    for (const auto &box : boxes_)
      box_.merge_with(box);
    tree_ = dealii::pack_rtree(entries);
  }



  Point<3>
  BezierBody::evaluate(const unsigned int           cell,
                       const std::array<double, 3> &xi,
                       std::array<Tensor<1, 3>, 3> *derivatives) const
  {
    const unsigned int             n = degree_ + 1;
    const std::array<Bernstein, 3> B = {{Bernstein(degree_, xi[0]),
                                         Bernstein(degree_, xi[1]),
                                         Bernstein(degree_, xi[2])}};
    Point<3>                       x;
    double                         W = 0;
    std::array<Tensor<1, 3>, 3>    dx;
    std::array<double, 3>          dW = {};
    unsigned int                   b  = 0; // the first direction runs fastest
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int i = 0; i < n; ++i, ++b)
          {
            const double    w = weights_[cell][b];
            const Point<3> &P = points_[cell][b];
            const double R = w * B[0].value[i] * B[1].value[j] * B[2].value[k];
            W += R;
            x += R * P;
            if (derivatives == nullptr)
              continue;
            const double by[3] = {
              w * B[0].derivative[i] * B[1].value[j] * B[2].value[k],
              w * B[0].value[i] * B[1].derivative[j] * B[2].value[k],
              w * B[0].value[i] * B[1].value[j] * B[2].derivative[k]};
            for (unsigned int d = 0; d < 3; ++d)
              {
                dW[d] += by[d];
                dx[d] += by[d] * P;
              }
          }
    x /= W;
    if (derivatives != nullptr)
      for (unsigned int d = 0; d < 3; ++d)
        (*derivatives)[d] = (dx[d] - dW[d] * x) / W;
    return x;
  }



  Point<3>
  BezierBody::value(const Place &place) const
  {
    return evaluate(cell_number(place.span), place.xi, nullptr);
  }



  bool
  BezierBody::invert(const unsigned int     cell,
                     const Point<3>        &x,
                     std::array<double, 3> &xi) const
  {
    const auto  &corners = boxes_[cell].get_boundary_points();
    const double size    = corners.first.distance(corners.second);
    xi                   = {{0.5, 0.5, 0.5}};
    for (unsigned int iteration = 0; iteration < 20; ++iteration)
      {
        std::array<Tensor<1, 3>, 3> a;
        const Tensor<1, 3>          r = x - evaluate(cell, xi, &a);
        if (r.norm() < 1e-10 * size)
          {
            for (const double t : xi)
              if (!(t > -1e-8 && t < 1. + 1e-8))
                return false;
            return true;
          }
        // Cramer's rule for sum_d a_d step_d = r.
        const double det = a[0] * cross_product_3d(a[1], a[2]);
        if (!(std::abs(det) > 0.))
          return false;
        const std::array<double, 3> step = {
          {r * cross_product_3d(a[1], a[2]) / det,
           a[0] * cross_product_3d(r, a[2]) / det,
           a[0] * cross_product_3d(a[1], r) / det}};
        // Far outside the rational map means nothing.
        for (unsigned int d = 0; d < 3; ++d)
          xi[d] = std::min(1.5, std::max(-0.5, xi[d] + step[d]));
      }
    return false;
  }



  std::optional<BezierBody::Place>
  BezierBody::find(const Point<3> &x) const
  {
    if (!box_.point_inside(x))
      return {};
    std::vector<Entry> candidates;
    tree_.query(boost::geometry::index::intersects(x),
                std::back_inserter(candidates));
    for (const Entry &candidate : candidates)
      {
        Place place;
        place.span = spans_[candidate.second];
        if (invert(candidate.second, x, place.xi))
          return place;
      }
    return {};
  }



  double
  BezierBody::depth(const Place &place, const double edge_radius) const
  {
    const Point<3> x       = value(place);
    const auto     nearest = [&](const unsigned int d) {
      double distance = std::numeric_limits<double>::max();
      for (unsigned int side = 0; side < 2; ++side)
        {
          Place on_face   = place;
          on_face.span[d] = side == 0 ? 0 : n_spans_[d] - 1;
          on_face.xi[d]   = side;
          distance        = std::min(distance, x.distance(value(on_face)));
        }
      return distance;
    };
    const double a = nearest(1), b = nearest(2);
    return a < edge_radius && b < edge_radius ?
             edge_radius - std::hypot(edge_radius - a, edge_radius - b) :
             std::min(a, b);
  }
} // namespace NPT
