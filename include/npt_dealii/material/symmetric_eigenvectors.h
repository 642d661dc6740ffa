// SPDX-License-Identifier: LGPL-2.1-or-later
// Declares the eigenvectors of symmetric tensors, for every compiler.

#ifndef npt_dealii_material_symmetric_eigenvectors_h
#define npt_dealii_material_symmetric_eigenvectors_h

#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <utility>

namespace NPT
{
  /**
   * Return the pairs (lambda, n) with A n = lambda n, |n| = 1, the largest
   * lambda first.
   *
   * This is dealii::eigenvectors(), but for clang: the return type of that
   * function depends on a constant expression, which clang encodes otherwise
   * than GCC, so that it does not find it in a deal.II that GCC has compiled.
   * Then the QR algorithm of GSL takes its place, whatever the method.
   */
  template <int dim>
  std::array<std::pair<double, dealii::Tensor<1, dim>>, dim>
  symmetric_eigenvectors(const dealii::SymmetricTensor<2, dim>         &A,
                         const dealii::SymmetricTensorEigenvectorMethod method);
} // namespace NPT

#endif
