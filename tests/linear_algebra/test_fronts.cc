// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims of the tree of fronts and its shares.

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
  FrontTree
  tree_of(const CSRMatrix &A, const unsigned int n_processes)
  {
    const BlockPattern blocks = make_block_pattern(A, Ranks());
    FrontTree tree = make_front_tree(blocks, nested_dissection(blocks));
    deal_out(tree, n_processes);
    return tree;
  }
} // namespace

namespace
{
  // Rows of equal columns are in one block, and blocks with a common entry are
  // neighbors.
  void
  check_blocks(const CSRMatrix &A, const BlockPattern &blocks)
  {
    std::vector<int> block_of(A.n(), -1);
    for (int b = 0; b < blocks.n(); ++b)
      for (int k = blocks.first[b]; k < blocks.first[b + 1]; ++k)
        {
          CHECK(block_of[blocks.unknowns[k]] == -1);
          block_of[blocks.unknowns[k]] = b;
        }
    const auto columns_of = [&](const unsigned int i) {
      return std::vector<int>(A.columns.begin() + A.row_start[i],
                              A.columns.begin() + A.row_start[i + 1]);
    };
    const auto are_neighbors = [&](const int a, const int b) {
      return std::binary_search(blocks.neighbors.begin() + blocks.row_start[a],
                                blocks.neighbors.begin() +
                                  blocks.row_start[a + 1],
                                b);
    };
    std::vector<std::vector<bool>> is_needed(blocks.n(),
                                             std::vector<bool>(blocks.n(),
                                                               false));
    for (unsigned int i = 0; i < A.n(); ++i)
      {
        REQUIRE(block_of[i] >= 0);
        CHECK(columns_of(i) ==
              columns_of(blocks.unknowns[blocks.first[block_of[i]]]));
        for (const int j : columns_of(i))
          is_needed[block_of[i]][block_of[j]] =
            is_needed[block_of[j]][block_of[i]] = true;
      }
    bool agree = true;
    for (int a = 0; a < blocks.n(); ++a)
      for (int b = 0; b < blocks.n(); ++b)
        agree = agree && are_neighbors(a, b) == (a != b && is_needed[a][b]);
    CHECK(agree);
  }
} // namespace

TEST_CASE("Blocks hold the unknowns with equal rows, and know all neighbors",
          "[fronts]")
{
  // Of an elastic body: the components of a control point.
  const CSRMatrix    A      = make_elastic_block({{6, 5, 4}}, 2, 1.).matrix;
  const BlockPattern blocks = make_block_pattern(A, Ranks());
  CHECK(3 * blocks.n() == static_cast<int>(A.n()));
  check_blocks(A, blocks);

  // Not symmetric, and with unknowns that nothing couples: each is its own.
  CSRMatrix                     B;
  std::vector<std::vector<int>> rows = {
    {0, 1, 4}, {0, 1, 4}, {2}, {3}, {2, 4}, {0, 1, 4}};
  B.set_pattern(rows);
  const BlockPattern of_b = make_block_pattern(B, Ranks());
  check_blocks(B, of_b);
  CHECK(of_b.unknowns == std::vector<int>({0, 1, 5, 2, 3, 4}));
  CHECK(of_b.first == std::vector<int>({0, 3, 4, 5, 6}));
}

TEST_CASE("Every unknown is the pivot of one front, and its parent holds all "
          "that the front changes",
          "[fronts]")
{
  const CSRMatrix A    = make_elastic_block({{6, 5, 2}}, 2, 1.).matrix;
  const FrontTree tree = tree_of(A, 1);
  int             next = 0;
  for (const Front &front : tree.fronts)
    {
      CHECK(front.first == next);
      next += front.n;
      if (front.parent < 0)
        {
          CHECK(front.changed.empty());
          continue;
        }
      const Front &parent = tree.fronts[front.parent];
      for (unsigned int k = 0; k < front.changed.size(); ++k)
        {
          const int place = front.places[k];
          CHECK(front.changed[k] == (place < parent.n ?
                                       parent.first + place :
                                       parent.changed[place - parent.n]));
        }
    }
  CHECK(next == static_cast<int>(A.n()));
}

TEST_CASE("Two processes get whole subtrees of nearly equal size and share "
          "what is above them",
          "[fronts]")
{
  const CSRMatrix A         = make_elastic_block({{12, 12, 2}}, 2, 1.).matrix;
  const FrontTree tree      = tree_of(A, 2);
  double          shares[2] = {0, 0}, shared = 0;
  for (const Front &front : tree.fronts)
    {
      (front.is_shared ? shared : shares[front.owner]) += front.operations();
      if (front.parent < 0)
        continue;
      const Front &parent = tree.fronts[front.parent];
      if (front.is_shared)
        CHECK(parent.is_shared);
      else if (!parent.is_shared)
        CHECK(front.owner == parent.owner);
    }
  CAPTURE(shares[0], shares[1], shared);
  CHECK(shared > 0);
  CHECK(std::min(shares[0], shares[1]) > 0.8 * std::max(shares[0], shares[1]));
}

TEST_CASE("Blocks of columns are dealt out in turn without a gap", "[fronts]")
{
  for (const int n_processes : {1, 2, 3})
    {
      const BlockColumns columns{n_processes};
      for (const int n : {0, 1, 63, 64, 65, 128, 200, 385})
        {
          std::vector<int> next(n_processes, 0);
          for (int c = 0; c < n; ++c)
            CHECK(columns.local(c) == next[columns.owner(c)]++);
          for (int p = 0; p < n_processes; ++p)
            CHECK(columns.n_local(n, p) == next[p]);
        }
    }
}

TEST_CASE("Fronts of single precision solve to single precision", "[fronts]")
{
  for (const double unsymmetric : {0., 0.3})
    {
      const CSRMatrix A =
        make_elastic_block({{6, 5, 2}}, 2, 1., unsymmetric).matrix;
      const auto     tree = std::make_shared<FrontTree>(tree_of(A, 1));
      Fronts<double> double_fronts(A, tree);
      Fronts<float>  single_fronts(A, tree);
      Vector<double> x(A.n()), y;
      for (unsigned int i = 0; i < A.n(); ++i)
        x[i] = 1. + i % 7;
      y = x;
      if (unsymmetric > 0)
        {
          CHECK_FALSE(double_fronts.factorize_positive_definite(
            std::vector<double>(A.values.size(), 0.)));
          REQUIRE(double_fronts.factorize_general(A.values));
          REQUIRE(single_fronts.factorize_general(A.values));
        }
      else
        {
          REQUIRE(double_fronts.factorize_positive_definite(A.values));
          REQUIRE(single_fronts.factorize_positive_definite(A.values));
        }
      double_fronts.solve(x);
      single_fronts.solve(y);
      y -= x;
      CHECK(y.l2_norm() > 1e-12 * x.l2_norm());
      CHECK(y.l2_norm() < 1e-4 * x.l2_norm());
      CHECK(2 * Fronts<float>::gigabytes(*tree, Ranks()) ==
            Fronts<double>::gigabytes(*tree, Ranks()));
    }
}
