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
   * the row or column that is eliminated first. With several processes each
   * entry is sent to the owner of its front, in one message from each process
   * to each.
   */
  class FrontEntries
  {
  public:
    /// @param A The part of this process; its pattern only is read.
    void
    set_up(const CSRMatrix &A, const FrontTree &tree, const Ranks &ranks);

    /**
     * Return the entries of own fronts, as `source` counts them.
     *
     * @param values Those of A; returned as they are by a process alone.
     */
    const std::vector<double> &
    collect(const std::vector<double> &values);

    /// Of a front; the first ones belong to the lower triangle.
    struct Range
    {
      int begin = 0, end_of_lower = 0, end = 0;
    };
    std::vector<Range> ranges; ///< one per front; empty where it is not own
    std::vector<int>   source; ///< of the entries, front by front
    /// Columns of pivots, m x n, then rows of pivots right of them,
    /// n x (m - n); each of them column by column. Of a shared front: own
    /// columns, m entries each.
    std::vector<int> target;

  private:
    struct Place
    {
      int row, column; // in the order of elimination
    };
    std::vector<Place>
    send_places(const std::vector<Place> &places, const FrontTree &tree);
    void
    sort(const std::vector<Place> &places, const FrontTree &tree);

    Ranks        ranks;
    BlockColumns block_columns;
    // Of A.values, process by process, and how many each of them gets and
    // gives.
    std::vector<int>    sent_positions, n_sent, n_received;
    std::vector<double> sent, received;
  };
} // namespace NPT

#endif
