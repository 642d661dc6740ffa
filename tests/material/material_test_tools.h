// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the material tests share: reproducible random tensors, and
// strain energies written from the printed formulas for automatic
// differentiation.

#ifndef npt_dealii_tests_material_test_tools_h
#define npt_dealii_tests_material_test_tools_h

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/neo_hookean.h>

#include <deal.II/base/tensor.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <random>

namespace MaterialTests
{
  using dealii::Tensor;

  template <int dim>
  Tensor<2, dim>
  identity()
  {
    Tensor<2, dim> one;
    for (unsigned int i = 0; i < dim; ++i)
      one[i][i] = 1.;
    return one;
  }



  // All entries in [-size, size].
  template <int dim>
  Tensor<2, dim>
  random_tensor(std::mt19937 &generator, const double size)
  {
    std::uniform_real_distribution<double> entry(-size, size);
    Tensor<2, dim>                         T;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        T[i][j] = entry(generator);
    return T;
  }



  // Strains of some 20 %, det F > 0.
  template <int dim>
  Tensor<2, dim>
  random_deformation(std::mt19937 &generator)
  {
    return identity<dim>() + random_tensor<dim>(generator, 0.2);
  }



  template <int dim>
  Tensor<1, dim>
  random_direction(std::mt19937 &generator)
  {
    std::normal_distribution<double> entry;
    Tensor<1, dim>                   v;
    for (unsigned int i = 0; i < dim; ++i)
      v[i] = entry(generator);
    return v / v.norm();
  }



  template <int dim>
  Tensor<2, dim>
  random_rotation(std::mt19937 &generator)
  {
    // Gram-Schmidt on random vectors; the last one is turned if necessary so
    // that det Q = +1.
    Tensor<2, dim> Q;
    for (unsigned int i = 0; i < dim; ++i)
      {
        Q[i] = random_direction<dim>(generator);
        for (unsigned int repeat = 0; repeat < 2; ++repeat)
          for (unsigned int j = 0; j < i; ++j)
            Q[i] -= (Q[i] * Q[j]) * Q[j];
        Q[i] /= Q[i].norm();
      }
    if (determinant(Q) < 0.)
      Q[dim - 1] *= -1.;
    return Q;
  }



  template <int dim>
  Tensor<1, dim>
  first_axis()
  {
    Tensor<1, dim> A;
    A[0] = 1.;
    return A;
  }



  template <typename Number>
  Number
  determinant_of(const std::array<Number, 4> &F)
  {
    return F[0] * F[3] - F[1] * F[2];
  }



  template <typename Number>
  Number
  determinant_of(const std::array<Number, 9> &F)
  {
    return F[0] * (F[4] * F[8] - F[5] * F[7]) -
           F[1] * (F[3] * F[8] - F[5] * F[6]) +
           F[2] * (F[3] * F[7] - F[4] * F[6]);
  }



  /// Eq. (51), Eq. (52) as printed, invariants from C as in (53); written
  /// independently of the library, for any number type.
  template <int dim, typename Number>
  Number
  printed_energy(const NPT::FiberBundleConstants     &m,
                 const Tensor<1, dim>                &A,
                 const std::array<Number, dim * dim> &F)
  {
    using std::log;

    std::array<Number, dim * dim> C;
    for (unsigned int I = 0; I < dim; ++I)
      for (unsigned int J = 0; J < dim; ++J)
        {
          C[I * dim + J] = 0.;
          for (unsigned int i = 0; i < dim; ++i)
            C[I * dim + J] += F[i * dim + I] * F[i * dim + J];
        }

    Number I1 = (dim == 2 ? 1. : 0.);
    Number I4 = 0., I5 = 0.;
    for (unsigned int I = 0; I < dim; ++I)
      {
        I1 += C[I * dim + I];
        for (unsigned int J = 0; J < dim; ++J)
          {
            I4 += A[I] * C[I * dim + J] * A[J];
            for (unsigned int K = 0; K < dim; ++K)
              I5 += A[I] * C[I * dim + K] * C[K * dim + J] * A[J];
          }
      }
    const Number log_J = log(determinant_of(F));

    return 0.5 * m.mu * (I1 - 3.) - m.mu * log_J +
           0.5 * m.lambda * log_J * log_J +
           (m.a + m.b * log_J + m.c * (I4 - 1.)) * (I4 - 1.) -
           (0.5 * m.a + m.d * log_J) * (I5 - 1.);
  }



  template <int dim>
  double
  max_difference(const Tensor<2, dim> &S, const Tensor<2, dim> &T)
  {
    double difference = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        difference = std::max(difference, std::abs(S[i][j] - T[i][j]));
    return difference;
  }



  template <int dim>
  double
  max_difference(const Tensor<4, dim> &S, const Tensor<4, dim> &T)
  {
    double difference = 0.;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int l = 0; l < dim; ++l)
            difference =
              std::max(difference, std::abs(S[i][j][k][l] - T[i][j][k][l]));
    return difference;
  }
} // namespace MaterialTests

#endif
