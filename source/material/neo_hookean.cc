// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the formulas of the compressible neo-Hookean law (51).

#include <npt_dealii/base/tensor_tools.h>
#include <npt_dealii/material/neo_hookean.h>

#include <cmath>

namespace NPT
{
  NeoHookeanConstants
  NeoHookeanConstants::from_young_and_poisson(const double young_modulus,
                                              const double poisson_ratio)
  {
    const double E = young_modulus, nu = poisson_ratio;
    return {E / (2. * (1. + nu)), E * nu / ((1. + nu) * (1. - 2. * nu))};
  }



  template <int dim>
  NeoHookean<dim>::NeoHookean(const NeoHookeanConstants &constants)
    : constants_(constants)
  {}



  template <int dim>
  std::string
  NeoHookean<dim>::name() const
  {
    return "neo-Hookean";
  }



  template <int dim>
  double
  NeoHookean<dim>::energy(const double *F) const
  {
    const auto [mu, lambda] = constants_;

    double       G[dim * dim];
    const double log_J = std::log(inverse_transpose<dim>(F, G));

    // I_1 - 3 in space is tr C - dim here, F_33 being 1 in plane strain.
    double I1_minus_3 = -dim;
    for (int e = 0; e < dim * dim; ++e)
      I1_minus_3 += F[e] * F[e];

    return 0.5 * mu * I1_minus_3 - mu * log_J + 0.5 * lambda * log_J * log_J;
  }



  template <int dim>
  void
  NeoHookean<dim>::stress(const double *F, double *P) const
  {
    const auto [mu, lambda] = constants_;

    double       G[dim * dim];
    const double log_J       = std::log(inverse_transpose<dim>(F, G));
    const double dPsi_dlog_J = lambda * log_J - mu;

    for (int e = 0; e < dim * dim; ++e)
      P[e] = mu * F[e] + dPsi_dlog_J * G[e];
  }



  template <int dim>
  void
  NeoHookean<dim>::stress_and_tangent(const double *F,
                                      double       *P,
                                      double       *A) const
  {
    const auto [mu, lambda] = constants_;

    double       G[dim * dim];
    const double log_J       = std::log(inverse_transpose<dim>(F, G));
    const double dPsi_dlog_J = lambda * log_J - mu;

    for (int e = 0; e < dim * dim; ++e)
      P[e] = mu * F[e] + dPsi_dlog_J * G[e];

    // dG_iJ / dF_kL = - G_iL G_kJ
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        {
          double *row = A + (i * dim + J) * dim * dim;
          for (int k = 0; k < dim; ++k)
            for (int L = 0; L < dim; ++L)
              row[k * dim + L] = lambda * G[i * dim + J] * G[k * dim + L] -
                                 dPsi_dlog_J * G[i * dim + L] * G[k * dim + J];
          row[i * dim + J] += mu;
        }
  }



  template class NeoHookean<2>;
  template class NeoHookean<3>;
} // namespace NPT
