// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what all laws with one fiber direction share at a point: invariants,
// their derivatives, and stress and tangent of an energy that depends on them.

#ifndef npt_dealii_material_fiber_kinematics_h
#define npt_dealii_material_fiber_kinematics_h

#include <npt_dealii/base/tensor_tools.h>

#include <deal.II/base/tensor.h>

#include <cmath>

namespace NPT
{
  /**
   * The invariants of a transversely isotropic energy at F, and the vectors of
   * their derivatives: I_1 = tr C, ln J, I_4 = A.CA, I_5 = A.C^2 A with the
   * unit fiber direction A, all row-major as in HyperelasticLaw.
   *
   * Throws InvertedCell if det F <= 0.
   */
  template <int dim>
  struct FiberKinematics
  {
    FiberKinematics(const double *F, const dealii::Tensor<1, dim> &A)
    {
      log_J = std::log(inverse_transpose<dim>(F, G));

      I1_minus_3 = -dim; // plane strain: F_33 = 1
      for (int e = 0; e < dim * dim; ++e)
        I1_minus_3 += F[e] * F[e];

      for (int i = 0; i < dim; ++i)
        {
          f[i] = 0.;
          for (int J = 0; J < dim; ++J)
            f[i] += F[i * dim + J] * A[J];
        }
      for (int J = 0; J < dim; ++J)
        {
          h[J] = 0.;
          for (int i = 0; i < dim; ++i)
            h[J] += F[i * dim + J] * f[i];
        }
      I4_minus_1 = -1.;
      I5_minus_1 = -1.;
      for (int i = 0; i < dim; ++i)
        {
          Fh[i] = 0.;
          for (int J = 0; J < dim; ++J)
            Fh[i] += F[i * dim + J] * h[J];
          I4_minus_1 += f[i] * f[i];
          I5_minus_1 += h[i] * h[i];
        }
    }

    double G[dim * dim]; ///< F^{-T} = d ln J / dF
    double f[dim];       ///< F A, the fiber in the current configuration
    double h[dim];       ///< C A
    double Fh[dim];
    double log_J, I1_minus_3, I4_minus_1, I5_minus_1;
  };



  /// First derivatives of an energy by the invariants [MPa].
  struct FiberEnergyDerivatives
  {
    double I1, log_J, I4, I5;
  };



  /// P = 2 Psi_,1 F + Psi_,lnJ F^{-T} + Psi_,4 dI4/dF + Psi_,5 dI5/dF.
  template <int dim>
  inline void
  compute_fiber_stress(const double                 *F,
                       const dealii::Tensor<1, dim> &A,
                       const FiberKinematics<dim>   &s,
                       const FiberEnergyDerivatives &dPsi,
                       double                       *P)
  {
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        P[i * dim + J] = 2. * dPsi.I1 * F[i * dim + J] +
                         dPsi.log_J * s.G[i * dim + J] +
                         2. * dPsi.I4 * s.f[i] * A[J] +
                         2. * dPsi.I5 * (s.f[i] * s.h[J] + s.Fh[i] * A[J]);
  }



  /// Entry (r, c) of the first n of some dyads. A recursion, because a loop
  /// here keeps the compiler from vectorizing the one around it.
  template <int n, int n_dyads, int size>
  inline double
  sum_of_dyads(const double (&left)[n_dyads][size],
               const int r,
               const double (&right)[n_dyads][size],
               const int c)
  {
    const double last = left[n - 1][r] * right[n - 1][c];
    if constexpr (n == 1)
      return last;
    else
      return sum_of_dyads<n - 1>(left, r, right, c) + last;
  }



  /**
   * Compute the tangent
   *
   * @f[ \sum_d L^d \otimes R^d + \sum_a \Psi_{,a}
   *     \frac{\partial^2 I_a}{\partial F^2} . @f]
   *
   * The dyads are the second derivatives of Psi by the invariants, which a law
   * groups as it likes: L^d = dI_d/dF and R^d = sum_b Psi_,db dI_b/dF.
   *
   * @param left, right The factors of the dyads, each of size dim dim.
   */
  template <int dim, int n_dyads>
  inline void
  compute_fiber_tangent(const double                 *F,
                        const dealii::Tensor<1, dim> &A,
                        const FiberKinematics<dim>   &s,
                        const FiberEnergyDerivatives &dPsi,
                        const double (&left)[n_dyads][dim * dim],
                        const double (&right)[n_dyads][dim * dim],
                        double *tangent)
  {
    // Second derivatives of the invariants:
    //   d2 I1/2 = delta_ik delta_JL,  d2 lnJ = - G_iL G_kJ,
    //   d2 I4/2 = delta_ik A_J A_L,
    //   d2 I5/2 = delta_ik (h_J A_L + A_J h_L) + delta_JL f_i f_k
    //           + f_i F_kJ A_L + F_iL f_k A_J + (F F^T)_ik A_J A_L.
    const double *G  = s.G;
    const double  q4 = 2. * dPsi.I4, q5 = 2. * dPsi.I5;

    double delta_ik_part[dim * dim];
    for (int J = 0; J < dim; ++J)
      for (int L = 0; L < dim; ++L)
        delta_ik_part[J * dim + L] = (J == L ? 2. * dPsi.I1 : 0.) +
                                     q4 * A[J] * A[L] +
                                     q5 * (s.h[J] * A[L] + A[J] * s.h[L]);

    for (int i = 0; i < dim; ++i)
      {
        const double *F_i = F + i * dim, *G_i = G + i * dim;

        double q5_B_i[dim]; // row i of 2 Psi_,5 F F^T
        for (int k = 0; k < dim; ++k)
          {
            q5_B_i[k] = 0.;
            for (int M = 0; M < dim; ++M)
              q5_B_i[k] += q5 * F_i[M] * F[k * dim + M];
          }

        for (int J = 0; J < dim; ++J)
          {
            const int e   = i * dim + J;
            double   *row = tangent + e * dim * dim;
            for (int k = 0; k < dim; ++k)
              {
                // The factors of G_iL, F_iL and A_L, so that the innermost
                // loop is a sum of scaled rows.
                const double with_G = -dPsi.log_J * G[k * dim + J];
                const double with_F = q5 * s.f[k] * A[J];
                const double with_A =
                  q5 * s.f[i] * F[k * dim + J] + q5_B_i[k] * A[J];
                for (int L = 0; L < dim; ++L)
                  {
                    const double of_dyads =
                      sum_of_dyads<n_dyads>(left, e, right, k * dim + L);
                    row[k * dim + L] = of_dyads + with_G * G_i[L] +
                                       with_F * F_i[L] + with_A * A[L];
                  }
                row[k * dim + J] += q5 * s.f[i] * s.f[k];
              }
            for (int L = 0; L < dim; ++L)
              row[i * dim + L] += delta_ik_part[J * dim + L];
          }
      }
  }
} // namespace NPT

#endif
