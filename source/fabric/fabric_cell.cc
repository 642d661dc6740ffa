// SPDX-License-Identifier: LGPL-2.1-or-later
// What woven cells and laminates have in common.

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/fabric/laminate.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/fabric/woven_cell.h>

#include <cmath>

namespace NPT
{
  using dealii::Point;

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
    const auto &mirror = layout_.bundles[bundle].mirror;
    if (!mirror)
      return 1;
    if (mirror->bundle != bundle)
      return mirror->bundle > bundle ? 2 : 0;
    const Point<3> image     = mirror->operation(Y);
    const double   tolerance = 1e-8 * parameters_.crossing_spacing.smaller();
    for (unsigned int i = 0; i < 2; ++i)
      if (std::abs(Y[i] - image[i]) > tolerance)
        return Y[i] > image[i] ? 2 : 0;
    return 1;
  }
} // namespace NPT
