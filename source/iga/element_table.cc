// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tables of the functions of deal.II's elements.

#include <npt_dealii/iga/element_table.h>

#include <deal.II/base/tensor_product_polynomials.h>
#include <deal.II/fe/fe_poly.h>
#include <deal.II/fe/fe_tools.h>

namespace NPT
{
  template <int dim>
  std::vector<unsigned int>
  lexicographic_numbering(const dealii::FiniteElement<dim> &element)
  {
    return dealii::FETools::lexicographic_to_hierarchic_numbering<dim>(
      element.degree);
  }



  template <int dim>
  ElementTable<dim>::ElementTable(const dealii::FiniteElement<dim> &element,
                                  const dealii::Quadrature<dim>    &quadrature)
    : weights(quadrature.get_weights())
    , values(quadrature.size(), element.n_dofs_per_cell())
    , gradients(quadrature.size(), element.n_dofs_per_cell())
  {
    const auto order = lexicographic_numbering(element);
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      for (unsigned int a = 0; a < order.size(); ++a)
        {
          values(q, a)    = element.shape_value(order[a], quadrature.point(q));
          gradients(q, a) = element.shape_grad(order[a], quadrature.point(q));
        }
  }



  template <int dim>
  std::vector<dealii::Polynomials::Polynomial<double>>
  polynomials_of(const dealii::FiniteElement<dim> &element)
  {
    const auto &space =
      dynamic_cast<const dealii::FE_Poly<dim> &>(element).get_poly_space();
    return dynamic_cast<const dealii::TensorProductPolynomials<dim> &>(space)
      .get_underlying_polynomials();
  }



#define INSTANTIATE(dim)                                           \
  template std::vector<unsigned int> lexicographic_numbering<dim>( \
    const dealii::FiniteElement<dim> &);                           \
  template struct ElementTable<dim>;                               \
  template std::vector<dealii::Polynomials::Polynomial<double>>    \
  polynomials_of<dim>(const dealii::FiniteElement<dim> &)

  INSTANTIATE(1);
  INSTANTIATE(2);
  INSTANTIATE(3);
#undef INSTANTIATE
} // namespace NPT
