// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the reference gradients of all cells, kept or computed again.

#ifndef npt_dealii_solid_cell_gradients_h
#define npt_dealii_solid_cell_gradients_h

#include <npt_dealii/iga/iga_values.h>
#include <npt_dealii/solid/solid_kernel.h>

#include <memory>
#include <vector>

namespace NPT
{
  /**
   * The reference gradients of the functions of all cells. They never change,
   * so they are kept where they fit in a bounded memory (23 kB per cell of
   * degree 2). Beyond that they are computed again for each use, which costs
   * about as much as the residual of the cell (the tangent costs more) and no
   * memory.
   */
  class GradientsOfCells
  {
  public:
    static constexpr std::size_t memory_for_keeping = 512ul << 20; ///< bytes

    /**
     * @param space Must outlive the object.
     * @param n_gauss_points Per direction; 0 takes degree + 1.
     * @param memory Keep the gradients of all cells if they need no more
     *   [bytes].
     *
     * Throws InvertedCell if a patch is folded in the reference configuration.
     */
    explicit GradientsOfCells(const IGASpace<3> &space,
                              const unsigned int n_gauss_points = 0,
                              const std::size_t  memory = memory_for_keeping);

    /// The gradients of a cell; valid until the next call.
    const CellGradients &
    operator[](const unsigned int cell) const;

    unsigned int
    size() const
    {
      return cells_.size();
    }
    bool
    are_kept() const
    {
      return !kept_.empty();
    }

  private:
    void
    compute(const unsigned int cell, CellGradients &gradients) const;

    std::vector<dealii::Triangulation<3>::active_cell_iterator> cells_;
    std::unique_ptr<IGAValues<3>>                               values_;
    std::vector<CellGradients>                                  kept_;
    // Of the cell that was asked for last, if they are not kept.
    mutable CellGradients last_;
    mutable unsigned int  last_cell_;
  };
} // namespace NPT

#endif
