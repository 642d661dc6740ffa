// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the pattern of a matrix, seen from blocks of unknowns.

#ifndef npt_dealii_linear_algebra_block_pattern_h
#define npt_dealii_linear_algebra_block_pattern_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/csr_matrix.h>

#include <vector>

namespace NPT
{
  /**
   * Unknowns with entries in the same columns of their rows form a block, as
   * the components of a control point do. What depends on the pattern alone,
   * such as the order of elimination, is found from blocks in a ninth of the
   * entries.
   */
  struct BlockPattern
  {
    /// Ascending, those of block b from first[b] to first[b + 1].
    std::vector<int> unknowns;
    std::vector<int> first;
    /// Blocks that share an entry with block b, in its rows or columns,
    /// ascending and without b itself, from row_start[b] to row_start[b + 1].
    std::vector<int> neighbors;
    std::vector<int> row_start;

    int
    n() const
    {
      return first.size() - 1;
    }
    int
    size(const int block) const
    {
      return first[block + 1] - first[block];
    }
  };

  /**
   * The blocks of A, in the order of their lowest unknowns; of several
   * processes those of the sum of what each has of A, the same on all of them.
   *
   * @param A Only its pattern is read; it need not be symmetric.
   */
  BlockPattern
  make_block_pattern(const CSRMatrix &A, const Ranks &ranks);
} // namespace NPT

#endif
