// SPDX-License-Identifier: LGPL-2.1-or-later
// Factorization and solution with a tree of fronts.

#include <npt_dealii/linear_algebra/fronts.h>

#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <utility>

// What deal.II does not declare.
extern "C"
{
  void
  dlaswp_(const int *,
          double *,
          const int *,
          const int *,
          const int *,
          const int *,
          const int *);
  void
  dtrsm_(const char *,
         const char *,
         const char *,
         const char *,
         const int *,
         const int *,
         const double *,
         const double *,
         const int *,
         double *,
         const int *);
  void
  dtrsv_(const char *,
         const char *,
         const char *,
         const int *,
         const double *,
         const int *,
         double *,
         const int *);
}

namespace NPT
{
  namespace
  {
    const int    one  = 1;
    const double plus = 1, minus = -1, zero = 0;

    // Beyond it the residual of a solution may be above 1e-10, and one step of
    // refinement no longer leaves round-off.
    constexpr double largest_growth = 1e6;

    bool
    is_within_growth(const double *column,
                     const int     n_rows,
                     const int     n_columns,
                     const int     stride)
    {
      for (int c = 0; c < n_columns; ++c, column += stride)
        for (int r = 0; r < n_rows; ++r)
          if (!(std::abs(column[r]) <= largest_growth))
            return false;
      return true;
    }
  } // namespace



  // Set the columns and rows of the pivots to the entries of the matrix and to
  // what the children have left for them.
  void
  Fronts::assemble(const Front &front, const std::vector<double> &values)
  {
    const int     n = front.n, m = front.m, n_changed = m - n;
    double *const columns = factors.data() + front.begin;
    double *const rows    = columns + std::size_t(n) * m;
    std::fill_n(columns,
                std::size_t(n) * (is_symmetric ? m : m + n_changed),
                0.);
    const int end = is_symmetric ? front.end_of_lower : front.end_of_entries;
    for (int e = front.first_entry; e < end; ++e)
      columns[targets[e]] += values[sources[e]];

    // Children lie on their stack one behind the other.
    const Stack  &stack = stacks[(front.level + 1) % 2];
    const double *given = stack.values.data() + stack.top;
    for (auto c = front.children.rbegin(); c != front.children.rend(); ++c)
      {
        const std::vector<int> &places = fronts[*c].places;
        const int               size   = places.size();
        given -= std::size_t(size) * size;
        const int n_pivots =
          std::lower_bound(places.begin(), places.end(), n) - places.begin();
        for (int j = 0; j < n_pivots; ++j)
          {
            double *const       to   = columns + std::size_t(places[j]) * m;
            const double *const from = given + std::size_t(j) * size;
            for (int i = is_symmetric ? j : 0; i < size; ++i)
              to[places[i]] += from[i];
          }
        if (!is_symmetric)
          for (int j = n_pivots; j < size; ++j)
            {
              double *const       to   = rows + std::size_t(places[j] - n) * n;
              const double *const from = given + std::size_t(j) * size;
              for (int i = 0; i < n_pivots; ++i)
                to[places[i]] += from[i];
            }
      }
  }



  // Add what the children have left for the unknowns that are eliminated later.
  void
  Fronts::add_contributions(const Front &front, double *contribution)
  {
    const int     n = front.n, n_changed = front.m - n;
    const Stack  &stack = stacks[(front.level + 1) % 2];
    const double *given = stack.values.data() + stack.top;
    for (auto c = front.children.rbegin(); c != front.children.rend(); ++c)
      {
        const std::vector<int> &places = fronts[*c].places;
        const int               size   = places.size();
        given -= std::size_t(size) * size;
        const int n_pivots =
          std::lower_bound(places.begin(), places.end(), n) - places.begin();
        for (int j = n_pivots; j < size; ++j)
          {
            double *const to =
              contribution + std::size_t(places[j] - n) * n_changed - n;
            const double *const from = given + std::size_t(j) * size;
            for (int i = is_symmetric ? j : n_pivots; i < size; ++i)
              to[places[i]] += from[i];
          }
      }
  }



  template <typename Eliminate>
  bool
  Fronts::eliminate_all(const std::vector<double> &values,
                        const Eliminate           &eliminate)
  {
    for (Stack &stack : stacks)
      stack.top = 0;
    for (Front &front : fronts)
      {
        assemble(front, values);
        Stack            &stack        = stacks[front.level % 2];
        double *const     contribution = stack.values.data() + stack.top;
        const std::size_t n_changed    = front.m - front.n;
        if (!eliminate(front, factors.data() + front.begin, contribution))
          return false;
        add_contributions(front, contribution);
        stack.top += n_changed * n_changed;
        for (const int c : front.children)
          stacks[(front.level + 1) % 2].top -=
            fronts[c].changed.size() * fronts[c].changed.size();
      }
    return true;
  }



