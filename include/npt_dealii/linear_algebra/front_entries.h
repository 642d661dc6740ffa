// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines where the entries of a matrix go in the fronts of a process.

#ifndef npt_dealii_linear_algebra_front_entries_h
#define npt_dealii_linear_algebra_front_entries_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/block_columns.h>
#include <npt_dealii/linear_algebra/csr_matrix.h>
#include <npt_dealii/linear_algebra/front_tree.h>

#include <vector>

namespace NPT
{
  /**
   * The entries of a matrix, sorted by the front that they belong to: that of
   * the row or column that is eliminated first. With several processes an entry
   * of a front of another one is sent to its owner, in one message from each
   * process to each.
   */
  class FrontEntries
  {
  public:
    /// @param A The part of this process; its pattern only is read.
    void
    set_up(const CSRMatrix &A, const FrontTree &tree, const Ranks &ranks);

    /**
     * Send what belongs to others, and get what add() adds.
     *
     * @param values     Those of A; they have to stay until nothing is added
     *   any more.
     * @param lower_only Of the lower triangle, as the matrix is symmetric.
     */
    void
    collect(const std::vector<double> &values, const bool lower_only);

    /**
     * Add the entries of an own or shared front.
     *
     * @param front Columns of pivots, m x n, then rows of pivots right of them,
     *   n x (m - n), unless lower_only; each of them column by column. Of a
     *   shared front: own columns, m entries each.
     */
    template <typename Number>
    void
    add(const unsigned int f, Number *front) const;

  private:
    // Rows and columns that follow each other in the matrix and in the order
    // of elimination, most often those of two control points. So one index
    // serves all their entries.
    struct Block
    {
      int row, column; // first ones, in the order
      int n_rows, n_columns;
      int source; // of the first entry, in the matrix or what is received
      int source_stride;     // from row to row
      int target        = 0; // of the first entry, in the front
      int target_stride = 0; // from column to column
    };
    static bool
    has_lower_entry(const Block &block);
    std::vector<Block>
    make_blocks(const CSRMatrix &A, const FrontTree &tree) const;
    std::vector<Block>
    exchange_blocks(std::vector<Block> &blocks, const FrontTree &tree);
    void
    sort(const std::vector<Block> &own,
         const std::vector<Block> &of_others,
         const FrontTree          &tree);
    void
    set_target(Block &block, const Front &front) const;

    Ranks        ranks;
    BlockColumns block_columns;

    // Of one front: blocks of the lower triangle that this process has, and
    // those that others send; then those above it.
    static constexpr unsigned int n_kinds = 4;
    std::vector<Block>            sorted_blocks;
    std::vector<int>              start; // of each kind of each front, and end

    const std::vector<double> *own_values       = nullptr;
    bool                       takes_lower_only = false;
    // One message for each process; entries of the lower triangle first.
    struct Message
    {
      std::vector<Block> lower, upper;
      int                n_lower = 0, n = 0; // entries
    };
    std::vector<Message> sent_blocks;
    std::vector<int>     n_received, n_received_lower;
    std::vector<double>  sent, received;
  };
} // namespace NPT

#endif
