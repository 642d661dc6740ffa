// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how the functions of deal.II's elements are read: tabulated at the
// points of a quadrature rule, or as polynomials of one direction.

#ifndef npt_dealii_iga_element_table_h
#define npt_dealii_iga_element_table_h

#include <deal.II/base/polynomial.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/base/table.h>
#include <deal.II/base/tensor.h>
#include <deal.II/fe/fe.h>

#include <vector>

namespace NPT
{
  /**
   * Position in an element's own (hierarchic) numbering of the function that
   * is l-th in lexicographic order, the first direction fastest.
   *
   * @param element FE_Bernstein or FE_Q.
   */
  template <int dim>
  std::vector<unsigned int>
  lexicographic_numbering(const dealii::FiniteElement<dim> &element);

  /**
   * The functions of an element, in lexicographic order, at the points of a
   * quadrature rule on the reference cell [0,1]^dim. Gradients are those with
   * respect to the reference cell; on a box with edges h_d they are divided by
   * h_d.
   */
  template <int dim>
  struct ElementTable
  {
    ElementTable(const dealii::FiniteElement<dim> &element,
                 const dealii::Quadrature<dim>    &quadrature);

    std::vector<double>                      weights;   ///< [point]
    dealii::Table<2, double>                 values;    ///< [point][function]
    dealii::Table<2, dealii::Tensor<1, dim>> gradients; ///< [point][function]
  };

  /**
   * The polynomials on [0,1] whose products are the functions of an element:
   * what is left of it on an edge. Surfaces need them as powers of the
   * parameter, up to third derivatives.
   *
   * @param element FE_Bernstein or FE_Q; throws std::bad_cast for an element
   *   that is no tensor product.
   */
  template <int dim>
  std::vector<dealii::Polynomials::Polynomial<double>>
  polynomials_of(const dealii::FiniteElement<dim> &element);
} // namespace NPT

#endif
