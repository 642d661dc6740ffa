// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the fiber bundle law (50)-(53): energy, stress,
// tangent, the small-strain constants and the entries in a parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/tensor_tools.h>
#include <npt_dealii/material/fiber_bundle_law.h>

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



    // The invariants at F and the vectors of their derivatives.
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



    // First derivatives of Psi with respect to ln J, I_4 and I_5.
    struct EnergyDerivatives
    {
      template <int dim>
      EnergyDerivatives(const FiberBundleConstants &constants,
                        const FiberKinematics<dim> &s)
      {
        const auto [mu, lambda, a, b, c, d] = constants;

        log_J = -mu + lambda * s.log_J + b * s.I4_minus_1 - d * s.I5_minus_1;
        I4    = a + b * s.log_J + 2. * c * s.I4_minus_1;
        I5    = -(0.5 * a + d * s.log_J);
      }

      double log_J, I4, I5;
    };



    // P = mu F + Psi_,lnJ F^{-T} + Psi_,4 dI4/dF + Psi_,5 dI5/dF
    template <int dim>
    void
    compute_stress(const double                  mu,
                   const double                 *F,
                   const dealii::Tensor<1, dim> &A,
                   const FiberKinematics<dim>   &s,
                   const EnergyDerivatives      &dPsi,
                   double                       *P)
    {
      for (int i = 0; i < dim; ++i)
        for (int J = 0; J < dim; ++J)
          P[i * dim + J] = mu * F[i * dim + J] + dPsi.log_J * s.G[i * dim + J] +
                           2. * dPsi.I4 * s.f[i] * A[J] +
                           2. * dPsi.I5 * (s.f[i] * s.h[J] + s.Fh[i] * A[J]);
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
    const EnergyDerivatives    dPsi(constants_, s);
    compute_stress(constants_.mu, F, fiber_direction_, s, dPsi, P);
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
    const EnergyDerivatives      dPsi(constants_, s);
    compute_stress(mu, F, A, s, dPsi, P);

    // Part 1, second derivatives of Psi: a sum of three dyads,
    //   G (x) (lambda G + b D4 - d D5) + D4 (x) (b G + 2 c D4) - D5 (x) d G,
    // where D4 = dI4/dF, D5 = dI5/dF. The right factors:
    const double *G = s.G;
    double        D4[dim * dim], D5[dim * dim];
    double        right_G[dim * dim], right_D4[dim * dim], right_D5[dim * dim];
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        {
          const int e = i * dim + J;
          D4[e]       = 2. * s.f[i] * A[J];
          D5[e]       = 2. * (s.f[i] * s.h[J] + s.Fh[i] * A[J]);
          right_G[e]  = lambda * G[e] + b * D4[e] - d * D5[e];
          right_D4[e] = b * G[e] + 2. * c * D4[e];
          right_D5[e] = -d * G[e];
        }

    // Part 2, second derivatives of the invariants:
    //   d2 I1/2 = delta_ik delta_JL,  d2 lnJ = - G_iL G_kJ,
    //   d2 I4/2 = delta_ik A_J A_L,
    //   d2 I5/2 = delta_ik (h_J A_L + A_J h_L) + delta_JL f_i f_k
    //           + f_i F_kJ A_L + F_iL f_k A_J + (F F^T)_ik A_J A_L.
    const double q4 = 2. * dPsi.I4, q5 = 2. * dPsi.I5;

    double delta_ik_part[dim * dim];
    for (int J = 0; J < dim; ++J)
      for (int L = 0; L < dim; ++L)
        delta_ik_part[J * dim + L] = (J == L ? mu : 0.) + q4 * A[J] * A[L] +
                                     q5 * (s.h[J] * A[L] + A[J] * s.h[L]);

    for (int i = 0; i < dim; ++i)
      {
        const double *F_i = F + i * dim, *G_i = G + i * dim;

        double q5_B_i[dim]; // row i of Psi_,5 F F^T
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
                // loop is a sum of six scaled rows.
                const double with_G = -dPsi.log_J * G[k * dim + J];
                const double with_F = q5 * s.f[k] * A[J];
                const double with_A =
                  q5 * s.f[i] * F[k * dim + J] + q5_B_i[k] * A[J];
                for (int L = 0; L < dim; ++L)
                  row[k * dim + L] = G[e] * right_G[k * dim + L] +
                                     D4[e] * right_D4[k * dim + L] +
                                     D5[e] * right_D5[k * dim + L] +
                                     with_G * G_i[L] + with_F * F_i[L] +
                                     with_A * A[L];
                row[k * dim + J] += q5 * s.f[i] * s.f[k];
              }
            for (int L = 0; L < dim; ++L)
              row[i * dim + L] += delta_ik_part[J * dim + L];
          }
      }
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
