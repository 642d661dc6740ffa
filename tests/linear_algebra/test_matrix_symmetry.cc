// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the question whether a matrix is symmetric.

#include <npt_dealii/linear_algebra/matrix_symmetry.h>

#include <catch2/catch.hpp>

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
