// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the isogeometric tests share: knot vectors and patches with
// everything uneven, exact circles, and an evaluation without extraction.

#ifndef npt_dealii_tests_iga_test_tools_h
#define npt_dealii_tests_iga_test_tools_h

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/iga_space.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace IGATests
{
  using dealii::Point;
  using dealii::Tensor;
  using NPT::Basis;
  using NPT::IGASpace;
  using NPT::KnotVector;
  using NPT::NURBSPatch;

  const std::array<Basis, 3> all_bases = {
    {Basis::NURBS, Basis::Bernstein, Basis::Lagrange}};



  inline std::string
  name(const Basis basis)
  {
    return basis == Basis::NURBS     ? "NURBS" :
           basis == Basis::Bernstein ? "Bernstein" :
                                       "Lagrange";
  }



  // Degrees 1 to 4, uneven spans, every multiplicity, intervals off [0,1].
  inline std::vector<KnotVector>
  uneven_knot_vectors()
  {
    return {KnotVector(1, {0, 0, 0.3, 1, 1}),
            KnotVector(2, {0, 0, 0, 1, 1, 1}),
            KnotVector(2, {-1, -1, -1, -0.9, 0.2, 0.2, 2, 2, 2}),
            KnotVector(3, {0, 0, 0, 0, 0.2, 0.5, 0.5, 1, 1, 1, 1}),
            KnotVector(3, {1, 1, 1, 1, 2, 2, 2, 4, 5, 5, 5, 5}),
            KnotVector(
              4, {0, 0, 0, 0, 0, .1, .1, .4, .4, .4, .7, .8, 1, 1, 1, 1, 1})};
  }



  // Five points in each span, the first and the last on its boundary.
  inline std::vector<double>
  points_of_span(const KnotVector &k, const unsigned int e)
  {
    const double        begin = k.breaks()[e], h = k.breaks()[e + 1] - begin;
    std::vector<double> points;
    for (const double t : {0., 0.11, 0.5, 0.83, 1.})
      points.push_back(begin + t * h);
    return points;
  }



  // A curved body with uneven knots, degrees 3 and 2, and (if rational)
  // weights between 0.8 and 1.2 in no pattern.
  template <int dim>
  NURBSPatch<dim>
  general_patch(const bool rational)
  {
    const std::array<KnotVector, 3> knots = {
      {KnotVector(3, {0, 0, 0, 0, 0.2, 0.5, 0.5, 1, 1, 1, 1}),
       KnotVector(2, {0, 0, 0, 0.3, 1, 1, 1}),
       KnotVector(2, {1, 1, 1, 2, 2, 2})}};
    std::vector<KnotVector> used(knots.begin(), knots.begin() + dim);
    std::mt19937            generator(7);
    std::uniform_real_distribution<double> weight(0.8, 1.2);

    std::vector<Point<dim>> points;
    std::vector<double>     weights;
    unsigned int            n = 1;
    for (const KnotVector &k : used)
      n *= k.n_functions();
    for (unsigned int A = 0; A < n; ++A)
      {
        Point<dim>   x;
        unsigned int rest = A;
        for (unsigned int d = 0; d < dim; ++d)
          {
            x[d] = used[d].greville(rest % used[d].n_functions());
            rest /= used[d].n_functions();
          }
        Point<dim> X = x;
        X[0] += 0.2 * std::sin(2. * x[1]);
        X[1] += 0.3 * x[0] * x[0];
        if (dim == 3)
          X[dim - 1] += 0.2 * x[0] * x[1];
        points.push_back(X);
        weights.push_back(rational ? weight(generator) : 1.);
      }
    if constexpr (dim == 2)
      return NURBSPatch<2>({{knots[0], knots[1]}}, points, weights);
    else
      return NURBSPatch<3>(knots, points, weights);
  }



  // Direction 0: radius, degree 1; direction 1: angle, degree 2, from the
  // angle `begin` over a quarter turn.
  inline NURBSPatch<2>
  quarter_ring(const double inner, const double outer, const double begin = 0.)
  {
    std::vector<Point<2>> points;
    std::vector<double>   weights;
    const double          corner = std::sqrt(2.), c = std::cos(begin),
                 s = std::sin(begin);
    for (unsigned int j = 0; j < 3; ++j)
      for (const double r : {inner, outer})
        {
          const double   scale = j == 1 ? r * corner : r;
          const double   angle = begin + j * std::acos(-1.) / 4.;
          const Point<2> square(j < 2 ? r : 0., j > 0 ? r : 0.);
          points.emplace_back(begin == 0. ?
                                square :
                                Point<2>(c * square[0] - s * square[1],
                                         s * square[0] + c * square[1]));
          REQUIRE(points.back().distance(Point<2>(scale * std::cos(angle),
                                                  scale * std::sin(angle))) <
                  1e-12);
          weights.push_back(j == 1 ? 1. / corner : 1.);
        }
    return NURBSPatch<2>({{KnotVector::uniform(1, 1),
                           KnotVector::uniform(2, 1)}},
                         points,
                         weights);
  }



  // Quarter of a tube: radius, angle, height (degree 1).
  inline NURBSPatch<3>
  quarter_tube(const double inner, const double outer, const double height)
  {
    const NURBSPatch<2>   ring = quarter_ring(inner, outer);
    std::vector<Point<3>> points;
    std::vector<double>   weights;
    for (const double z : {0., height})
      for (unsigned int A = 0; A < ring.n_control_points(); ++A)
        {
          const Point<2> &P = ring.control_points()[A];
          points.emplace_back(P[0], P[1], z);
          weights.push_back(ring.weights()[A]);
        }
    return NURBSPatch<3>(
      {{ring.knot_vector(0), ring.knot_vector(1), KnotVector::uniform(1, 1)}},
      points,
      weights);
  }



  // n points of the parameter space in no pattern.
  template <int dim>
  std::vector<Point<dim>>
  parameters(const NURBSPatch<dim> &patch, const unsigned int n)
  {
    std::mt19937                           generator(3);
    std::uniform_real_distribution<double> unit(0., 1.);
    std::vector<Point<dim>>                result(n);
    for (Point<dim> &u : result)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto &breaks = patch.knot_vector(d).breaks();
          u[d] =
            breaks.front() + (breaks.back() - breaks.front()) * unit(generator);
        }
    return result;
  }



  template <int dim>
  double
  max_distance(const NURBSPatch<dim> &a, const NURBSPatch<dim> &b)
  {
    double distance = 0.;
    for (const Point<dim> &u : parameters(a, 40))
      distance = std::max(distance, a.value(u).distance(b.value(u)));
    return distance;
  }



  template <int dim>
  typename dealii::Triangulation<dim>::active_cell_iterator
  cell_of(const IGASpace<dim> &space, const unsigned int c)
  {
    return {&space.triangulation(), 0, static_cast<int>(c)};
  }



  // The point with coordinates t in [0,1]^dim of a cell.
  template <int dim>
  Point<dim>
  parameter_in_cell(const IGASpace<dim> &space,
                    const unsigned int   c,
                    const Point<dim>    &t)
  {
    const auto &cell = space.cells()[c];
    Point<dim>  u;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto &breaks   = space.patch(cell.patch).knot_vector(d).breaks();
        const unsigned int e = cell.span[d];
        u[d]                 = breaks[e] + t[d] * (breaks[e + 1] - breaks[e]);
      }
    return u;
  }



  // All functions of a cell at the parameters u by Cox-de Boor (Lagrange: by
  // the products of the nodes' differences), without extraction operators or
  // reference elements; u may leave the span.
  template <int dim>
  std::vector<double>
  direct_functions(const IGASpace<dim> &space,
                   const unsigned int   c,
                   const Point<dim>    &u)
  {
    const auto        &cell  = space.cells()[c];
    const auto        &patch = space.patch(cell.patch);
    const unsigned int p     = space.degree(cell.patch);

    std::array<std::vector<double>, dim> N;
    for (unsigned int d = 0; d < dim; ++d)
      if (space.basis() == Basis::Lagrange)
        {
          // Gauss-Lobatto nodes of degrees 1 to 3, mapped to [0,1].
          REQUIRE(p <= 3);
          const double        s = 0.5 / std::sqrt(5.);
          std::vector<double> nodes =
            p == 1 ? std::vector<double>{0., 1.} :
            p == 2 ? std::vector<double>{0., 0.5, 1.} :
                     std::vector<double>{0., 0.5 - s, 0.5 + s, 1.};
          const auto  &breaks = patch.knot_vector(d).breaks();
          const double begin  = breaks[cell.span[d]];
          const double t = (u[d] - begin) / (breaks[cell.span[d] + 1] - begin);
          for (unsigned int a = 0; a <= p; ++a)
            {
              double value = 1.;
              for (unsigned int b = 0; b <= p; ++b)
                if (b != a)
                  value *= (t - nodes[b]) / (nodes[a] - nodes[b]);
              N[d].push_back(value);
            }
        }
      else
        N[d] = patch.knot_vector(d).values(cell.span[d], u[d], 0)[0];

    const auto          indices = space.control_points_of_cell(c);
    std::vector<double> R(indices.size());
    double              W = 0.;
    for (unsigned int l = 0; l < R.size(); ++l)
      {
        unsigned int rest = l;
        R[l]              = space.weights()[indices[l]];
        for (unsigned int d = 0; d < dim; ++d)
          {
            R[l] *= N[d][rest % (p + 1)];
            rest /= p + 1;
          }
        W += R[l];
      }
    for (double &r : R)
      r /= W;
    return R;
  }



  template <int dim>
  Point<dim>
  direct_position(const IGASpace<dim> &space,
                  const unsigned int   c,
                  const Point<dim>    &u)
  {
    const auto indices = space.control_points_of_cell(c);
    const auto R       = direct_functions(space, c, u);
    Point<dim> X;
    for (unsigned int l = 0; l < R.size(); ++l)
      X += R[l] * space.control_points()[indices[l]];
    return X;
  }



  // Derivative of a vector-valued function of u in direction d by the central
  // five-point formula, error h^4 f^(5) / 30 plus rounding 1e-16 / h.
  template <int dim, typename Function>
  std::vector<double>
  difference(const Function    &f,
             const Point<dim>  &u,
             const unsigned int d,
             const double       h)
  {
    const std::array<double, 4> step   = {{-2., -1., 1., 2.}};
    const std::array<double, 4> factor = {{1., -8., 8., -1.}};
    std::vector<double>         sum;
    for (unsigned int k = 0; k < 4; ++k)
      {
        Point<dim> v = u;
        v[d] += step[k] * h;
        const std::vector<double> values = f(v);
        sum.resize(values.size(), 0.);
        for (unsigned int i = 0; i < values.size(); ++i)
          sum[i] += factor[k] / (12. * h) * values[i];
      }
    return sum;
  }



  // The sentence of the InputError that the call ends with, or a note that
  // there was none.
  template <typename Call>
  std::string
  input_error(const Call &call)
  {
    try
      {
        call();
      }
    catch (const NPT::InputError &error)
      {
        return error.what();
      }
    return "(accepted)";
  }
} // namespace IGATests

#endif
