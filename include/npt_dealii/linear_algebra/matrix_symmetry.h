// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what direct solvers ask of a matrix: is it symmetric?

#ifndef npt_dealii_linear_algebra_matrix_symmetry_h
#define npt_dealii_linear_algebra_matrix_symmetry_h

#include <npt_dealii/linear_algebra/csr_matrix.h>

namespace NPT
{
  /// Return whether every entry has a transposed one.
  bool
  has_symmetric_pattern(const CSRMatrix &A);

  /// Return whether, in addition, both have the same value, up to 1e-12 of the
  /// largest one of the row; values that are not numbers are not symmetric.
  bool
  has_symmetric_values(const CSRMatrix &A);
} // namespace NPT

#endif
