// SPDX-License-Identifier: LGPL-2.1-or-later
// Solution with a tree of fronts.

#include <npt_dealii/linear_algebra/dense_kernels.h>
#include <npt_dealii/linear_algebra/fronts.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <utility>

namespace NPT
{
  using DenseKernels::one;



  template <typename Number>
  void
  Fronts<Number>::solve_forward(Number *y)
  {
    using B              = Blas<Number>;
    Number *const change = changes.data();
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      {
        const Front &front = tree->fronts[f];
        if (!is_own(front))
          continue;
        const int           n = front.n, m = front.m, n_changed = m - n;
        const Number *const columns = factors.data() + begin[f];
        Number *const       pivots  = y + front.first;
        if (!is_symmetric)
          for (int r = 0; r < n; ++r)
            std::swap(pivots[r], pivots[exchanges[front.first + r] - 1]);
        B::trsv(
          "L", "N", is_symmetric ? "N" : "U", &n, columns, &m, pivots, &one);
        if (n_changed == 0)
          continue;
        dealii::gemv("N",
                     &n_changed,
                     &n,
                     &B::plus,
                     columns + n,
                     &m,
                     pivots,
                     &one,
                     &B::zero,
                     change,
                     &one);
        for (int r = 0; r < n_changed; ++r)
          y[front.changed[r]] -= change[r];
      }

    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      if (tree->fronts[f].is_shared)
        {
          gather(tree->fronts[f], y);
          shared[f]->solve_forward(change);
          scatter(tree->fronts[f], tree->fronts[f].m, y);
        }
  }



  template <typename Number>
  void
  Fronts<Number>::gather(const Front &front, const Number *y)
  {
    std::copy_n(y + front.first, front.n, changes.begin());
    for (unsigned int r = 0; r < front.n_changed(); ++r)
      changes[front.n + r] = y[front.changed[r]];
  }



  template <typename Number>
  void
  Fronts<Number>::scatter(const Front &front, const int n_rows, Number *y) const
  {
    std::copy_n(changes.begin(), front.n, y + front.first);
    for (int r = front.n; r < n_rows; ++r)
      y[front.changed[r - front.n]] = changes[r];
  }



  template <typename Number>
  void
  Fronts<Number>::solve_backward(Number *y)
  {
    using B              = Blas<Number>;
    Number *const change = changes.data();
    for (int f = tree->fronts.size() - 1; f >= 0; --f)
      if (tree->fronts[f].is_shared)
        {
          gather(tree->fronts[f], y);
          shared[f]->solve_backward(change);
          scatter(tree->fronts[f], tree->fronts[f].n, y);
        }

    for (int f = tree->fronts.size() - 1; f >= 0; --f)
      {
        if (!is_own(tree->fronts[f]))
          continue;
        const Front        &front = tree->fronts[f];
        const int           n = front.n, m = front.m, n_changed = m - n;
        const Number *const columns = factors.data() + begin[f];
        Number *const       pivots  = y + front.first;
        if (n_changed > 0)
          {
            for (int r = 0; r < n_changed; ++r)
              change[r] = y[front.changed[r]];
            if (is_symmetric)
              dealii::gemv("T",
                           &n_changed,
                           &n,
                           &B::minus,
                           columns + n,
                           &m,
                           change,
                           &one,
                           &B::plus,
                           pivots,
                           &one);
            else
              dealii::gemv("N",
                           &n,
                           &n_changed,
                           &B::minus,
                           columns + std::size_t(n) * m,
                           &n,
                           change,
                           &one,
                           &B::plus,
                           pivots,
                           &one);
          }
        if (is_symmetric)
          B::trsv("L", "T", "N", &n, columns, &m, pivots, &one);
        else
          B::trsv("U", "N", "N", &n, columns, &m, pivots, &one);
      }
  }



  template <typename Number>
  void
  Fronts<Number>::solve(dealii::Vector<double> &x)
  {
    // Of a right-hand side everyone has all; each begins with what is its own.
    std::vector<Number> &y = permuted;
    for (unsigned int i = 0; i < x.size(); ++i)
      y[tree->position[i]] = is_own_place[tree->position[i]] ? x[i] : 0;
    solve_forward(y.data());
    solve_backward(y.data());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = is_own_place[tree->position[i]] ? y[tree->position[i]] : 0;
    ranks.sum(x);
  }



  template void
  Fronts<double>::solve(dealii::Vector<double> &);
  template void
  Fronts<float>::solve(dealii::Vector<double> &);
} // namespace NPT
