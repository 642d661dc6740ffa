// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines shape functions in a cell: values, gradients, second derivatives, JxW
// and control point indices.

#ifndef npt_dealii_iga_iga_values_h
#define npt_dealii_iga_iga_values_h

#include <npt_dealii/iga/element_table.h>
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
   * Deal.II's elements are tabulated once per degree. Splines N_A are products
   * of the functions of the directions, to which the extraction operators of
   * the cell are applied in the tables of FE_Bernstein<1>. The C0 bases take
   * the tables of FE_Bernstein<dim> or FE_Q<dim> as they are; without weights
   * these are the values that FEValues gives with the mapping of the nodes.
   */
  template <int dim>
  class IGAValues
  {
  public:
    using CellIterator =
      typename dealii::Triangulation<dim>::active_cell_iterator;

    /// @param n_points Gauss points per direction; 0 takes degree + 1.
    explicit IGAValues(const IGASpace<dim> &space,
                       const unsigned int   n_points = 0);

    /**
     * @param cell Of the triangulation of the space.
     *
     * Throws InvertedCell if the reference geometry is folded (det J <= 0).
     */
    void
    reinit(const CellIterator &cell);

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
    // Fill functions_ and what is parametric: splines of a cell, and the
    // functions of a C0 element as they are.
    void
    evaluate_splines(const unsigned int cell);
    void
    evaluate_element(const unsigned int cell);
    // Quotient rule in functions_ at one point.
    void
    divide_by_weight_function(const unsigned int q);
    // From parametric derivatives to those with respect to X at one point.
    void
    map_to_reference_configuration(const unsigned int cell,
                                   const unsigned int q);

    const IGASpace<dim>                      &space_;
    const unsigned int                        n_points_;
    std::map<unsigned int, ElementTable<1>>   line_tables_; // by degree
    std::map<unsigned int, ElementTable<dim>> element_tables_;

    // Of the present cell. Functions and their parametric derivatives:
    // [point][0: value, 1 + d: derivative in direction d][function].
    dealii::Table<3, double> functions_;
    double                   parametric_volume_;
    std::vector<double>      parametric_weight_; // of the points of [0,1]^dim

    std::vector<unsigned int>                indices_;
    dealii::Table<2, double>                 value_;
    dealii::Table<2, dealii::Tensor<1, dim>> gradient_;
    std::vector<double>                      jxw_;
    std::vector<dealii::Point<dim>>          position_;
  };
} // namespace NPT

#endif
