// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the interface of all hyperelastic laws: energy, stress and tangent at
// one point.

#ifndef npt_dealii_material_hyperelastic_law_h
#define npt_dealii_material_hyperelastic_law_h

#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <string>

namespace NPT
{
  /**
   * A strain energy Psi(F) per reference volume with its first Piola-Kirchhoff
   * stress and tangent,
   *
   * @f[ P_{iJ} = \frac{\partial\Psi}{\partial F_{iJ}}, \qquad
   *     A_{iJkL} = \frac{\partial P_{iJ}}{\partial F_{kL}} . @f]
   *
   * Psi in N/mm^2, P and A in MPa; i, k current and J, L reference directions.
   * For dim = 2 all laws mean plane strain (F_33 = 1).
   *
   * A law adds the three functions on raw arrays, all row-major: F and P of
   * size dim x dim, A of size (dim dim) x (dim dim) with row iJ and column kL.
   * They are what assembly calls; the functions on tensors wrap them. To spare
   * the virtual call too, hold the law by its own type (the laws are final).
   *
   * Every evaluation throws InvertedCell if det F <= 0 or not finite; outputs
   * are then undefined. Laws have no state: all functions may be called from
   * several threads.
   */
  template <int dim>
  class HyperelasticLaw
  {
  public:
    virtual ~HyperelasticLaw() = default;

    /// The name by which a parameter file selects the law.
    virtual std::string
    name() const = 0;

    /// The unit vector along the fibers in the reference configuration; null
    /// if the law has none.
    virtual const dealii::Tensor<1, dim> *
    fiber() const
    {
      return nullptr;
    }

    virtual double
    energy(const double *F) const = 0;

    /// Without the tangent: a quarter of its price or less, for line searches.
    virtual void
    stress(const double *F, double *P) const = 0;

    virtual void
    stress_and_tangent(const double *F, double *P, double *A) const = 0;

    double
    energy(const dealii::Tensor<2, dim> &F) const;

    void
    stress(const dealii::Tensor<2, dim> &F, dealii::Tensor<2, dim> &P) const;

    void
    stress_and_tangent(const dealii::Tensor<2, dim> &F,
                       dealii::Tensor<2, dim>       &P,
                       dealii::Tensor<4, dim>       &dP_dF) const;

    /**
     * Return the stiffness [MPa] at F = 1 in Voigt form: strains in the order
     * 11, 22, 33, 23, 31, 12 (dim = 3) or 11, 22, 12 (dim = 2), shear strains
     * as engineering shears.
     *
     * It is the stiffness of linear elasticity because F = 1 is stress-free in
     * all our laws; the minor symmetries are then not an assumption.
     */
    dealii::FullMatrix<double>
    small_strain_stiffness() const;
  };
} // namespace NPT

#endif