  bool
  Fronts::factorize_general(const std::vector<double> &values)
  {
    is_symmetric = false;
    return eliminate_all(
      values,
      [this](const Front &front, double *columns, double *contribution) {
        const int n = front.n, m = front.m, n_changed = m - n;
        int       info = 0;
        dealii::getrf(
          &n, &n, columns, &m, exchanges.data() + front.first, &info);
        if (info != 0)
          return false;
        if (n_changed == 0)
          return true;
        double *const rows = columns + std::size_t(n) * m;
        dlaswp_(
          &n_changed, rows, &n, &one, &n, exchanges.data() + front.first, &one);
        dtrsm_(
          "L", "L", "N", "U", &n, &n_changed, &plus, columns, &m, rows, &n);
        dtrsm_("R",
               "U",
               "N",
               "N",
               &n_changed,
               &n,
               &plus,
               columns,
               &m,
               columns + n,
               &m);
        if (!is_within_growth(columns + n, n_changed, n, m))
          return false;
        dealii::gemm("N",
                     "N",
                     &n_changed,
                     &n_changed,
                     &n,
                     &minus,
                     columns + n,
                     &m,
                     rows,
                     &n,
                     &zero,
                     contribution,
                     &n_changed);
        return true;
      });
  }



  bool
  Fronts::factorize_positive_definite(const std::vector<double> &values)
  {
    is_symmetric = true;
    return eliminate_all(
      values, [](const Front &front, double *columns, double *contribution) {
        const int n = front.n, m = front.m, n_changed = m - n;
        int       info = 0;
        dealii::potrf("L", &n, columns, &m, &info);
        if (info != 0)
          return false;
        if (n_changed == 0)
          return true;
        dtrsm_("R",
               "L",
               "T",
               "N",
               &n_changed,
               &n,
               &plus,
               columns,
               &m,
               columns + n,
               &m);
        dealii::syrk("L",
                     "N",
                     &n_changed,
                     &n,
                     &minus,
                     columns + n,
                     &m,
                     &zero,
                     contribution,
                     &n_changed);
        return true;
      });
  }



  void
  Fronts::solve(dealii::Vector<double> &x)
  {
    double *const y = permuted.data(), *const change = changes.data();
    for (int i = 0; i < n_unknowns; ++i)
      y[position[i]] = x[i];

    for (const Front &front : fronts)
      {
        const int           n = front.n, m = front.m, n_changed = m - n;
        const double *const columns = factors.data() + front.begin;
        double *const       pivots  = y + front.first;
        if (!is_symmetric)
          for (int r = 0; r < n; ++r)
            std::swap(pivots[r], pivots[exchanges[front.first + r] - 1]);
        dtrsv_(
          "L", "N", is_symmetric ? "N" : "U", &n, columns, &m, pivots, &one);
        if (n_changed == 0)
          continue;
        dealii::gemv("N",
                     &n_changed,
                     &n,
                     &plus,
                     columns + n,
                     &m,
                     pivots,
                     &one,
                     &zero,
                     change,
                     &one);
        for (int r = 0; r < n_changed; ++r)
          y[front.changed[r]] -= change[r];
      }

    for (auto front = fronts.rbegin(); front != fronts.rend(); ++front)
      {
        const int           n = front->n, m = front->m, n_changed = m - n;
        const double *const columns = factors.data() + front->begin;
        double *const       pivots  = y + front->first;
        if (n_changed > 0)
          {
            for (int r = 0; r < n_changed; ++r)
              change[r] = y[front->changed[r]];
            if (is_symmetric)
              dealii::gemv("T",
                           &n_changed,
                           &n,
                           &minus,
                           columns + n,
                           &m,
                           change,
                           &one,
                           &plus,
                           pivots,
                           &one);
            else
              dealii::gemv("N",
                           &n,
                           &n_changed,
                           &minus,
                           columns + std::size_t(n) * m,
                           &n,
                           change,
                           &one,
                           &plus,
                           pivots,
                           &one);
          }
        if (is_symmetric)
          dtrsv_("L", "T", "N", &n, columns, &m, pivots, &one);
        else
          dtrsv_("U", "N", "N", &n, columns, &m, pivots, &one);
      }

    for (int i = 0; i < n_unknowns; ++i)
      x[i] = y[position[i]];
  }
} // namespace NPT
