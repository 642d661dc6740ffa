// SPDX-License-Identifier: LGPL-2.1-or-later
// Factorization and solution with a tree of fronts.

#include <npt_dealii/linear_algebra/fronts.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace NPT
{
  namespace
  {
    template <typename Number>
    using Exchanges = void(const int *,
                           Number *,
                           const int *,
                           const int *,
                           const int *,
                           const int *,
                           const int *);
    template <typename Number>
    using TriangularMatrix = void(const char *,
                                  const char *,
                                  const char *,
                                  const char *,
                                  const int *,
                                  const int *,
                                  const Number *,
                                  const Number *,
                                  const int *,
                                  Number *,
                                  const int *);
    template <typename Number>
    using TriangularVector = void(const char *,
                                  const char *,
                                  const char *,
                                  const int *,
                                  const Number *,
                                  const int *,
                                  Number *,
                                  const int *);
  } // namespace
} // namespace NPT

// What deal.II does not declare.
extern "C"
{
  NPT::Exchanges<double>        dlaswp_;
  NPT::Exchanges<float>         slaswp_;
  NPT::TriangularMatrix<double> dtrsm_;
  NPT::TriangularMatrix<float>  strsm_;
  NPT::TriangularVector<double> dtrsv_;
  NPT::TriangularVector<float>  strsv_;
}

namespace NPT
{
  namespace
  {
    const int one = 1;

    template <typename Number>
    struct Blas
    {
      static constexpr bool is_double = std::is_same<Number, double>::value;

      static constexpr Number plus = 1, minus = -1, zero = 0;

      static constexpr auto
      laswp()
      {
        if constexpr (is_double)
          return &dlaswp_;
        else
          return &slaswp_;
      }
      static constexpr auto
      trsm()
      {
        if constexpr (is_double)
          return &dtrsm_;
        else
          return &strsm_;
      }
      static constexpr auto
      trsv()
      {
        if constexpr (is_double)
          return &dtrsv_;
        else
          return &strsv_;
      }
    };

    // Beyond it the residual of a solution may be above 1e-10, and one step of
    // refinement no longer leaves round-off; with factors of single precision
    // an iteration with them no longer gains a digit.
    constexpr double largest_growth = 1e6;

    template <typename Number>
    bool
    is_within_growth(const Number *column,
                     const int     n_rows,
                     const int     n_columns,
                     const int     stride)
    {
      for (int c = 0; c < n_columns; ++c, column += stride)
        for (int r = 0; r < n_rows; ++r)
          if (!(std::abs(column[r]) <= largest_growth))
            return false;
      return true;
    }



    std::size_t
    square(const std::size_t n)
    {
      return n * n;
    }



    /// What a process has to keep.
    struct Need
    {
      std::size_t factors = 0, stacks[2] = {0, 0}, messages = 0;
      int         largest_front = 0;
    };

    Need
    need_of(const FrontTree &tree, const unsigned int process)
    {
      Need        need;
      std::size_t tops[2] = {0, 0};
      for (const Front &front : tree.fronts)
        if (front.owner == process)
          {
            need.factors += std::size_t(front.n) * (2 * front.m - front.n);
            need.largest_front = std::max(need.largest_front, front.m);
            for (const int c : front.children)
              if (tree.fronts[c].owner == process)
                tops[tree.fronts[c].level % 2] -=
                  square(tree.fronts[c].n_changed());
            if (front.parent < 0)
              continue;
            if (tree.fronts[front.parent].owner != process)
              {
                need.messages += square(front.n_changed());
                continue;
              }
            std::size_t &top     = tops[front.level % 2];
            std::size_t &highest = need.stacks[front.level % 2];
            top += square(front.n_changed());
            highest = std::max(highest, top);
          }
      return need;
    }
  } // namespace



  template <typename Number>
  Fronts<Number>::Fronts(const CSRMatrix                        &A,
                         const std::shared_ptr<const FrontTree> &given_tree,
                         const Ranks                            &ranks_of_run)
    : ranks(ranks_of_run)
    , tree(given_tree)
  {
    entries.set_up(A, *tree, ranks);
    const Need need = need_of(*tree, ranks.rank());
    factors.resize(need.factors);
    for (const int parity : {0, 1})
      stacks[parity].values.resize(need.stacks[parity]);
    exchanges.resize(A.n());
    permuted.resize(A.n());
    changes.resize(need.largest_front);
    is_own_place.resize(A.n());
    std::size_t next = 0;
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      {
        begin.push_back(next);
        const Front &front = tree->fronts[f];
        std::fill_n(is_own_place.begin() + front.first, front.n, is_own(f));
        if (is_own(f))
          next += std::size_t(front.n) * (2 * front.m - front.n);
      }
  }



