// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines polynomials by the coefficients of their powers, and what surface
// functions need of them.

#ifndef npt_dealii_iga_powers_h
#define npt_dealii_iga_powers_h

#include <deal.II/base/polynomial.h>
#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace NPT
{
  /// c[0] + c[1] t + c[2] t^2 + ...; at least one coefficient.
  using Powers = std::vector<double>;

  /// Value by Horner's rule.
  double
  value_of(const Powers &polynomial, const double t);

  /// Product of two polynomials.
  Powers
  product_of(const Powers &a, const Powers &b);

  /// outer(inner(t)).
  Powers
  composition_of(const Powers &outer, const Powers &inner);

  /// The functions sum_b C(a,b) B_b(t), one for each a.
  std::vector<Powers>
  power_coefficients(
    const dealii::FullMatrix<double>                           &C,
    const std::vector<dealii::Polynomials::Polynomial<double>> &B);
} // namespace NPT

#endif
