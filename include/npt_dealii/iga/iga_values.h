// SPDX-License-Identifier: LGPL-2.1-or-later
// The door of the isogeometric room: shape values, gradients, second
// derivatives, JxW and control point indices of a cell.

#ifndef npt_dealii_iga_iga_values_h
#define npt_dealii_iga_iga_values_h

#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/table.h>

#include <map>

namespace NPT
{
  /**
   * What FEValues is to deal.II: after reinit(cell) it offers the functions of
   * that cell at its Gauss points. Behind this class nobody knows of Bernstein
   * polynomials, extraction operators or weights.
   *
   * All derivatives are with respect to the reference coordinates X [1/mm],
   *
   * @f[ R_A = \frac{w_A N_A}{W}, \qquad \mathrm{Grad}\, R_A =
   *   J^{-T} \partial R_A / \partial\xi, \qquad J = \partial X/\partial\xi. @f]
   *
   * The polynomials of one direction are tabulated once per degree; a cell
   * applies its extraction operators to these tables and multiplies the
   * directions.
   */
  template <int dim>
  class IGAValues
  {
  public:
    /**
     * @param n_points Gauss points per direction; 0 takes degree + 1.
     * @param second_derivatives Compute shape_hessian() as well.
     */
    IGAValues(const IGASpace<dim> &space,
              const unsigned int   n_points           = 0,
              const bool           second_derivatives = false);

    /// Throws InvertedCell if the reference geometry is folded (det J <= 0).
    void
    reinit(const unsigned int cell);

    unsigned int
    n_quadrature_points() const
    {
      return jxw_.size();
    }
    unsigned int
    dofs_per_cell() const
    {
      return indices_.size();
    }
    /// Global control point numbers of the cell.
    const std::vector<unsigned int> &
    control_points() const
    {
      return indices_;
    }
    double
    shape_value(const unsigned int A, const unsigned int q) const
    {
      return value_(A, q);
    }
    const dealii::Tensor<1, dim> &
    shape_grad(const unsigned int A, const unsigned int q) const
    {
      return gradient_(A, q);
    }
    const dealii::Tensor<2, dim> &
    shape_hessian(const unsigned int A, const unsigned int q) const
    {
      Assert(second_derivatives_, dealii::ExcNotInitialized());
      return hessian_(A, q);
    }
    /// Reference volume of the quadrature point [mm^dim].
    double
    JxW(const unsigned int q) const
    {
      return jxw_[q];
    }
    const dealii::Point<dim> &
    quadrature_point(const unsigned int q) const
    {
      return position_[q];
    }

  private:
    // Polynomials of one direction at its Gauss points: value, first and
    // second derivative.
    struct Tabulated
    {
      std::vector<double>      weights;
      dealii::Table<3, double> data; // [point][derivative][function]
    };
    const Tabulated &
    tabulate(const unsigned int patch);

    const IGASpace<dim>              &space_;
    const unsigned int                n_points_;
    const bool                        second_derivatives_;
    std::map<unsigned int, Tabulated> tables_; // by degree

    std::vector<unsigned int>                indices_;
    dealii::Table<2, double>                 value_;
    dealii::Table<2, dealii::Tensor<1, dim>> gradient_;
    dealii::Table<2, dealii::Tensor<2, dim>> hessian_;
    std::vector<double>                      jxw_;
    std::vector<dealii::Point<dim>>          position_;
  };
} // namespace NPT

#endif
