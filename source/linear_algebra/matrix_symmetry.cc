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
    /// Entries of a group of rows in the columns of another one, first to
    /// last, and the transposed ones.
    struct Block
    {
      int           row, column, n_rows, n_columns;
      const double *values, *transposed;
      int           stride, stride_of_transposed; // from row to row
    };



    /// Call visit(block) for every block left of the diagonal or on it, row by
    /// row: a row meets the entries of its columns in order. Return false at
    /// the first block without a transposed one, or for which visit() says so.
    template <typename Visitor>
    bool
    for_each_transposed(const CSRMatrix &A, const Visitor &visit)
    {
      const int n_groups = std::max<int>(A.row_groups.size(), 1) - 1;
      const std::vector<int> group_of = A.group_of_rows();
      // Whether the columns from k on are all those of a group.
      const auto has_all = [&](const int k, const int end, const int group) {
        const int first = A.row_groups[group], last = A.row_groups[group + 1];
        return last - first <= end - k && A.columns[k] == first &&
               A.columns[k + last - first - 1] == last - 1;
      };
      // Of the first row of each group: right of the diagonal, not met yet.
      std::vector<int> next(n_groups);
      for (int g = 0; g < n_groups; ++g)
        {
          const int i = A.row_groups[g], n_rows = A.row_groups[g + 1] - i;
          const int begin = A.row_start[i], end = A.row_start[i + 1];
          int       k = begin;
          while (k < end && A.columns[k] < A.row_groups[g + 1])
            {
              const int h           = group_of[A.columns[k]];
              const int j           = A.row_groups[h],
                        n_columns   = A.row_groups[h + 1] - j;
              const int l           = h == g ? k : next[h];
              const int end_of_rows = A.row_start[j + 1];
              if (!has_all(k, end, h) || !has_all(l, end_of_rows, g) ||
                  !visit(Block{i,
                               j,
                               n_rows,
                               n_columns,
                               A.values.data() + k,
                               A.values.data() + l,
                               end - begin,
                               end_of_rows - A.row_start[j]}))
                return false;
              next[h] = l + n_rows;
              k += n_columns;
            }
          next[g] = k;
        }
      for (int g = 0; g < n_groups; ++g)
        if (next[g] != A.row_start[A.row_groups[g] + 1])
          return false;
      return true;
    }



    std::vector<double>
    largest_of_rows(const CSRMatrix &A)
    {
      std::vector<double> largest(A.n(), 0.);
      for (unsigned int i = 0; i < A.n(); ++i)
        {
          // Four at a time, which do not wait for each other.
          double        part[4] = {};
          const double *value   = A.values.data() + A.row_start[i];
          const int     size    = A.row_start[i + 1] - A.row_start[i];
          for (int k = 0; k + 4 <= size; k += 4)
            for (int p = 0; p < 4; ++p)
              part[p] = std::max(part[p], std::abs(value[k + p]));
          for (int k = size / 4 * 4; k < size; ++k)
            part[0] = std::max(part[0], std::abs(value[k]));
          largest[i] = *std::max_element(part, part + 4);
        }
      return largest;
    }



    // Without a branch inside, so that the compiler unrolls it where the sizes
    // are constants.
    inline bool
    is_symmetric(const Block  &block,
                 const int     n_rows,
                 const int     n_columns,
                 const double *largest)
    {
      // The memory cannot foresee which part of the column comes next.
      for (int c = 0; c < n_columns; ++c)
        __builtin_prefetch(block.transposed + c * block.stride_of_transposed +
                           16);
      bool is_equal = true;
      for (int r = 0; r < n_rows; ++r)
        for (int c = 0; c < n_columns; ++c)
          {
            const double difference =
              block.values[r * block.stride + c] -
              block.transposed[c * block.stride_of_transposed + r];
            // False also if the difference is no number.
            is_equal &= std::abs(difference) <=
                        1e-12 * std::min(largest[block.row + r],
                                         largest[block.column + c]);
          }
      return is_equal;
    }
  } // namespace



  bool
  has_symmetric_pattern(const CSRMatrix &A)
  {
    return for_each_transposed(A, [](const Block &) { return true; });
  }



  bool
  has_symmetric_values(const CSRMatrix &A)
  {
    const std::vector<double> largest = largest_of_rows(A);
    for (const double x : largest)
      if (!std::isfinite(x))
        return false;
    return for_each_transposed(A, [&](const Block &block) {
      // Most blocks couple two control points.
      if (block.n_rows == 3 && block.n_columns == 3)
        return is_symmetric(block, 3, 3, largest.data());
      return is_symmetric(block, block.n_rows, block.n_columns, largest.data());
    });
  }
} // namespace NPT
