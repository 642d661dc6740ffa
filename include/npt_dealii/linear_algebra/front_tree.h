// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the elimination tree of a sparse matrix, with its columns joined to
// fronts, and who works on them.

#ifndef npt_dealii_linear_algebra_front_tree_h
#define npt_dealii_linear_algebra_front_tree_h

#include <npt_dealii/linear_algebra/block_pattern.h>

#include <vector>

namespace NPT
{
  /// Unknowns that are eliminated together, and what that changes.
  struct Front
  {
    int first = 0; ///< of its pivots, in the order of elimination
    int n     = 0; ///< pivots
    int m     = 0; ///< rows: pivots and the unknowns that these change
    /// Of the unknowns that change: place in the order, ascending.
    std::vector<int> changed;
    /// Of the front that they are passed to, -1: there are none. `places` are
    /// their rows there, ascending.
    int              parent = -1;
    std::vector<int> places;
    std::vector<int> children;  ///< ascending
    int              level = 0; ///< distance from the root
    unsigned int     owner = 0; ///< the process that eliminates
    /// All processes eliminate it together; then so they do all above it.
    bool is_shared = false;

    std::size_t
    n_changed() const
    {
      return changed.size();
    }
    /// Row of a pivot or of an unknown that changes.
    int
    local(const int place) const;
    /// Multiplications and additions of L U.
    double
    operations() const;
    /// Time to assemble and eliminate it, in operations of products of large
    /// matrices. Fitted to 5,876 eliminations of fronts, in 35 factorizations
    /// of a woven cell of 12,630 unknowns, of which small ones reach a fifth of
    /// the speed of large ones.
    double
    work() const;
  };



  struct FrontTree
  {
    std::vector<int>   position; ///< of an unknown in the order, from 0
    std::vector<Front> fronts;   ///< children before parents

    /// Of the unknown at each place of the order.
    std::vector<int>
    front_of_place() const;
  };



  /**
   * @param order Position (from 0) of each block in the order of elimination,
   *   as of nested_dissection(); empty: as they are numbered. The order of the
   *   tree is one with the same factors.
   */
  FrontTree
  make_front_tree(const BlockPattern &pattern, const std::vector<int> &order);

  /**
   * Deal the fronts out to processes: whole subtrees (Geist, Ng 1989), and the
   * fronts above them to all together, so that the work of the
   * slowest one is small. Every process gets the same result.
   */
  void
  deal_out(FrontTree &tree, const unsigned int n_processes);
} // namespace NPT

#endif
