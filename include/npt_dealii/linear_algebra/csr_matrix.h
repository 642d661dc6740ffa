// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a square sparse matrix in compressed row storage with direct access
// to its values: what assembly writes into and what linear solvers read.

#ifndef npt_dealii_linear_algebra_csr_matrix_h
#define npt_dealii_linear_algebra_csr_matrix_h

#include <deal.II/base/exceptions.h>
#include <deal.II/lac/vector.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace NPT
{
  /**
   * Compressed row storage. The pattern carries a number that changes whenever
   * the pattern is rebuilt, so that a solver knows when its symbolic
   * factorization is still valid. Columns of a row are sorted.
   *
   * Assembly writes to `values` at positions it has computed once
   * (position()), which is an order of magnitude faster than searching.
   */
  class CSRMatrix
  {
  public:
    std::vector<int>    row_start; ///< size n+1
    std::vector<int>    columns;   ///< sorted within a row
    std::vector<double> values;

    unsigned int
    n() const
    {
      return row_start.empty() ? 0 : row_start.size() - 1;
    }

    std::size_t
    n_nonzeros() const
    {
      return columns.size();
    }

    /// Changes with every call of set_pattern() of any matrix.
    std::size_t
    pattern_id() const
    {
      return pattern_id_;
    }

    /**
     * Take over a pattern and set all values to zero.
     *
     * @param row_columns Columns of each row in any order, duplicates allowed;
     *   empty afterwards.
     */
    void
    set_pattern(std::vector<std::vector<int>> &row_columns)
    {
      row_start.assign(1, 0);
      row_start.reserve(row_columns.size() + 1);
      for (auto &row : row_columns)
        {
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
          row_start.push_back(row_start.back() + row.size());
        }
      // Not a byte more than they need, and the old ones are gone.
      columns = std::vector<int>();
      values  = std::vector<double>();
      columns.reserve(row_start.back());
      for (auto &row : row_columns)
        {
          columns.insert(columns.end(), row.begin(), row.end());
          row = std::vector<int>();
        }
      values.assign(columns.size(), 0.);
      static std::size_t counter = 0;
      pattern_id_                = ++counter;
    }

    void
    set_zero()
    {
      std::fill(values.begin(), values.end(), 0.);
    }

    /// Position of an entry in `values`, or -1 if it is not in the pattern.
    int
    position(const int row, const int column) const
    {
      const auto begin = columns.begin() + row_start[row];
      const auto end   = columns.begin() + row_start[row + 1];
      const auto it    = std::lower_bound(begin, end, column);
      return (it != end && *it == column) ? it - columns.begin() : -1;
    }

    /// y = A x.
    void
    vmult(dealii::Vector<double> &y, const dealii::Vector<double> &x) const
    {
      AssertDimension(x.size(), n());
      y.reinit(n());
      for (unsigned int i = 0; i < n(); ++i)
        {
          double sum = 0;
          for (int k = row_start[i]; k < row_start[i + 1]; ++k)
            sum += values[k] * x[columns[k]];
          y[i] = sum;
        }
    }

    /// y = |A| |x|, absolute values of all entries.
    void
    vmult_absolute(dealii::Vector<double>       &y,
                   const dealii::Vector<double> &x) const
    {
      AssertDimension(x.size(), n());
      y.reinit(n());
      for (unsigned int i = 0; i < n(); ++i)
        {
          double sum = 0;
          for (int k = row_start[i]; k < row_start[i + 1]; ++k)
            sum += std::abs(values[k] * x[columns[k]]);
          y[i] = sum;
        }
    }

  private:
    std::size_t pattern_id_ = 0;
  };
} // namespace NPT

#endif
