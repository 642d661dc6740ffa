// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the exact solutions that solid benchmarks are compared with: three of
// linear elasticity, and homogeneous states of both laws at finite strain.

#ifndef npt_dealii_verification_solids_exact_solids_h
#define npt_dealii_verification_solids_exact_solids_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/material/make_material.h>

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>

namespace NPT
{
  /// A solution of linear isotropic elasticity without body force.
  class ElasticSolution
  {
  public:
    virtual ~ElasticSolution() = default;

    /// [mm]
    virtual dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &X) const = 0;

    /// [MPa]
    virtual dealii::Tensor<2, 3>
    stress(const dealii::Point<3> &X) const = 0;
  };

  /**
   * Infinite plate with a circular hole around the axis 3, under the tension T
   * along direction 1 far away, in plane strain (Kirsch 1898). With
   * kappa = 3 - 4 nu and plane polar coordinates r, theta
   *
   * @f[ \sigma_{11} = T \left[1 - \frac{R^2}{r^2} \left(\tfrac32 \cos 2\theta
   *       + \cos 4\theta\right) + \tfrac32 \frac{R^4}{r^4} \cos 4\theta
   *     \right], \quad
   *     u_1 = \frac{T R}{8 \mu} \left[ \frac{r}{R} (\kappa + 1) \cos\theta
   *       + \frac{2R}{r} \left((1 + \kappa) \cos\theta + \cos 3\theta\right)
   *       - \frac{2 R^3}{r^3} \cos 3\theta \right] @f]
   *
   * and so on; the largest stress is 3 T, at theta = 90 degrees.
   * Reference: Timoshenko and Goodier, Theory of Elasticity, section 35.
   */
  class HoleUnderTension final : public ElasticSolution
  {
  public:
    /// @param tension T [MPa]. @param radius R [mm].
    HoleUnderTension(const double tension,
                     const double radius,
                     const double young_modulus,
                     const double poisson_ratio);

    dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &X) const override;
    dealii::Tensor<2, 3>
    stress(const dealii::Point<3> &X) const override;

  private:
    const double T_, R_, mu_, nu_;
  };

  /**
   * Thick-walled cylinder around the axis 3 under inner pressure p, in plane
   * strain (Lame 1852). With inner and outer radius a and b
   *
   * @f[ \sigma_{r,\theta} = \frac{p a^2}{b^2 - a^2}
   *       \left(1 \mp \frac{b^2}{r^2}\right), \qquad
   *     u_r = \frac{1 + \nu}{E} \frac{p a^2}{b^2 - a^2}
   *       \left[(1 - 2 \nu) r + \frac{b^2}{r}\right] . @f]
   */
  class PressurizedCylinder final : public ElasticSolution
  {
  public:
    PressurizedCylinder(const double pressure,
                        const double inner_radius,
                        const double outer_radius,
                        const double young_modulus,
                        const double poisson_ratio);

    dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &X) const override;
    dealii::Tensor<2, 3>
    stress(const dealii::Point<3> &X) const override;

  private:
    const double c_, b_, E_, nu_; // c = p a^2 / (b^2 - a^2)
  };

  /**
   * Thick-walled sphere around the origin under inner pressure p (Lame 1852).
   *
   * @f[ \sigma_r = \frac{p a^3}{b^3 - a^3} \left(1 - \frac{b^3}{r^3}\right),
   *     \quad \sigma_t = \frac{p a^3}{b^3 - a^3}
   *       \left(1 + \frac{b^3}{2 r^3}\right), \quad
   *     u_r = \frac{p a^3}{E (b^3 - a^3)} \left[(1 - 2 \nu) r
   *       + (1 + \nu) \frac{b^3}{2 r^2}\right] . @f]
   */
  class PressurizedSphere final : public ElasticSolution
  {
  public:
    PressurizedSphere(const double pressure,
                      const double inner_radius,
                      const double outer_radius,
                      const double young_modulus,
                      const double poisson_ratio);

    dealii::Tensor<1, 3>
    displacement(const dealii::Point<3> &X) const override;
    dealii::Tensor<2, 3>
    stress(const dealii::Point<3> &X) const override;

  private:
    const double c_, b_, E_, nu_; // c = p a^3 / (b^3 - a^3)
  };



  /// Homogeneous deformations of a block.
  enum class HomogeneousMode
  {
    uniaxial,    ///< stretch along 1, free across
    equibiaxial, ///< the same stretch along 1 and 2, free along 3
    dilation,    ///< the same stretch in all directions
    simple_shear ///< F = 1 + gamma e_1 (x) e_2
  };

  template <>
  const EnumNames<HomogeneousMode> &
  enum_names<HomogeneousMode>();

  struct HomogeneousState
  {
    dealii::Tensor<2, 3> F;
    dealii::Tensor<2, 3> P; ///< first Piola-Kirchhoff stress [MPa]
  };

  /**
   * Closed form of a homogeneous state for both laws. In stretches along the
   * axes, J = l_1 l_2 l_3, fiber along axis f,
   *
   * @f[ P_i = \mu l_i + \frac{\lambda \ln J - \mu}{l_i}
   *   + \frac{b (l_f^2 - 1) - d (l_f^4 - 1)}{l_i}
   *   + \delta_{if} \left\{ 2 l_f [a + b \ln J + 2 c (l_f^2 - 1)]
   *     - 4 l_f^3 [\tfrac{a}{2} + d \ln J] \right\} , @f]
   *
   * which is the derivative of (50)-(53) written out by hand and shares nothing
   * with the laws of room material (a = b = c = d = 0 for the isotropic one,
   * and lambda (J^2 - 1) / 2 for lambda ln J with Ciarlet's energy). Stretches
   * of free directions are the roots of their P_i = 0. Simple shear is
   * polynomial in gamma, see the source.
   *
   * @param amount The stretch l [-], or the shear gamma [-].
   * @param fiber_axis 0, 1 or 2; means nothing to the isotropic law.
   *
   * Throws InputError if no stress-free stretch is found nearby.
   */
  HomogeneousState
  homogeneous_state(const MaterialParameters &material,
                    const unsigned int        fiber_axis,
                    const HomogeneousMode     mode,
                    const double              amount);
} // namespace NPT

#endif