  template <typename Number>
  double
  Fronts<Number>::gigabytes(const FrontTree &tree, const unsigned int process)
  {
    const Need need = need_of(tree, process);
    return 1e-9 * sizeof(Number) *
           (need.factors + need.stacks[0] + need.stacks[1] + need.messages);
  }



  template <typename Number>
  bool
  Fronts<Number>::is_own(const int front) const
  {
    return tree->fronts[front].owner == ranks.rank();
  }



  template <typename Number>
  bool
  Fronts<Number>::is_passed_on(const Front &front) const
  {
    return front.parent >= 0 && !is_own(front.parent);
  }



  template <typename Number>
  void
  Fronts<Number>::send(const int           front,
                       const unsigned int  to,
                       std::vector<Number> message)
  {
    messages.push_back(std::move(message));
    requests.emplace_back();
    MPI_Isend(messages.back().data(),
              messages.back().size(),
              dealii::Utilities::MPI::mpi_type_id_for_type<Number>,
              to,
              tree->fronts[front].message,
              ranks.communicator(),
              &requests.back());
  }



  template <typename Number>
  void
  Fronts<Number>::receive(const int          front,
                          const unsigned int from,
                          Number            *message,
                          const std::size_t  size) const
  {
    MPI_Recv(message,
             size,
             dealii::Utilities::MPI::mpi_type_id_for_type<Number>,
             from,
             tree->fronts[front].message,
             ranks.communicator(),
             MPI_STATUS_IGNORE);
  }



  template <typename Number>
  void
  Fronts<Number>::wait_until_sent()
  {
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    requests.clear();
    messages.clear();
  }



  // Find what the children of a front have left for it. Own ones lie on their
  // stack one behind the other.
  template <typename Number>
  void
  Fronts<Number>::find_given(const Front &front)
  {
    const Stack  &stack = stacks[(front.level + 1) % 2];
    const Number *top   = stack.values.data() + stack.top;
    given.resize(front.children.size());
    received.clear();
    for (int k = front.children.size() - 1; k >= 0; --k)
      {
        const int         c    = front.children[k];
        const std::size_t size = square(tree->fronts[c].n_changed());
        if (is_own(c))
          given[k] = top -= size;
        else
          {
            received.emplace_back(size);
            receive(c, tree->fronts[c].owner, received.back().data(), size);
            given[k] = received.back().data();
          }
      }
  }



  // Set the columns and rows of the pivots to the entries of the matrix and to
  // what the children have left for them.
  template <typename Number>
  void
  Fronts<Number>::assemble(const int f, const std::vector<double> &values)
  {
    const Front  &front = tree->fronts[f];
    const int     n = front.n, m = front.m, n_changed = m - n;
    Number *const columns = factors.data() + begin[f];
    Number *const rows    = columns + std::size_t(n) * m;
    std::fill_n(columns,
                std::size_t(n) * (is_symmetric ? m : m + n_changed),
                Number(0));
    const FrontEntries::Range range = entries.ranges[f];
    const int end = is_symmetric ? range.end_of_lower : range.end;
    for (int e = range.begin; e < end; ++e)
      columns[entries.target[e]] += values[entries.source[e]];

    for (int k = front.children.size() - 1; k >= 0; --k)
      {
        const std::vector<int> &places = tree->fronts[front.children[k]].places;
        const int               size   = places.size();
        const int               n_pivots =
          std::lower_bound(places.begin(), places.end(), n) - places.begin();
        for (int j = 0; j < n_pivots; ++j)
          {
            Number *const       to   = columns + std::size_t(places[j]) * m;
            const Number *const from = given[k] + std::size_t(j) * size;
            for (int i = is_symmetric ? j : 0; i < size; ++i)
              to[places[i]] += from[i];
          }
        if (!is_symmetric)
          for (int j = n_pivots; j < size; ++j)
            {
              Number *const       to   = rows + std::size_t(places[j] - n) * n;
              const Number *const from = given[k] + std::size_t(j) * size;
              for (int i = 0; i < n_pivots; ++i)
                to[places[i]] += from[i];
            }
      }
  }



