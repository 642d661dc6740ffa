// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a front that several processes eliminate together.

#ifndef npt_dealii_linear_algebra_shared_front_h
#define npt_dealii_linear_algebra_shared_front_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/block_columns.h>

#include <memory>
#include <vector>

namespace NPT
{
  /// Processes side by side, as ScaLAPACK knows them; made collectively.
  class ProcessRow
  {
  public:
    explicit ProcessRow(const Ranks &ranks);
    ~ProcessRow();
    ProcessRow(const ProcessRow &) = delete;
    ProcessRow &
    operator=(const ProcessRow &) = delete;

    const Ranks        ranks;
    const BlockColumns columns;

    int
    context() const
    {
      return context_;
    }

  private:
    int system_context = -1, context_ = -1;
  };



  /**
   * A front with its contribution, an m x m matrix by blocks of columns:
   *
   * @f[ \begin{pmatrix} F_{EE} & F_{EB} \\ F_{BE} & F_{BB} \end{pmatrix}
   *     \quad\to\quad F_{BB} - F_{BE} F_{EE}^{-1} F_{EB} @f]
   *
   * ScaLAPACK does the work. In solutions a vector on its way down to x is the
   * sum of what the processes have (each unknown of x is known to all as soon
   * as it is computed). All member functions but column() are collective.
   */
  template <typename Number>
  class SharedFront
  {
  public:
    SharedFront(const int                                n_pivots,
                const int                                n_rows,
                const std::shared_ptr<const ProcessRow> &row);

    std::vector<Number> values; ///< own columns, one behind the other

    /// Of the whole matrix; it must be an own one.
    Number *
    column(const int c);

    /// As those of Fronts; with what this process has found.
    bool
    factorize_general(const double largest_growth);
    bool
    factorize_positive_definite();

    /**
     * Eliminate the pivots from a right-hand side.
     *
     * @param y Pivots, then what they change; afterwards that is changed and
     *   the pivots are those of L^-1 b.
     */
    void
    solve_forward(Number *y);
    /// @param x Pivots as solve_forward() left them, then the solution for what
    ///   they change; afterwards the solution, on all processes.
    void
    solve_backward(Number *x);

  private:
    // Blocks of columns of pivots.
    int
    n_blocks() const;
    int
    block_size(const int block) const;
    void
    sum_at(const int process, Number *x, const int size) const;
    void
    broadcast(const int process, Number *x, const int size) const;

    const int                               n, m;
    const std::shared_ptr<const ProcessRow> row;
    std::vector<int>                        descriptor;
    std::vector<int>                        exchanges;
    bool                                    is_symmetric = false;
    std::vector<Number>                     change;
  };

  extern template class SharedFront<double>;
  extern template class SharedFront<float>;
} // namespace NPT

#endif
