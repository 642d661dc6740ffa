// SPDX-License-Identifier: LGPL-2.1-or-later
// Least squares by GSL, and the nearest point in half-spaces.

#include <npt_dealii/problems/identification/constrained_least_squares.h>

#include <deal.II/base/exceptions.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace NPT
{
  using dealii::FullMatrix;

  LeastSquares::LeastSquares(const FullMatrix<double>  &X,
                             const std::vector<double> &y)
    : inverse(X.n(), X.n())
  {
    // GSL's own handler would abort the program.
    const unsigned int n = X.m(), p = X.n();
    const auto         old_handler = gsl_set_error_handler_off();
    gsl_matrix        *matrix      = gsl_matrix_alloc(n, p);
    gsl_matrix        *covariance  = gsl_matrix_alloc(p, p);
    gsl_vector        *rhs         = gsl_vector_alloc(n);
    gsl_vector        *weights     = gsl_vector_alloc(n);
    gsl_vector        *t           = gsl_vector_alloc(p);
    auto              *work        = gsl_multifit_linear_alloc(n, p);

    // Equilibrate the columns, so that the condition tells of the data and
    // not of units.
    std::vector<double> scale(p, 0.);
    for (unsigned int j = 0; j < p; ++j)
      {
        for (unsigned int i = 0; i < n; ++i)
          scale[j] += X(i, j) * X(i, j);
        scale[j] = scale[j] > 0. ? std::sqrt(scale[j]) : 1.;
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        gsl_vector_set(rhs, i, y[i]);
        for (unsigned int j = 0; j < p; ++j)
          gsl_matrix_set(matrix, i, j, X(i, j) / scale[j]);
      }
    // The variant with weights returns (X^T X)^{-1} itself, without an
    // estimated variance: constrained fits estimate theirs later.
    gsl_vector_set_all(weights, 1.);
    double    sum_of_squares;
    const int status = gsl_multifit_wlinear(
      matrix, weights, rhs, t, covariance, &sum_of_squares, work);
    const double rcond   = gsl_multifit_linear_rcond(work);
    reciprocal_condition = std::isfinite(rcond) ? rcond : 0.;
    for (unsigned int i = 0; i < p; ++i)
      {
        solution.push_back(gsl_vector_get(t, i) / scale[i]);
        for (unsigned int j = 0; j < p; ++j)
          inverse(i, j) =
            gsl_matrix_get(covariance, i, j) / (scale[i] * scale[j]);
      }
    gsl_multifit_linear_free(work);
    gsl_vector_free(t);
    gsl_vector_free(weights);
    gsl_vector_free(rhs);
    gsl_matrix_free(covariance);
    gsl_matrix_free(matrix);
    gsl_set_error_handler(old_handler);
    AssertThrow(status == 0,
                dealii::ExcMessage("GSL: " +
                                   std::string(gsl_strerror(status))));
  }



  namespace
  {
    // min |E u - f| subject to u >= 0 (Lawson and Hanson 1974, algorithm NNLS).
    std::vector<double>
    nonnegative_least_squares(const FullMatrix<double>  &E,
                              const std::vector<double> &f)
    {
      const unsigned int  n = E.m(), m = E.n();
      std::vector<double> u(m, 0.);
      std::vector<bool>   passive(m, false);
      double              size = 0;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < m; ++j)
          size = std::max(size, std::abs(E(i, j)));

      for (unsigned int outer = 0; outer < 10 * (m + 1); ++outer)
        {
          // The gradient tells which variable would reduce the residual.
          std::vector<double> r = f;
          for (unsigned int i = 0; i < n; ++i)
            for (unsigned int j = 0; j < m; ++j)
              r[i] -= E(i, j) * u[j];
          int    best  = -1;
          double value = 1e-12 * size;
          for (unsigned int j = 0; j < m; ++j)
            if (!passive[j])
              {
                double g = 0;
                for (unsigned int i = 0; i < n; ++i)
                  g += E(i, j) * r[i];
                if (g > value)
                  {
                    value = g;
                    best  = j;
                  }
              }
          if (best < 0)
            return u;
          passive[best] = true;

          for (;;)
            {
              std::vector<unsigned int> set;
              for (unsigned int j = 0; j < m; ++j)
                if (passive[j])
                  set.push_back(j);
              if (set.empty() || set.size() > n)
                return u;
              FullMatrix<double> part(n, set.size());
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int k = 0; k < set.size(); ++k)
                  part(i, k) = E(i, set[k]);
              const std::vector<double> s    = LeastSquares(part, f).solution;
              double                    step = 1.;
              for (unsigned int k = 0; k < set.size(); ++k)
                if (s[k] <= 0.)
                  step = std::min(step, u[set[k]] / (u[set[k]] - s[k]));
              for (unsigned int k = 0; k < set.size(); ++k)
                u[set[k]] += step * (s[k] - u[set[k]]);
              if (step == 1.)
                break;
              for (const unsigned int j : set)
                if (u[j] <= 1e-14)
                  {
                    u[j]       = 0.;
                    passive[j] = false;
                  }
            }
        }
      return u;
    }
  } // namespace



  std::vector<double>
  nearest_admissible(const std::vector<double>    &start,
                     const FullMatrix<double>     &inverse,
                     const std::vector<HalfSpace> &cuts,
                     std::vector<bool>            &active)
  {
    const unsigned int n = start.size();
    FullMatrix<double> L(n, n);
    L.cholesky(inverse);

    // Rows of G L and what is missing; each row normalized.
    const unsigned int  m = cuts.size();
    FullMatrix<double>  E(n + 1, m);
    std::vector<double> f(n + 1, 0.);
    f[n] = 1.;
    for (unsigned int c = 0; c < m; ++c)
      {
        double norm = 0, gap = cuts[c].bound;
        for (unsigned int j = 0; j < n; ++j)
          {
            double sum = 0;
            for (unsigned int i = 0; i < n; ++i)
              sum += cuts[c].g[i] * L(i, j);
            E(j, c) = sum;
            norm += sum * sum;
            gap -= cuts[c].g[j] * start[j];
          }
        norm = std::sqrt(norm);
        for (unsigned int j = 0; j < n; ++j)
          E(j, c) /= norm;
        E(n, c) = gap / norm;
      }
    // The dual problem is scaled by its largest gap.
    double largest = 0;
    for (unsigned int c = 0; c < m; ++c)
      largest = std::max(largest, std::abs(E(n, c)));
    if (largest == 0.)
      largest = 1.;
    for (unsigned int c = 0; c < m; ++c)
      E(n, c) /= largest;

    const std::vector<double> u = nonnegative_least_squares(E, f);
    std::vector<double>       r = f;
    for (unsigned int i = 0; i <= n; ++i)
      {
        r[i] = -f[i];
        for (unsigned int c = 0; c < m; ++c)
          r[i] += E(i, c) * u[c];
      }
    AssertThrow(std::abs(r[n]) > 1e-13,
                dealii::ExcMessage("The half-spaces contradict each other."));
    active.assign(m, false);
    for (unsigned int c = 0; c < m; ++c)
      active[c] = u[c] > 0.;
    std::vector<double> theta = start;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        theta[i] -= L(i, j) * r[j] / r[n] * largest;
    return theta;
  }
} // namespace NPT
