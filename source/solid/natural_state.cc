// SPDX-License-Identifier: LGPL-2.1-or-later
// Relaxation of stress, and cells that deform from a natural state.

#include <npt_dealii/material/symmetric_eigenvectors.h>
#include <npt_dealii/solid/natural_state.h>

#include <cmath>

namespace NPT
{
  using dealii::Tensor;

  namespace
  {
    // The smallest rotation that turns the unit vector a into b.
    Tensor<2, 3>
    rotation(const Tensor<1, 3> &a, const Tensor<1, 3> &b)
    {
      const Tensor<1, 3> v = cross_product_3d(a, b);
      Tensor<2, 3>       V;
      V[0][1] = -v[2];
      V[0][2] = v[1];
      V[1][2] = -v[0];
      V[1][0] = -V[0][1];
      V[2][0] = -V[0][2];
      V[2][1] = -V[1][2];
      return dealii::unit_symmetric_tensor<3>() + V + V * V / (1. + a * b);
    }
  } // namespace



  Tensor<2, 3>
  relaxed_inverse(const Tensor<2, 3> &F_e,
                  const Tensor<2, 3> &inverse,
                  const Tensor<1, 3> &fiber,
                  const double        fraction)
  {
    if (fraction == 0.)
      return inverse;
    const auto eigenpairs =
      symmetric_eigenvectors(symmetrize(transpose(F_e) * F_e),
                             dealii::SymmetricTensorEigenvectorMethod::jacobi);
    Tensor<2, 3> stretch, its_inverse; // U_e^phi
    for (const auto &[square, n] : eigenpairs)
      {
        const double       power = std::pow(square, 0.5 * fraction);
        const Tensor<2, 3> nn    = outer_product(n, n) / n.norm_square();
        stretch += power * nn;
        its_inverse += nn / power;
      }
    const Tensor<1, 3> along = stretch * fiber;
    return inverse * its_inverse * rotation(fiber, along / along.norm());
  }



  void
  to_natural_state(const CellGradients &reference,
                   const double        *inverse,
                   CellGradients       &natural)
  {
    natural.reinit(reference.n_functions, reference.n_points);
    natural.values = reference.values;
    natural.jxw    = reference.jxw;
    natural.at_rest.assign(inverse, inverse + 9 * reference.n_points);
    const unsigned int stride = reference.stride;
    for (unsigned int q = 0; q < reference.n_points; ++q)
      {
        Tensor<2, 3> map;
        for (unsigned int e = 0; e < 9; ++e)
          map[e / 3][e % 3] = inverse[9 * q + e];
        natural.jxw[q] /= determinant(map);
        for (unsigned int J = 0; J < 3; ++J)
          for (unsigned int K = 0; K < 3; ++K)
            {
              const double *from = &reference.gradients[(3 * q + K) * stride];
              double       *to   = &natural.gradients[(3 * q + J) * stride];
              for (unsigned int A = 0; A < stride; ++A)
                to[A] += from[A] * map[K][J];
            }
      }
  }
} // namespace NPT
