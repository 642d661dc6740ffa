// SPDX-License-Identifier: LGPL-2.1-or-later
// What woven cells and laminates have in common.

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/fabric/laminate.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric/woven_cell.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  namespace
  {
    // Where no loads are known the smallest cell of the weave will do; with
    // loads see smallest_cell_type().
    CellParameters
    with_type(CellParameters cell)
    {
      if (cell.type == "automatic")
        {
          const WeavePattern weave(cell.weave);
          cell.type = weave.has_glide() && cell.n_layers == 1 ?
                        "sub-unit cell" :
                      weave.is_plain() ? "two-crossing cell" :
                                         "primitive cell";
        }
      return cell;
    }
  } // namespace



  FabricCell::FabricCell(const CellParameters &cell, const MeshParameters &mesh)
    : parameters_(with_type(cell))
    , layout_(parameters_.type == "laminate" ?
                make_laminate(parameters_, mesh) :
                make_woven_cell(parameters_, mesh))
  {}



  std::array<bool, 3>
  FabricCell::free_translations() const
  {
    std::array<bool, 3> is_free = {{true, true, true}};
    for (const SymmetryOperation &g : layout_.operations)
      for (unsigned int i = 0; i < 3; ++i)
        is_free[i] = is_free[i] && g.Q[i] > 0;
    return is_free;
  }



  unsigned int
  FabricCell::symmetry_weight(const unsigned int bundle,
                              const Point<3>    &Y) const
  {
    const FiberBundle &b         = layout_.bundles[bundle];
    const auto         direction = [](const FiberBundle &of) {
      return of.family == FiberBundle::Family::weft ? 1 : 0;
    };
    const double tolerance = 1e-8 * parameters_.crossing_spacing.smaller();
    // One image for each way of turning. Positive: the image is the better one.
    std::vector<Tensor<1, 3>> turned;
    unsigned int              n_same = 1;
    for (const FiberBundle::Counterpart &counterpart : b.counterparts)
      {
        const SymmetryOperation &g     = counterpart.operation;
        const double             along = Y[direction(b)];
        if (along < counterpart.begin - tolerance ||
            along > counterpart.end + tolerance ||
            std::find(turned.begin(), turned.end(), g.Q) != turned.end())
          continue;
        turned.push_back(g.Q);
        const FiberBundle &c     = layout_.bundles[counterpart.bundle];
        const Point<3>     image = g(Y);
        // Nearer to the middle, smaller number, larger Y1, larger Y2.
        const double advantages[] = {std::abs(along - b.middle) -
                                       std::abs(image[direction(c)] - c.middle),
                                     static_cast<double>(bundle) -
                                       static_cast<double>(counterpart.bundle),
                                     image[0] - Y[0],
                                     image[1] - Y[1]};
        const auto   decisive =
          std::find_if(std::begin(advantages),
                       std::end(advantages),
                       [&](const double x) { return std::abs(x) > tolerance; });
        if (decisive == std::end(advantages))
          ++n_same;
        else if (*decisive > 0.)
          return 0;
      }
    return (1 + turned.size()) / n_same;
  }
} // namespace NPT
