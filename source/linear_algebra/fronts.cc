// SPDX-License-Identifier: LGPL-2.1-or-later
// Factorization with a tree of fronts.

#include <npt_dealii/linear_algebra/dense_kernels.h>
#include <npt_dealii/linear_algebra/fronts.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_templates.h>

#include <mpi.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using DenseKernels::one;

  namespace
  {
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



    /// Numbers that a process has to keep.
    struct Need
    {
      std::size_t factors = 0, stacks[2] = {0, 0}, shared = 0, tops = 0;
      int         largest_front = 0;
    };

    Need
    need_of(const FrontTree    &tree,
            const unsigned int  process,
            const BlockColumns &block_columns)
    {
      Need        need;
      std::size_t tops[2] = {0, 0};
      for (const Front &front : tree.fronts)
        if (front.is_shared)
          {
            need.shared +=
              std::size_t(front.m) * block_columns.n_local(front.m, process);
            need.largest_front = std::max(need.largest_front, front.m);
          }
        else if (front.owner == process)
          {
            need.factors += std::size_t(front.n) * (2 * front.m - front.n);
            need.largest_front = std::max(need.largest_front, front.m);
            for (const int c : front.children)
              tops[tree.fronts[c].level % 2] -=
                square(tree.fronts[c].n_changed());
            if (front.parent < 0)
              continue;
            if (tree.fronts[front.parent].is_shared)
              {
                need.tops += square(front.n_changed());
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
    , shared(tree->fronts.size())
    , tops(tree->fronts.size())
    , block_columns{static_cast<int>(ranks.n())}
  {
    entries.set_up(A, *tree, ranks);
    const Need need = need_of(*tree, ranks.rank(), block_columns);
    factors.resize(need.factors);
    for (const int parity : {0, 1})
      stacks[parity].values.resize(need.stacks[parity]);
    exchanges.resize(A.n());
    permuted.resize(A.n());
    changes.resize(need.largest_front);
    is_own_place.resize(A.n());

    std::shared_ptr<const ProcessRow> row;
    std::size_t                       next = 0;
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      {
        begin.push_back(next);
        const Front &front = tree->fronts[f];
        // Somebody has to add the right-hand side and the solution of all.
        std::fill_n(is_own_place.begin() + front.first,
                    front.n,
                    front.is_shared ? ranks.is_first() : is_own(front));
        if (is_own(front))
          next += std::size_t(front.n) * (2 * front.m - front.n);
        if (is_top(front))
          tops[f].resize(square(front.n_changed()));
        if (!front.is_shared)
          continue;
        if (!row)
          row = std::make_shared<ProcessRow>(ranks);
        shared[f] =
          std::make_unique<SharedFront<Number>>(front.n, front.m, row);
      }
  }



  template <typename Number>
  double
  Fronts<Number>::gigabytes(const FrontTree &tree, const Ranks &ranks)
  {
    const Need need =
      need_of(tree, ranks.rank(), {static_cast<int>(ranks.n())});
    return 1e-9 * sizeof(Number) *
           (need.factors + need.stacks[0] + need.stacks[1] + need.shared +
            need.tops);
  }



  template <typename Number>
  bool
  Fronts<Number>::is_own(const Front &front) const
  {
    return !front.is_shared && front.owner == ranks.rank();
  }



  template <typename Number>
  bool
  Fronts<Number>::is_top(const Front &front) const
  {
    return is_own(front) && front.parent >= 0 &&
           tree->fronts[front.parent].is_shared;
  }



  // Set the columns and rows of the pivots to the entries of the matrix and to
  // what the children have left for them.
  template <typename Number>
  void
  Fronts<Number>::assemble(const int f)
  {
    const Front  &front = tree->fronts[f];
    const int     n = front.n, m = front.m, n_changed = m - n;
    Number *const columns = factors.data() + begin[f];
    Number *const rows    = columns + std::size_t(n) * m;
    std::fill_n(columns,
                std::size_t(n) * (is_symmetric ? m : m + n_changed),
                Number(0));
    entries.add(f, columns);

    // Children lie on their stack one behind the other.
    const Stack  &stack = stacks[(front.level + 1) % 2];
    const Number *given = stack.values.data() + stack.top;
    for (auto c = front.children.rbegin(); c != front.children.rend(); ++c)
      {
        const std::vector<int> &places = tree->fronts[*c].places;
        const int               size   = places.size();
        given -= square(size);
        const int n_pivots =
          std::lower_bound(places.begin(), places.end(), n) - places.begin();
        for (int j = 0; j < n_pivots; ++j)
          {
            Number *const       to   = columns + std::size_t(places[j]) * m;
            const Number *const from = given + std::size_t(j) * size;
            for (int i = is_symmetric ? j : 0; i < size; ++i)
              to[places[i]] += from[i];
          }
        if (!is_symmetric)
          for (int j = n_pivots; j < size; ++j)
            {
              Number *const       to   = rows + std::size_t(places[j] - n) * n;
              const Number *const from = given + std::size_t(j) * size;
              for (int i = 0; i < n_pivots; ++i)
                to[places[i]] += from[i];
            }
      }
  }



  // Add what the children have left for the unknowns that are eliminated later.
  template <typename Number>
  void
  Fronts<Number>::add_contributions(const Front &front,
                                    Number      *contribution) const
  {
    const int     n = front.n, n_changed = front.m - n;
    const Stack  &stack = stacks[(front.level + 1) % 2];
    const Number *given = stack.values.data() + stack.top;
    for (auto c = front.children.rbegin(); c != front.children.rend(); ++c)
      {
        const std::vector<int> &places = tree->fronts[*c].places;
        const int               size   = places.size();
        given -= square(size);
        const int n_pivots =
          std::lower_bound(places.begin(), places.end(), n) - places.begin();
        for (int j = n_pivots; j < size; ++j)
          {
            Number *const to =
              contribution + std::size_t(places[j] - n) * n_changed - n;
            const Number *const from = given + std::size_t(j) * size;
            for (int i = is_symmetric ? j : n_pivots; i < size; ++i)
              to[places[i]] += from[i];
          }
      }
  }



  template <typename Number>
  template <typename Eliminate>
  bool
  Fronts<Number>::eliminate_own(const Eliminate &eliminate)
  {
    for (Stack &stack : stacks)
      stack.top = 0;
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      {
        const Front &front = tree->fronts[f];
        if (!is_own(front))
          continue;
        assemble(f);
        Stack        &stack = stacks[front.level % 2];
        Number *const contribution =
          is_top(front) ? tops[f].data() : stack.values.data() + stack.top;
        if (!eliminate(front, factors.data() + begin[f], contribution))
          return false;
        add_contributions(front, contribution);
        if (!is_top(front))
          stack.top += square(front.n_changed());
        for (const int c : front.children)
          stacks[(front.level + 1) % 2].top -=
            square(tree->fronts[c].n_changed());
      }
    return true;
  }



  // The process that has a column of what a front leaves.
  template <typename Number>
  unsigned int
  Fronts<Number>::holder(const Front &front, const int column) const
  {
    return front.is_shared ? block_columns.owner(front.n + column) :
                             front.owner;
  }



  template <typename Number>
  const Number *
  Fronts<Number>::contribution(const int f, const int column) const
  {
    const Front &front = tree->fronts[f];
    return front.is_shared ?
             shared[f]->column(front.n + column) + front.n :
             tops[f].data() + std::size_t(column) * front.n_changed();
  }



  // Send what this process has of what the children of a shared front have
  // left, and add what it gets.
  template <typename Number>
  void
  Fronts<Number>::exchange_contributions(const int f)
  {
    const Front       &front = tree->fronts[f];
    const unsigned int me    = ranks.rank();
    // Columns of the children's contributions, each from its first row that is
    // needed, with the process that has it and the one that wants it.
    const auto for_each_column = [&](const auto &visit) {
      for (const int c : front.children)
        {
          const Front &child = tree->fronts[c];
          for (unsigned int j = 0; j < child.n_changed(); ++j)
            {
              const unsigned int to = block_columns.owner(child.places[j]);
              visit(c, j, is_symmetric ? j : 0u, holder(child, j), to);
            }
        }
    };
    const auto size_of = [&](const int c, const unsigned int first_row) {
      return tree->fronts[c].n_changed() - first_row;
    };
    using Unsigned = unsigned int;

    std::vector<std::size_t> to_send(ranks.n(), 0), to_receive(ranks.n(), 0);
    for_each_column(
      [&](
        const int c, Unsigned, Unsigned first_row, Unsigned from, Unsigned to) {
        if (from == me)
          to_send[to] += size_of(c, first_row);
        else if (to == me)
          to_receive[from] += size_of(c, first_row);
      });
    std::vector<std::vector<Number>> sent(ranks.n()), received(ranks.n());
    for (unsigned int p = 0; p < ranks.n(); ++p)
      {
        sent[p].reserve(p == me ? 0 : to_send[p]);
        received[p].resize(to_receive[p]);
      }
    for_each_column([&](const int c,
                        Unsigned  j,
                        Unsigned  first_row,
                        Unsigned  from,
                        Unsigned  to) {
      if (from != me || to == me)
        return;
      const Number *const from_here = contribution(c, j) + first_row;
      sent[to].insert(sent[to].end(),
                      from_here,
                      from_here + size_of(c, first_row));
    });

    const MPI_Datatype type =
      dealii::Utilities::MPI::mpi_type_id_for_type<Number>;
    std::vector<MPI_Request> requests;
    for (unsigned int p = 0; p < ranks.n(); ++p)
      {
        if (!received[p].empty())
          MPI_Irecv(received[p].data(),
                    received[p].size(),
                    type,
                    p,
                    0,
                    ranks.communicator(),
                    &requests.emplace_back());
        if (!sent[p].empty())
          MPI_Isend(sent[p].data(),
                    sent[p].size(),
                    type,
                    p,
                    0,
                    ranks.communicator(),
                    &requests.emplace_back());
      }

    const auto add =
      [&](const int c, Unsigned j, Unsigned first_row, const Number *from) {
        const std::vector<int> &places = tree->fronts[c].places;
        Number *const           target = shared[f]->column(places[j]);
        for (Unsigned i = first_row; i < places.size(); ++i)
          target[places[i]] += from[i - first_row];
      };
    // Own ones while the others are on their way.
    for_each_column([&](const int c,
                        Unsigned  j,
                        Unsigned  first_row,
                        Unsigned  from,
                        Unsigned  to) {
      if (from == me && to == me)
        add(c, j, first_row, contribution(c, j) + first_row);
    });
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    std::vector<const Number *> next;
    for (const std::vector<Number> &message : received)
      next.push_back(message.data());
    for_each_column([&](const int c,
                        Unsigned  j,
                        Unsigned  first_row,
                        Unsigned  from,
                        Unsigned  to) {
      if (from == me || to != me)
        return;
      add(c, j, first_row, next[from]);
      next[from] += size_of(c, first_row);
    });
  }



  template <typename Number>
  template <typename Eliminate>
  bool
  Fronts<Number>::eliminate_shared(const Eliminate &eliminate)
  {
    for (unsigned int f = 0; f < tree->fronts.size(); ++f)
      if (tree->fronts[f].is_shared)
        {
          std::vector<Number> &entries_here = shared[f]->values;
          std::fill(entries_here.begin(), entries_here.end(), Number(0));
          entries.add(f, entries_here.data());
          exchange_contributions(f);
          if (!ranks.all(eliminate(*shared[f])))
            return false;
        }
    return true;
  }



  template <typename Number>
  bool
  Fronts<Number>::factorize_general(const std::vector<double> &values)
  {
    using B      = Blas<Number>;
    is_symmetric = false;
    entries.collect(values, is_symmetric);
    const bool succeeded = eliminate_own(
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
        B::laswp(&n_changed, rows, &n, &one, &n, exchanged, &one);
        B::trsm(
          "L", "L", "N", "U", &n, &n_changed, &B::plus, columns, &m, rows, &n);
        B::trsm(
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
    return ranks.all(succeeded) &&
           eliminate_shared([](SharedFront<Number> &front) {
             return front.factorize_general(largest_growth);
           });
  }



  template <typename Number>
  bool
  Fronts<Number>::factorize_positive_definite(const std::vector<double> &values)
  {
    using B      = Blas<Number>;
    is_symmetric = true;
    entries.collect(values, is_symmetric);
    const bool succeeded = eliminate_own(
      [](const Front &front, Number *columns, Number *contribution) {
        const int n = front.n, m = front.m, n_changed = m - n;
        int       info = 0;
        dealii::potrf("L", &n, columns, &m, &info);
        if (info != 0)
          return false;
        if (n_changed == 0)
          return true;
        Number *const below = columns + n;
        B::trsm(
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
    return ranks.all(succeeded) &&
           eliminate_shared([](SharedFront<Number> &front) {
             return front.factorize_positive_definite();
           });
  }



  template class Fronts<double>;
  template class Fronts<float>;
} // namespace NPT
