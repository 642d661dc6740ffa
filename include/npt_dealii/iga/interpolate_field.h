// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the transfer of a field from one mesh of the same patches to another.

#ifndef npt_dealii_iga_interpolate_field_h
#define npt_dealii_iga_interpolate_field_h

#include <npt_dealii/iga/iga_space.h>

#include <deal.II/lac/vector.h>

namespace NPT
{
  /**
   * Return the field on the space `to` that interpolates a field on the space
   * `from`, patch by patch. Both have the same patches with the same geometry,
   * refined in different ways, so that the denominator W of the rational
   * functions is the same and
   *
   * @f[ (w u)^{to} = (T_1 \otimes T_2 \otimes T_3) (w u)^{from} @f]
   *
   * with the operators T_i of KnotVector::interpolation_operator(). Exact if
   * `to` contains `from` (knots inserted, degree raised).
   *
   * @param u dim components for each control point of `from`, first all of the
   *   first control point; entries behind them are left out.
   * @return The same for `to`.
   *
   * Not for Basis::Lagrange, whose coefficients are not those of splines.
   */
  template <int dim>
  dealii::Vector<double>
  interpolate_field(const IGASpace<dim>          &from,
                    const dealii::Vector<double> &u,
                    const IGASpace<dim>          &to);
} // namespace NPT

#endif
