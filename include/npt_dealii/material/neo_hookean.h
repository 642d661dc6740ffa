// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the compressible neo-Hookean law, the isotropic part (51) of the
// fiber bundle and the law of fibers and matrix.

#ifndef npt_dealii_material_neo_hookean_h
#define npt_dealii_material_neo_hookean_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/material/law_parameters.h>

namespace NPT
{
  /**
   * The volumetric energy U(J) of a neo-Hookean law. Both have U'' = lambda at
   * J = 1 and differ in the third order of the strain.
   */
  enum class VolumetricEnergy
  {
    logarithm, ///< lambda/2 (ln J)^2, Eq. (51)
    ciarlet    ///< lambda/4 (J^2 - 1 - 2 ln J), Eq. (A14)
  };

  template <>
  const EnumNames<VolumetricEnergy> &
  enum_names<VolumetricEnergy>();

  /// Lame constants [MPa] and the volumetric energy they belong to.
  struct NeoHookeanConstants
  {
    double           mu;
    double           lambda;
    VolumetricEnergy volumetric_energy = VolumetricEnergy::logarithm;

    /// From Young's modulus [MPa] and Poisson's ratio, -1 < nu < 1/2.
    static NeoHookeanConstants
    from_young_and_poisson(
      const double           young_modulus,
      const double           poisson_ratio,
      const VolumetricEnergy volumetric_energy = VolumetricEnergy::logarithm);
  };

  /**
   * Compressible neo-Hookean law, Eq. (51) with one of two volumetric energies:
   *
   * @f[ \Psi = \tfrac{\mu}{2} (I_1 - 3) - \mu \ln J + U(J), \qquad
   *     U = \tfrac{\lambda}{2} (\ln J)^2 \quad \text{or} \quad
   *     U = \tfrac{\lambda}{4} (J^2 - 1 - 2 \ln J) @f]
   * @f[ P = \mu F + (J U' - \mu) F^{-T}, \qquad
   *     J U' = \lambda \ln J \quad \text{or} \quad
   *     J U' = \tfrac{\lambda}{2} (J^2 - 1) @f]
   *
   * with I_1 = tr C of the three-dimensional C also for dim = 2. The second
   * energy is polyconvex and bounds the volume from above more strongly; other
   * programs offer it, so that results can be compared without a difference
   * of the laws. Reference: Ciarlet, Mathematical Elasticity I (1988), 4.10.
   */
  template <int dim>
  class NeoHookean final : public HyperelasticLaw<dim>
  {
  public:
    explicit NeoHookean(const NeoHookeanConstants &constants);

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

    const NeoHookeanConstants &
    constants() const
    {
      return constants_;
    }

  private:
    const NeoHookeanConstants constants_;
  };



  /// The law "neo-Hookean" of a parameter file.
  struct NeoHookeanParameters final : public LawParameters
  {
    double           young_modulus     = 100.; ///< E [MPa]
    double           poisson_ratio     = 0.3;  ///< nu [-]
    VolumetricEnergy volumetric_energy = VolumetricEnergy::logarithm;

    NeoHookeanConstants
    constants() const
    {
      return NeoHookeanConstants::from_young_and_poisson(young_modulus,
                                                         poisson_ratio,
                                                         volumetric_energy);
    }

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
