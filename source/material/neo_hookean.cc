// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the compressible neo-Hookean law (51).

#include <npt_dealii/base/tensor_tools.h>
#include <npt_dealii/material/neo_hookean.h>

#include <cmath>

namespace NPT
{
  namespace
  {
    // U(J) and its first two derivatives by ln J.
    struct Volumetric
    {
      double value, first, second;
    };

    Volumetric
    volumetric(const NeoHookeanConstants &constants, const double log_J)
    {
      const double lambda = constants.lambda;
      if (constants.volumetric_energy == VolumetricEnergy::logarithm)
        return {0.5 * lambda * log_J * log_J, lambda * log_J, lambda};
      // J^2 - 1 without cancellation at small strain.
      const double J2_minus_1 = std::expm1(2. * log_J);
      return {0.25 * lambda * (J2_minus_1 - 2. * log_J),
              0.5 * lambda * J2_minus_1,
              lambda * (J2_minus_1 + 1.)};
    }
  } // namespace



  NeoHookeanConstants
  NeoHookeanConstants::from_young_and_poisson(
    const double           young_modulus,
    const double           poisson_ratio,
    const VolumetricEnergy volumetric_energy)
  {
    const double E = young_modulus, nu = poisson_ratio;
    return {E / (2. * (1. + nu)),
            E * nu / ((1. + nu) * (1. - 2. * nu)),
            volumetric_energy};
  }



  template <int dim>
  NeoHookean<dim>::NeoHookean(const NeoHookeanConstants &constants)
    : constants_(constants)
  {}



  template <int dim>
  std::string
  NeoHookean<dim>::name() const
  {
    return constants_.volumetric_energy == VolumetricEnergy::logarithm ?
             "neo-Hookean" :
             "neo-Hookean, Ciarlet";
  }



  template <int dim>
  double
  NeoHookean<dim>::energy(const double *F) const
  {
    const double mu = constants_.mu;

    double       G[dim * dim];
    const double log_J = std::log(inverse_transpose<dim>(F, G));

    // I_1 - 3 in space is tr C - dim here, F_33 being 1 in plane strain.
    double I1_minus_3 = -dim;
    for (int e = 0; e < dim * dim; ++e)
      I1_minus_3 += F[e] * F[e];

    return 0.5 * mu * I1_minus_3 - mu * log_J +
           volumetric(constants_, log_J).value;
  }



  template <int dim>
  void
  NeoHookean<dim>::stress(const double *F, double *P) const
  {
    const double mu = constants_.mu;

    double       G[dim * dim];
    const double log_J       = std::log(inverse_transpose<dim>(F, G));
    const double dPsi_dlog_J = volumetric(constants_, log_J).first - mu;

    for (int e = 0; e < dim * dim; ++e)
      P[e] = mu * F[e] + dPsi_dlog_J * G[e];
  }



  template <int dim>
  void
  NeoHookean<dim>::stress_and_tangent(const double *F,
                                      double       *P,
                                      double       *A) const
  {
    const double mu = constants_.mu;

    double           G[dim * dim];
    const double     log_J       = std::log(inverse_transpose<dim>(F, G));
    const Volumetric U           = volumetric(constants_, log_J);
    const double     dPsi_dlog_J = U.first - mu;

    for (int e = 0; e < dim * dim; ++e)
      P[e] = mu * F[e] + dPsi_dlog_J * G[e];

    // dG_iJ / dF_kL = - G_iL G_kJ
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        {
          double *row = A + (i * dim + J) * dim * dim;
          for (int k = 0; k < dim; ++k)
            for (int L = 0; L < dim; ++L)
              row[k * dim + L] = U.second * G[i * dim + J] * G[k * dim + L] -
                                 dPsi_dlog_J * G[i * dim + L] * G[k * dim + J];
          row[i * dim + J] += mu;
        }
  }



  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace NPT
