// SPDX-License-Identifier: LGPL-2.1-or-later
// The rigid motions of a cylinder and their derivatives.

#include <npt_dealii/homogenization/cylinder_motion.h>

#include <cmath>
#include <type_traits>
#include <utility>

namespace NPT
{
  using dealii::Tensor;

  namespace
  {
    using Number = SecondOrder<MacroModes::n>;

    // What motion() needs of both kinds of numbers.
    template <typename T>
    T
    number(const double value)
    {
      if constexpr (std::is_same_v<T, double>)
        return value;
      else
        return T::constant(value);
    }

    double
    square_root(const double a)
    {
      return std::sqrt(a);
    }

    double
    inverse(const double a)
    {
      return 1. / a;
    }

    // Stumpff's function c_k(s) = 1/k! - s/(k+2)! + s^2/(k+4)! - ...; with the
    // angle theta = sqrt(s), c_1 = sin theta / theta and c_2 = (1 - cos theta)
    // / theta^2. For angles of a few turns the series is exact to round-off.
    double
    stumpff(const unsigned int k, const double s)
    {
      double term = 1.;
      for (unsigned int j = 2; j <= k; ++j)
        term /= j;
      double sum = 0.;
      for (unsigned int j = k; std::abs(term) > 1e-20; j += 2)
        {
          sum += term;
          term *= -s / ((j + 1.) * (j + 2.));
        }
      return sum;
    }

    // Of c_k with respect to s.
    double
    stumpff_derivative(const unsigned int k, const double s)
    {
      return 0.5 * (k * stumpff(k + 2, s) - stumpff(k + 1, s));
    }

    FirstOrder<MacroModes::n>
    stumpff(const unsigned int k, const FirstOrder<MacroModes::n> &s)
    {
      return compose(s, stumpff(k, s.value), stumpff_derivative(k, s.value));
    }

    Number
    stumpff(const unsigned int k, const Number &s)
    {
      return compose(s,
                     stumpff(k, s.value),
                     stumpff_derivative(k, s.value),
                     0.5 * (k * stumpff_derivative(k + 2, s.value) -
                            stumpff_derivative(k + 1, s.value)));
    }
  } // namespace



  CylinderMotion::CylinderMotion(const Tensor<1, 2> &direction)
    : n_(direction)
  {
    Assert(std::abs(direction.norm() - 1.) < 1e-12,
           dealii::ExcMessage("The direction of bending is a unit vector."));
  }



  namespace
  {
    // R_U, by U and n.
    template <typename T>
    std::pair<T, T>
    rotation_of_lines(const std::array<T, MacroModes::n> &H,
                      const Tensor<1, 2>                 &n)
    {
      const T E1 = number<T>(1.) + H[0], E2 = number<T>(1.) + H[1],
              G       = 0.5 * H[2];
      const double m1 = -n[1], m2 = n[0];
      const T      Um1 = m1 * E1 + m2 * G, Um2 = m1 * G + m2 * E2;
      const T      over = inverse(square_root(Um1 * Um1 + Um2 * Um2));
      return {over * (m1 * Um1 + m2 * Um2),
              over * ((-n[0]) * Um1 + (-n[1]) * Um2)};
    }

    template <typename T>
    struct Motion
    {
      std::array<std::array<T, 3>, 3> R;
      std::array<T, 3>                t;
    };

    template <typename T>
    Motion<T>
    motion(const std::array<T, MacroModes::n> &H,
           const Tensor<1, 2>                 &n,
           const Tensor<1, 2>                 &p)
    {
      const T one = number<T>(1.);
      const T E1 = one + H[0], E2 = one + H[1], G = 0.5 * H[2];
      const auto [cosine, sine] = rotation_of_lines(H, n);

      // omega = (a, b, 0) and V.
      const T half_H6 = 0.5 * H[5];
      const T Kp1     = p[0] * H[3] + p[1] * half_H6,
              Kp2     = p[0] * half_H6 + p[1] * H[4];
      const T a       = (-1.) * (sine * Kp1 + cosine * Kp2),
              b       = cosine * Kp1 - sine * Kp2;
      const T V1 = p[0] * E1 + p[1] * G, V2 = p[0] * G + p[1] * E2;

      // R = 1 + c_1 W + c_2 W^2 and t = (1 + c_2 W + c_3 W^2) V, W = omega x.
      const T s  = a * a + b * b;
      const T c1 = stumpff(1, s), c2 = stumpff(2, s), c3 = stumpff(3, s);
      const T c1_a = c1 * a, c1_b = c1 * b, c2_ab = c2 * a * b,
              turn = b * V1 - a * V2;
      Motion<T> result;
      result.R = {{{{one - c2 * b * b, c2_ab, c1_b}},
                   {{c2_ab, one - c2 * a * a, (-1.) * c1_a}},
                   {{(-1.) * c1_b, c1_a, one - c2 * s}}}};
      result.t = {
        {V1 - c3 * b * turn, V2 + c3 * a * turn, (-1.) * (c2 * turn)}};
      return result;
    }

    template <typename T = Number>
    std::array<T, MacroModes::n>
    variables(const Gradients &H)
    {
      std::array<T, MacroModes::n> result;
      for (unsigned int n = 0; n < H.size(); ++n)
        result[n] = T::variable(n, H[n]);
      return result;
    }
  } // namespace



  CylinderMotion::Derivatives
  CylinderMotion::derivatives_at(const Gradients    &H,
                                 const Tensor<1, 2> &p) const
  {
    const Motion<Number> at = motion(variables(H), n_, p);
    return {at.R, at.t};
  }



  CylinderMotion::FirstDerivatives
  CylinderMotion::first_derivatives_at(const Gradients    &H,
                                       const Tensor<1, 2> &p) const
  {
    const auto at = motion(variables<FirstOrder<MacroModes::n>>(H), n_, p);
    return {at.R, at.t};
  }



  CylinderMotion::Circle
  CylinderMotion::circle(const Gradients &values) const
  {
    const auto   H  = variables(values);
    const Number E1 = Number::constant(1.) + H[0],
                 E2 = Number::constant(1.) + H[1], G = 0.5 * H[2];
    const auto [cosine, sine] = rotation_of_lines(H, n_);
    const double n1 = n_[0], n2 = n_[1];
    const Number b1 = n1 * cosine - n2 * sine, b2 = n1 * sine + n2 * cosine;
    const Number angle = (n1 * n1) * H[3] + (n2 * n2) * H[4] + (n1 * n2) * H[5];
    const Number length = b1 * (n1 * E1 + n2 * G) + b2 * (n1 * G + n2 * E2);
    return {angle * inverse(length), {{b1, b2}}};
  }



  RigidMotion
  CylinderMotion::at(const Gradients &H, const Tensor<1, 2> &p) const
  {
    const Motion<double> at = motion(H, n_, p);
    RigidMotion          result;
    for (unsigned int i = 0; i < 3; ++i)
      {
        result.t[i] = at.t[i];
        for (unsigned int j = 0; j < 3; ++j)
          result.R[i][j] = at.R[i][j];
      }
    return result;
  }



  Tensor<1, 3>
  image_on_cylinder(const Tensor<1, 2>      &direction,
                    const Gradients         &H,
                    const SymmetryOperation &g,
                    const dealii::Point<3>  &x)
  {
    Tensor<1, 3> turned;
    for (unsigned int i = 0; i < 3; ++i)
      turned[i] = g.Q[i] * x[i];
    return CylinderMotion(direction).at(H,
                                        Tensor<1, 2>({g.a[0], g.a[1]}))(turned);
  }
} // namespace NPT
