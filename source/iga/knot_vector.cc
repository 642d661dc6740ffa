// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines knot vectors; algorithms after Piegl and Tiller, The NURBS Book,
// chapters 2 and 5.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/knot_vector.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::FullMatrix;

  KnotVector::KnotVector(const unsigned int         degree,
                         const std::vector<double> &knots)
    : degree_(degree)
    , knots_(knots)
  {
    const unsigned int p = degree;
    if (p < 1)
      throw InputError("A knot vector needs a degree of at least 1.");
    if (knots.size() < 2 * (p + 1))
      throw InputError("A knot vector of degree " + std::to_string(p) +
                       " needs at least " + std::to_string(2 * (p + 1)) +
                       " knots; found " + std::to_string(knots.size()) + ".");
    for (unsigned int i = 0; i + 1 < knots.size(); ++i)
      if (!(knots[i] <= knots[i + 1]))
        throw InputError("Knots must not decrease; knot " +
                         std::to_string(i + 1) + " is " +
                         std::to_string(knots[i + 1]) + " after " +
                         std::to_string(knots[i]) + ".");

    const unsigned int n = n_functions();
    if (knots[p] != knots[0] || knots[n] != knots.back() ||
        !(knots[p] < knots[p + 1]) || !(knots[n - 1] < knots[n]))
      throw InputError("A knot vector must be open: its first and last knot "
                       "appear exactly degree + 1 times.");
    for (unsigned int i = 1; i + p < knots.size() - 1; ++i)
      if (knots[i] == knots[i + p] && knots[i] != knots[0] &&
          knots[i] != knots.back())
        throw InputError("Interior knot " + std::to_string(knots[i]) +
                         " appears more than degree = " + std::to_string(p) +
                         " times: the patch would fall apart there.");

    for (unsigned int i = p; i < n; ++i)
      if (knots[i] < knots[i + 1])
        {
          span_knot_.push_back(i);
          breaks_.push_back(knots[i]);
        }
    breaks_.push_back(knots.back());
  }



  KnotVector
  KnotVector::uniform(const unsigned int degree, const unsigned int n_spans)
  {
    AssertThrow(n_spans > 0, dealii::ExcMessage("At least one span."));
    std::vector<double> knots(degree + 1, 0.);
    for (unsigned int e = 1; e < n_spans; ++e)
      knots.push_back(static_cast<double>(e) / n_spans);
    knots.insert(knots.end(), degree + 1, 1.);
    return KnotVector(degree, knots);
  }



  unsigned int
  KnotVector::find_span(const double u) const
  {
    const auto it = std::upper_bound(breaks_.begin(), breaks_.end(), u);
    const auto e  = std::max<std::ptrdiff_t>(it - breaks_.begin() - 1, 0);
    return std::min<unsigned int>(e, n_spans() - 1);
  }



  unsigned int
  KnotVector::multiplicity(const double u) const
  {
    return std::count(knots_.begin(), knots_.end(), u);
  }



  std::vector<std::vector<double>>
  KnotVector::values(const unsigned int e,
                     const double       u,
                     const unsigned int n_derivatives) const
  {
    AssertIndexRange(e, n_spans());
    const unsigned int p = degree_;
    const unsigned int i = span_knot_[e];

    // Triangle of lower-degree functions: row k holds the k+1 functions of
    // degree k that are nonzero on this span.
    std::vector<std::vector<double>> triangle(p + 1);
    triangle[0] = {1.};
    for (unsigned int k = 1; k <= p; ++k)
      {
        triangle[k].assign(k + 1, 0.);
        for (unsigned int a = 0; a < k; ++a)
          {
            // Function a of degree k-1 has support [u_{i-k+1+a}, u_{i+1+a}].
            const double left  = knots_[i - k + 1 + a];
            const double right = knots_[i + 1 + a];
            const double share = triangle[k - 1][a] / (right - left);
            triangle[k][a] += (right - u) * share;
            triangle[k][a + 1] += (u - left) * share;
          }
      }

    // d-th derivatives: differences applied d times, starting from the
    // functions of degree p-d.
    std::vector<std::vector<double>> result(n_derivatives + 1,
                                            std::vector<double>(p + 1, 0.));
    result[0] = triangle[p];
    for (unsigned int d = 1; d <= std::min(n_derivatives, p); ++d)
      {
        std::vector<double> current = triangle[p - d];
        for (unsigned int k = p - d + 1; k <= p; ++k)
          {
            std::vector<double> next(k + 1, 0.);
            for (unsigned int a = 0; a < k; ++a)
              {
                const double share =
                  k * current[a] / (knots_[i + 1 + a] - knots_[i - k + 1 + a]);
                next[a] -= share;
                next[a + 1] += share;
              }
            current.swap(next);
          }
        result[d] = current;
      }
    return result;
  }



  double
  KnotVector::greville(const unsigned int i) const
  {
    double sum = 0;
    for (unsigned int k = 1; k <= degree_; ++k)
      sum += knots_[i + k];
    return sum / degree_;
  }



  FullMatrix<double>
  KnotVector::insertion_operator(const std::vector<double> &new_knots,
                                 KnotVector                &refined) const
  {
    const unsigned int  p     = degree_;
    std::vector<double> knots = knots_;
    FullMatrix<double>  T(n_functions(), n_functions());
    for (unsigned int i = 0; i < n_functions(); ++i)
      T(i, i) = 1.;

    for (const double u : new_knots)
      {
        if (!(u > knots.front() && u < knots.back()))
          throw InputError("A new knot must lie strictly inside the knot "
                           "vector; found " +
                           std::to_string(u) + ".");
        const unsigned int k =
          std::upper_bound(knots.begin(), knots.end(), u) - knots.begin() - 1;
        const unsigned int n = T.m();
        FullMatrix<double> next(n + 1, T.n());
        for (unsigned int i = 0; i <= n; ++i)
          {
            double alpha;
            if (i + p <= k)
              alpha = 1.;
            else if (i > k)
              alpha = 0.;
            else
              alpha = (u - knots[i]) / (knots[i + p] - knots[i]);
            for (unsigned int j = 0; j < T.n(); ++j)
              next(i, j) = (alpha != 0. ? alpha * T(i, j) : 0.) +
                           (alpha != 1. ? (1. - alpha) * T(i - 1, j) : 0.);
          }
        T = next;
        knots.insert(knots.begin() + k + 1, u);
      }
    refined = KnotVector(p, knots);
    return T;
  }



  FullMatrix<double>
  KnotVector::elevation_operator(const unsigned int times,
                                 KnotVector        &elevated) const
  {
    const unsigned int  p = degree_ + times;
    std::vector<double> knots;
    for (unsigned int b = 0; b < breaks_.size(); ++b)
      knots.insert(knots.end(), multiplicity(breaks_[b]) + times, breaks_[b]);
    elevated = KnotVector(p, knots);

    return interpolation_operator(elevated);
  }



  FullMatrix<double>
  KnotVector::interpolation_operator(const KnotVector &other) const
  {
    const unsigned int n = other.n_functions();
    FullMatrix<double> B_other(n, n), B_this(n, n_functions()),
      T(n, n_functions());
    for (unsigned int i = 0; i < n; ++i)
      {
        const double u   = other.greville(i);
        const auto   add = [&](const KnotVector &knots, FullMatrix<double> &B) {
          const unsigned int e = knots.find_span(u);
          const auto         v = knots.values(e, u, 0);
          for (unsigned int a = 0; a <= knots.degree(); ++a)
            B(i, knots.first_function(e) + a) = v[0][a];
        };
        add(other, B_other);
        add(*this, B_this);
      }
    B_other.gauss_jordan();
    B_other.mmult(T, B_this);
    return T;
  }



  std::vector<double>
  KnotVector::subdividing_knots(const unsigned int parts) const
  {
    std::vector<double> result;
    for (unsigned int e = 0; e < n_spans(); ++e)
      for (unsigned int k = 1; k < parts; ++k)
        result.push_back(breaks_[e] +
                         (breaks_[e + 1] - breaks_[e]) * k / parts);
    return result;
  }



  std::vector<double>
  KnotVector::bezier_knots() const
  {
    std::vector<double> result;
    for (unsigned int b = 1; b + 1 < breaks_.size(); ++b)
      for (unsigned int m = multiplicity(breaks_[b]); m < degree_; ++m)
        result.push_back(breaks_[b]);
    return result;
  }
} // namespace NPT
