// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a direct factorization of sparse matrices of some thousand rows:
// multifrontal, with dense kernels of the BLAS.

#ifndef npt_dealii_linear_algebra_fronts_h
#define npt_dealii_linear_algebra_fronts_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/csr_matrix.h>
#include <npt_dealii/linear_algebra/front_entries.h>
#include <npt_dealii/linear_algebra/front_tree.h>

#include <mpi.h>

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
   * Several processes share the fronts by subtrees, see deal_out(): a process
   * sends C only where the front above belongs to another one.
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
    gigabytes(const FrontTree &tree, const unsigned int process);

  private:
    // Contributions of the fronts of every other level, the last one on top.
    struct Stack
    {
      std::vector<Number> values;
      std::size_t         top = 0;
    };

    bool
    is_own(const int front) const;
    // Whether the front that it is passed to is that of another process.
    bool
    is_passed_on(const Front &front) const;

    void
    find_given(const Front &front);
    void
    assemble(const int front, const std::vector<double> &values);
    void
    add_given(const Front &front, Number *contribution) const;
    template <typename Eliminate>
    bool
    eliminate_all(const std::vector<double> &values,
                  const Eliminate           &eliminate);

    void
    solve_forward(Number *y);
    void
    solve_backward(Number *y);

    // Messages belong to a front whose parent is that of another process.
    void
    send(const int front, const unsigned int to, std::vector<Number> message);
    void
    receive(const int          front,
            const unsigned int from,
            Number            *message,
            const std::size_t  size) const;
    void
    wait_until_sent();

    const Ranks                            ranks;
    const std::shared_ptr<const FrontTree> tree;
    FrontEntries                           entries;
    std::vector<std::size_t>               begin; // of fronts in the factors
    std::vector<Number>                    factors;
    std::vector<int>                       exchanges; // of rows, one per pivot
    Stack                                  stacks[2];
    bool                                   is_symmetric = false;

    // What the children of the present front have left, and what of it has
    // come from other processes.
    std::vector<const Number *>      given;
    std::vector<std::vector<Number>> received;
    // On their way.
    std::vector<std::vector<Number>> messages;
    std::vector<MPI_Request>         requests;

    std::vector<bool>   is_own_place;      // in the order of elimination
    std::vector<Number> permuted, changes; // of solve()
  };

  extern template class Fronts<double>;
  extern template class Fronts<float>;
} // namespace NPT

#endif
