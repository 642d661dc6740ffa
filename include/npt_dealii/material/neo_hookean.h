// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the compressible neo-Hookean law, the isotropic part (51) of the fiber
// bundle and the law of fibers and matrix.

#ifndef npt_dealii_material_neo_hookean_h
#define npt_dealii_material_neo_hookean_h

#include <npt_dealii/material/hyperelastic_law.h>

namespace NPT
{
  /// Lame constants [MPa].
  struct NeoHookeanConstants
  {
    double mu;
    double lambda;

    /// From Young's modulus [MPa] and Poisson's ratio, -1 < nu < 1/2.
    static NeoHookeanConstants
    from_young_and_poisson(const double young_modulus,
                           const double poisson_ratio);
  };

  /**
   * Compressible neo-Hookean law, Eq. (51):
   *
   * @f[ \Psi = \tfrac{\mu}{2} (I_1 - 3) - \mu \ln J
   *          + \tfrac{\lambda}{2} (\ln J)^2 @f]
   * @f[ P = \mu F + (\lambda \ln J - \mu) F^{-T} @f]
   *
   * with I_1 = tr C of the three-dimensional C also for dim = 2.
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
} // namespace NPT

#endif
