// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the fiber bundle law (50)-(53): energy, stress,
// tangent, the small-strain constants and the entries in a parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/fiber_kinematics.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <sstream>

namespace NPT
{
  namespace
  {
    // Stiffness with the fiber along 1; the remaining entries follow from
    // transverse isotropy (C44 = G_T, C55 = C66 = G_L, C33 = C22, C13 = C12).
    struct SmallStrainModuli
    {
      explicit SmallStrainModuli(const FiberBundleConstants &constants)
      {
        const auto [mu, lambda, a, b, c, d] = constants;

        const double k = 2. * b - 4. * d;
        C11            = lambda + 2. * mu + 8. * c + 2. * k - 4. * a;
        C12            = lambda + k;
        C22            = lambda + 2. * mu;
        C23            = lambda;
        G_L            = mu - a;
        G_T            = mu;
      }

      double C11, C12, C22, C23, G_L, G_T;
    };



    // First derivatives of Psi by the invariants.
    template <int dim>
    FiberEnergyDerivatives
    first_derivatives(const FiberBundleConstants &constants,
                      const FiberKinematics<dim> &s)
    {
      const auto [mu, lambda, a, b, c, d] = constants;
      return {0.5 * mu,
              -mu + lambda * s.log_J + b * s.I4_minus_1 - d * s.I5_minus_1,
              a + b * s.log_J + 2. * c * s.I4_minus_1,
              -(0.5 * a + d * s.log_J)};
    }
  } // namespace



  EngineeringConstants
  FiberBundleConstants::engineering_constants() const
  {
    const SmallStrainModuli m(*this);

    const double nu_LT = m.C12 / (m.C22 + m.C23);
    const double E_L   = m.C11 - 2. * m.C12 * nu_LT;
    const double E_T   = (m.C22 - m.C23) *
                       (m.C11 * (m.C22 + m.C23) - 2. * m.C12 * m.C12) /
                       (m.C11 * m.C22 - m.C12 * m.C12);
    return {E_L, E_T, m.G_L, m.G_T, nu_LT};
  }



  FiberBundleConstants::LowestEigenvalue
  FiberBundleConstants::lowest_stiffness_eigenvalue() const
  {
    const SmallStrainModuli m(*this);

    // Strains that are symmetric about the fiber form an invariant plane with
    // the stiffness [C11, sqrt(2) C12; sqrt(2) C12, C22 + C23]; all others are
    // shears.
    const double sum        = m.C11 + m.C22 + m.C23;
    const double difference = m.C11 - m.C22 - m.C23;
    const double axisymmetric =
      0.5 * (sum - std::hypot(difference, 2. * std::sqrt(2.) * m.C12));

    LowestEigenvalue lowest{2. * m.G_L, "shear along the fiber (2 G_L)"};
    if (2. * m.G_T < lowest.value)
      lowest = {2. * m.G_T, "shear across the fiber (2 G_T)"};
    if (axisymmetric < lowest.value)
      lowest = {axisymmetric, "stretch along the fiber with lateral stretch"};
    return lowest;
  }



  template <int dim>
  FiberBundleLaw<dim>::FiberBundleLaw(
    const FiberBundleConstants   &constants,
    const dealii::Tensor<1, dim> &fiber_direction)
    : constants_(constants)
    , fiber_direction_(fiber_direction)
  {
    AssertThrow(std::abs(fiber_direction.norm() - 1.) < 1e-8,
                dealii::ExcMessage("The fiber direction has the length " +
                                   std::to_string(fiber_direction.norm()) +
                                   "; it must be a unit vector."));
  }



  template <int dim>
  std::string
  FiberBundleLaw<dim>::name() const
  {
    return "fiber bundle";
  }



  template <int dim>
  double
  FiberBundleLaw<dim>::energy(const double *F) const
  {
    const auto [mu, lambda, a, b, c, d] = constants_;
    const FiberKinematics<dim> s(F, fiber_direction_);

    return 0.5 * mu * s.I1_minus_3 - mu * s.log_J +
           0.5 * lambda * s.log_J * s.log_J +
           (a + b * s.log_J + c * s.I4_minus_1) * s.I4_minus_1 -
           (0.5 * a + d * s.log_J) * s.I5_minus_1;
  }



  template <int dim>
  void
  FiberBundleLaw<dim>::stress(const double *F, double *P) const
  {
    const FiberKinematics<dim> s(F, fiber_direction_);
    compute_fiber_stress(
      F, fiber_direction_, s, first_derivatives(constants_, s), P);
  }



