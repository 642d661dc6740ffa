// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines NURBS patches: evaluation and refinement in homogeneous coordinates.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/nurbs_patch.h>

#include <algorithm>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Point;

  template <int dim>
  NURBSPatch<dim>::NURBSPatch(const std::array<KnotVector, dim> &knot_vectors,
                              const std::vector<Point<dim>>     &control_points,
                              const std::vector<double>         &weights)
    : knot_vectors_(knot_vectors)
    , control_points_(control_points)
    , weights_(weights)
  {
    unsigned int n = 1;
    for (const KnotVector &k : knot_vectors)
      n *= k.n_functions();
    if (control_points.size() != n)
      throw InputError("A patch with these knots needs " + std::to_string(n) +
                       " control points; found " +
                       std::to_string(control_points.size()) + ".");
    if (weights_.empty())
      weights_.assign(n, 1.);
    if (weights_.size() != n)
      throw InputError("A patch with these knots needs " + std::to_string(n) +
                       " weights; found " + std::to_string(weights.size()) +
                       ".");
    for (const double w : weights_)
      if (!(w > 0))
        throw InputError("NURBS weights must be positive; found " +
                         std::to_string(w) + ".");
  }



  template <int dim>
  unsigned int
  NURBSPatch<dim>::index(const std::array<unsigned int, dim> &i) const
  {
    unsigned int A = 0;
    for (int d = dim - 1; d >= 0; --d)
      A = A * n_control_points(d) + i[d];
    return A;
  }



  template <int dim>
  std::array<unsigned int, dim>
  NURBSPatch<dim>::multi_index(unsigned int A) const
  {
    std::array<unsigned int, dim> i;
    for (unsigned int d = 0; d < dim; ++d)
      {
        i[d] = A % n_control_points(d);
        A /= n_control_points(d);
      }
    return i;
  }



  template <int dim>
  bool
  NURBSPatch<dim>::is_rational() const
  {
    return std::any_of(weights_.begin(), weights_.end(), [&](const double w) {
      return w != weights_[0];
    });
  }



  template <int dim>
  Point<dim>
  NURBSPatch<dim>::value(const Point<dim> &u) const
  {
    std::array<std::vector<double>, dim> N;
    std::array<unsigned int, dim>        first;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int e = knot_vectors_[d].find_span(u[d]);
        N[d]                 = knot_vectors_[d].values(e, u[d], 0)[0];
        first[d]             = knot_vectors_[d].first_function(e);
      }

    Point<dim>   sum;
    double       W       = 0;
    unsigned int n_local = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_local *= N[d].size();
    for (unsigned int l = 0; l < n_local; ++l)
      {
        double                        R    = 1;
        unsigned int                  rest = l;
        std::array<unsigned int, dim> i;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const unsigned int a = rest % N[d].size();
            rest /= N[d].size();
            R *= N[d][a];
            i[d] = first[d] + a;
          }
        const unsigned int A = index(i);
        R *= weights_[A];
        W += R;
        sum += R * control_points_[A];
      }
    return Point<dim>(sum / W);
  }



  template <int dim>
  void
  NURBSPatch<dim>::apply(const unsigned int        direction,
                         const FullMatrix<double> &T,
                         const KnotVector         &new_knot_vector)
  {
    // Refinement is linear in homogeneous coordinates (w X, w).
    unsigned int stride = 1, outer = 1;
    for (unsigned int d = 0; d < direction; ++d)
      stride *= n_control_points(d);
    for (unsigned int d = direction + 1; d < dim; ++d)
      outer *= n_control_points(d);
    const unsigned int n_old = T.n(), n_new = T.m();
    const bool         rational = is_rational();

    std::vector<Point<dim>> points(stride * n_new * outer);
    std::vector<double>     weights(points.size(), 0.);
    for (unsigned int o = 0; o < outer; ++o)
      for (unsigned int s = 0; s < stride; ++s)
        for (unsigned int i = 0; i < n_new; ++i)
          {
            const unsigned int B = s + stride * (i + n_new * o);
            for (unsigned int j = 0; j < n_old; ++j)
              if (T(i, j) != 0.)
                {
                  const unsigned int A = s + stride * (j + n_old * o);
                  points[B] += T(i, j) * weights_[A] * control_points_[A];
                  weights[B] += T(i, j) * weights_[A];
                }
            points[B] /= weights[B];
          }
    // Equal weights stay equal exactly, whatever the rounding in T.
    if (!rational)
      weights.assign(points.size(), weights_[0]);
    control_points_.swap(points);
    weights_.swap(weights);
    knot_vectors_[direction] = new_knot_vector;
  }



  template <int dim>
  void
  NURBSPatch<dim>::insert_knots(const unsigned int         direction,
                                const std::vector<double> &new_knots)
  {
    KnotVector refined = knot_vectors_[direction];
    const auto T =
      knot_vectors_[direction].insertion_operator(new_knots, refined);
    apply(direction, T, refined);
  }



  template <int dim>
  void
  NURBSPatch<dim>::subdivide(const unsigned int direction,
                             const unsigned int parts)
  {
    insert_knots(direction, knot_vectors_[direction].subdividing_knots(parts));
  }



  template <int dim>
  void
  NURBSPatch<dim>::elevate_degree(const unsigned int direction,
                                  const unsigned int times)
  {
    if (times == 0)
      return;
    KnotVector elevated = knot_vectors_[direction];
    const auto T = knot_vectors_[direction].elevation_operator(times, elevated);
    apply(direction, T, elevated);
  }



  template <int dim>
  void
  NURBSPatch<dim>::reduce_to_c0()
  {
    for (unsigned int d = 0; d < dim; ++d)
      insert_knots(d, knot_vectors_[d].bezier_knots());
  }



  template <int dim>
  void
  NURBSPatch<dim>::make_isotropic()
  {
    unsigned int p = 0;
    for (const KnotVector &k : knot_vectors_)
      p = std::max(p, k.degree());
    for (unsigned int d = 0; d < dim; ++d)
      elevate_degree(d, p - knot_vectors_[d].degree());
  }



  template <int dim>
  void
  NURBSPatch<dim>::transform(
    const std::function<Point<dim>(const Point<dim> &)> &map)
  {
    for (Point<dim> &P : control_points_)
      P = map(P);
  }

  template class NURBSPatch<2>;
  template class NURBSPatch<3>;
} // namespace NPT
