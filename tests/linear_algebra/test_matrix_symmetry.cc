// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the question whether a matrix is symmetric.

#include <npt_dealii/linear_algebra/matrix_symmetry.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <limits>
#include <vector>

using namespace NPT;

namespace
{
  // The matrix of a pattern, with the value of (i, j) that of (j, i).
  CSRMatrix
  symmetric_matrix(std::vector<std::vector<int>> columns)
  {
    CSRMatrix A;
    A.set_pattern(columns);
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        A.values[k] = 1. + (i + 1.) * (A.columns[k] + 1.);
    return A;
  }
} // namespace



TEST_CASE("A pattern is symmetric only if every entry has a transposed one",
          "[linear_algebra]")
{
  CHECK(has_symmetric_pattern(CSRMatrix()));
  CHECK(has_symmetric_pattern(symmetric_matrix({{0, 2}, {1}, {0, 2}})));
  CHECK(has_symmetric_pattern(symmetric_matrix({{2}, {}, {0}})));
  // One entry too many left or right of the diagonal, in every row.
  CHECK_FALSE(has_symmetric_pattern(symmetric_matrix({{0, 1}, {1}, {2}})));
  CHECK_FALSE(has_symmetric_pattern(symmetric_matrix({{0}, {0, 1}, {2}})));
  CHECK_FALSE(has_symmetric_pattern(symmetric_matrix({{0}, {1, 2}, {2}})));
  CHECK_FALSE(has_symmetric_pattern(symmetric_matrix({{0}, {1}, {1, 2}})));
  // As many left as right.
  CHECK_FALSE(
    has_symmetric_pattern(symmetric_matrix({{0, 1}, {1}, {1, 2}, {3}})));
}



TEST_CASE(
  "One value that differs by more than rounding, or is no number, makes "
  "a matrix unsymmetric",
  "[linear_algebra]")
{
  const CSRMatrix A = symmetric_matrix({{0, 1, 2}, {0, 1}, {0, 2}});
  CHECK(has_symmetric_values(A));
  for (std::size_t k = 0; k < A.values.size(); ++k)
    {
      INFO("entry " << k);
      for (const double no_number : {std::numeric_limits<double>::quiet_NaN(),
                                     std::numeric_limits<double>::infinity()})
        {
          CSRMatrix changed = A;
          changed.values[k] = no_number;
          CHECK_FALSE(has_symmetric_values(changed));
        }
      const bool is_diagonal = k == 0 || k == 4 || k == 6;
      CSRMatrix  changed     = A;
      changed.values[k] *= 1. + 1e-11;
      CHECK(has_symmetric_values(changed) == is_diagonal);
      changed.values[k] = A.values[k] * (1. + 1e-15);
      CHECK(has_symmetric_values(changed));
    }
}



TEST_CASE("Rows with equal columns, whatever their number, hide no difference",
          "[linear_algebra]")
{
  // Groups of one to five unknowns, each coupled with all of some others.
  const std::vector<int> first            = {0, 3, 4, 6, 9, 14};
  const bool             is_coupled[5][5] = {{true, true, false, true, false},
                                             {true, true, false, false, true},
                                             {false, false, true, true, true},
                                             {true, false, true, false, true},
                                             {false, true, true, true, true}};
  std::vector<std::vector<int>> columns(first.back());
  for (int g = 0; g < 5; ++g)
    for (int h = 0; h < 5; ++h)
      for (int i = first[g]; is_coupled[g][h] && i < first[g + 1]; ++i)
        for (int j = first[h]; j < first[h + 1]; ++j)
          columns[i].push_back(j);
  const CSRMatrix A = symmetric_matrix(columns);
  CHECK(A.row_groups == first);
  CHECK(has_symmetric_values(A));
  for (int i = 0; i < static_cast<int>(A.n()); ++i)
    for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
      {
        INFO("row " << i << ", column " << A.columns[k]);
        CSRMatrix changed = A;
        changed.values[k] *= 1. + 1e-11;
        CHECK(has_symmetric_values(changed) == (A.columns[k] == i));
        if (A.columns[k] == i)
          continue;
        // One entry less.
        auto fewer = columns;
        fewer[i].erase(
          std::find(fewer[i].begin(), fewer[i].end(), A.columns[k]));
        CHECK_FALSE(has_symmetric_pattern(symmetric_matrix(fewer)));
      }
  // Infinite values around a circle of rows leave no finite scale.
  CSRMatrix circle = A;
  for (const int at : {A.position(0, 3), A.position(3, 1), A.position(1, 0)})
    circle.values.at(at) = std::numeric_limits<double>::infinity();
  CHECK_FALSE(has_symmetric_values(circle));
}
