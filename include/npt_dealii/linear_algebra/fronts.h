// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a direct factorization of small sparse matrices: multifrontal, with
// dense kernels of the BLAS.

#ifndef npt_dealii_linear_algebra_fronts_h
#define npt_dealii_linear_algebra_fronts_h

#include <npt_dealii/linear_algebra/csr_matrix.h>

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
   * All that depends on the pattern is done once, by analyze(). The same input
   * gives the same factors to the last bit.
   */
  class Fronts
  {
  public:
    /**
     * @param A     Only its pattern is read; it need not be symmetric.
     * @param order Position (from 1) of each unknown in the order of
     *   elimination, as of nested_dissection(); empty: as they are numbered.
     */
    void
    analyze(const CSRMatrix &A, const std::vector<int> &order);

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

    /// Memory of the factors and the largest contributions [GB].
    double
    gigabytes() const;

  private:
    struct Front
    {
      int first = 0; // of its pivots, in the order of elimination
      int n     = 0; // pivots
      int m     = 0; // rows: pivots and the unknowns that these change
      // Of the unknowns that change: place in the order, ascending.
      std::vector<int> changed;
      // Of the front that they are passed to, -1: there are none. `places` are
      // their rows there, ascending.
      int              parent = -1;
      std::vector<int> places;
      std::vector<int> children;
      int              level = 0; // distance from the root
      // Columns of pivots, m x n, then rows of pivots right of them,
      // n x (m - n); each of them column by column.
      std::size_t begin = 0;
      // Entries of the matrix: where from, where to. The first ones belong to
      // the lower triangle.
      int first_entry = 0, end_of_lower = 0, end_of_entries = 0;
    };

    // Contributions of the fronts of every other level, the last one on top.
    struct Stack
    {
      std::vector<double> values;
      std::size_t         top = 0;
    };

    // Set `fronts` but for the entries, and `order` to its final values.
    void
    make_tree(const CSRMatrix &A, std::vector<int> &order);
    void
    find_entries(const CSRMatrix &A);

    void
    assemble(const Front &front, const std::vector<double> &values);
    void
    add_contributions(const Front &front, double *contribution);

    template <typename Eliminate>
    bool
    eliminate_all(const std::vector<double> &values,
                  const Eliminate           &eliminate);

    int                 n_unknowns = 0;
    std::vector<int>    position; // in the order of elimination, from 0
    std::vector<Front>  fronts;   // children before parents
    std::vector<int>    sources, targets;
    std::vector<double> factors;
    std::vector<int>    exchanges; // of rows, one per unknown
    Stack               stacks[2];
    bool                is_symmetric = false;
    std::vector<double> permuted, changes; // of solve()
  };
} // namespace NPT

#endif
