// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a square sparse matrix in compressed row storage with direct access
// to its values: what assembly writes into and what linear solvers read.

#ifndef npt_dealii_linear_algebra_csr_matrix_h
#define npt_dealii_linear_algebra_csr_matrix_h

#include <deal.II/lac/vector.h>

#include <algorithm>
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
    /// First rows of groups of neighboring rows with the same columns, such as
    /// those of the components of a control point; then n().
    std::vector<int> row_groups;

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
    set_pattern(std::vector<std::vector<int>> &row_columns);

    void
    set_zero()
    {
      std::fill(values.begin(), values.end(), 0.);
    }

    /// The group of each row, as `row_groups` counts them.
    std::vector<int>
    group_of_rows() const;

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
    vmult(dealii::Vector<double> &y, const dealii::Vector<double> &x) const;

    /// y = |A| |x|, absolute values of all entries.
    void
    vmult_absolute(dealii::Vector<double>       &y,
                   const dealii::Vector<double> &x) const;

  private:
    std::size_t pattern_id_ = 0;
  };
} // namespace NPT

#endif
