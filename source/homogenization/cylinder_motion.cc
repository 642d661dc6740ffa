// SPDX-License-Identifier: LGPL-2.1-or-later
// The rigid motions of a cylinder and their derivatives.

#include <npt_dealii/homogenization/cylinder_motion.h>

#include <cmath>

namespace NPT
{
  using dealii::Tensor;

  namespace
  {
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

    using Number = SecondOrder<MacroModes::n>;

    Number
    stumpff(const unsigned int k, const Number &s)
    {
      const auto derivative = [&](const unsigned int j) {
        return 0.5 * (j * stumpff(j + 2, s.value) - stumpff(j + 1, s.value));
      };
      return compose(s,
                     stumpff(k, s.value),
                     derivative(k),
                     0.5 * (k * derivative(k + 2) - derivative(k + 1)));
    }
  } // namespace



  CylinderMotion::CylinderMotion(const Tensor<1, 2> &direction)
    : n_(direction)
  {
    Assert(std::abs(direction.norm() - 1.) < 1e-12,
           dealii::ExcMessage("The direction of bending is a unit vector."));
  }



  CylinderMotion::InPlaneRotation
  CylinderMotion::rotation_of_lines(const Gradients &H) const
  {
    const Number E1 = Number::constant(1.) + Number::variable(0, H[0]),
                 E2 = Number::constant(1.) + Number::variable(1, H[1]),
                 G  = 0.5 * Number::variable(2, H[2]);
    const double m1 = -n_[1], m2 = n_[0];
    const Number Um1 = m1 * E1 + m2 * G, Um2 = m1 * G + m2 * E2;
    const Number over = inverse(square_root(Um1 * Um1 + Um2 * Um2));
    return {over * (m1 * Um1 + m2 * Um2),
            over * ((-n_[0]) * Um1 + (-n_[1]) * Um2)};
  }



  CylinderMotion::Derivatives
  CylinderMotion::derivatives_at(const Gradients    &H,
                                 const Tensor<1, 2> &p) const
  {
    const Number one          = Number::constant(1.);
    const Number E1           = one + Number::variable(0, H[0]),
                 E2           = one + Number::variable(1, H[1]),
                 G            = 0.5 * Number::variable(2, H[2]);
    const auto [cosine, sine] = rotation_of_lines(H);

    // omega = (a, b, 0) and V.
    const Number half_H6 = 0.5 * Number::variable(5, H[5]);
    const Number Kp1     = p[0] * Number::variable(3, H[3]) + p[1] * half_H6,
                 Kp2     = p[0] * half_H6 + p[1] * Number::variable(4, H[4]);
    const Number a       = (-1.) * (sine * Kp1 + cosine * Kp2),
                 b       = cosine * Kp1 - sine * Kp2;
    const Number V1 = p[0] * E1 + p[1] * G, V2 = p[0] * G + p[1] * E2;

    // R = 1 + c_1 W + c_2 W^2 and t = (1 + c_2 W + c_3 W^2) V, W = omega x.
    const Number s  = a * a + b * b;
    const Number c1 = stumpff(1, s), c2 = stumpff(2, s), c3 = stumpff(3, s);
    const Number c1_a = c1 * a, c1_b = c1 * b, c2_ab = c2 * a * b,
                 turn = b * V1 - a * V2;
    Derivatives result;
    result.R = {{{{one - c2 * b * b, c2_ab, c1_b}},
                 {{c2_ab, one - c2 * a * a, (-1.) * c1_a}},
                 {{(-1.) * c1_b, c1_a, one - c2 * s}}}};
    result.t = {{V1 - c3 * b * turn, V2 + c3 * a * turn, (-1.) * (c2 * turn)}};
    return result;
  }



  CylinderMotion::Circle
  CylinderMotion::circle(const Gradients &H) const
  {
    const Number E1 = Number::constant(1.) + Number::variable(0, H[0]),
                 E2 = Number::constant(1.) + Number::variable(1, H[1]),
                 G  = 0.5 * Number::variable(2, H[2]);
    const auto [cosine, sine] = rotation_of_lines(H);
    const double n1 = n_[0], n2 = n_[1];
    const Number b1 = n1 * cosine - n2 * sine, b2 = n1 * sine + n2 * cosine;
    const Number angle = (n1 * n1) * Number::variable(3, H[3]) +
                         (n2 * n2) * Number::variable(4, H[4]) +
                         (n1 * n2) * Number::variable(5, H[5]);
    const Number length = b1 * (n1 * E1 + n2 * G) + b2 * (n1 * G + n2 * E2);
    return {angle * inverse(length), {{b1, b2}}};
  }



  RigidMotion
  CylinderMotion::at(const Gradients &H, const Tensor<1, 2> &p) const
  {
    const Derivatives d = derivatives_at(H, p);
    RigidMotion       motion;
    for (unsigned int i = 0; i < 3; ++i)
      {
        motion.t[i] = d.t[i].value;
        for (unsigned int j = 0; j < 3; ++j)
          motion.R[i][j] = d.R[i][j].value;
      }
    return motion;
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
