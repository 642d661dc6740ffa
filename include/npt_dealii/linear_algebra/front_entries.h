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
    // Of one front: entries of the lower triangle that are of this process, and
    // those that others send; then those above it. Where they begin, and end.
    static constexpr unsigned int n_kinds = 4;

    struct Entry
    {
      int row, column; // in the order of elimination
      int source;      // in the values of the matrix, or in received ones
    };
    std::vector<Entry>
    send_places(std::vector<Entry> &entries, const FrontTree &tree);
    void
    sort(const std::vector<Entry> &own,
         const std::vector<Entry> &of_others,
         const FrontTree          &tree);

    Ranks        ranks;
    BlockColumns block_columns;

    std::vector<int> start;  // of each kind of each front, and end
    std::vector<int> source; // of the entries, front by front
    std::vector<int> target; // in the front

    const std::vector<double> *own_values       = nullptr;
    bool                       takes_lower_only = false;
    // Of A.values, process by process, those of the lower triangle first, and
    // how many each of them gets and gives.
    std::vector<int>    sent_positions;
    std::vector<int>    n_sent, n_sent_lower, n_received, n_received_lower;
    std::vector<double> sent, received;
  };
} // namespace NPT

#endif
