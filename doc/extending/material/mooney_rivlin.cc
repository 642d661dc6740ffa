// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of the Mooney-Rivlin law, its entries in a parameter
// file, and its name there.

#include "mooney_rivlin.h"

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/base/tensor_tools.h>

#include <cmath>

namespace NPT
{
  namespace
  {
    // b = F F^T and C = F^T F, row major, and I_1 of the solid in space.
    template <int dim>
    struct Squares
    {
      double b[dim * dim] = {}, C[dim * dim] = {};
      double I1 = 3 - dim; // F_33 = 1 in plane strain

      explicit Squares(const double *F)
      {
        for (int i = 0; i < dim; ++i)
          for (int j = 0; j < dim; ++j)
            for (int k = 0; k < dim; ++k)
              {
                b[i * dim + j] += F[i * dim + k] * F[j * dim + k];
                C[i * dim + j] += F[k * dim + i] * F[k * dim + j];
              }
        for (int i = 0; i < dim; ++i)
          I1 += C[i * dim + i];
      }
    };
  } // namespace



  template <int dim>
  MooneyRivlin<dim>::MooneyRivlin(const double c1,
                                  const double c2,
                                  const double lambda)
    : c1_(c1)
    , c2_(c2)
    , lambda_(lambda)
  {}



  template <int dim>
  std::string
  MooneyRivlin<dim>::name() const
  {
    return "Mooney-Rivlin";
  }



  template <int dim>
  double
  MooneyRivlin<dim>::energy(const double *F) const
  {
    double             G[dim * dim];
    const double       log_J = std::log(inverse_transpose<dim>(F, G));
    const Squares<dim> squares(F);
    const double       I1 = squares.I1;

    double tr_C2 = 3 - dim;
    for (const double C : squares.C)
      tr_C2 += C * C;
    const double I2 = 0.5 * (I1 * I1 - tr_C2);

    return c1_ * (I1 - 3.) + c2_ * (I2 - 3.) - 2. * (c1_ + 2. * c2_) * log_J +
           0.5 * lambda_ * log_J * log_J;
  }



  template <int dim>
  void
  MooneyRivlin<dim>::stress(const double *F, double *P) const
  {
    double             G[dim * dim];
    const double       log_J = std::log(inverse_transpose<dim>(F, G));
    const Squares<dim> squares(F);
    const double       dPsi_dlog_J = lambda_ * log_J - 2. * c1_ - 4. * c2_;

    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        {
          double FC = 0.;
          for (int K = 0; K < dim; ++K)
            FC += F[i * dim + K] * squares.C[K * dim + J];
          const int e = i * dim + J;
          P[e]        = 2. * (c1_ + c2_ * squares.I1) * F[e] - 2. * c2_ * FC +
                 dPsi_dlog_J * G[e];
        }
  }



  template <int dim>
  void
  MooneyRivlin<dim>::stress_and_tangent(const double *F,
                                        double       *P,
                                        double       *A) const
  {
    stress(F, P);

    double             G[dim * dim];
    const double       log_J = std::log(inverse_transpose<dim>(F, G));
    const Squares<dim> squares(F);
    const double       dPsi_dlog_J = lambda_ * log_J - 2. * c1_ - 4. * c2_;
    const double       identity    = 2. * (c1_ + c2_ * squares.I1);

    // d(F C)_iJ / dF_kL = delta_ik C_LJ + F_iL F_kJ + b_ik delta_JL,
    // dG_iJ / dF_kL     = - G_iL G_kJ
    for (int i = 0; i < dim; ++i)
      for (int J = 0; J < dim; ++J)
        for (int k = 0; k < dim; ++k)
          for (int L = 0; L < dim; ++L)
            {
              const int iJ = i * dim + J, kL = k * dim + L;
              const int iL = i * dim + L, kJ = k * dim + J;
              double    c2_part = 2. * F[iJ] * F[kL] - F[iL] * F[kJ];
              double    value =
                lambda_ * G[iJ] * G[kL] - dPsi_dlog_J * G[iL] * G[kJ];
              if (i == k)
                c2_part -= squares.C[L * dim + J];
              if (J == L)
                c2_part -= squares.b[i * dim + k];
              if (iJ == kL)
                value += identity;
              A[iJ * dim * dim + kL] = value + 2. * c2_ * c2_part;
            }
  }



  template class MooneyRivlin<2>;
  template class MooneyRivlin<3>;



  double
  MooneyRivlinParameters::lambda() const
  {
    return bulk_modulus - 4. / 3. * (c1 + c2) - 4. * c2;
  }



  std::unique_ptr<LawParameters>
  MooneyRivlinParameters::clone() const
  {
    return std::make_unique<MooneyRivlinParameters>(*this);
  }



  void
  MooneyRivlinParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Mooney c1",
                  c1,
                  "Mooney-Rivlin: coefficient c_1 of I_1 - 3 [MPa]; the shear "
                  "modulus at small strain is 2 (c_1 + c_2).");
    add_parameter(prm,
                  "Mooney c2",
                  c2,
                  "Mooney-Rivlin: coefficient c_2 of I_2 - 3 [MPa].");
    add_parameter(prm,
                  "Mooney bulk modulus",
                  bulk_modulus,
                  "Mooney-Rivlin: bulk modulus K at small strain [MPa].");
  }



  void
  MooneyRivlinParameters::check(const std::string &subsection) const
  {
    const std::string place = " (subsection " + subsection + ").";
    if (!(c1 + c2 > 0.))
      throw InputError(
        "Mooney c1 and Mooney c2 add up to " + short_number(c1 + c2) +
        " MPa, half of the shear modulus; it must be > 0" + place);
    if (!(bulk_modulus > 0.))
      throw InputError("Mooney bulk modulus is " + short_number(bulk_modulus) +
                       " MPa; it must be > 0" + place);
  }



  std::unique_ptr<HyperelasticLaw<2>>
  MooneyRivlinParameters::make_law(const dealii::Tensor<1, 2> &) const
  {
    return std::make_unique<MooneyRivlin<2>>(c1, c2, lambda());
  }



  std::unique_ptr<HyperelasticLaw<3>>
  MooneyRivlinParameters::make_law(const dealii::Tensor<1, 3> &) const
  {
    return std::make_unique<MooneyRivlin<3>>(c1, c2, lambda());
  }



  namespace
  {
    const Registry<RegisteredLaw>::Registration
      mooney_rivlin("Mooney-Rivlin",
                    {"the isotropic Mooney-Rivlin law", []() {
                       return std::make_unique<MooneyRivlinParameters>();
                     }});
  } // namespace
} // namespace NPT
