// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims on fronts of several processes. ctest runs them on one process and
// once more under mpirun.

#include <npt_dealii/linear_algebra/elimination_order.h>
#include <npt_dealii/linear_algebra/front_tree.h>
#include <npt_dealii/linear_algebra/fronts.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include "elastic_block.h"

using namespace NPT;
using dealii::Vector;

namespace
{
  // What a process has of A if couplings of pieces of so many unknowns are
  // dealt out in turn.
  CSRMatrix
  part_of(const CSRMatrix &A, const Ranks &ranks, const int size_of_piece)
  {
    const auto is_mine = [&](const int i, const int j) {
      return ranks.has(i / size_of_piece + j / size_of_piece);
    };
    std::vector<std::vector<int>> columns(A.n());
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        if (is_mine(i, A.columns[k]))
          columns[i].push_back(A.columns[k]);
    CSRMatrix part;
    part.set_pattern(columns);
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (int k = part.row_start[i]; k < part.row_start[i + 1]; ++k)
        part.values[k] = A.values[A.position(i, part.columns[k])];
    return part;
  }
} // namespace

TEST_CASE("Fronts of several processes solve what one process solves, by L L^T "
          "where the matrix is positive definite",
          "[fronts]")
{
  const Ranks ranks(MPI_COMM_WORLD);
  for (const double unsymmetric : {0., 0.3})
    for (const int size_of_piece : {1, 3, 42})
      {
        INFO("unsymmetric " << unsymmetric << ", pieces of " << size_of_piece);
        const CSRMatrix A =
          make_elastic_block({{13, 12, 2}}, 2, 1., unsymmetric).matrix;
        const CSRMatrix    part   = part_of(A, ranks, size_of_piece);
        const BlockPattern blocks = make_block_pattern(part, ranks);
        // The components of a control point stay together, unless pieces cut
        // it.
        CHECK(blocks.n() >= make_block_pattern(A, Ranks()).n());
        CHECK(blocks.n() * (size_of_piece % 3 == 0 ? 3 : 1) <=
              static_cast<int>(A.n()));
        const auto tree = std::make_shared<FrontTree>(
          make_front_tree(blocks, nested_dissection(blocks)));
        deal_out(*tree, ranks.n());
        const bool shares =
          std::any_of(tree->fronts.begin(),
                      tree->fronts.end(),
                      [](const Front &front) { return front.is_shared; });
        CHECK(shares == !ranks.is_alone());

        Vector<double> exact(A.n()), x;
        for (unsigned int i = 0; i < A.n(); ++i)
          exact[i] = 1. + i % 7;
        A.vmult(x, exact);
        Fronts<double> fronts(part, tree, ranks);
        // The second time with what is left of the first one.
        for (unsigned int time = 0; time < 2; ++time)
          {
            REQUIRE((unsymmetric > 0 ?
                       fronts.factorize_general(part.values) :
                       fronts.factorize_positive_definite(part.values)));
            Vector<double> y(x);
            fronts.solve(y);
            y -= exact;
            CHECK(y.linfty_norm() < 1e-9 * exact.linfty_norm());
          }
        if (unsymmetric > 0)
          continue;
        // The same fronts take all entries as well.
        REQUIRE(fronts.factorize_general(part.values));
        fronts.solve(x);
        x -= exact;
        CHECK(x.linfty_norm() < 1e-9 * exact.linfty_norm());
      }
}
