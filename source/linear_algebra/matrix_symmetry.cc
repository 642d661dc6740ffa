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
    /// Call visit(k, l) for every entry k with the position l of the transposed
    /// one, row by row: a row meets the entries of its column in order. Return
    /// false at the first entry without one, or for which visit() says so.
    template <typename Visitor>
    bool
    for_each_transposed(const CSRMatrix &A, const Visitor &visit)
    {
      std::vector<int> next(A.row_start.begin(), A.row_start.end() - 1);
      for (int i = 0; i < static_cast<int>(A.n()); ++i)
        for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          {
            const int j = A.columns[k], l = next[j]++;
            if (l == A.row_start[j + 1] || A.columns[l] != i || !visit(k, l))
              return false;
          }
      return true;
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
        largest[i] = std::max(largest[i], std::abs(A.values[k]));
    return for_each_transposed(A, [&](const int k, const int l) {
      // Written so that NaN is not symmetric.
      return std::abs(A.values[k] - A.values[l]) <=
             1e-12 * largest[A.columns[k]];
    });
  }
} // namespace NPT
