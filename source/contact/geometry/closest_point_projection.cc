// SPDX-License-Identifier: LGPL-2.1-or-later
// Closest point projection by a bounded, damped Newton method.

#include <npt_dealii/contact/geometry/closest_point_projection.h>

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

    // What is kept of the closest point, at u with the polynomials of a given
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



  namespace
  {
    // One projection: the place that Newton's method has reached, and the piece
    // between C0 knots in which it moves.
    template <int dim>
    class Projection
    {
    public:
      static constexpr int m = dim - 1;

      Projection(const ContactSurface<dim>         &surface,
                 const std::vector<Point<dim>>     &positions,
                 const Point<dim>                  &point,
                 const std::array<double, dim - 1> &start);

      // Minimize the distance, (10); found = false if the iteration fails.
      ClosestPlace<dim>
      minimize();

    private:
      // A point of the surface.
      struct Place
      {
        std::array<double, m>         u;
        Segment<m>                    segment;
        Tensor<1, dim>                r; // to the point in space
        std::array<Tensor<1, dim>, m> a;
        std::array<Tensor<1, dim>, SymmetricIndices<m>::n_second> x_second;
      };

      // Newton's step for half the squared distance.
      struct Step
      {
        double gradient[m], H[m][m], metric[m];
        bool   free[m];
        double step[m];
        bool   any_free     = false;
        bool   gauss_newton = false;
        double decrement    = 0;
        double length       = 0; // [mm]
      };

      bool
      compute_step(Step &newton) const;
      static bool
      solve(Step &newton);
      bool
      change_piece(const bool *free);
      bool
      line_search(const Step &newton, const bool last);
      ClosestPlace<dim>
      found(const bool *free) const;

      Place
      place_at(const std::array<double, m> &u, const Segment<m> &segment) const
      {
        const SurfaceJet<dim> jet = face_.jet(u, positions_, segment);
        return {u, segment, point_ - Point<dim>(jet.x), jet.first, jet.second};
      }

      const ContactSurface<dim>     &surface_;
      const IGASurface<dim>         &face_;
      const std::vector<Point<dim>> &positions_;
      const Point<dim>              &point_;

      std::array<std::pair<double, double>, m> domain_, piece_;
      Place                                    here_;
      double                                   distance2_;
      unsigned int                             n_changes_ = 0;
    };



    template <int dim>
    Projection<dim>::Projection(const ContactSurface<dim>         &surface,
                                const std::vector<Point<dim>>     &positions,
                                const Point<dim>                  &point,
                                const std::array<double, dim - 1> &start)
      : surface_(surface)
      , face_(surface.surface())
      , positions_(positions)
      , point_(point)
    {
      std::array<double, m> u = start;
      Segment<m>            segment;
      for (int k = 0; k < m; ++k)
        {
          const auto &breaks = face_.segment_breaks(k);
          domain_[k]         = {breaks.front(), breaks.back()};
          u[k] = std::min(std::max(u[k], domain_[k].first), domain_[k].second);
          segment[k] = face_.find_segment(k, u[k]);
          piece_[k]  = surface_.smooth_piece(k, segment[k]);
        }
      here_      = place_at(u, segment);
      distance2_ = here_.r.norm_square();
    }



    template <int dim>
    ClosestPlace<dim>
    Projection<dim>::minimize()
    {
      // Newton's step below this part of the size doubles its digits: the next
      // point is exact to rounding, and comparing distances means nothing
      // there.
      const double length_last = 1e-8;
      bool         last        = false;
      for (unsigned int iteration = 0; iteration < 100; ++iteration)
        {
          Step newton;
          if (!compute_step(newton))
            return {}; // degenerate surface
          if (!newton.any_free || last || newton.length == 0. ||
              newton.decrement <= 0)
            {
              // Stationary in this piece.
              if (change_piece(newton.free))
                {
                  last = false;
                  continue;
                }
              return found(newton.free);
            }

          const double scale =
            std::sqrt(distance2_) + std::sqrt(newton.metric[0]);
          last = !newton.gauss_newton && newton.length <= length_last * scale;
          if (!line_search(newton, last))
            {
              // Too near for comparing distances, too far for the last step
              // (large coordinates): Newton's step is still the better guess.
              if (newton.gauss_newton || newton.length > 1e-5 * scale)
                return {};
              last = true;
            }
        }
      return {};
    }



    template <int dim>
    bool
    Projection<dim>::compute_step(Step &newton) const
    {
      // Half the gradient of the squared distance; its Hessian H_ab of (A8).
      for (int k = 0; k < m; ++k)
        {
          newton.gradient[k] = -(here_.r * here_.a[k]);
          newton.metric[k]   = here_.a[k].norm_square();
          newton.step[k]     = 0;
          const bool at_low  = here_.u[k] <= piece_[k].first;
          const bool at_high = here_.u[k] >= piece_[k].second;
          newton.free[k]     = !((at_low && newton.gradient[k] > 0) ||
                             (at_high && newton.gradient[k] < 0));
          newton.any_free    = newton.any_free || newton.free[k];
          // A direction without extent (or not a number).
          const double width = domain_[k].second - domain_[k].first;
          if (!(newton.metric[k] * width * width > 1e-24 * distance2_))
            return false;
        }
      if (!newton.any_free)
        return true;

      for (int k = 0; k < m; ++k)
        for (int l = 0; l < m; ++l)
          newton.H[k][l] =
            here_.a[k] * here_.a[l] -
            here_.r * here_.x_second[SymmetricIndices<m>::second(k, l)];
      if (!solve(newton))
        {
          newton.gauss_newton = true;
          for (int k = 0; k < m; ++k)
            for (int l = 0; l < m; ++l)
              newton.H[k][l] = here_.a[k] * here_.a[l];
          if (!solve(newton))
            return false;
        }
      for (int k = 0; k < m; ++k)
        if (newton.free[k])
          {
            newton.decrement -= newton.gradient[k] * newton.step[k];
            newton.length =
              std::max(newton.length,
                       std::abs(newton.step[k]) * std::sqrt(newton.metric[k]));
          }
      return true;
    }



    // The step in the free directions; false if H is not safely positive there.
    template <int dim>
    bool
    Projection<dim>::solve(Step &newton)
    {
      const auto &H        = newton.H;
      const auto &metric   = newton.metric;
      const auto &gradient = newton.gradient;
      if (m == 2 && newton.free[0] && newton.free[m - 1])
        {
          const double det =
            H[0][0] * H[m - 1][m - 1] - H[0][m - 1] * H[0][m - 1];
          if (!(H[0][0] > 1e-3 * metric[0] &&
                det > 1e-6 * metric[0] * metric[m - 1]))
            return false;
          newton.step[0] =
            -(H[m - 1][m - 1] * gradient[0] - H[0][m - 1] * gradient[m - 1]) /
            det;
          newton.step[m - 1] =
            -(H[0][0] * gradient[m - 1] - H[0][m - 1] * gradient[0]) / det;
          return true;
        }
      const int k = newton.free[0] ? 0 : m - 1;
      if (!(H[k][k] > 1e-3 * metric[k]))
        return false;
      newton.step[k] = -gradient[k] / H[k][k];
      return true;
    }



    // Look across the C0 knots at which we are held: the neighbor may lead
    // further down.
    template <int dim>
    bool
    Projection<dim>::change_piece(const bool *free)
    {
      for (int k = 0; k < m; ++k)
        if (!free[k] && n_changes_ < 40)
          {
            const bool high = here_.u[k] >= piece_[k].second;
            if ((high && here_.u[k] >= domain_[k].second) ||
                (!high && here_.u[k] <= domain_[k].first))
              continue;
            Segment<m> other = here_.segment;
            other[k] += high ? 1 : -1;
            const Place  there = place_at(here_.u, other);
            const double slope = -(there.r * there.a[k]);
            const double size  = there.a[k].norm() * there.r.norm() * 1e-12;
            if ((high && slope < -size) || (!high && slope > size))
              {
                here_     = there;
                piece_[k] = surface_.smooth_piece(k, other[k]);
                ++n_changes_;
                return true;
              }
          }
      return false;
    }



    // Armijo backtracking along the projected path; the last step is taken as
    // it is. False if no step lowers the distance.
    template <int dim>
    bool
    Projection<dim>::line_search(const Step &newton, const bool last)
    {
      double alpha = 1;
      for (unsigned int halving = 0; halving < 30; ++halving, alpha *= 0.5)
        {
          std::array<double, m> u_new;
          Segment<m>            segment_new;
          double                predicted = 0;
          for (int k = 0; k < m; ++k)
            {
              u_new[k] = std::min(std::max(here_.u[k] + alpha * newton.step[k],
                                           piece_[k].first),
                                  piece_[k].second);
              segment_new[k] = segment_in_piece(face_, k, piece_[k], u_new[k]);
              predicted += newton.gradient[k] * (u_new[k] - here_.u[k]);
            }
          const Place  trial  = place_at(u_new, segment_new);
          const double trial2 = trial.r.norm_square();
          if (last ||
              (predicted < 0 && trial2 <= distance2_ + 2e-4 * predicted))
            {
              here_      = trial;
              distance2_ = trial2;
              return true;
            }
        }
      return false;
    }



    template <int dim>
    ClosestPlace<dim>
    Projection<dim>::found(const bool *free) const
    {
      ClosestPlace<dim> place;
      place.found    = true;
      place.u        = here_.u;
      place.segment  = here_.segment;
      place.distance = here_.r.norm();
      for (int k = 0; k < m; ++k)
        {
          place.free[k] = free[k];
          // Where another piece of the strand continues the surface, its end
          // is not a boundary of the body.
          if (!free[k] &&
              ((here_.u[k] <= domain_[k].first &&
                !(k == surface_.along() && surface_.neighbor(0) >= 0)) ||
               (here_.u[k] >= domain_[k].second &&
                !(k == surface_.along() && surface_.neighbor(1) >= 0))))
            place.on_boundary = true;
        }
      return place;
    }



    // At a C0 knot the mean of the adjacent normals tells inside (-1) from
    // outside (1).
    template <int dim>
    double
    side_of_kink(const ContactSurface<dim>     &surface,
                 const std::vector<Point<dim>> &positions,
                 const ClosestPoint<dim>       &c)
    {
      Tensor<1, dim> mean = c.surface_normal;
      for (int k = 0; k < dim - 1; ++k)
        {
          const auto &breaks = surface.surface().segment_breaks(k);
          if (c.free[k] || c.u[k] <= breaks.front() || c.u[k] >= breaks.back())
            continue;
          Segment<dim - 1> other = c.segment;
          other[k] +=
            c.u[k] >= surface.smooth_piece(k, c.segment[k]).second ? 1 : -1;
          mean +=
            unit_normal(surface,
                        surface.surface().jet(c.u, positions, other).first);
        }
      return mean * c.r >= 0 ? 1. : -1.;
    }
  } // namespace



  template <int dim>
  ClosestPlace<dim>
  find_closest_place(const ContactSurface<dim>         &surface,
                     const std::vector<Point<dim>>     &positions,
                     const Point<dim>                  &point,
                     const std::array<double, dim - 1> &start)
  {
    return Projection<dim>(surface, positions, point, start).minimize();
  }



  template <int dim>
  void
  compute_closest_point(const ContactSurface<dim>     &surface,
                        const std::vector<Point<dim>> &positions,
                        const Point<dim>              &point,
                        const ClosestPlace<dim>       &place,
                        const bool                     third_derivatives,
                        ClosestPoint<dim>             &c)
  {
    static_cast<ClosestPlace<dim> &>(c) = place;
    c.edge_radius                       = 0.;
    if (!place.found)
      return;
    evaluate_geometry(surface,
                      positions,
                      point,
                      place.u,
                      place.segment,
                      third_derivatives || place.on_boundary ? 3 : 2,
                      c);

    bool all_free = true;
    for (const bool free : c.free)
      all_free = all_free && free;

    const Tensor<1, dim> n = unit_normal(surface, c.a);
    const double         r = c.r.norm();
    if (all_free || r < 1e-12 * c.a[0].norm())
      {
        c.normal = n;
        c.gap    = n * c.r;
        return;
      }

    // Edge or corner. A sharp boundary would make the gap of a penetrating
    // point that slides over it jump from -d to +d: contact sees it rounded,
    // (A15), C1 where the surface ends. Without a radius the point is outside
    // of the body.
    c.surface_normal = n;
    if (c.on_boundary && surface.edge_radius() > 0.)
      {
        c.edge_radius = surface.edge_radius();
        c.normal      = c.r / r;
        c.gap         = RoundedEdge(c.edge_radius, r, n * c.r).gap;
        return;
      }
    const double side =
      c.on_boundary ? 1. : side_of_kink(surface, positions, c);
    c.normal = side * c.r / r;
    c.gap    = side * r;
  }



  template <int dim>
  void
  project(const ContactSurface<dim>         &surface,
          const std::vector<Point<dim>>     &positions,
          const Point<dim>                  &point,
          const std::array<double, dim - 1> &start,
          const bool                         third_derivatives,
          ClosestPoint<dim>                 &result)
  {
    compute_closest_point(surface,
                          positions,
                          point,
                          find_closest_place(surface, positions, point, start),
                          third_derivatives,
                          result);
  }



#define NPT_INSTANTIATE(dim)                                           \
  template ClosestPlace<dim> find_closest_place(                       \
    const ContactSurface<dim> &,                                       \
    const std::vector<Point<dim>> &,                                   \
    const Point<dim> &,                                                \
    const std::array<double, dim - 1> &);                              \
  template void compute_closest_point(const ContactSurface<dim> &,     \
                                      const std::vector<Point<dim>> &, \
                                      const Point<dim> &,              \
                                      const ClosestPlace<dim> &,       \
                                      const bool,                      \
                                      ClosestPoint<dim> &);            \
  template void project(const ContactSurface<dim> &,                   \
                        const std::vector<Point<dim>> &,               \
                        const Point<dim> &,                            \
                        const std::array<double, dim - 1> &,           \
                        const bool,                                    \
                        ClosestPoint<dim> &);
  NPT_INSTANTIATE(2)
  NPT_INSTANTIATE(3)
#undef NPT_INSTANTIATE
} // namespace NPT
