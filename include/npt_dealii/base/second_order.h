// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a number that carries its first and second derivatives.

#ifndef npt_dealii_base_second_order_h
#define npt_dealii_base_second_order_h

#include <array>
#include <cmath>

namespace NPT
{
  /// A number with its first and second derivatives with respect to n
  /// variables. Sums and products, and functions by compose(), differentiate
  /// themselves.
  template <unsigned int n>
  struct SecondOrder
  {
    double                               value = 0.;
    std::array<double, n>                gradient{};
    std::array<std::array<double, n>, n> hessian{};

    static SecondOrder
    constant(const double value)
    {
      SecondOrder result;
      result.value = value;
      return result;
    }
    static SecondOrder
    variable(const unsigned int number, const double value)
    {
      SecondOrder result      = constant(value);
      result.gradient[number] = 1.;
      return result;
    }
  };

  /// f(a), given f and its first two derivatives at the value of a.
  template <unsigned int n>
  SecondOrder<n>
  compose(const SecondOrder<n> &a,
          const double          f,
          const double          df,
          const double          ddf)
  {
    SecondOrder<n> result;
    result.value = f;
    for (unsigned int i = 0; i < n; ++i)
      {
        result.gradient[i] = df * a.gradient[i];
        for (unsigned int j = 0; j < n; ++j)
          result.hessian[i][j] =
            df * a.hessian[i][j] + ddf * a.gradient[i] * a.gradient[j];
      }
    return result;
  }

  template <unsigned int n>
  SecondOrder<n>
  operator+(const SecondOrder<n> &a, const SecondOrder<n> &b)
  {
    SecondOrder<n> sum = a;
    sum.value += b.value;
    for (unsigned int i = 0; i < n; ++i)
      {
        sum.gradient[i] += b.gradient[i];
        for (unsigned int j = 0; j < n; ++j)
          sum.hessian[i][j] += b.hessian[i][j];
      }
    return sum;
  }

  template <unsigned int n>
  SecondOrder<n>
  operator*(const double factor, const SecondOrder<n> &a)
  {
    return compose(a, factor * a.value, factor, 0.);
  }

  template <unsigned int n>
  SecondOrder<n>
  operator-(const SecondOrder<n> &a, const SecondOrder<n> &b)
  {
    return a + (-1.) * b;
  }

  template <unsigned int n>
  SecondOrder<n>
  operator*(const SecondOrder<n> &a, const SecondOrder<n> &b)
  {
    SecondOrder<n> product;
    product.value = a.value * b.value;
    for (unsigned int i = 0; i < n; ++i)
      {
        product.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
        for (unsigned int j = 0; j < n; ++j)
          product.hessian[i][j] =
            a.hessian[i][j] * b.value + a.gradient[i] * b.gradient[j] +
            a.gradient[j] * b.gradient[i] + a.value * b.hessian[i][j];
      }
    return product;
  }

  template <unsigned int n>
  SecondOrder<n>
  square_root(const SecondOrder<n> &a)
  {
    const double root = std::sqrt(a.value);
    return compose(a, root, 0.5 / root, -0.25 / (root * a.value));
  }

  template <unsigned int n>
  SecondOrder<n>
  inverse(const SecondOrder<n> &a)
  {
    const double over = 1. / a.value;
    return compose(a, over, -over * over, 2. * over * over * over);
  }
} // namespace NPT

#endif
