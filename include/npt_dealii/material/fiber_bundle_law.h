// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the transversely isotropic law of a fiber bundle (50)-(53), its
// constants and what they mean at small strain.

#ifndef npt_dealii_material_fiber_bundle_law_h
#define npt_dealii_material_fiber_bundle_law_h

#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/material/law_parameters.h>

#include <string>

namespace NPT
{
  /// Small-strain constants of a transversely isotropic solid; L along the
  /// fiber, T across. Moduli in MPa, nu_LT = contraction across per extension
  /// along the fiber.
  struct EngineeringConstants
  {
    double E_L;
    double E_T;
    double G_L;
    double G_T;
    double nu_LT;
  };

  /**
   * The six constants [MPa] of (51), (52) with Table 1 as default.
   *
   * The sign of d is reversed against the printed table: with d = -6.4613 the
   * law has E_L = -363 MPa and is not elliptic at rest (doc/theory.md).
   */
  struct FiberBundleConstants
  {
    double mu     = 3.2675;
    double lambda = 3.9042;
    double a      = -2.3451;
    double b      = 16.167;
    double c      = 4.7881;
    double d      = 6.4613;

    /// Return the engineering constants; they are finite only if the stiffness
    /// is regular.
    EngineeringConstants
    engineering_constants() const;

    struct LowestEigenvalue
    {
      double      value; ///< [MPa]
      std::string mode;  ///< the strain that has it, in words
    };

    /**
     * Return the lowest eigenvalue of the small-strain stiffness as a linear
     * map of symmetric tensors (so shear along the fiber has 2 G_L). The law
     * is a stable solid at rest if and only if it is positive.
     */
    LowestEigenvalue
    lowest_stiffness_eigenvalue() const;
  };

  /**
   * Transversely isotropic hyperelasticity of a fiber bundle, (50)-(53):
   *
   * @f[ \Psi = \tfrac{\mu}{2} (I_1 - 3) - \mu \ln J
   *          + \tfrac{\lambda}{2} (\ln J)^2
   *          + [a + b \ln J + c (I_4 - 1)] (I_4 - 1)
   *          - [\tfrac{a}{2} + d \ln J] (I_5 - 1) @f]
   *
   * with I_1 = tr C, I_4 = A.CA, I_5 = A.C^2 A and A the unit fiber direction
   * in the reference configuration. With f = F A and h = F^T f,
   *
   * @f[ I_4 = f \cdot f, \quad I_5 = h \cdot h, \quad
   *     \frac{\partial I_4}{\partial F} = 2 f \otimes A, \quad
   *     \frac{\partial I_5}{\partial F} = 2 (f \otimes h + F h \otimes A). @f]
   *
   * F = 1 is stress-free for all constants. The law is not polyconvex, and
   * with Table 1 it loses ellipticity (ellipticity.h) in two ways:
   * - compression along the fiber by 12.7 % (sides held) to 13.3 % (sides
   *   free): a kink band, N = A and m normal to the fiber;
   * - splitting along the fiber, N normal to A and m parallel to F A. For these
   *   the acoustic form is mu - (a + 2 d lnJ) I_4 at any F, negative from a
   *   fiber stretch of 33.3 % (sides free) or 37.1 % (held), but from 13.4 %
   *   in a stretch that is equal in all directions: with d > 0 it is the volume
   *   that counts.
   *
   * For dim = 2 the fiber lies in the plane of plane strain.
   */
  template <int dim>
  class FiberBundleLaw final : public HyperelasticLaw<dim>
  {
  public:
    /**
     * @param constants       Constants [MPa]. Not checked here: studies may
     *   want an unstable law; parameter files are checked by
     *   FiberBundleParameters.
     * @param fiber_direction A, of unit length to 1e-8 (throws otherwise).
     */
    FiberBundleLaw(const FiberBundleConstants   &constants,
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

    const FiberBundleConstants &
    constants() const
    {
      return constants_;
    }

    const dealii::Tensor<1, dim> &
    fiber_direction() const
    {
      return fiber_direction_;
    }

    EngineeringConstants
    engineering_constants() const
    {
      return constants_.engineering_constants();
    }

  private:
    const FiberBundleConstants   constants_;
    const dealii::Tensor<1, dim> fiber_direction_;
  };



  /// The law "fiber bundle" of a parameter file.
  struct FiberBundleParameters final : public LawParameters
  {
    FiberBundleConstants constants; ///< (51), (52) [MPa]

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
