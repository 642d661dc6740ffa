// SPDX-License-Identifier: LGPL-2.1-or-later
// Is a matrix symmetric?

#include <npt_dealii/linear_algebra/matrix_symmetry.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace NPT
{
  namespace
  {
    /// Call visit(k, l) for every entry k left of the diagonal with the
    /// position l of the transposed one, row by row: a row meets the entries of
    /// its column in order. Return false at the first entry without one, or for
    /// which visit() says so.
    template <typename Visitor>
    bool
    for_each_transposed(const CSRMatrix &A, const Visitor &visit)
    {
      const int n = A.n();
      if (n == 0)
        return true; // a matrix without a pattern has no row_start either
      // Entries right of the diagonal that were not met yet.
      std::vector<int> next(n);
      for (int i = 0; i < n; ++i)
        next[i] = std::upper_bound(A.columns.begin() + A.row_start[i],
                                   A.columns.begin() + A.row_start[i + 1],
                                   i) -
                  A.columns.begin();
      for (int i = 0; i < n; ++i)
        for (int k = A.row_start[i]; k < A.row_start[i + 1] && A.columns[k] < i;
             ++k)
          {
            const int j = A.columns[k], l = next[j]++;
            if (l == A.row_start[j + 1] || A.columns[l] != i || !visit(k, l))
              return false;
          }
      return std::equal(next.begin(), next.end(), A.row_start.begin() + 1);
    }
  } // namespace



  bool
  has_symmetric_pattern(const CSRMatrix &A)
  {
    return for_each_transposed(A, [](const int, const int) { return true; });
  }



  bool
  has_symmetric_values(const CSRMatrix &A)
  {
    std::vector<double> largest(A.n(), 0.);
    for (unsigned int i = 0; i < A.n(); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        {
          if (!std::isfinite(A.values[k]))
            return false;
          largest[i] = std::max(largest[i], std::abs(A.values[k]));
        }
    return for_each_transposed(A, [&](const int k, const int l) {
      return std::abs(A.values[k] - A.values[l]) <=
             1e-12 * std::min(largest[A.columns[k]], largest[A.columns[l]]);
    });
  }
} // namespace NPT
