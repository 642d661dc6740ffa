// SPDX-License-Identifier: LGPL-2.1-or-later
// Closest point projection by a bounded, damped Newton method.

#include <npt_dealii/contact/closest_point_projection.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    template <int m>
    using Segment = std::array<unsigned int, m>;

    // Surface point and derivatives at u with the polynomial of a given
    // segment.
    template <int dim>
    void
    evaluate_geometry(const ContactSurface<dim>         &surface,
                      const std::vector<Point<dim>>     &positions,
                      const Point<dim>                  &point,
                      const std::array<double, dim - 1> &u,
                      const Segment<dim - 1>            &segment,
                      const unsigned int                 n_derivatives,
                      ClosestPoint<dim>                 &c)
    {
      constexpr int m = dim - 1;
      surface.surface().evaluate(u, n_derivatives, c.shape, &segment);
      c.u       = u;
      c.segment = segment;

      const unsigned int n = c.shape.lattice.size();
      Tensor<1, dim>     x;
      for (auto &t : c.a)
        t = 0;
      for (auto &t : c.x_second)
        t = 0;
      for (auto &t : c.x_third)
        t = 0;
      for (unsigned int l = 0; l < n; ++l)
        {
          const Point<dim> &P = positions[c.shape.lattice[l]];
          x += c.shape.value[l] * P;
          for (unsigned int k = 0; k < m; ++k)
            c.a[k] += c.shape.first[k][l] * P;
          for (unsigned int k = 0; k < c.x_second.size(); ++k)
            c.x_second[k] += c.shape.second[k][l] * P;
          if (n_derivatives >= 3)
            for (unsigned int k = 0; k < c.x_third.size(); ++k)
              c.x_third[k] += c.shape.third[k][l] * P;
        }
      c.r = point - x;
    }

    // Segment of the piece [low, high] that contains u; at the upper end of
    // the piece the last one of the piece, not the first of the next one.
    template <int dim>
    unsigned int
    segment_in_piece(const IGASurface<dim>           &face,
                     const unsigned int               direction,
                     const std::pair<double, double> &piece,
                     const double                     u)
    {
      unsigned int e = face.find_segment(direction, u);
      while (e > 0 && face.segment_breaks(direction)[e] >= piece.second)
        --e;
      return e;
    }

    template <int dim>
    Tensor<1, dim>
    unit_normal(const ContactSurface<dim>                 &surface,
                const std::array<Tensor<1, dim>, dim - 1> &a)
    {
      Tensor<1, dim> n;
      if constexpr (dim == 3)
        n = cross_product_3d(a[0], a[1]);
      else
        n = cross_product_2d(a[0]);
      return surface.orientation() * n / n.norm();
    }
  } // namespace



  RoundedEdge::RoundedEdge(const double R, const double rho, const double c)
  {
    // On the axis of the rounding the direction is lost; a body that deep
    // inside is never loaded, it only must not divide by zero.
    const double q =
      std::max(std::sqrt(std::max(0., rho * rho + 2. * R * c + R * R)),
               1e-8 * R);
    gap                  = q - R;
    by_distance          = rho / q;
    by_height            = R / q;
    by_distance_distance = 1. / q - rho * rho / (q * q * q);
    by_distance_height   = -rho * R / (q * q * q);
    by_height_height     = -R * R / (q * q * q);
  }



  template <int dim>
  void
  project(const ContactSurface<dim>         &surface,
          const std::vector<Point<dim>>     &positions,
          const Point<dim>                  &point,
          const std::array<double, dim - 1> &start,
          const bool                         third_derivatives,
          ClosestPoint<dim>                 &c)
  {
    constexpr int          m    = dim - 1;
    const IGASurface<dim> &face = surface.surface();

    std::array<std::pair<double, double>, m> domain, piece;
    std::array<double, m>                    u       = start;
    Segment<m>                               segment = {};
    for (int k = 0; k < m; ++k)
      {
        const auto &breaks = face.segment_breaks(k);
        domain[k]          = {breaks.front(), breaks.back()};
        u[k] = std::min(std::max(u[k], domain[k].first), domain[k].second);
        segment[k] = face.find_segment(k, u[k]);
        piece[k]   = surface.smooth_piece(k, segment[k]);
      }

    // Its vectors are kept between calls: allocation would cost more than the
    // geometry itself.
    static thread_local ClosestPoint<dim> trial;
    c.found       = false;
    c.edge_radius = 0.;
    c.on_boundary = false;
    evaluate_geometry(surface, positions, point, u, segment, 2, c);
    double       distance2 = c.r.norm_square();
    unsigned int n_changes = 0;
    // Newton's step below this part of the size doubles its digits: the next
    // point is exact to rounding, and comparing distances means nothing there.
    const double length_last = 1e-8;
    bool         last        = false;

    for (unsigned int iteration = 0; iteration < 100; ++iteration)
      {
        // Half the gradient and Hessian of the squared distance.
        double gradient[m], H[m][m], metric[m];
        bool   free[m];
        for (int k = 0; k < m; ++k)
          {
            gradient[k]        = -(c.r * c.a[k]);
            metric[k]          = c.a[k].norm_square();
            const bool at_low  = u[k] <= piece[k].first;
            const bool at_high = u[k] >= piece[k].second;
            free[k] =
              !((at_low && gradient[k] > 0) || (at_high && gradient[k] < 0));
            // A direction without extent (or not a number).
            const double width = domain[k].second - domain[k].first;
            if (!(metric[k] * width * width > 1e-24 * distance2))
              return;
          }
        for (int k = 0; k < m; ++k)
          for (int l = 0; l < m; ++l)
            H[k][l] = c.a[k] * c.a[l] -
                      c.r * c.x_second[SymmetricIndices<m>::second(k, l)];

        double step[m];
        for (int k = 0; k < m; ++k)
          step[k] = 0;
        bool any_free = false, gauss_newton = false;
        for (int k = 0; k < m; ++k)
          any_free = any_free || free[k];
        if (any_free)
          {
            for (int attempt = 0; attempt < 2; ++attempt)
              {
                if (m == 2 && free[0] && free[m - 1])
                  {
                    const double det =
                      H[0][0] * H[m - 1][m - 1] - H[0][m - 1] * H[0][m - 1];
                    if (H[0][0] > 1e-3 * metric[0] &&
                        det > 1e-6 * metric[0] * metric[m - 1])
                      {
                        step[0] = -(H[m - 1][m - 1] * gradient[0] -
                                    H[0][m - 1] * gradient[m - 1]) /
                                  det;
                        step[m - 1] = -(H[0][0] * gradient[m - 1] -
                                        H[0][m - 1] * gradient[0]) /
                                      det;
                        break;
                      }
                  }
                else
                  {
                    const int k = free[0] ? 0 : m - 1;
                    if (H[k][k] > 1e-3 * metric[k])
                      {
                        step[k] = -gradient[k] / H[k][k];
                        break;
                      }
                  }
                if (gauss_newton)
                  return; // degenerate surface: found stays false
                gauss_newton = true;
                for (int k = 0; k < m; ++k)
                  for (int l = 0; l < m; ++l)
                    H[k][l] = c.a[k] * c.a[l];
              }
          }

        double decrement = 0, length = 0;
        for (int k = 0; k < m; ++k)
          if (free[k])
            {
              decrement -= gradient[k] * step[k];
              length =
                std::max(length, std::abs(step[k]) * std::sqrt(metric[k]));
            }
        const double scale = std::sqrt(distance2) + std::sqrt(metric[0]);

        if (!any_free || last || length == 0. || decrement <= 0)
          {
            // Stationary in this piece: look across the C0 knots we are held
            // at; the neighbor may lead further down.
            bool changed = false;
            for (int k = 0; k < m && !changed; ++k)
              if (!free[k] && n_changes < 40)
                {
                  const bool high = u[k] >= piece[k].second;
                  if ((high && u[k] >= domain[k].second) ||
                      (!high && u[k] <= domain[k].first))
                    continue;
                  Segment<m> other = segment;
                  other[k] += high ? 1 : -1;
                  evaluate_geometry(
                    surface, positions, point, u, other, 2, trial);
                  const double slope = -(trial.r * trial.a[k]);
                  const double size =
                    trial.a[k].norm() * trial.r.norm() * 1e-12;
                  if ((high && slope < -size) || (!high && slope > size))
                    {
                      segment  = other;
                      piece[k] = surface.smooth_piece(k, segment[k]);
                      std::swap(c, trial);
                      ++n_changes;
                      changed = true;
                      last    = false;
                    }
                }
            if (changed)
              continue;

            c.found = true;
            for (int k = 0; k < m; ++k)
              {
                c.free[k] = free[k];
                // Where another piece of the strand continues the surface,
                // its end is not a boundary of the body.
                if (!free[k] &&
                    ((u[k] <= domain[k].first &&
                      !(k == surface.along() && surface.neighbor(0) >= 0)) ||
                     (u[k] >= domain[k].second &&
                      !(k == surface.along() && surface.neighbor(1) >= 0))))
                  c.on_boundary = true;
              }
            break;
          }
        last = !gauss_newton && length <= length_last * scale;

        // Armijo backtracking along the projected path.
        double alpha    = 1;
        bool   accepted = false;
        for (unsigned int halving = 0; halving < 30 && !accepted;
             ++halving, alpha *= 0.5)
          {
            std::array<double, m> u_new;
            Segment<m>            segment_new;
            double                predicted = 0;
            for (int k = 0; k < m; ++k)
              {
                u_new[k] =
                  std::min(std::max(u[k] + alpha * step[k], piece[k].first),
                           piece[k].second);
                segment_new[k] = segment_in_piece(face, k, piece[k], u_new[k]);
                predicted += gradient[k] * (u_new[k] - u[k]);
              }
            evaluate_geometry(
              surface, positions, point, u_new, segment_new, 2, trial);
            const double trial2 = trial.r.norm_square();
            if (last ||
                (predicted < 0 && trial2 <= distance2 + 2e-4 * predicted))
              {
                u         = u_new;
                segment   = segment_new;
                distance2 = trial2;
                accepted  = true;
                std::swap(c, trial);
              }
          }
        if (!accepted)
          {
            // Too near for comparing distances, too far for the last step
            // (large coordinates): Newton's step is still the better guess.
            if (gauss_newton || length > 1e-5 * scale)
              break;
            last = true;
          }
      }
    if (!c.found)
      return;

    if (third_derivatives || c.on_boundary)
      evaluate_geometry(surface, positions, point, u, segment, 3, c);

    bool all_free = true;
    for (int k = 0; k < m; ++k)
      all_free = all_free && c.free[k];

    const Tensor<1, dim> n = unit_normal(surface, c.a);
    const double         r = c.r.norm();
    if (all_free || r < 1e-12)
      {
        c.normal = n;
        c.gap    = n * c.r;
        return;
      }

    // Edge or corner. A sharp boundary would make the gap of a penetrating
    // point that slides over it jump from -d to +d: contact sees it rounded,
    // (A15), C1 where the surface ends. Without a radius the point is outside
    // of the body. At a C0 knot the mean of the adjacent normals tells inside
    // from outside.
    double side = 1;
    if (c.on_boundary)
      {
        if (surface.edge_radius() > 0.)
          {
            c.edge_radius    = surface.edge_radius();
            c.surface_normal = n;
            c.normal         = c.r / r;
            c.gap            = RoundedEdge(c.edge_radius, r, n * c.r).gap;
            return;
          }
      }
    else
      {
        Tensor<1, dim> mean = n;
        for (int k = 0; k < m; ++k)
          if (!c.free[k] && u[k] > domain[k].first && u[k] < domain[k].second)
            {
              Segment<m> other = segment;
              other[k] += u[k] >= piece[k].second ? 1 : -1;
              evaluate_geometry(surface, positions, point, u, other, 2, trial);
              mean += unit_normal(surface, trial.a);
            }
        side = mean * c.r >= 0 ? 1. : -1.;
      }
    c.normal = side * c.r / r;
    c.gap    = side * r;
  }

  template void
  project(const ContactSurface<2> &,
          const std::vector<Point<2>> &,
          const Point<2> &,
          const std::array<double, 1> &,
          const bool,
          ClosestPoint<2> &);
  template void
  project(const ContactSurface<3> &,
          const std::vector<Point<3>> &,
          const Point<3> &,
          const std::array<double, 2> &,
          const bool,
          ClosestPoint<3> &);
} // namespace NPT
