// SPDX-License-Identifier: LGPL-2.1-or-later
// Algebra of polynomials given by powers.

#include <npt_dealii/iga/powers.h>

namespace NPT
{
  double
  value_of(const Powers &polynomial, const double t)
  {
    double value = 0;
    for (int k = polynomial.size() - 1; k >= 0; --k)
      value = value * t + polynomial[k];
    return value;
  }



  Powers
  product_of(const Powers &a, const Powers &b)
  {
    Powers result(a.size() + b.size() - 1, 0.);
    for (unsigned int i = 0; i < a.size(); ++i)
      for (unsigned int j = 0; j < b.size(); ++j)
        result[i + j] += a[i] * b[j];
    return result;
  }



  Powers
  composition_of(const Powers &outer, const Powers &inner)
  {
    Powers result = {outer.back()};
    for (int k = outer.size() - 2; k >= 0; --k)
      {
        result = product_of(result, inner);
        result[0] += outer[k];
      }
    return result;
  }



  std::vector<Powers>
  power_coefficients(
    const dealii::FullMatrix<double>                           &C,
    const std::vector<dealii::Polynomials::Polynomial<double>> &B)
  {
    const unsigned int  n = B.size();
    std::vector<Powers> result(n, Powers(n, 0.));
    std::vector<double> derivatives(n);
    for (unsigned int b = 0; b < n; ++b)
      {
        B[b].value(0., derivatives);
        double factorial = 1;
        for (unsigned int k = 0; k < n; ++k)
          {
            if (k > 0)
              factorial *= k;
            for (unsigned int a = 0; a < n; ++a)
              result[a][k] += C(a, b) * derivatives[k] / factorial;
          }
      }
    return result;
  }
} // namespace NPT
