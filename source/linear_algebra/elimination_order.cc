// SPDX-License-Identifier: LGPL-2.1-or-later
// Nested dissection by METIS.

#include <npt_dealii/linear_algebra/elimination_order.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#ifdef DEAL_II_WITH_METIS
#  include <metis.h>
#endif
#include <mpi.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace NPT
{
  namespace
  {
    /// Neighbors of each unknown, sorted, in compressed rows.
    struct Graph
    {
      std::vector<int> start, neighbors;
    };

    /// That of A + A^T, with the diagonal where A has it.
    Graph
    symmetric_graph(const CSRMatrix &A)
    {
      std::vector<std::vector<int>> transposed(A.n());
      for (int i = 0; i < static_cast<int>(A.n()); ++i)
        for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          transposed[A.columns[k]].push_back(i);
      Graph graph{{0}, {}};
      for (int i = 0; i < static_cast<int>(A.n()); ++i)
        {
          std::set_union(A.columns.begin() + A.row_start[i],
                         A.columns.begin() + A.row_start[i + 1],
                         transposed[i].begin(),
                         transposed[i].end(),
                         std::back_inserter(graph.neighbors));
          graph.start.push_back(graph.neighbors.size());
        }
      return graph;
    }



    Graph
    joined(const Graph &a, const Graph &b)
    {
      Graph both{{0}, {}};
      for (std::size_t i = 0; i + 1 < a.start.size(); ++i)
        {
          std::set_union(a.neighbors.begin() + a.start[i],
                         a.neighbors.begin() + a.start[i + 1],
                         b.neighbors.begin() + b.start[i],
                         b.neighbors.begin() + b.start[i + 1],
                         std::back_inserter(both.neighbors));
          both.start.push_back(both.neighbors.size());
        }
      return both;
    }



    /// The graphs of all processes in one, on the first of them.
    Graph
    gathered(Graph graph, const Ranks &ranks)
    {
      const auto receive = [&](const unsigned int from) {
        Graph other;
        for (std::vector<int> *list : {&other.start, &other.neighbors})
          {
            MPI_Status status;
            int        size = 0;
            MPI_Probe(from, 0, ranks.communicator(), &status);
            MPI_Get_count(&status, MPI_INT, &size);
            list->resize(size);
            MPI_Recv(list->data(),
                     size,
                     MPI_INT,
                     from,
                     0,
                     ranks.communicator(),
                     MPI_STATUS_IGNORE);
          }
        return other;
      };
      if (ranks.is_first())
        for (unsigned int p = 1; p < ranks.n(); ++p)
          graph = joined(graph, receive(p));
      else
        for (const std::vector<int> *list : {&graph.start, &graph.neighbors})
          MPI_Send(
            list->data(), list->size(), MPI_INT, 0, 0, ranks.communicator());
      return graph;
    }
  } // namespace



  CSRMatrix
  sum_of_patterns(const CSRMatrix &A, const Ranks &ranks)
  {
    Graph graph = gathered({A.row_start, A.columns}, ranks);
    for (std::vector<int> *list : {&graph.start, &graph.neighbors})
      {
        int size = list->size();
        MPI_Bcast(&size, 1, MPI_INT, 0, ranks.communicator());
        list->resize(size);
        MPI_Bcast(list->data(), size, MPI_INT, 0, ranks.communicator());
      }
    CSRMatrix sum;
    sum.row_start = std::move(graph.start);
    sum.columns   = std::move(graph.neighbors);
    return sum;
  }



  std::vector<int>
  nested_dissection(const CSRMatrix &A,
                    const bool       pattern_is_symmetric,
                    const Ranks     &ranks)
  {
#ifdef DEAL_II_WITH_METIS
    Graph graph;
    if (!pattern_is_symmetric)
      graph = symmetric_graph(A);
    else if (!ranks.is_alone())
      graph = {A.row_start, A.columns};
    if (!ranks.is_alone())
      graph = gathered(std::move(graph), ranks);
    if (!ranks.is_first())
      return {};
    // METIS wants it without the diagonal. A symmetric pattern of one process
    // is read where it stands.
    const bool              is_copy = !graph.start.empty();
    const std::vector<int> &from    = is_copy ? graph.start : A.row_start;
    const std::vector<int> &to      = is_copy ? graph.neighbors : A.columns;
    std::vector<idx_t>      start(1, 0), neighbors;
    neighbors.reserve(to.size());
    idx_t n = A.n();
    for (int i = 0; i < n; ++i)
      {
        for (int k = from[i]; k < from[i + 1]; ++k)
          if (to[k] != i)
            neighbors.push_back(to[k]);
        start.push_back(neighbors.size());
      }
    graph = Graph();

    std::array<idx_t, METIS_NOPTIONS> options;
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_UFACTOR] = 5; // per mille
    std::vector<idx_t> order(n), position(n);
    const int          status = METIS_NodeND(&n,
                                    start.data(),
                                    neighbors.data(),
                                    nullptr,
                                    options.data(),
                                    order.data(),
                                    position.data());
    AssertThrow(status == METIS_OK,
                dealii::ExcMessage("METIS cannot order the matrix."));
    for (auto &p : position)
      ++p;
    return {position.begin(), position.end()};
#else
    (void)A;
    (void)pattern_is_symmetric;
    (void)ranks;
    return {};
#endif
  }
} // namespace NPT
