// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the natural state of bodies whose stress has relaxed: the shape at
// every quadrature point in which the material bears no stress.

#ifndef npt_dealii_solid_natural_state_h
#define npt_dealii_solid_natural_state_h

#include <npt_dealii/solid/solid_kernel.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace NPT
{
  /**
   * Bodies from which stress has relaxed deform from a natural state,
   *
   * @f[ F = F_e F_w, \qquad W = J_w \Psi(F_e), \qquad
   *     P = J_w \frac{\partial\Psi}{\partial F_e} F_w^{-T}, @f]
   *
   * with the map F_w from the reference to the natural state, which need not be
   * the gradient of anything. This is a value: the inverse of F_w of all
   * quadrature points, nine numbers each, row major, in the order of the cells;
   * empty where the reference configuration is the natural state.
   *
   * F_w is turned such that it keeps the direction of the fiber, so that a law
   * with its fiber along A sees F_e with the fiber along A.
   */
  using NaturalState = std::vector<double>;

  /**
   * Inverse of the map into the natural state after a fraction of the stress
   * has relaxed,
   *
   * @f[ F_w' = Q^T U_e^{\varphi} F_w, \qquad U_e^2 = F_e^T F_e, \qquad
   *     Q A = U_e^{\varphi} A / |U_e^{\varphi} A| , @f]
   *
   * so that the elastic stretch that is left is U_e^{1 - \varphi}: none if all
   * has relaxed. Only this function of U_e commutes with it, so that relaxing
   * twice by half of what is there is relaxing once by three quarters.
   *
   * @param F_e Elastic deformation gradient of the present state.
   * @param inverse F_w^{-1} up to now.
   * @param fiber Unit vector A, the fiber in the reference configuration.
   * @param fraction phi, 0 to 1.
   */
  dealii::Tensor<2, 3>
  relaxed_inverse(const dealii::Tensor<2, 3> &F_e,
                  const dealii::Tensor<2, 3> &inverse,
                  const dealii::Tensor<1, 3> &fiber,
                  const double                fraction);

  /**
   * The data of a cell that deforms from a natural state: gradients G F_w^{-1},
   * volumes J_w dV, and F_e at rest, F_w^{-1}. SolidKernel then finds F_e, and
   * force, stiffness and energy of W.
   *
   * @param inverse F_w^{-1} of the points of the cell, row major.
   */
  void
  to_natural_state(const CellGradients &reference,
                   const double        *inverse,
                   CellGradients       &natural);
} // namespace NPT

#endif
