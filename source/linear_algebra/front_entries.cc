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



    /// Give numbers to each process, and get those of each, one after the
    /// other.
    std::vector<std::vector<int>>
    all_to_all(const std::vector<std::vector<int>> &given, const Ranks &ranks)
    {
      std::vector<int> sizes, all_given;
      for (const std::vector<int> &numbers : given)
        {
          sizes.push_back(numbers.size());
          all_given.insert(all_given.end(), numbers.begin(), numbers.end());
        }
      std::vector<int> sizes_taken(ranks.n());
      MPI_Alltoall(sizes.data(),
                   1,
                   MPI_INT,
                   sizes_taken.data(),
                   1,
                   MPI_INT,
                   ranks.communicator());
      const std::vector<int> from = offsets(sizes_taken);
      std::vector<int>       all_taken(from.back());
      MPI_Alltoallv(all_given.data(),
                    sizes.data(),
                    offsets(sizes).data(),
                    MPI_INT,
                    all_taken.data(),
                    sizes_taken.data(),
                    from.data(),
                    MPI_INT,
                    ranks.communicator());
      std::vector<std::vector<int>> taken;
      for (unsigned int p = 0; p < ranks.n(); ++p)
        taken.emplace_back(all_taken.begin() + from[p],
                           all_taken.begin() + from[p + 1]);
      return taken;
    }
  } // namespace



  void
  FrontEntries::set_up(const CSRMatrix &A,
                       const FrontTree &tree,
                       const Ranks     &ranks_of_run)
  {
    ranks                  = ranks_of_run;
    block_columns          = {static_cast<int>(ranks.n())};
    std::vector<Block> own = make_blocks(A, tree), of_others;
    if (!ranks.is_alone())
      of_others = exchange_blocks(own, tree);
    sort(own, of_others, tree);
  }



  // Blocks on the diagonal count as lower ones: nobody reads what they have
  // above it.
  bool
  FrontEntries::has_lower_entry(const Block &block)
  {
    return block.row + block.n_rows > block.column;
  }



  std::vector<FrontEntries::Block>
  FrontEntries::make_blocks(const CSRMatrix &A, const FrontTree &tree) const
  {
    const int               n        = A.n();
    const std::vector<int>  front_of = tree.front_of_place();
    const std::vector<int>  group_of = A.group_of_rows();
    const std::vector<int> &place    = tree.position;
    // Where unknowns end that belong together.
    std::vector<int> end_of(n);
    for (int i = n - 1; i >= 0; --i)
      end_of[i] = i + 1 < n && group_of[i] == group_of[i + 1] &&
                      place[i] + 1 == place[i + 1] &&
                      front_of[place[i]] == front_of[place[i + 1]] ?
                    end_of[i + 1] :
                    i + 1;

    std::vector<Block> blocks;
    for (int i = 0; i < n; i = end_of[i])
      {
        const int end = A.row_start[i + 1], stride = end - A.row_start[i];
        for (int k = A.row_start[i]; k < end;)
          {
            const int j         = A.columns[k];
            int       n_columns = 1;
            while (k + n_columns < end &&
                   A.columns[k + n_columns] == j + n_columns &&
                   j + n_columns < end_of[j])
              ++n_columns;
            const Front &front =
              tree.fronts[front_of[std::min(place[i], place[j])]];
            if (front.is_shared) // its columns are dealt out
              n_columns = std::min(n_columns,
                                   BlockColumns::width - front.local(place[j]) %
                                                           BlockColumns::width);
            blocks.push_back(
              {place[i], place[j], end_of[i] - i, n_columns, k, stride});
            k += n_columns;
          }
      }
    return blocks;
  }



  // Keep own blocks, and tell the others which ones they will get.
  std::vector<FrontEntries::Block>
  FrontEntries::exchange_blocks(std::vector<Block> &blocks,
                                const FrontTree    &tree)
  {
    const std::vector<int> front_of = tree.front_of_place();
    const auto             owner    = [&](const Block &block) {
      const Front &front =
        tree.fronts[front_of[std::min(block.row, block.column)]];
      return front.is_shared ? block_columns.owner(front.local(block.column)) :
                                              static_cast<int>(front.owner);
    };
    sent_blocks.assign(ranks.n(), Message());
    std::size_t n_own = 0;
    for (const Block &block : blocks)
      {
        const unsigned int to = owner(block);
        if (to == ranks.rank())
          {
            blocks[n_own++] = block;
            continue;
          }
        Message  &message = sent_blocks[to];
        const int size    = block.n_rows * block.n_columns;
        message.n += size;
        if (has_lower_entry(block))
          {
            message.lower.push_back(block);
            message.n_lower += size;
          }
        else
          message.upper.push_back(block);
      }
    blocks.resize(n_own);

    // How many entries are lower ones; then row, column, and their numbers, of
    // each block.
    std::vector<std::vector<int>> given(ranks.n());
    int                           n_sent = 0;
    for (unsigned int p = 0; p < ranks.n(); ++p)
      {
        const Message &message = sent_blocks[p];
        n_sent += message.n;
        given[p].push_back(message.n_lower);
        for (const auto *list : {&message.lower, &message.upper})
          for (const Block &block : *list)
            given[p].insert(
              given[p].end(),
              {block.row, block.column, block.n_rows, block.n_columns});
      }
    sent.resize(n_sent);

    n_received.clear();
    n_received_lower.clear();
    std::vector<Block> of_others;
    int                source = 0;
    for (const std::vector<int> &numbers : all_to_all(given, ranks))
      {
        const int first = source;
        for (std::size_t k = 1; k < numbers.size(); k += 4)
          {
            of_others.push_back({numbers[k],
                                 numbers[k + 1],
                                 numbers[k + 2],
                                 numbers[k + 3],
                                 source,
                                 numbers[k + 3]});
            source += numbers[k + 2] * numbers[k + 3];
          }
        n_received.push_back(source - first);
        n_received_lower.push_back(numbers[0]);
      }
    received.resize(source);
    return of_others;
  }



  void
  FrontEntries::sort(const std::vector<Block> &own,
                     const std::vector<Block> &of_others,
                     const FrontTree          &tree)
  {
    const std::vector<int> front_of = tree.front_of_place();
    // By counting.
    const auto for_each_block = [&](const auto &visit) {
      for (const auto *blocks : {&own, &of_others})
        for (const Block &block : *blocks)
          {
            const bool is_lower = has_lower_entry(block);
            visit(n_kinds * front_of[std::min(block.row, block.column)] +
                    (is_lower ? 0 : 2) + (blocks == &own ? 0 : 1),
                  block);
          }
    };
    start.assign(n_kinds * tree.fronts.size() + 1, 0);
    for_each_block([&](const int kind, const Block &) { ++start[kind + 1]; });
    std::partial_sum(start.begin(), start.end(), start.begin());
    sorted_blocks.resize(start.back());
    std::vector<int> next = start;
    for_each_block([&](const int kind, const Block &block) {
      sorted_blocks[next[kind]++] = block;
    });
    for (unsigned int f = 0; f < tree.fronts.size(); ++f)
      for (int b = start[n_kinds * f]; b < start[n_kinds * (f + 1)]; ++b)
        set_target(sorted_blocks[b], tree.fronts[f]);
  }



  void
  FrontEntries::set_target(Block &block, const Front &front) const
  {
    const int row = front.local(block.row), column = front.local(block.column);
    if (front.is_shared || column < front.n)
      {
        block.target_stride = front.m;
        block.target =
          (front.is_shared ? block_columns.local(column) : column) * front.m +
          row;
      }
    else
      {
        block.target_stride = front.n;
        block.target = front.n * front.m + (column - front.n) * front.n + row;
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
    std::vector<int> n_sent, n_sent_now;
    double          *first = sent.data(); // of a message
    for (const Message &message : sent_blocks)
      {
        double    *next = first;
        const auto put  = [&](const std::vector<Block> &blocks) {
          for (const Block &block : blocks)
            for (int r = 0; r < block.n_rows; ++r)
              next = std::copy_n(values.data() + block.source +
                                   r * block.source_stride,
                                 block.n_columns,
                                 next);
        };
        put(message.lower);
        if (!lower_only)
          put(message.upper);
        n_sent.push_back(message.n);
        n_sent_now.push_back(next - first);
        first += message.n;
      }
    MPI_Alltoallv(sent.data(),
                  n_sent_now.data(),
                  offsets(n_sent).data(),
                  MPI_DOUBLE,
                  received.data(),
                  (lower_only ? n_received_lower : n_received).data(),
                  offsets(n_received).data(),
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
        const std::vector<double> &values =
          kind % 2 == 0 ? *own_values : received;
        for (int b = begin[kind]; b < begin[kind + 1]; ++b)
          {
            const Block  &block = sorted_blocks[b];
            Number *const to    = front + block.target;
            const double *from  = values.data() + block.source;
            for (int r = 0; r < block.n_rows; ++r, from += block.source_stride)
              for (int c = 0; c < block.n_columns; ++c)
                to[c * block.target_stride + r] += from[c];
          }
      }
  }



  template void
  FrontEntries::add(const unsigned int, double *) const;
  template void
  FrontEntries::add(const unsigned int, float *) const;
} // namespace NPT
