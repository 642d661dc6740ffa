// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a direct factorization of sparse matrices of some thousand rows:
// multifrontal, with dense kernels of the BLAS.

#ifndef npt_dealii_linear_algebra_fronts_h
#define npt_dealii_linear_algebra_fronts_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/csr_matrix.h>
#include <npt_dealii/linear_algebra/front_entries.h>
#include <npt_dealii/linear_algebra/front_tree.h>
#include <npt_dealii/linear_algebra/shared_front.h>

#include <memory>
#include <vector>

namespace NPT
{
  /**
   * L U or, for a symmetric positive definite matrix, L L^T of a sparse matrix,
   * as a tree of dense matrices, the fronts (Duff, Reid 1983; Liu 1992).
   *
   * A front eliminates a few unknowns E that have almost the same neighbors B:
   *
   * @f[ \begin{pmatrix} F_{EE} & F_{EB} \\ F_{BE} & 0 \end{pmatrix}
   *     \quad\to\quad C = - F_{BE} F_{EE}^{-1} F_{EB} @f]
   *
   * F are the entries of the matrix in rows or columns of E plus what the
   * fronts below have left, C is added to the front of the first unknown of B.
   * Rows are exchanged within E only, so a matrix may be refused though it is
   * not singular: then somebody with all pivots must do it. For n unknowns of a
   * three-dimensional body operations grow as n^2 and memory as n^(4/3).
   *
   * Several processes share the fronts by subtrees, see deal_out(), and those
   * above them by blocks of columns (SharedFront).
   *
   * All that depends on the pattern is done once, by the constructor. The same
   * input gives the same factors to the last bit. All member functions are
   * collective.
   *
   * @tparam Number Of the factors: double or float.
   */
  template <typename Number>
  class Fronts
  {
  public:
    /**
     * @param A     The part of this process; only its pattern is read.
     * @param tree  That of the sum of all parts, dealt out to `ranks`.
     */
    Fronts(const CSRMatrix                        &A,
           const std::shared_ptr<const FrontTree> &tree,
           const Ranks                            &ranks = {});

    /// Return false if a pivot is zero, or entries of L grow beyond 1e6, where
    /// refinement would not mend what is lost; the factors are void then.
    bool
    factorize_general(const std::vector<double> &values);

    /// Only entries of the lower triangle are read. Return false if the matrix
    /// is not positive definite; the factors are void then.
    bool
    factorize_positive_definite(const std::vector<double> &values);

    /// Replace x by the solution of A y = x.
    void
    solve(dealii::Vector<double> &x);

    /// Memory of the factors and the largest contributions of a process [GB].
    static double
    gigabytes(const FrontTree &tree, const Ranks &ranks);

  private:
    // Contributions of the fronts of every other level, the last one on top.
    struct Stack
    {
      std::vector<Number> values;
      std::size_t         top = 0;
    };

    bool
    is_own(const Front &front) const;
    // Whether it is an own one below a shared one.
    bool
    is_top(const Front &front) const;

    void
    assemble(const int front);
    void
    add_contributions(const Front &front, Number *contribution) const;
    // Own fronts, children before parents.
    template <typename Eliminate>
    bool
    eliminate_own(const Eliminate &eliminate);

    unsigned int
    holder(const Front &front, const int column) const;
    const Number *
    contribution(const int front, const int column) const;
    void
    exchange_contributions(const int front);
    template <typename Eliminate>
    bool
    eliminate_shared(const Eliminate &eliminate);

    void
    solve_forward(Number *y);
    void
    solve_backward(Number *y);
    // Pivots of a front, then what they change.
    void
    gather(const Front &front, const Number *y);
    void
    scatter(const Front &front, const int n_rows, Number *y) const;

    const Ranks                            ranks;
    const std::shared_ptr<const FrontTree> tree;
    FrontEntries                           entries;
    std::vector<std::size_t>               begin; // of fronts in the factors
    std::vector<Number>                    factors;
    std::vector<int>                       exchanges; // of rows, one per pivot
    Stack                                  stacks[2];
    bool                                   is_symmetric = false;

    // By front, where there is one.
    std::vector<std::unique_ptr<SharedFront<Number>>> shared;
    std::vector<std::vector<Number>>                  tops; // what they leave
    const BlockColumns                                block_columns;

    std::vector<bool>   is_own_place;      // in the order of elimination
    std::vector<Number> permuted, changes; // of solve(), as local ones
  };
} // namespace NPT

#endif
