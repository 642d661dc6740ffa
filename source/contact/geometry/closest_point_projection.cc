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



  namespace
  {
    // One projection: the point u that Newton's method has reached, the
    // geometry c there, and the piece between C0 knots in which it moves.
    template <int dim>
    class Projection
    {
    public:
      static constexpr int m = dim - 1;

      Projection(const ContactSurface<dim>         &surface,
                 const std::vector<Point<dim>>     &positions,
                 const Point<dim>                  &point,
                 const std::array<double, dim - 1> &start,
                 ClosestPoint<dim>                 &result);

      // Minimize the distance, (10); false if the iteration fails.
      bool
      minimize();

      // Gap and normal at the closest point, (9) and (A15).
      void
      set_gap(const bool third_derivatives);

      // What was found, to where the caller wants it.
      void
      hand_over()
      {
        if (c_ != &result_)
          std::swap(*c_, result_);
      }

    private:
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
      void
      finish(const bool *free);
      double
      side_of_kink(const Tensor<1, dim> &n);

      void
      evaluate(const std::array<double, m> &u,
               const Segment<m>            &segment,
               const unsigned int           n_derivatives,
               ClosestPoint<dim>           &c) const
      {
        evaluate_geometry(
          surface_, positions_, point_, u, segment, n_derivatives, c);
      }

      const ContactSurface<dim>     &surface_;
      const IGASurface<dim>         &face_;
      const std::vector<Point<dim>> &positions_;
      const Point<dim>              &point_;

      std::array<std::pair<double, double>, m> domain_, piece_;
      std::array<double, m>                    u_;
      Segment<m>                               segment_ = {};
      // The best point so far and one that is tried: they change their places.
      ClosestPoint<dim> *c_;
      ClosestPoint<dim> *trial_;
      ClosestPoint<dim> &result_;
      double             distance2_;
      unsigned int       n_changes_ = 0;
    };



    // The trial point's vectors are kept between calls: allocation would cost
    // more than the geometry itself.
    template <int dim>
    ClosestPoint<dim> &
    trial_point()
    {
      static thread_local ClosestPoint<dim> trial;
      return trial;
    }



    template <int dim>
    Projection<dim>::Projection(const ContactSurface<dim>         &surface,
                                const std::vector<Point<dim>>     &positions,
                                const Point<dim>                  &point,
                                const std::array<double, dim - 1> &start,
                                ClosestPoint<dim>                 &result)
      : surface_(surface)
      , face_(surface.surface())
      , positions_(positions)
      , point_(point)
      , u_(start)
      , c_(&result)
      , trial_(&trial_point<dim>())
      , result_(result)
    {
      for (int k = 0; k < m; ++k)
        {
          const auto &breaks = face_.segment_breaks(k);
          domain_[k]         = {breaks.front(), breaks.back()};
          u_[k] =
            std::min(std::max(u_[k], domain_[k].first), domain_[k].second);
          segment_[k] = face_.find_segment(k, u_[k]);
          piece_[k]   = surface_.smooth_piece(k, segment_[k]);
        }
      c_->found       = false;
      c_->edge_radius = 0.;
      c_->on_boundary = false;
      evaluate(u_, segment_, 2, *c_);
      distance2_ = c_->r.norm_square();
    }



    template <int dim>
    bool
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
            return false; // degenerate surface
          if (!newton.any_free || last || newton.length == 0. ||
              newton.decrement <= 0)
            {
              // Stationary in this piece.
              if (change_piece(newton.free))
                {
                  last = false;
                  continue;
                }
              finish(newton.free);
              return true;
            }

          const double scale =
            std::sqrt(distance2_) + std::sqrt(newton.metric[0]);
          last = !newton.gauss_newton && newton.length <= length_last * scale;
          if (!line_search(newton, last))
            {
              // Too near for comparing distances, too far for the last step
              // (large coordinates): Newton's step is still the better guess.
              if (newton.gauss_newton || newton.length > 1e-5 * scale)
                return false;
              last = true;
            }
        }
      return false;
    }



    template <int dim>
    bool
    Projection<dim>::compute_step(Step &newton) const
    {
      // Half the gradient of the squared distance; its Hessian H_ab of (A8).
      for (int k = 0; k < m; ++k)
        {
          newton.gradient[k] = -(c_->r * c_->a[k]);
          newton.metric[k]   = c_->a[k].norm_square();
          newton.step[k]     = 0;
          const bool at_low  = u_[k] <= piece_[k].first;
          const bool at_high = u_[k] >= piece_[k].second;
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
            c_->a[k] * c_->a[l] -
            c_->r * c_->x_second[SymmetricIndices<m>::second(k, l)];
      if (!solve(newton))
        {
          newton.gauss_newton = true;
          for (int k = 0; k < m; ++k)
            for (int l = 0; l < m; ++l)
              newton.H[k][l] = c_->a[k] * c_->a[l];
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
            const bool high = u_[k] >= piece_[k].second;
            if ((high && u_[k] >= domain_[k].second) ||
                (!high && u_[k] <= domain_[k].first))
              continue;
            Segment<m> other = segment_;
            other[k] += high ? 1 : -1;
            evaluate(u_, other, 2, *trial_);
            const double slope = -(trial_->r * trial_->a[k]);
            const double size  = trial_->a[k].norm() * trial_->r.norm() * 1e-12;
            if ((high && slope < -size) || (!high && slope > size))
              {
                segment_  = other;
                piece_[k] = surface_.smooth_piece(k, segment_[k]);
                std::swap(c_, trial_);
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
              u_new[k]       = std::min(std::max(u_[k] + alpha * newton.step[k],
                                           piece_[k].first),
                                  piece_[k].second);
              segment_new[k] = segment_in_piece(face_, k, piece_[k], u_new[k]);
              predicted += newton.gradient[k] * (u_new[k] - u_[k]);
            }
          evaluate(u_new, segment_new, 2, *trial_);
          const double trial2 = trial_->r.norm_square();
          if (last ||
              (predicted < 0 && trial2 <= distance2_ + 2e-4 * predicted))
            {
              u_         = u_new;
              segment_   = segment_new;
              distance2_ = trial2;
              std::swap(c_, trial_);
              return true;
            }
        }
      return false;
    }



    template <int dim>
    void
    Projection<dim>::finish(const bool *free)
    {
      c_->found = true;
      for (int k = 0; k < m; ++k)
        {
          c_->free[k] = free[k];
          // Where another piece of the strand continues the surface, its end
          // is not a boundary of the body.
          if (!free[k] &&
              ((u_[k] <= domain_[k].first &&
                !(k == surface_.along() && surface_.neighbor(0) >= 0)) ||
               (u_[k] >= domain_[k].second &&
                !(k == surface_.along() && surface_.neighbor(1) >= 0))))
            c_->on_boundary = true;
        }
    }



    // At a C0 knot the mean of the adjacent normals tells inside (-1) from
    // outside (1).
    template <int dim>
    double
    Projection<dim>::side_of_kink(const Tensor<1, dim> &n)
    {
      Tensor<1, dim> mean = n;
      for (int k = 0; k < m; ++k)
        if (!c_->free[k] && u_[k] > domain_[k].first &&
            u_[k] < domain_[k].second)
          {
            Segment<m> other = segment_;
            other[k] += u_[k] >= piece_[k].second ? 1 : -1;
            evaluate(u_, other, 2, *trial_);
            mean += unit_normal(surface_, trial_->a);
          }
      return mean * c_->r >= 0 ? 1. : -1.;
    }



    template <int dim>
    void
    Projection<dim>::set_gap(const bool third_derivatives)
    {
      if (third_derivatives || c_->on_boundary)
        evaluate(u_, segment_, 3, *c_);

      bool all_free = true;
      for (int k = 0; k < m; ++k)
        all_free = all_free && c_->free[k];

      const Tensor<1, dim> n = unit_normal(surface_, c_->a);
      const double         r = c_->r.norm();
      if (all_free || r < 1e-12 * c_->a[0].norm())
        {
          c_->normal = n;
          c_->gap    = n * c_->r;
          return;
        }

      // Edge or corner. A sharp boundary would make the gap of a penetrating
      // point that slides over it jump from -d to +d: contact sees it rounded,
      // (A15), C1 where the surface ends. Without a radius the point is outside
      // of the body.
      c_->surface_normal = n;
      if (c_->on_boundary && surface_.edge_radius() > 0.)
        {
          c_->edge_radius = surface_.edge_radius();
          c_->normal      = c_->r / r;
          c_->gap         = RoundedEdge(c_->edge_radius, r, n * c_->r).gap;
          return;
        }
      const double side = c_->on_boundary ? 1. : side_of_kink(n);
      c_->normal        = side * c_->r / r;
      c_->gap           = side * r;
    }
  } // namespace



  template <int dim>
  void
  project(const ContactSurface<dim>         &surface,
          const std::vector<Point<dim>>     &positions,
          const Point<dim>                  &point,
          const std::array<double, dim - 1> &start,
          const bool                         third_derivatives,
          ClosestPoint<dim>                 &result)
  {
    Projection<dim> projection(surface, positions, point, start, result);
    if (projection.minimize())
      projection.set_gap(third_derivatives);
    projection.hand_over();
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
