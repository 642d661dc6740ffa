// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the few tensor helpers that deal.II lacks, on raw row-major arrays
// for the kernels at quadrature points.

#ifndef npt_dealii_base_tensor_tools_h
#define npt_dealii_base_tensor_tools_h

#include <cmath>

namespace NPT
{
  /// Throw InvertedCell with the determinant in the message. Kept out of line,
  /// so that the kernels which test the determinant stay small.
  [[noreturn]] void
  throw_inverted_cell(const double determinant);

  /**
   * Compute G = F^{-T} and return J = det F.
   *
   * @param F Deformation gradient, dim x dim, row-major.
   * @param G Inverse transposed, dim x dim, row-major; must not alias F.
   *
   * Throws InvertedCell if J <= 0 or if J is not finite; then G is undefined.
   */
  template <int dim>
  inline double
  inverse_transpose(const double *F, double *G)
  {
    static_assert(dim == 2 || dim == 3, "Only implemented for dim = 2 and 3.");

    double J;
    if constexpr (dim == 2)
      {
        G[0] = F[3];
        G[1] = -F[2];
        G[2] = -F[1];
        G[3] = F[0];
        J    = F[0] * G[0] + F[1] * G[1];
      }
    else
      {
        G[0] = F[4] * F[8] - F[5] * F[7];
        G[1] = F[5] * F[6] - F[3] * F[8];
        G[2] = F[3] * F[7] - F[4] * F[6];
        G[3] = F[2] * F[7] - F[1] * F[8];
        G[4] = F[0] * F[8] - F[2] * F[6];
        G[5] = F[1] * F[6] - F[0] * F[7];
        G[6] = F[1] * F[5] - F[2] * F[4];
        G[7] = F[2] * F[3] - F[0] * F[5];
        G[8] = F[0] * F[4] - F[1] * F[3];
        J    = F[0] * G[0] + F[1] * G[1] + F[2] * G[2];
      }

    // The negation also catches a determinant that is not a number.
    if (!(J > 0.) || !std::isfinite(J))
      throw_inverted_cell(J);

    const double inverse_J = 1. / J;
    for (int e = 0; e < dim * dim; ++e)
      G[e] *= inverse_J;
    return J;
  }
} // namespace NPT

#endif
