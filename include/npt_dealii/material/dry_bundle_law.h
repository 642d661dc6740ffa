// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the law of a bundle of dry fibers (A30)-(A32): fibers that are stiff
// in tension and may buckle, that slide along and are pressed together across.

#ifndef npt_dealii_material_dry_bundle_law_h
#define npt_dealii_material_dry_bundle_law_h

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/material/law_parameters.h>

#include <string>

namespace NPT
{
  /// The constants of (A30)-(A32); moduli in MPa.
  struct DryBundleConstants
  {
    double E_L   = 43200.; ///< along the fibers, in tension
    double c     = 1.;     ///< modulus of buckled fibers over E_L [-]
    double eps_b = 1e-3;   ///< strain at which fibers buckle [-]
    double G_L   = 5.;     ///< shear along the fibers
    double E_T   = 10.;    ///< across, at rest
    double nu_T  = 0.25;   ///< contraction across per extension across [-]
    double V_0   = 0.6;    ///< fiber fraction at rest [-]
    double V_a   = 0.8;    ///< fiber fraction of the closest packing [-]

    /// Transverse shear modulus at rest, E_T / (2 (1 + nu_T)).
    double
    G_T() const
    {
      return E_T / (2. * (1. + nu_T));
    }

    /// Stiffness of the section against a change of its area at rest,
    /// E_T / (2 (1 - nu_T)).
    double
    K_T() const
    {
      return E_T / (2. * (1. - nu_T));
    }

    /// At rest; nu_LT is zero.
    EngineeringConstants
    engineering_constants() const
    {
      return {E_L, E_T, G_L, G_T(), 0.};
    }
  };

  /**
   * Hyperelasticity of a bundle of dry fibers, (A30): the sum of the energies
   * of four motions that do not touch each other at small strain,
   *
   * @f[ \Psi = W_f(\lambda - 1) + W_c(j)
   *     + \tfrac{G_T}{2} \left(\frac{I_1 - I_5/I_4}{j} - 2\right)
   *     + \tfrac{G_L}{2} \left(\frac{I_5}{I_4^2} - 1\right), \qquad
   *     \lambda = \sqrt{I_4}, \quad j = J/\lambda , @f]
   *
   * the stretch of the fibers, the change of the section's area, its change of
   * shape, and the sliding along the fibers. These are the invariants of
   * Charmetant, Vidal-Salle and Boisse, Composites Sci. Tech. 71 (2011) 1623.
   *
   * Fibers buckle, (A31): with e = lambda - 1, and for e < 0
   *
   * @f[ W_f = \tfrac{E_L}{2} e^2 \ (e \ge 0), \qquad
   *     W_f' = c E_L e + \frac{(1 - c) E_L \, e}{\sqrt{1 + (e/e_b)^2}}
   *     \ (e < 0) , @f]
   *
   * so that the stress of thin fibers tends to (1 - c) E_L e_b. The stiffness
   * at rest is E_L, and W_f has three continuous derivatives.
   *
   * Compaction, (A32): the pressure on the fibers by their fraction V = V_0/j,
   *
   * @f[ -W_c' = 2 K_T \left(\sqrt{V_a/V_0} - 1\right)^4
   *     \frac{\sqrt{V/V_0} - 1}{(\sqrt{V_a/V} - 1)^4} \ (j \le 1), \qquad
   *     W_c' = K_T (j - 1) \ (j > 1) , @f]
   *
   * of Gutowski et al., J. Composite Materials 21 (1987) 650, with the factor
   * for which the stiffness at rest is K_T. It grows without limit as V goes to
   * V_a; where sqrt(V_a/V) - 1 is a tenth of its value at rest, the pressure
   * goes on with its tangent, so that a trial of Newton's method has a stress.
   * The energy has two continuous derivatives everywhere.
   *
   * F = 1 is free of stress. Compression along the fiber makes the law lose its
   * ellipticity by a kink band where the Kirchhoff stress in the fibers reaches
   * the shear stiffness: at F = diag(lambda, 1, 1) the acoustic form of N = A
   * and m across is W_f'/lambda + G_L/lambda^4. Fibers that buckle reach
   * it only by the compression c E_L |e| beyond that. For dim = 2 the fiber
   * lies in the plane of plane strain.
   */
  template <int dim>
  class DryBundleLaw final : public HyperelasticLaw<dim>
  {
  public:
    /**
     * @param constants Constants; asserts V_0 < V_a. Otherwise not checked
     *   here: parameter files are checked by DryBundleParameters.
     * @param fiber_direction A, of unit length to 1e-8 (throws otherwise).
     */
    DryBundleLaw(const DryBundleConstants     &constants,
                 const dealii::Tensor<1, dim> &fiber_direction);

    using HyperelasticLaw<dim>::energy;
    using HyperelasticLaw<dim>::stress;
    using HyperelasticLaw<dim>::stress_and_tangent;

    std::string
    name() const override;

    const dealii::Tensor<1, dim> *
    fiber() const override
    {
      return &fiber_direction_;
    }

    double
    energy(const double *F) const override;

    void
    stress(const double *F, double *P) const override;

    void
    stress_and_tangent(const double *F, double *P, double *A) const override;

    const DryBundleConstants &
    constants() const
    {
      return constants_;
    }

  private:
    const DryBundleConstants     constants_;
    const dealii::Tensor<1, dim> fiber_direction_;
  };



  /// The law "dry bundle" of a parameter file, by what a data sheet has.
  struct DryBundleParameters final : public LawParameters
  {
    double fiber_modulus       = 72000.; ///< E_f [MPa]
    double fiber_fraction      = 0.6;    ///< V_0 [-], unless tex is given
    double fiber_limit         = 0.8;    ///< V_a [-]
    double tex                 = 0.;     ///< of a bundle [g/km]; 0: not given
    double fiber_density       = 2.54;   ///< [g/cm^3]
    double bundle_area         = 0.;     ///< of its section [mm^2]
    double transverse_modulus  = 10.;    ///< E_T [MPa]
    double transverse_poisson  = 0.25;   ///< nu_T [-]
    double shear_modulus       = 5.;     ///< G_L [MPa], unless a ratio is given
    double bending_ratio       = 0.;     ///< B over that of a solid; 0: none
    double bending_slenderness = 0.;     ///< t/L of that bending test [-]
    double compression_ratio   = 1.;     ///< c [-]
    double buckling_strain     = 0.;     ///< eps_b [-]; 0: see constants()

    /// What follows from the entries, (A30)-(A33). Without a buckling strain,
    /// fibers buckle at half of the shear stiffness, (1 - c) E_L eps_b = G_L/2,
    /// so that no kink bands arise up to c E_L |e| = G_L/2.
    DryBundleConstants
    constants() const;

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

  private:
    void
    add_fiber_fraction(dealii::ParameterHandler &prm);
    void
    add_moduli(dealii::ParameterHandler &prm);
    void
    add_buckling(dealii::ParameterHandler &prm);
  };
} // namespace NPT

#endif
