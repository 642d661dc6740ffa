// SPDX-License-Identifier: LGPL-2.1-or-later
// Nested dissection by METIS.

#include <npt_dealii/linear_algebra/elimination_order.h>

#include <deal.II/base/config.h>
#include <deal.II/base/exceptions.h>

#ifdef DEAL_II_WITH_METIS
#  include <metis.h>
#endif

#include <array>

namespace NPT
{
  std::vector<int>
  nested_dissection(const BlockPattern &blocks)
  {
#ifdef DEAL_II_WITH_METIS
    idx_t              n = blocks.n();
    std::vector<idx_t> start(blocks.row_start.begin(), blocks.row_start.end());
    std::vector<idx_t> neighbors(blocks.neighbors.begin(),
                                 blocks.neighbors.end());
    std::vector<idx_t> sizes(n);
    for (int b = 0; b < n; ++b)
      sizes[b] = blocks.size(b);

    std::array<idx_t, METIS_NOPTIONS> options;
    METIS_SetDefaultOptions(options.data());
    options[METIS_OPTION_UFACTOR]  = 5; // per mille
    options[METIS_OPTION_COMPRESS] = 0; // as that was done
    std::vector<idx_t> order(n), position(n);
    const int          status = METIS_NodeND(&n,
                                    start.data(),
                                    neighbors.data(),
                                    sizes.data(),
                                    options.data(),
                                    order.data(),
                                    position.data());
    AssertThrow(status == METIS_OK,
                dealii::ExcMessage("METIS cannot order the matrix."));
    return {position.begin(), position.end()};
#else
    (void)blocks;
    return {};
#endif
  }



  std::vector<int>
  order_of_unknowns(const BlockPattern     &blocks,
                    const std::vector<int> &order_of_blocks)
  {
    AssertDimension(order_of_blocks.size(),
                    static_cast<unsigned int>(blocks.n()));
    std::vector<int> block_at(blocks.n());
    for (int b = 0; b < blocks.n(); ++b)
      block_at[order_of_blocks[b]] = b;
    std::vector<int> position(blocks.unknowns.size());
    int              next = 1;
    for (const int b : block_at)
      for (int k = blocks.first[b]; k < blocks.first[b + 1]; ++k)
        position[blocks.unknowns[k]] = next++;
    return position;
  }
} // namespace NPT