  // Add what the children have left for the unknowns that are eliminated later.
  template <typename Number>
  void
  Fronts<Number>::add_given(const Front &front, Number *contribution) const
  {
    const int n = front.n, n_changed = front.m - n;
    for (int k = front.children.size() - 1; k >= 0; --k)
      {
        const std::vector<int> &places = tree->fronts[front.children[k]].places;
        const int               size   = places.size();
        const int               n_pivots =
          std::lower_bound(places.begin(), places.end(), n) - places.begin();
        for (int j = n_pivots; j < size; ++j)
          {
            Number *const to =
              contribution + std::size_t(places[j] - n) * n_changed - n;
            const Number *const from = given[k] + std::size_t(j) * size;
            for (int i = is_symmetric ? j : n_pivots; i < size; ++i)
              to[places[i]] += from[i];
          }
      }
  }



  template <typename Number>
  template <typename Eliminate>
  bool
  Fronts<Number>::eliminate_all(const std::vector<double> &values,
                                const Eliminate           &eliminate)
  {
    const std::vector<double> &collected = entries.collect(values);
    for (Stack &stack : stacks)
      stack.top = 0;
    // A process that fails goes on to send what others wait for.
    bool succeeded = true;
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      {
        if (!is_own(f))
          continue;
        const Front &front = tree->fronts[f];
        Stack       &stack = stacks[front.level % 2];
        find_given(front);
        std::vector<Number> message;
        if (is_passed_on(front))
          message.resize(square(front.n_changed()));
        if (succeeded)
          {
            assemble(f, collected);
            Number *const contribution = is_passed_on(front) ?
                                           message.data() :
                                           stack.values.data() + stack.top;
            succeeded =
              eliminate(front, factors.data() + begin[f], contribution);
            if (succeeded)
              add_given(front, contribution);
            else if (ranks.is_alone())
              return false;
          }
        if (is_passed_on(front))
          send(f, tree->fronts[front.parent].owner, std::move(message));
        else
          stack.top += square(front.n_changed());
        for (const int c : front.children)
          if (is_own(c))
            stacks[(front.level + 1) % 2].top -=
              square(tree->fronts[c].n_changed());
      }
    wait_until_sent();
    return ranks.all(succeeded);
  }



  template <typename Number>
  bool
  Fronts<Number>::factorize_general(const std::vector<double> &values)
  {
    using B      = Blas<Number>;
    is_symmetric = false;
    return eliminate_all(
      values,
      [this](const Front &front, Number *columns, Number *contribution) {
        const int  n = front.n, m = front.m, n_changed = m - n;
        int *const exchanged = exchanges.data() + front.first;
        int        info      = 0;
        dealii::getrf(&n, &n, columns, &m, exchanged, &info);
        if (info != 0)
          return false;
        if (n_changed == 0)
          return true;
        Number *const rows  = columns + std::size_t(n) * m;
        Number *const below = columns + n;
        B::laswp()(&n_changed, rows, &n, &one, &n, exchanged, &one);
        B::trsm()(
          "L", "L", "N", "U", &n, &n_changed, &B::plus, columns, &m, rows, &n);
        B::trsm()(
          "R", "U", "N", "N", &n_changed, &n, &B::plus, columns, &m, below, &m);
        if (!is_within_growth(below, n_changed, n, m))
          return false;
        dealii::gemm("N",
                     "N",
                     &n_changed,
                     &n_changed,
                     &n,
                     &B::minus,
                     below,
                     &m,
                     rows,
                     &n,
                     &B::zero,
                     contribution,
                     &n_changed);
        return true;
      });
  }



  template <typename Number>
  bool
  Fronts<Number>::factorize_positive_definite(const std::vector<double> &values)
  {
    using B      = Blas<Number>;
    is_symmetric = true;
    return eliminate_all(
      values, [](const Front &front, Number *columns, Number *contribution) {
        const int n = front.n, m = front.m, n_changed = m - n;
        int       info = 0;
        dealii::potrf("L", &n, columns, &m, &info);
        if (info != 0)
          return false;
        if (n_changed == 0)
          return true;
        Number *const below = columns + n;
        B::trsm()(
          "R", "L", "T", "N", &n_changed, &n, &B::plus, columns, &m, below, &m);
        dealii::syrk("L",
                     "N",
                     &n_changed,
                     &n,
                     &B::minus,
                     below,
                     &m,
                     &B::zero,
                     contribution,
                     &n_changed);
        return true;
      });
  }



