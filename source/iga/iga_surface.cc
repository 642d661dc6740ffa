// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines surface functions from the extracted polynomials of each span.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/element_table.h>
#include <npt_dealii/iga/iga_surface.h>
#include <npt_dealii/iga/powers.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_bernstein.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Bounds of the arrays in LineFunctions; a round end has the functions of
    // two directions (a rounded kink those of two spans, which are fewer).
    constexpr unsigned int max_p           = 7;
    constexpr unsigned int max_n_functions = (max_p + 1) * (max_p + 1);

    // The functions of one direction and their first three derivatives.
    struct LineFunctions
    {
      unsigned int        first; // number of the first one in its direction
      const unsigned int *rows;  // of all, if they do not follow each other
      unsigned int        n;
      double              N[4][max_n_functions]; // [derivative][function]

      unsigned int
      number(const unsigned int i) const
      {
        return rows == nullptr ? first + i : rows[i];
      }
    };



    // Horner's rule for polynomials of t and their derivatives with respect to
    // u, du = h dt, up to the given order.
    template <unsigned int order>
    void
    evaluate_polynomials(const std::vector<std::vector<double>> &coefficients,
                         const double                            t,
                         const double                            h,
                         LineFunctions                          &functions)
    {
      functions.n = coefficients.size();
      for (unsigned int i = 0; i < functions.n; ++i)
        {
          const std::vector<double> &c    = coefficients[i];
          double                     v[4] = {0., 0., 0., 0.};
          for (int k = c.size() - 1; k >= 0; --k)
            {
              if constexpr (order >= 3)
                v[3] = v[3] * t + 3 * v[2];
              v[2] = v[2] * t + 2 * v[1];
              v[1] = v[1] * t + v[0];
              v[0] = v[0] * t + c[k];
            }
          double scale = 1;
          for (unsigned int d = 0; d <= order; ++d)
            {
              functions.N[d][i] = v[d] * scale;
              scale /= h;
            }
        }
    }



    template <int m>
    void
    resize(SurfaceShape<m>   &shape,
           const unsigned int n,
           const unsigned int n_derivatives)
    {
      shape.lattice.resize(n);
      shape.value.resize(n);
      if (n_derivatives >= 1)
        for (auto &d : shape.first)
          d.resize(n);
      if (n_derivatives >= 2)
        for (auto &d : shape.second)
          d.resize(n);
      if (n_derivatives >= 3)
        for (auto &d : shape.third)
          d.resize(n);
    }



    // A curve has the functions of its only direction.
    void
    multiply_directions(const std::array<LineFunctions, 1> &functions,
                        const unsigned int /*row_length*/,
                        const unsigned int n_derivatives,
                        SurfaceShape<1>   &shape)
    {
      const LineFunctions &f = functions[0];
      resize(shape, f.n, n_derivatives);
      for (unsigned int i = 0; i < f.n; ++i)
        {
          shape.lattice[i] = f.number(i);
          shape.value[i]   = f.N[0][i];
          if (n_derivatives >= 1)
            shape.first[0][i] = f.N[1][i];
          if (n_derivatives >= 2)
            shape.second[0][i] = f.N[2][i];
          if (n_derivatives >= 3)
            shape.third[0][i] = f.N[3][i];
        }
    }



    // Products of the directions, the first one fastest. The lattice has rows
    // of row_length control points.
    void
    multiply_directions(const std::array<LineFunctions, 2> &functions,
                        const unsigned int                  row_length,
                        const unsigned int                  n_derivatives,
                        SurfaceShape<2>                    &shape)
    {
      const LineFunctions &f = functions[0], &g = functions[1];
      resize(shape, f.n * g.n, n_derivatives);
      for (unsigned int j = 0, l = 0; j < g.n; ++j)
        for (unsigned int i = 0; i < f.n; ++i, ++l)
          {
            shape.lattice[l] = f.first + i + g.number(j) * row_length;
            shape.value[l]   = f.N[0][i] * g.N[0][j];
            if (n_derivatives >= 1)
              {
                shape.first[0][l] = f.N[1][i] * g.N[0][j];
                shape.first[1][l] = f.N[0][i] * g.N[1][j];
              }
            if (n_derivatives >= 2)
              for (unsigned int k = 0; k <= 2; ++k)
                shape.second[k][l] = f.N[2 - k][i] * g.N[k][j];
            if (n_derivatives >= 3)
              for (unsigned int k = 0; k <= 3; ++k)
                shape.third[k][l] = f.N[3 - k][i] * g.N[k][j];
          }
    }



    // Functions times their weights become rational ones by the quotient rule,
    // one order after the other.
    template <int m>
    void
    divide_by_weight_function(const std::vector<double> &weights,
                              const unsigned int         n_derivatives,
                              SurfaceShape<m>           &shape)
    {
      using Indices        = SymmetricIndices<m>;
      const unsigned int n = shape.value.size();
      double W = 0, W1[Indices::n_first] = {}, W2[Indices::n_second] = {},
             W3[Indices::n_third] = {};
      for (unsigned int l = 0; l < n; ++l)
        {
          const double w = weights[shape.lattice[l]];
          W += shape.value[l] *= w;
          if (n_derivatives >= 1)
            for (unsigned int k = 0; k < Indices::n_first; ++k)
              W1[k] += shape.first[k][l] *= w;
          if (n_derivatives >= 2)
            for (unsigned int k = 0; k < Indices::n_second; ++k)
              W2[k] += shape.second[k][l] *= w;
          if (n_derivatives >= 3)
            for (unsigned int k = 0; k < Indices::n_third; ++k)
              W3[k] += shape.third[k][l] *= w;
        }
      for (unsigned int l = 0; l < n; ++l)
        {
          const double R = shape.value[l] /= W;
          if (n_derivatives >= 1)
            for (unsigned int a = 0; a < m; ++a)
              shape.first[a][l] = (shape.first[a][l] - R * W1[a]) / W;
          if (n_derivatives >= 2)
            for (unsigned int a = 0; a < m; ++a)
              for (unsigned int b = a; b < m; ++b)
                {
                  double &R_ab = shape.second[Indices::second(a, b)][l];
                  R_ab         = (R_ab - shape.first[a][l] * W1[b] -
                          shape.first[b][l] * W1[a] -
                          R * W2[Indices::second(a, b)]) /
                         W;
                }
          if (n_derivatives >= 3)
            for (unsigned int a = 0; a < m; ++a)
              for (unsigned int b = a; b < m; ++b)
                for (unsigned int c = b; c < m; ++c)
                  {
                    double &R_abc = shape.third[Indices::third(a, b, c)][l];
                    const unsigned int ab = Indices::second(a, b),
                                       ac = Indices::second(a, c),
                                       bc = Indices::second(b, c);
                    R_abc =
                      (R_abc - shape.second[ab][l] * W1[c] -
                       shape.second[ac][l] * W1[b] -
                       shape.second[bc][l] * W1[a] -
                       shape.first[a][l] * W2[bc] - shape.first[b][l] * W2[ac] -
                       shape.first[c][l] * W2[ab] -
                       R * W3[Indices::third(a, b, c)]) /
                      W;
                  }
        }
    }


    // The point and its derivatives, from sums of homogeneous coordinates over
    // the functions, row by row.
    template <bool rational, int dim>
    SurfaceJet<dim>
    sum_of_functions(const std::array<LineFunctions, dim - 1> &N,
                     const unsigned int                        row_length,
                     const std::vector<Point<dim>>            &positions,
                     const std::vector<double>                &weights)
    {
      constexpr int          m             = dim - 1;
      constexpr unsigned int n_coordinates = rational ? dim + 1 : dim;
      using Coordinates                    = std::array<double, n_coordinates>;
      using Indices                        = SymmetricIndices<m>;
      Coordinates X{}, first[Indices::n_first]{}, second[Indices::n_second]{};
      const auto  add =
        [](Coordinates &to, const double factor, const Coordinates &from) {
          for (unsigned int c = 0; c < n_coordinates; ++c)
            to[c] += factor * from[c];
        };
      // Derivatives along the first parameter, of one row of the lattice.
      const auto derivatives_of_row = [&](const unsigned int begin) {
        std::array<Coordinates, 3> row{};
        for (unsigned int i = 0; i < N[0].n; ++i)
          {
            const unsigned int l = begin + i;
            Coordinates        point;
            const double       w = rational ? weights[l] : 1.;
            for (unsigned int c = 0; c < dim; ++c)
              point[c] = w * positions[l][c];
            if constexpr (rational)
              point[dim] = w;
            for (unsigned int d = 0; d < 3; ++d)
              add(row[d], N[0].N[d][i], point);
          }
        return row;
      };
      if constexpr (m == 1)
        {
          AssertThrow(N[0].rows == nullptr, dealii::ExcInternalError());
          const auto row = derivatives_of_row(N[0].first);
          X              = row[0];
          first[0]       = row[1];
          second[0]      = row[2];
        }
      else
        for (unsigned int j = 0; j < N[1].n; ++j)
          {
            const auto row =
              derivatives_of_row(N[0].first + N[1].number(j) * row_length);
            add(X, N[1].N[0][j], row[0]);
            add(first[0], N[1].N[0][j], row[1]);
            add(first[1], N[1].N[1][j], row[0]);
            for (unsigned int k = 0; k <= 2; ++k)
              add(second[k], N[1].N[k][j], row[2 - k]);
          }

      // Of the point and its derivatives by the quotient rule.
      SurfaceJet<dim> result;
      for (unsigned int c = 0; c < dim; ++c)
        {
          const auto quotient = [&](const Coordinates &Y, const double known) {
            if constexpr (rational)
              return (Y[c] - known) / X[dim];
            else
              return Y[c];
          };
          const auto weight = [](const Coordinates &Y) {
            return rational ? Y[n_coordinates - 1] : 0.;
          };
          result.x[c] = quotient(X, 0.);
          for (unsigned int a = 0; a < m; ++a)
            result.first[a][c] =
              quotient(first[a], result.x[c] * weight(first[a]));
          for (unsigned int a = 0; a < m; ++a)
            for (unsigned int b = a; b < m; ++b)
              {
                const unsigned int ab = Indices::second(a, b);
                result.second[ab][c] =
                  quotient(second[ab],
                           result.first[a][c] * weight(first[b]) +
                             result.first[b][c] * weight(first[a]) +
                             result.x[c] * weight(second[ab]));
              }
        }
      return result;
    }
  } // namespace



  template <int dim>
  IGASurface<dim>::IGASurface(const IGASpace<dim> &space,
                              const unsigned int   patch,
                              const unsigned int   direction,
                              const unsigned int   side,
                              const double         kink_rounding,
                              const double         end_rounding)
    : space_(&space)
    , patch_(patch)
    , orientation_(side == 1 ? 1. : -1.)
    , end_rounding_(end_rounding)
  {
    AssertIndexRange(direction, static_cast<unsigned int>(dim));
    AssertIndexRange(side, 2u);
    Assert(kink_rounding >= 0. && kink_rounding <= 0.5,
           dealii::ExcMessage("Neighboring kinks must not overlap."));
    const unsigned int p = degree();
    if (p > max_p)
      throw InputError("A surface takes degrees up to " +
                       std::to_string(max_p) + "; found " + std::to_string(p) +
                       ".");
    // In 2D the tangent of the remaining direction, rotated clockwise, is the
    // outward normal of the sides (0,1) and (1,0) only.
    if (dim == 2 && direction == 1)
      orientation_ = -orientation_;

    const auto bernstein = polynomials_of(dealii::FE_Bernstein<1>(p));
    for (unsigned int a = 0; a < m; ++a)
      {
        const unsigned int line = (direction + 1 + a) % dim;
        knots_.push_back(space.patch(patch).knot_vector(line));
        const auto &breaks = knots_[a].breaks();
        for (unsigned int e = 0; e < knots_[a].n_spans(); ++e)
          {
            const auto &C = space.extraction_operator(patch, line, e);
            Segment     segment;
            segment.origin         = breaks[e];
            segment.length         = breaks[e + 1] - breaks[e];
            segment.first_function = knots_[a].first_function(e);
            segment.coefficients =
              power_coefficients(C, space.local_polynomials(patch));
            segments_[a].append(segment, breaks[e], breaks[e + 1]);
            segment.coefficients = power_coefficients(C, bernstein);
            averaging_segments_[a].append(segment, breaks[e], breaks[e + 1]);
          }
        for (unsigned int i = 0; i < breaks.size(); ++i)
          segments_[a].smooth[i] = knots_[a].multiplicity(breaks[i]) < p;
        if (kink_rounding > 0.)
          round_kinks(segments_[a], kink_rounding);
      }
    for (unsigned int j = 0; j < knots_[m - 1].n_functions(); ++j)
      rows_.emplace_back(j, 0);
    n_face_control_points_ =
      rows_.size() * (m == 1 ? 1 : knots_[0].n_functions());
    if (end_rounding > 0.)
      round_ends(direction, side);
    set_control_points(direction, side);
  }



  // The first parameter of a face of a body runs fastest; a curve has rows of
  // one control point.
  template <int dim>
  void
  IGASurface<dim>::set_control_points(const unsigned int direction,
                                      const unsigned int side)
  {
    const NURBSPatch<dim> &P     = space_->patch(patch_);
    const unsigned int     n_row = m == 1 ? 1 : knots_[0].n_functions();
    rational_                    = false;
    for (const auto &row : rows_)
      for (unsigned int i = 0; i < n_row; ++i)
        {
          std::array<unsigned int, dim> index;
          index[(direction + 1) % dim] = i;
          index[(direction + m) % dim] = row.first;
          index[direction]             = side == 0 ?
                                           row.second :
                                           P.n_control_points(direction) - 1 - row.second;
          control_points_.push_back(
            space_->control_point(patch_, P.index(index)));
          weights_.push_back(space_->weights()[control_points_.back()]);
          rational_ = rational_ || weights_.back() != weights_.front();
        }
  }



  template <int dim>
  unsigned int
  IGASurface<dim>::Segments::find(const double u) const
  {
    const auto next = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, u);
    return next - breaks.begin() - 1;
  }



  template <int dim>
  void
  IGASurface<dim>::Segments::append(const Segment &s,
                                    const double   begin,
                                    const double   end)
  {
    if (breaks.empty())
      {
        breaks.push_back(begin);
        smooth.push_back(false);
      }
    segments.push_back(s);
    breaks.push_back(end);
    smooth.push_back(true);
  }



  template <int dim>
  void
  IGASurface<dim>::round_kinks(Segments    &segments,
                               const double kink_rounding) const
  {
    const Segments     sharp = segments;
    const unsigned int n     = sharp.segments.size();
    segments                 = Segments();
    double begin             = sharp.breaks[0];
    for (unsigned int e = 0; e < n; ++e)
      {
        const double end  = sharp.breaks[e + 1];
        const bool   kink = e + 1 < n && !sharp.smooth[e + 1];
        if (!kink)
          {
            segments.append(sharp.segments[e], begin, end);
            begin = end;
            continue;
          }

        const Segment &left = sharp.segments[e], &right = sharp.segments[e + 1];
        const double   low  = end - kink_rounding * left.length;
        const double   high = end + kink_rounding * right.length;
        if (low > begin)
          segments.append(left, begin, low);

        // Cubics with the values and slopes of all functions at both ends.
        Segment round;
        round.origin         = low;
        round.length         = high - low;
        round.first_function = left.first_function;
        round.coefficients.assign(right.first_function +
                                    right.coefficients.size() -
                                    left.first_function,
                                  std::vector<double>(4, 0.));
        const auto add_end = [&](const Segment &s,
                                 const double   u,
                                 const bool     at_end) {
          const double t = (u - s.origin) / s.length;
          for (unsigned int i = 0; i < s.coefficients.size(); ++i)
            {
              double value = 0., slope = 0.;
              for (int k = s.coefficients[i].size() - 1; k >= 0; --k)
                {
                  slope = slope * t + value;
                  value = value * t + s.coefficients[i][k];
                }
              slope *= round.length / s.length;
              auto &c =
                round.coefficients[s.first_function - left.first_function + i];
              if (at_end)
                {
                  c[2] += 3. * value - slope;
                  c[3] += slope - 2. * value;
                }
              else
                {
                  c[0] += value;
                  c[1] += slope;
                  c[2] += -3. * value - 2. * slope;
                  c[3] += 2. * value + slope;
                }
            }
        };
        add_end(left, low, false);
        add_end(right, high, true);
        segments.append(round, low, high);
        begin = high;
      }
  }



  template <int dim>
  void
  IGASurface<dim>::evaluate(const Parameter                   &u,
                            const unsigned int                 n_derivatives,
                            SurfaceShape<m>                   &shape,
                            const std::array<unsigned int, m> *segment) const
  {
    evaluate(segments_, rational_, u, n_derivatives, segment, shape);
  }



  template <int dim>
  SurfaceJet<dim>
  IGASurface<dim>::jet(const Parameter                   &u,
                       const std::vector<Point<dim>>     &positions,
                       const std::array<unsigned int, m> &segment) const
  {
    AssertDimension(positions.size(), n_control_points());
    std::array<LineFunctions, m> N;
    for (unsigned int a = 0; a < m; ++a)
      {
        const Segment &s = segments_[a].segments[segment[a]];
        N[a].first       = s.first_function;
        N[a].rows        = s.rows.empty() ? nullptr : s.rows.data();
        evaluate_polynomials<2>(s.coefficients,
                                (u[a] - s.origin) / s.length,
                                s.length,
                                N[a]);
      }
    const unsigned int row_length = knots_[0].n_functions();
    return rational_ ?
             sum_of_functions<true, dim>(N, row_length, positions, weights_) :
             sum_of_functions<false, dim>(N, row_length, positions, weights_);
  }



  template <int dim>
  void
  IGASurface<dim>::evaluate_averaging(const Parameter &u,
                                      SurfaceShape<m> &shape) const
  {
    evaluate(averaging_segments_, rational_, u, 0, nullptr, shape);
  }



  template <int dim>
  void
  IGASurface<dim>::evaluate(const std::array<Segments, m>     &segments,
                            const bool                         rational,
                            const Parameter                   &u,
                            const unsigned int                 n_derivatives,
                            const std::array<unsigned int, m> *segment,
                            SurfaceShape<m>                   &shape) const
  {
    std::array<LineFunctions, m> N;
    for (unsigned int a = 0; a < m; ++a)
      {
        const unsigned int e =
          segment != nullptr ? (*segment)[a] : segments[a].find(u[a]);
        const Segment &s = segments[a].segments[e];
        N[a].first       = s.first_function;
        N[a].rows        = s.rows.empty() ? nullptr : s.rows.data();
        evaluate_polynomials<3>(s.coefficients,
                                (u[a] - s.origin) / s.length,
                                s.length,
                                N[a]);
      }
    multiply_directions(N, knots_[0].n_functions(), n_derivatives, shape);
    if (rational)
      divide_by_weight_function(weights_, n_derivatives, shape);
  }



  template <int dim>
  std::vector<double>
  IGASurface<dim>::integration_breaks(const unsigned int a) const
  {
    std::vector<double> breaks = knots_[a].breaks();
    if (a + 1 == m && end_rounding_ > 0.)
      for (const double u :
           {breaks.front() + end_rounding_, breaks.back() - end_rounding_})
        {
          const auto   next = std::lower_bound(breaks.begin(), breaks.end(), u);
          const double size = breaks.back() - breaks.front();
          if (*next - u > 1e-10 * size && u - *(next - 1) > 1e-10 * size)
            breaks.insert(next, u);
        }
    return breaks;
  }



  template <int dim>
  std::vector<typename IGASurface<dim>::QuadraturePoint>
  IGASurface<dim>::quadrature(const unsigned int n) const
  {
    const dealii::QGauss<1> gauss(n > 0 ? n : degree() + 1);
    const unsigned int      n_q = gauss.size();

    unsigned int                       n_parts = 1, n_points = 1;
    std::array<std::vector<double>, m> breaks;
    for (unsigned int a = 0; a < m; ++a)
      {
        breaks[a] = integration_breaks(a);
        n_parts *= breaks[a].size() - 1;
        n_points *= n_q;
      }

    std::vector<QuadraturePoint> points;
    for (unsigned int e = 0; e < n_parts; ++e)
      for (unsigned int q = 0; q < n_points; ++q)
        {
          QuadraturePoint point;
          unsigned int    rest_e = e, rest_q = q;
          double          weight = 1;
          for (unsigned int a = 0; a < m; ++a)
            {
              const unsigned int n_a   = breaks[a].size() - 1;
              const double       begin = breaks[a][rest_e % n_a];
              const double       h     = breaks[a][rest_e % n_a + 1] - begin;
              point.u[a]    = begin + h * gauss.point(rest_q % n_q)[0];
              point.span[a] = knots_[a].find_span(point.u[a]);
              weight *= h * gauss.weight(rest_q % n_q);
              rest_e /= n_a;
              rest_q /= n_q;
            }
          evaluate(point.u, 1, point.shape);
          evaluate(averaging_segments_,
                   rational_,
                   point.u,
                   0,
                   &point.span,
                   point.averaging);

          std::array<Tensor<1, dim>, m> tangent;
          for (unsigned int l = 0; l < point.shape.lattice.size(); ++l)
            {
              const Point<dim> &P = reference_position(point.shape.lattice[l]);
              point.X += point.shape.value[l] * P;
              for (unsigned int a = 0; a < m; ++a)
                tangent[a] += point.shape.first[a][l] * P;
            }
          double area;
          if constexpr (dim == 3)
            area = cross_product_3d(tangent[0], tangent[1]).norm();
          else
            area = tangent[0].norm();
          point.area = weight * area;
          points.push_back(point);
        }
    return points;
  }

  template class IGASurface<2>;
  template class IGASurface<3>;
} // namespace NPT
