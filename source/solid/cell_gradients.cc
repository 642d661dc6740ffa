// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the reference gradients of all cells.

#include <npt_dealii/solid/cell_gradients.h>

namespace NPT
{
  namespace
  {
    std::size_t
    bytes(const CellGradients &cell)
    {
      return sizeof(double) *
             (cell.gradients.size() + cell.values.size() + cell.jxw.size());
    }
  } // namespace



  GradientsOfCells::GradientsOfCells(const IGASpace<3> &space,
                                     const unsigned int n_gauss_points,
                                     const std::size_t  memory)
    : values_(std::make_unique<IGAValues<3>>(space, n_gauss_points))
    , last_cell_(dealii::numbers::invalid_unsigned_int)
  {
    for (const auto &cell : space.triangulation().active_cell_iterators())
      cells_.push_back(cell);
    std::size_t memory_used = 0;
    for (unsigned int c = 0; c < cells_.size(); ++c)
      {
        // Also where nothing is kept, so that a folded cell is found at once.
        compute(c, last_);
        memory_used += bytes(last_);
        if (memory_used <= memory)
          kept_.push_back(last_);
        else
          kept_.clear();
      }
    kept_.shrink_to_fit();
    last_cell_ = dealii::numbers::invalid_unsigned_int;
  }



  const CellGradients &
  GradientsOfCells::operator[](const unsigned int cell) const
  {
    AssertIndexRange(cell, cells_.size());
    if (are_kept())
      return kept_[cell];
    if (cell != last_cell_)
      {
        last_cell_ = dealii::numbers::invalid_unsigned_int;
        compute(cell, last_);
        last_cell_ = cell;
      }
    return last_;
  }



  void
  GradientsOfCells::compute(const unsigned int cell,
                            CellGradients     &gradients) const
  {
    values_->reinit(cells_[cell]);
    gradients.reinit(values_->dofs_per_cell(), values_->n_quadrature_points());
    gradients.jxw.clear();
    gradients.values.clear();
    for (unsigned int q = 0; q < gradients.n_points; ++q)
      {
        gradients.jxw.push_back(values_->JxW(q));
        for (unsigned int A = 0; A < gradients.n_functions; ++A)
          gradients.values.push_back(values_->shape_value(A, q));
        for (unsigned int J = 0; J < 3; ++J)
          for (unsigned int A = 0; A < gradients.n_functions; ++A)
            gradients.gradients[(3 * q + J) * gradients.stride + A] =
              values_->shape_grad(A, q)[J];
      }
  }
} // namespace NPT
