// SPDX-License-Identifier: LGPL-2.1-or-later
// Equal rows of a pattern, and which of them have entries in common.

#include <npt_dealii/linear_algebra/block_pattern.h>

#include <mpi.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>

namespace NPT
{
  namespace
  {
    /// Columns of a row, none if there is only the diagonal: a process has the
    /// diagonal also of rows whose other entries are on other processes.
    std::pair<const int *, const int *>
    columns_of(const CSRMatrix &A, const int row)
    {
      const int *begin       = A.columns.data() + A.row_start[row];
      const int *end         = A.columns.data() + A.row_start[row + 1];
      const bool is_diagonal = end - begin == 1 && *begin == row;
      return {begin, is_diagonal ? begin : end};
    }



    /// A number that tells sets of columns apart, nearly always; zero: there
    /// are none. Of several processes with parts of a row it is that of all.
    std::vector<std::uint64_t>
    signatures(const CSRMatrix &A, const Ranks &ranks)
    {
      std::vector<std::uint64_t> result(A.n(), 0);
      for (std::size_t g = 0; g + 1 < A.row_groups.size(); ++g)
        {
          const int     first     = A.row_groups[g];
          std::uint64_t signature = 0;
          const auto [begin, end] = columns_of(A, first);
          for (const int *column = begin; column != end; ++column)
            {
              // A step of the generator splitmix64 (Steele, Lea, Flood 2014).
              std::uint64_t x = *column + 0x9e3779b97f4a7c15u;
              x               = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
              x               = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
              signature += x ^ (x >> 31);
            }
          std::fill(result.begin() + first,
                    result.begin() + A.row_groups[g + 1],
                    signature);
        }
      if (!ranks.is_alone())
        MPI_Allreduce(MPI_IN_PLACE,
                      result.data(),
                      result.size(),
                      MPI_UINT64_T,
                      MPI_SUM,
                      ranks.communicator());
      return result;
    }



    /// Bring unknowns that form a block together, and return where blocks
    /// begin.
    std::vector<int>
    find_blocks(const CSRMatrix  &A,
                const Ranks      &ranks,
                std::vector<int> &unknowns)
    {
      const int  n         = A.n();
      const auto signature = signatures(A, ranks);
      unknowns.resize(n);
      std::iota(unknowns.begin(), unknowns.end(), 0);
      std::sort(unknowns.begin(),
                unknowns.end(),
                [&](const int i, const int j) {
                  return signature[i] < signature[j] ||
                         (signature[i] == signature[j] && i < j);
                });
      // Everyone compares what it has; one difference is enough.
      const std::vector<int>     group_of = A.group_of_rows();
      std::vector<unsigned char> differs(n, 0);
      for (int k = 1; k < n; ++k)
        {
          const int i = unknowns[k - 1], j = unknowns[k];
          const auto [begin_i, end_i] = columns_of(A, i);
          const auto [begin_j, end_j] = columns_of(A, j);
          differs[k] = signature[i] != signature[j] || signature[i] == 0 ||
                       (group_of[i] != group_of[j] &&
                        !std::equal(begin_i, end_i, begin_j, end_j));
        }
      if (!ranks.is_alone())
        MPI_Allreduce(MPI_IN_PLACE,
                      differs.data(),
                      n,
                      MPI_UNSIGNED_CHAR,
                      MPI_MAX,
                      ranks.communicator());

      std::vector<std::pair<int, int>> blocks; // lowest unknown, place above
      for (int k = 0; k < n; ++k)
        if (k == 0 || differs[k])
          blocks.emplace_back(unknowns[k], k);
      std::vector<int> end(n);
      for (unsigned int b = 0; b < blocks.size(); ++b)
        end[blocks[b].second] =
          b + 1 < blocks.size() ? blocks[b + 1].second : n;
      std::sort(blocks.begin(), blocks.end());
      std::vector<int> sorted, first(1, 0);
      sorted.reserve(n);
      for (const auto &block : blocks)
        {
          sorted.insert(sorted.end(),
                        unknowns.begin() + block.second,
                        unknowns.begin() + end[block.second]);
          first.push_back(sorted.size());
        }
      unknowns = std::move(sorted);
      return first;
    }



    /// Call visit(a, b) once for each pair of blocks of which this process has
    /// entries in the rows of a and the columns of b.
    template <typename Visitor>
    void
    for_each_pair(const CSRMatrix    &A,
                  const BlockPattern &blocks,
                  const Visitor      &visit)
    {
      std::vector<int> block_of(A.n());
      for (int b = 0; b < blocks.n(); ++b)
        for (int k = blocks.first[b]; k < blocks.first[b + 1]; ++k)
          block_of[blocks.unknowns[k]] = b;
      std::vector<int> seen_by(blocks.n(), -1);
      for (int a = 0; a < blocks.n(); ++a)
        {
          const int row = blocks.unknowns[blocks.first[a]];
          for (int k = A.row_start[row]; k < A.row_start[row + 1]; ++k)
            {
              const int b = block_of[A.columns[k]];
              if (seen_by[b] == a)
                continue;
              seen_by[b] = a;
              visit(a, b);
            }
        }
    }



    /// Pairs of blocks, one after the other, of all processes.
    std::vector<int>
    gathered(const std::vector<int> &pairs, const Ranks &ranks)
    {
      const int        size = pairs.size();
      std::vector<int> sizes(ranks.n()), offsets(ranks.n() + 1, 0);
      MPI_Allgather(
        &size, 1, MPI_INT, sizes.data(), 1, MPI_INT, ranks.communicator());
      std::partial_sum(sizes.begin(), sizes.end(), offsets.begin() + 1);
      std::vector<int> all(offsets.back());
      MPI_Allgatherv(pairs.data(),
                     size,
                     MPI_INT,
                     all.data(),
                     sizes.data(),
                     offsets.data(),
                     MPI_INT,
                     ranks.communicator());
      return all;
    }
  } // namespace



  BlockPattern
  make_block_pattern(const CSRMatrix &A, const Ranks &ranks)
  {
    BlockPattern blocks;
    blocks.first = find_blocks(A, ranks, blocks.unknowns);

    // Each pair is found from one side or from both, by one process or by
    // several.
    std::vector<int> pairs;
    for_each_pair(A, blocks, [&](const int a, const int b) {
      if (a != b)
        {
          pairs.push_back(std::min(a, b));
          pairs.push_back(std::max(a, b));
        }
    });
    if (!ranks.is_alone())
      pairs = gathered(pairs, ranks);

    // Handed out twice, so that each list comes out ascending, with what is
    // found several times in a row.
    const int        n = blocks.n();
    std::vector<int> start(n + 1, 0);
    for (const int b : pairs)
      ++start[b + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<int> partners(pairs.size()), end = start;
    for (std::size_t k = 0; k < pairs.size(); k += 2)
      {
        partners[end[pairs[k]]++]     = pairs[k + 1];
        partners[end[pairs[k + 1]]++] = pairs[k];
      }
    std::vector<int> ascending(pairs.size());
    end = start;
    for (int a = 0; a < n; ++a)
      for (int k = start[a]; k < start[a + 1]; ++k)
        {
          const int b = partners[k];
          if (end[b] == start[b] || ascending[end[b] - 1] != a)
            ascending[end[b]++] = a;
        }
    blocks.row_start.assign(1, 0);
    for (int b = 0; b < n; ++b)
      {
        blocks.neighbors.insert(blocks.neighbors.end(),
                                ascending.begin() + start[b],
                                ascending.begin() + end[b]);
        blocks.row_start.push_back(blocks.neighbors.size());
      }
    return blocks;
  }
} // namespace NPT