  template <typename Number>
  void
  Fronts<Number>::solve_forward(Number *y)
  {
    using B              = Blas<Number>;
    Number *const change = changes.data();
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      {
        if (!is_own(f))
          continue;
        const Front &front = tree->fronts[f];
        for (const int c : front.children)
          if (!is_own(c))
            {
              const std::vector<int> &changed = tree->fronts[c].changed;
              received.assign(1, std::vector<Number>(changed.size()));
              receive(c,
                      tree->fronts[c].owner,
                      received[0].data(),
                      changed.size());
              for (unsigned int r = 0; r < changed.size(); ++r)
                y[changed[r]] += received[0][r];
            }

        const int           n = front.n, m = front.m, n_changed = m - n;
        const Number *const columns = factors.data() + begin[f];
        Number *const       pivots  = y + front.first;
        if (!is_symmetric)
          for (int r = 0; r < n; ++r)
            std::swap(pivots[r], pivots[exchanges[front.first + r] - 1]);
        B::trsv()(
          "L", "N", is_symmetric ? "N" : "U", &n, columns, &m, pivots, &one);
        if (n_changed == 0)
          continue;
        dealii::gemv("N",
                     &n_changed,
                     &n,
                     &B::plus,
                     columns + n,
                     &m,
                     pivots,
                     &one,
                     &B::zero,
                     change,
                     &one);
        for (int r = 0; r < n_changed; ++r)
          y[front.changed[r]] -= change[r];

        if (is_passed_on(front))
          {
            std::vector<Number> message;
            for (const int place : front.changed)
              {
                message.push_back(y[place]);
                y[place] = 0;
              }
            send(f, tree->fronts[front.parent].owner, std::move(message));
          }
      }
    wait_until_sent();
  }



  template <typename Number>
  void
  Fronts<Number>::solve_backward(Number *y)
  {
    using B              = Blas<Number>;
    Number *const change = changes.data();
    for (int f = tree->fronts.size() - 1; f >= 0; --f)
      {
        if (!is_own(f))
          continue;
        const Front        &front = tree->fronts[f];
        const int           n = front.n, m = front.m, n_changed = m - n;
        const Number *const columns = factors.data() + begin[f];
        Number *const       pivots  = y + front.first;
        if (n_changed > 0)
          {
            if (is_passed_on(front))
              receive(f, tree->fronts[front.parent].owner, change, n_changed);
            else
              for (int r = 0; r < n_changed; ++r)
                change[r] = y[front.changed[r]];
            // For the fronts below.
            if (is_passed_on(front))
              for (int r = 0; r < n_changed; ++r)
                y[front.changed[r]] = change[r];
            if (is_symmetric)
              dealii::gemv("T",
                           &n_changed,
                           &n,
                           &B::minus,
                           columns + n,
                           &m,
                           change,
                           &one,
                           &B::plus,
                           pivots,
                           &one);
            else
              dealii::gemv("N",
                           &n,
                           &n_changed,
                           &B::minus,
                           columns + std::size_t(n) * m,
                           &n,
                           change,
                           &one,
                           &B::plus,
                           pivots,
                           &one);
          }
        if (is_symmetric)
          B::trsv()("L", "T", "N", &n, columns, &m, pivots, &one);
        else
          B::trsv()("U", "N", "N", &n, columns, &m, pivots, &one);

        for (const int c : front.children)
          if (!is_own(c))
            {
              std::vector<Number> message;
              for (const int place : tree->fronts[c].changed)
                message.push_back(y[place]);
              send(c, tree->fronts[c].owner, std::move(message));
            }
      }
    wait_until_sent();
  }



  template <typename Number>
  void
  Fronts<Number>::solve(dealii::Vector<double> &x)
  {
    // Of a right-hand side everyone has all; each begins with what is its own.
    std::vector<Number> &y = permuted;
    for (unsigned int i = 0; i < x.size(); ++i)
      y[tree->position[i]] = is_own_place[tree->position[i]] ? x[i] : 0;
    solve_forward(y.data());
    solve_backward(y.data());
    for (unsigned int i = 0; i < x.size(); ++i)
      x[i] = is_own_place[tree->position[i]] ? y[tree->position[i]] : 0;
    ranks.sum(x);
  }



  template class Fronts<double>;
  template class Fronts<float>;
} // namespace NPT
