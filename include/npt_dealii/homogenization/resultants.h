// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the resultants of a cell as volume averages, and the contact dipole
// by which they differ from the conjugates of the macro unknowns.

#ifndef npt_dealii_homogenization_resultants_h
#define npt_dealii_homogenization_resultants_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/fabric_couplings.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

namespace NPT
{
  /// Resultants of the first Piola-Kirchhoff stress, (7) and (8).
  struct Resultants
  {
    dealii::Tensor<2, 3> N; ///< [N/mm]
    dealii::Tensor<2, 3> M; ///< [N]
  };

  /**
   * Complete sums over the integrated part of a cell to the resultants of the
   * full unit cell: divide by the area and average over the symmetry
   * operations of the cell, P -> Q P Q, and Z3 -> Q_33 Z3 in M. Components
   * that change sign under an operation vanish.
   *
   * @param sum N is the sum of P dV [N mm], M that of Z3 P dV [N mm^2].
   */
  Resultants
  complete_by_symmetry(const FabricCell &cell, const Resultants &sum);

  /**
   * Contact dipole (1/(L1 L2)) sum_A f_A (x) X_A of the contact forces on the
   * control points [N/mm]. Conjugates and averages differ by exactly this,
   * e.g. n_1 = N_11 + D_11, n_3 = (N_12 + N_21 + D_12 + D_21) / 2.
   *
   * @param contact_force C_c of all unknowns (full vector, images
   *   included).
   */
  dealii::Tensor<2, 3>
  contact_dipole(const FabricCell                 &cell,
                 const IGASpace<3>                &space,
                 const std::vector<PeriodicImage> &images,
                 const dealii::Vector<double>     &contact_force);
} // namespace NPT

#endif
