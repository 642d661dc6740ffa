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
    std::vector<Place> places;
    places.reserve(A.n_nonzeros());
    for (unsigned int i = 0; i < A.n(); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        places.push_back({tree.position[i], tree.position[A.columns[k]]});
    if (!ranks.is_alone())
      places = send_places(places, tree);
    sort(places, tree);
  }



  std::vector<FrontEntries::Place>
  FrontEntries::send_places(const std::vector<Place> &places,
                            const FrontTree          &tree)
  {
    const std::vector<int> front_of = tree.front_of_place();
    const auto             owner    = [&](const Place &place) {
      const Front &front =
        tree.fronts[front_of[std::min(place.row, place.column)]];
      return front.is_shared ? block_columns.owner(front.local(place.column)) :
                                              static_cast<int>(front.owner);
    };
    n_sent.assign(ranks.n(), 0);
    for (const Place &place : places)
      ++n_sent[owner(place)];
    n_received.resize(ranks.n());
    MPI_Alltoall(n_sent.data(),
                 1,
                 MPI_INT,
                 n_received.data(),
                 1,
                 MPI_INT,
                 ranks.communicator());

    const std::vector<int> to = offsets(n_sent), from = offsets(n_received);
    std::vector<int>       next = to;
    std::vector<Place>     sent_places(places.size());
    sent_positions.resize(places.size());
    for (unsigned int k = 0; k < places.size(); ++k)
      {
        const int at       = next[owner(places[k])]++;
        sent_places[at]    = places[k];
        sent_positions[at] = k;
      }
    sent.resize(to.back());
    received.resize(from.back());

    std::vector<Place> received_places(from.back());
    MPI_Alltoallv(sent_places.data(),
                  n_sent.data(),
                  to.data(),
                  MPI_2INT,
                  received_places.data(),
                  n_received.data(),
                  from.data(),
                  MPI_2INT,
                  ranks.communicator());
    return received_places;
  }



  void
  FrontEntries::sort(const std::vector<Place> &places, const FrontTree &tree)
  {
    const std::vector<int> front_of = tree.front_of_place();
    const std::size_t      n_fronts = tree.fronts.size();
    // By counting: lower and upper entries of each front.
    const auto group_of = [&](const Place &place) {
      return 2 * front_of[std::min(place.row, place.column)] +
             (place.row < place.column ? 1 : 0);
    };
    std::vector<int> next(2 * n_fronts + 1, 0);
    for (const Place &place : places)
      ++next[group_of(place) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    ranges.resize(n_fronts);
    for (unsigned int f = 0; f < n_fronts; ++f)
      ranges[f] = {next[2 * f], next[2 * f + 1], next[2 * f + 2]};

    source.resize(places.size());
    for (unsigned int k = 0; k < places.size(); ++k)
      source[next[group_of(places[k])]++] = k;

    target.resize(places.size());
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
        for (int e = ranges[f].begin; e < ranges[f].end; ++e)
          {
            const int row    = local(places[source[e]].row),
                      column = local(places[source[e]].column);
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



  const std::vector<double> &
  FrontEntries::collect(const std::vector<double> &values)
  {
    if (ranks.is_alone())
      return values;
    for (std::size_t k = 0; k < sent.size(); ++k)
      sent[k] = values[sent_positions[k]];
    MPI_Alltoallv(sent.data(),
                  n_sent.data(),
                  offsets(n_sent).data(),
                  MPI_DOUBLE,
                  received.data(),
                  n_received.data(),
                  offsets(n_received).data(),
                  MPI_DOUBLE,
                  ranks.communicator());
    return received;
  }
} // namespace NPT
