// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the compressible neo-Hookean law (51) and its entries
// in a parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/tensor_tools.h>
#include <npt_dealii/material/neo_hookean.h>

#include <cmath>
#include <sstream>

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



  template <>
  const EnumNames<VolumetricEnergy> &
  enum_names<VolumetricEnergy>()
  {
    static const EnumNames<VolumetricEnergy> names = {
      {VolumetricEnergy::logarithm, "logarithm"},
      {VolumetricEnergy::ciarlet, "Ciarlet"}};
    return names;
  }



  std::unique_ptr<LawParameters>
  NeoHookeanParameters::clone() const
  {
    return std::make_unique<NeoHookeanParameters>(*this);
  }



  void
  NeoHookeanParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Young modulus",
                  young_modulus,
                  "neo-Hookean: Young's modulus E > 0 [MPa] at small "
                  "strain, mu = E/(2 (1 + nu)) in Eq. (51).");
    add_parameter(prm,
                  "Poisson ratio",
                  poisson_ratio,
                  "neo-Hookean: Poisson's ratio -1 < nu < 0.5 [-] at small "
                  "strain, lambda = E nu/((1 + nu)(1 - 2 nu)) in "
                  "Eq. (51).");
    add_parameter(prm,
                  "Volumetric energy",
                  volumetric_energy,
                  "neo-Hookean: lambda/2 (ln J)^2 of Eq. (51), or "
                  "lambda/4 (J^2 - 1 - 2 ln J) of Ciarlet, which other "
                  "programs have too. They differ in the third order of "
                  "the strain.");
  }



  void
  NeoHookeanParameters::check(const std::string &subsection) const
  {
    std::ostringstream text;
    if (!(young_modulus > 0.))
      text << "Young modulus is " << young_modulus
           << " MPa; it must be > 0 (subsection " << subsection << ").";
    else if (!(poisson_ratio > -1. && poisson_ratio < 0.5))
      text << "Poisson ratio is " << poisson_ratio
           << "; it must be > -1 and < 0.5, both exclusive (subsection "
           << subsection << ").";
    if (!text.str().empty())
      throw InputError(text.str());
  }



  std::unique_ptr<HyperelasticLaw<2>>
  NeoHookeanParameters::make_law(const dealii::Tensor<1, 2> &) const
  {
    return std::make_unique<NeoHookean<2>>(constants());
  }



  std::unique_ptr<HyperelasticLaw<3>>
  NeoHookeanParameters::make_law(const dealii::Tensor<1, 3> &) const
  {
    return std::make_unique<NeoHookean<3>>(constants());
  }



  namespace
  {
    const Registry<RegisteredLaw>::Registration
      neo_hookean("neo-Hookean",
                  {"the isotropic neo-Hookean law, Eq. (51)",
                   []() { return std::make_unique<NeoHookeanParameters>(); }});
  } // namespace
} // namespace NPT
