// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a number that carries its first derivatives.

#ifndef npt_dealii_base_first_order_h
#define npt_dealii_base_first_order_h

#include <array>
#include <cmath>

namespace NPT
{
  /// As SecondOrder, without second derivatives.
  template <unsigned int n>
  struct FirstOrder
  {
    double                value = 0.;
    std::array<double, n> gradient{};

    static FirstOrder
    constant(const double value)
    {
      FirstOrder result;
      result.value = value;
      return result;
    }
    static FirstOrder
    variable(const unsigned int number, const double value)
    {
      FirstOrder result       = constant(value);
      result.gradient[number] = 1.;
      return result;
    }
  };

  /// f(a), given f and its derivative at the value of a.
  template <unsigned int n>
  FirstOrder<n>
  compose(const FirstOrder<n> &a, const double f, const double df)
  {
    FirstOrder<n> result;
    result.value = f;
    for (unsigned int i = 0; i < n; ++i)
      result.gradient[i] = df * a.gradient[i];
    return result;
  }

  template <unsigned int n>
  FirstOrder<n>
  operator+(const FirstOrder<n> &a, const FirstOrder<n> &b)
  {
    FirstOrder<n> sum = a;
    sum.value += b.value;
    for (unsigned int i = 0; i < n; ++i)
      sum.gradient[i] += b.gradient[i];
    return sum;
  }

  template <unsigned int n>
  FirstOrder<n>
  operator*(const double factor, const FirstOrder<n> &a)
  {
    return compose(a, factor * a.value, factor);
  }

  template <unsigned int n>
  FirstOrder<n>
  operator-(const FirstOrder<n> &a, const FirstOrder<n> &b)
  {
    return a + (-1.) * b;
  }

  template <unsigned int n>
  FirstOrder<n>
  operator*(const FirstOrder<n> &a, const FirstOrder<n> &b)
  {
    FirstOrder<n> product;
    product.value = a.value * b.value;
    for (unsigned int i = 0; i < n; ++i)
      product.gradient[i] = a.gradient[i] * b.value + a.value * b.gradient[i];
    return product;
  }

  template <unsigned int n>
  FirstOrder<n>
  square_root(const FirstOrder<n> &a)
  {
    const double root = std::sqrt(a.value);
    return compose(a, root, 0.5 / root);
  }

  template <unsigned int n>
  FirstOrder<n>
  inverse(const FirstOrder<n> &a)
  {
    const double over = 1. / a.value;
    return compose(a, over, -over * over);
  }
} // namespace NPT

#endif
