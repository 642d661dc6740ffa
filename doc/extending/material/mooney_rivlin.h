// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the compressible Mooney-Rivlin law, an example of a further material.

#ifndef npt_dealii_doc_extending_mooney_rivlin_h
#define npt_dealii_doc_extending_mooney_rivlin_h

#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/material/law_parameters.h>

namespace NPT
{
  /**
   * Compressible Mooney-Rivlin law,
   *
   * @f[ \Psi = c_1 (I_1 - 3) + c_2 (I_2 - 3) - 2 (c_1 + 2 c_2) \ln J
   *            + \tfrac{\lambda}{2} (\ln J)^2, @f]
   * @f[ P = 2 c_1 F + 2 c_2 (I_1 F - F C)
   *         + (\lambda \ln J - 2 c_1 - 4 c_2) F^{-T} , @f]
   *
   * with I_1 and I_2 of the three-dimensional C also for dim = 2. At small
   * strain the shear modulus is 2 (c_1 + c_2), Lame's first constant
   * lambda + 4 c_2. Reference: Ciarlet, Mathematical Elasticity I (1988), 4.10.
   */
  template <int dim>
  class MooneyRivlin final : public HyperelasticLaw<dim>
  {
  public:
    /// All three in MPa.
    MooneyRivlin(const double c1, const double c2, const double lambda);

    using HyperelasticLaw<dim>::energy;
    using HyperelasticLaw<dim>::stress;
    using HyperelasticLaw<dim>::stress_and_tangent;

    std::string
    name() const override;

    double
    energy(const double *F) const override;

    void
    stress(const double *F, double *P) const override;

    void
    stress_and_tangent(const double *F, double *P, double *A) const override;

  private:
    const double c1_, c2_, lambda_;
  };



  /// The law "Mooney-Rivlin" of a parameter file.
  struct MooneyRivlinParameters final : public LawParameters
  {
    double c1           = 15.; ///< [MPa]
    double c2           = 5.;  ///< [MPa]
    double bulk_modulus = 80.; ///< K at small strain [MPa]

    /// K - 2/3 of the shear modulus - 4 c_2.
    double
    lambda() const;

    std::unique_ptr<LawParameters>
    clone() const override;

    void
    add_parameters(dealii::ParameterHandler &prm) override;

    void
    check(const std::string &subsection) const override;

    std::unique_ptr<HyperelasticLaw<2>>
    make_law(const dealii::Tensor<1, 2> &fiber_direction) const override;

    std::unique_ptr<HyperelasticLaw<3>>
    make_law(const dealii::Tensor<1, 3> &fiber_direction) const override;
  };
} // namespace NPT

#endif
