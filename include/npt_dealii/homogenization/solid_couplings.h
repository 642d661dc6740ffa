// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the couplings of a cell that is periodic in all three directions,
// with the nine components of the displacement gradient as macro unknowns.

#ifndef npt_dealii_homogenization_solid_couplings_h
#define npt_dealii_homogenization_solid_couplings_h

#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/affine_constraints.h>

#include <array>

namespace NPT
{
  /**
   * Numbering of all unknowns of a micro cell: three displacement components
   * per control point, then the nine components H_iJ of the macroscopic
   * displacement gradient, row by row: 11, 12, 13, 21, ...
   */
  struct SolidMacroUnknowns
  {
    static constexpr unsigned int n_macro = 9;

    explicit SolidMacroUnknowns(const unsigned int n_control_points)
      : first(3 * n_control_points)
    {}

    unsigned int
    component(const unsigned int i, const unsigned int J) const
    {
      return first + 3 * i + J;
    }
    unsigned int
    n_unknowns() const
    {
      return first + n_macro;
    }

    unsigned int first;
  };

  /**
   * Periodicity of the fluctuation of the displacement,
   *
   * @f[ w_i(X + L) = w_i(X) + H_{iJ} L_J @f]
   *
   * for control points X and X + L that are a lattice vector L apart, found by
   * position. One control point is held, which takes away the translations and
   * carries no force.
   *
   * @param periods The edges of the cell [mm]; lattice vectors are their sums
   *   and differences.
   * @param uniform_direction If 0, 1 or 2: the fluctuation does not change in
   *   the direction of this edge either. Exact for a cell whose sections are
   *   all alike, as long as it does not buckle; it saves unknowns. The control
   *   points must lie in layers.
   * @return Closed constraints over macro.n_unknowns() unknowns.
   *
   * Throws InputError if a face on the boundary of the cell has no partner.
   */
  dealii::AffineConstraints<double>
  make_solid_couplings(const IGASpace<3>                         &space,
                       const SolidMacroUnknowns                  &macro,
                       const std::array<dealii::Tensor<1, 3>, 3> &periods,
                       const int uniform_direction = -1);
} // namespace NPT

#endif
