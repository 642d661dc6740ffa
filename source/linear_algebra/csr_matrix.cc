// SPDX-License-Identifier: LGPL-2.1-or-later
// Patterns and products of sparse matrices.

#include <npt_dealii/linear_algebra/csr_matrix.h>

#include <deal.II/base/exceptions.h>

#include <cmath>

namespace NPT
{
  using dealii::Vector;

  void
  CSRMatrix::set_pattern(std::vector<std::vector<int>> &row_columns)
  {
    const int n_rows = row_columns.size();
    row_start.assign(1, 0);
    row_start.reserve(n_rows + 1);
    row_groups.clear();
    for (int i = 0; i < n_rows; ++i)
      {
        std::vector<int> &row = row_columns[i];
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        row_start.push_back(row_start.back() + row.size());
        if (i == 0 || row != row_columns[i - 1])
          row_groups.push_back(i);
      }
    row_groups.push_back(n_rows);
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



  std::vector<int>
  CSRMatrix::group_of_rows() const
  {
    std::vector<int> group_of(n());
    for (std::size_t g = 0; g + 1 < row_groups.size(); ++g)
      std::fill(group_of.begin() + row_groups[g],
                group_of.begin() + row_groups[g + 1],
                g);
    return group_of;
  }



  void
  CSRMatrix::vmult(Vector<double> &y, const Vector<double> &x) const
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



  void
  CSRMatrix::vmult_absolute(Vector<double> &y, const Vector<double> &x) const
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
} // namespace NPT