  template <int dim>
  void
  FiberBundleLaw<dim>::stress_and_tangent(const double *F,
                                          double       *P,
                                          double       *tangent) const
  {
    const auto [mu, lambda, a, b, c, d] = constants_;

    const dealii::Tensor<1, dim> A = fiber_direction_;
    const FiberKinematics<dim>   s(F, A);
    const FiberEnergyDerivatives dPsi = first_derivatives(constants_, s);
    compute_fiber_stress(F, A, s, dPsi, P);

    // The second derivatives of Psi are a sum of three dyads,
    //   G (x) (lambda G + b D4 - d D5) + D4 (x) (b G + 2 c D4) - D5 (x) d G,
    // where D4 = dI4/dF, D5 = dI5/dF.
    const double *G = s.G;
    double        left[3][dim * dim], right[3][dim * dim];
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        {
          const int    e  = i * dim + J;
          const double D4 = 2. * s.f[i] * A[J];
          const double D5 = 2. * (s.f[i] * s.h[J] + s.Fh[i] * A[J]);
          left[0][e]      = G[e];
          left[1][e]      = D4;
          left[2][e]      = D5;
          right[0][e]     = lambda * G[e] + b * D4 - d * D5;
          right[1][e]     = b * G[e] + 2. * c * D4;
          right[2][e]     = -d * G[e];
        }
    compute_fiber_tangent<dim, 3>(F, A, s, dPsi, left, right, tangent);
  }



  template class FiberBundleLaw<2>;
  template class FiberBundleLaw<3>;



  std::unique_ptr<LawParameters>
  FiberBundleParameters::clone() const
  {
    return std::make_unique<FiberBundleParameters>(*this);
  }



  void
  FiberBundleParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "mu_iso",
                  constants.mu,
                  "Fiber bundle: shear modulus mu_iso across the fiber "
                  "[MPa], Eq. (51).");
    add_parameter(prm,
                  "lambda_iso",
                  constants.lambda,
                  "Fiber bundle: Lame constant lambda_iso [MPa], Eq. (51).");
    add_parameter(prm,
                  "a_trn",
                  constants.a,
                  "Fiber bundle: a_trn [MPa], Eq. (52). The shear modulus "
                  "along the fiber is mu_iso - a_trn.");
    add_parameter(prm,
                  "b_trn",
                  constants.b,
                  "Fiber bundle: b_trn [MPa], Eq. (52), couples volume "
                  "change and fiber stretch.");
    add_parameter(prm,
                  "c_trn",
                  constants.c,
                  "Fiber bundle: c_trn [MPa], Eq. (52), stiffness along "
                  "the fiber.");
    add_parameter(prm,
                  "d_trn",
                  constants.d,
                  "Fiber bundle: d_trn [MPa], Eq. (52). Table 1 prints it "
                  "with the opposite sign, with which the bundle is not "
                  "stable at rest.");
  }



  void
  FiberBundleParameters::check(const std::string &subsection) const
  {
    const auto lowest = constants.lowest_stiffness_eigenvalue();
    if (lowest.value > 0.)
      return;

    std::ostringstream text;
    text << "The small-strain stiffness of the fiber bundle must be positive "
         << "definite, but its lowest eigenvalue, the one of " << lowest.mode
         << ", is " << lowest.value << " MPa; change mu_iso, lambda_iso, "
         << "a_trn, b_trn, c_trn or d_trn (subsection " << subsection << ")";

    FiberBundleConstants reversed = constants;
    reversed.d                    = -constants.d;
    if (reversed.lowest_stiffness_eigenvalue().value > 0.)
      text << ": with d_trn = " << reversed.d
           << " it is positive definite, and the sign of d_trn printed in "
           << "Table 1 is a misprint";
    throw InputError(text.str() + ".");
  }



  std::unique_ptr<HyperelasticLaw<2>>
  FiberBundleParameters::make_law(
    const dealii::Tensor<1, 2> &fiber_direction) const
  {
    return std::make_unique<FiberBundleLaw<2>>(constants, fiber_direction);
  }



  std::unique_ptr<HyperelasticLaw<3>>
  FiberBundleParameters::make_law(
    const dealii::Tensor<1, 3> &fiber_direction) const
  {
    return std::make_unique<FiberBundleLaw<3>>(constants, fiber_direction);
  }



  namespace
  {
    const Registry<RegisteredLaw>::Registration fiber_bundle(
      "fiber bundle",
      {"the transversely isotropic fiber bundle, Eqs. (50)-(53)",
       []() { return std::make_unique<FiberBundleParameters>(); }});
  } // namespace
} // namespace NPT
