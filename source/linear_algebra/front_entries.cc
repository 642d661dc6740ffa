// SPDX-License-Identifier: LGPL-2.1-or-later
// Sorting and sending the entries of a matrix.

#include <npt_dealii/linear_algebra/front_entries.h>

#include <mpi.h>

#include <algorithm>
#include <numeric>

namespace NPT
{
  namespace
  {
    /// Where the messages from or to each process begin; last the sum.
    std::vector<int>
    offsets(const std::vector<int> &sizes)
    {
      std::vector<int> offsets(1, 0);
      for (const int size : sizes)
        offsets.push_back(offsets.back() + size);
      return offsets;
    }
  } // namespace



  void
  FrontEntries::set_up(const CSRMatrix &A,
                       const FrontTree &tree,
                       const Ranks     &ranks_of_run)
  {
    ranks         = ranks_of_run;
    block_columns = {static_cast<int>(ranks.n())};
    std::vector<Entry> own, of_others;
    own.reserve(A.n_nonzeros());
    for (unsigned int i = 0; i < A.n(); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        own.push_back({tree.position[i], tree.position[A.columns[k]], k});
    if (!ranks.is_alone())
      of_others = send_places(own, tree);
    sort(own, of_others, tree);
  }



  // Keep own entries, and tell the others where those go that they will get.
  std::vector<FrontEntries::Entry>
  FrontEntries::send_places(std::vector<Entry> &entries, const FrontTree &tree)
  {
    const int              me       = ranks.rank();
    const std::vector<int> front_of = tree.front_of_place();
    const auto             owner    = [&](const Entry &entry) {
      const Front &front =
        tree.fronts[front_of[std::min(entry.row, entry.column)]];
      return front.is_shared ? block_columns.owner(front.local(entry.column)) :
                                              static_cast<int>(front.owner);
    };
    const auto all_to_all = [&](const std::vector<int> &given) {
      std::vector<int> taken(ranks.n());
      MPI_Alltoall(given.data(),
                   1,
                   MPI_INT,
                   taken.data(),
                   1,
                   MPI_INT,
                   ranks.communicator());
      return taken;
    };

    std::vector<int> owners(entries.size());
    n_sent.assign(ranks.n(), 0);
    n_sent_lower.assign(ranks.n(), 0);
    for (std::size_t e = 0; e < entries.size(); ++e)
      {
        owners[e] = owner(entries[e]);
        if (owners[e] == me)
          continue;
        ++n_sent[owners[e]];
        if (entries[e].row >= entries[e].column)
          ++n_sent_lower[owners[e]];
      }
    n_received       = all_to_all(n_sent);
    n_received_lower = all_to_all(n_sent_lower);

    const std::vector<int> to = offsets(n_sent), from = offsets(n_received);
    std::vector<int>       next_lower = to, next_upper = to;
    for (unsigned int p = 0; p < ranks.n(); ++p)
      next_upper[p] += n_sent_lower[p];
    struct Place
    {
      int row, column;
    };
    std::vector<Place> sent_places(to.back()), received_places(from.back());
    sent_positions.resize(to.back());
    std::size_t n_own = 0;
    for (std::size_t e = 0; e < entries.size(); ++e)
      {
        const Entry entry = entries[e];
        const int   p     = owners[e];
        if (p == me)
          {
            entries[n_own++] = entry;
            continue;
          }
        const int at =
          entry.row >= entry.column ? next_lower[p]++ : next_upper[p]++;
        sent_places[at]    = {entry.row, entry.column};
        sent_positions[at] = entry.source;
      }
    entries.resize(n_own);
    sent.resize(to.back());
    received.resize(from.back());

    MPI_Alltoallv(sent_places.data(),
                  n_sent.data(),
                  to.data(),
                  MPI_2INT,
                  received_places.data(),
                  n_received.data(),
                  from.data(),
                  MPI_2INT,
                  ranks.communicator());
    std::vector<Entry> of_others;
    of_others.reserve(received_places.size());
    for (const Place &place : received_places)
      of_others.push_back(
        {place.row, place.column, static_cast<int>(of_others.size())});
    return of_others;
  }



  void
  FrontEntries::sort(const std::vector<Entry> &own,
                     const std::vector<Entry> &of_others,
                     const FrontTree          &tree)
  {
    const std::vector<int> front_of = tree.front_of_place();
    const unsigned int     n_fronts = tree.fronts.size();
    // By counting.
    const auto for_each_entry = [&](const auto &visit) {
      for (const auto *entries : {&own, &of_others})
        for (const Entry &entry : *entries)
          {
            const bool is_lower = entry.row >= entry.column;
            visit(n_kinds * front_of[is_lower ? entry.column : entry.row] +
                    (is_lower ? 0 : 2) + (entries == &own ? 0 : 1),
                  entry);
          }
    };
    start.assign(n_kinds * n_fronts + 1, 0);
    for_each_entry([&](const int kind, const Entry &) { ++start[kind + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<Entry> sorted(start.back());
    std::vector<int>   next = start;
    for_each_entry([&](const int kind, const Entry &entry) {
      sorted[next[kind]++] = entry;
    });

    source.resize(sorted.size());
    target.resize(sorted.size());
    std::vector<int> row_of_changed(front_of.size());
    for (unsigned int f = 0; f < n_fronts; ++f)
      {
        const Front &front = tree.fronts[f];
        for (unsigned int r = 0; r < front.n_changed(); ++r)
          row_of_changed[front.changed[r]] = front.n + r;
        const auto local = [&](const int place) {
          return place < front.first + front.n ? place - front.first :
                                                 row_of_changed[place];
        };
        for (int e = start[n_kinds * f]; e < start[n_kinds * (f + 1)]; ++e)
          {
            const int row    = local(sorted[e].row),
                      column = local(sorted[e].column);
            source[e]        = sorted[e].source;
            if (front.is_shared)
              target[e] = block_columns.local(column) * front.m + row;
            else if (column < front.n)
              target[e] = column * front.m + row;
            else
              target[e] =
                front.n * front.m + (column - front.n) * front.n + row;
          }
      }
  }



  void
  FrontEntries::collect(const std::vector<double> &values,
                        const bool                 lower_only)
  {
    own_values       = &values;
    takes_lower_only = lower_only;
    if (ranks.is_alone())
      return;
    const std::vector<int> &n_given = lower_only ? n_sent_lower : n_sent;
    const std::vector<int> &n_taken =
      lower_only ? n_received_lower : n_received;
    const std::vector<int> to = offsets(n_sent), from = offsets(n_received);
    for (unsigned int p = 0; p < ranks.n(); ++p)
      for (int k = to[p]; k < to[p] + n_given[p]; ++k)
        sent[k] = values[sent_positions[k]];
    MPI_Alltoallv(sent.data(),
                  n_given.data(),
                  to.data(),
                  MPI_DOUBLE,
                  received.data(),
                  n_taken.data(),
                  from.data(),
                  MPI_DOUBLE,
                  ranks.communicator());
  }



  template <typename Number>
  void
  FrontEntries::add(const unsigned int f, Number *front) const
  {
    const int *const begin = &start[n_kinds * f];
    for (unsigned int kind = 0; kind < (takes_lower_only ? 2 : n_kinds); ++kind)
      {
        const double *const values =
          kind % 2 == 0 ? own_values->data() : received.data();
        for (int e = begin[kind]; e < begin[kind + 1]; ++e)
          front[target[e]] += values[source[e]];
      }
  }



  template void
  FrontEntries::add(const unsigned int, double *) const;
  template void
  FrontEntries::add(const unsigned int, float *) const;
} // namespace NPT
