// SPDX-License-Identifier: LGPL-2.1-or-later
// Exact solutions of contact mechanics.

#include <npt_dealii/verification/contact/exact_contact.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>
#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::numbers::PI;

  namespace
  {
    // Of the equation f(x) = 0 with f rising between low and high.
    template <typename Function>
    double
    bisect(const Function &f, double low, double high)
    {
      for (unsigned int i = 0; i < 200 && low < high; ++i)
        {
          const double middle = 0.5 * (low + high);
          if (middle <= low || middle >= high)
            break;
          (f(middle) < 0 ? low : high) = middle;
        }
      return 0.5 * (low + high);
    }

    double
    K(const double modulus)
    {
      return std::comp_ellint_1(modulus);
    }

    double
    E(const double modulus)
    {
      return std::comp_ellint_2(modulus);
    }

    // K - E without cancellation for small moduli.
    double
    K_minus_E(const double modulus)
    {
      const double m = modulus * modulus;
      return m < 1e-3 ? PI / 4 * m * (1 + 3. / 8 * m * (1 + 5. / 8 * m)) :
                        K(modulus) - E(modulus);
    }

    // Shape of the ellipse of contact: b/a and F_1, F_2 of Johnson (4.26) and
    // (4.28) from the ratio R'/R'' >= 1.
    struct Ellipse
    {
      double b_over_a, F_1, F_2;

      explicit Ellipse(const double ratio)
      {
        if (ratio < 1. + 1e-7)
          {
            b_over_a = F_1 = F_2 = 1.;
            return;
          }
        const auto numerator = [](const double e) {
          const double a_over_b_2 = 1. / (1. - e * e);
          return a_over_b_2 * E(e) - K(e);
        };
        const double e = bisect(
          [&](const double x) { return numerator(x) / K_minus_E(x) - ratio; },
          1e-5,
          1. - 1e-14);
        b_over_a = std::sqrt(1. - e * e);
        F_1      = std::cbrt(4. / (PI * e * e) * std::pow(b_over_a, 1.5) *
                        std::sqrt(numerator(e) * K_minus_E(e)));
        F_2      = 2. / PI * std::sqrt(b_over_a) / F_1 * K(e);
      }
    };
  } // namespace



  double
  contact_modulus(const double E_1,
                  const double nu_1,
                  const double E_2,
                  const double nu_2)
  {
    return 1. / ((1. - nu_1 * nu_1) / E_1 + (1. - nu_2 * nu_2) / E_2);
  }



  HertzLine
  HertzLine::from_load(const double P, const double R, const double modulus)
  {
    const double a = std::sqrt(4. * P * R / (PI * modulus));
    return {P, a, 2. * P / (PI * a)};
  }



  HertzLine
  HertzLine::from_half_width(const double a,
                             const double R,
                             const double modulus)
  {
    return from_load(PI * modulus * a * a / (4. * R), R, modulus);
  }



  double
  HertzLine::pressure(const double x) const
  {
    const double s = x / half_width;
    return peak_pressure * std::sqrt(std::max(0., 1. - s * s));
  }



  HertzPoint
  HertzPoint::from_load(const double P,
                        const double R_x,
                        const double R_y,
                        const double modulus)
  {
    const Ellipse ellipse(std::max(R_x, R_y) / std::min(R_x, R_y));
    const double  R = std::sqrt(R_x * R_y);
    const double  c = std::cbrt(3. * P * R / (4. * modulus)) * ellipse.F_1;
    const double  a = c / std::sqrt(ellipse.b_over_a);
    const double  b = c * std::sqrt(ellipse.b_over_a);
    return {P,
            R_x >= R_y ? a : b,
            R_x >= R_y ? b : a,
            3. * P / (2. * PI * a * b),
            std::cbrt(9. * P * P / (16. * modulus * modulus * R)) *
              ellipse.F_2};
  }



  HertzPoint
  HertzPoint::from_half_axis_x(const double half_axis_x,
                               const double R_x,
                               const double R_y,
                               const double modulus)
  {
    // All lengths grow with the cubic root of the load.
    const HertzPoint unit = from_load(1., R_x, R_y, modulus);
    return from_load(std::pow(half_axis_x / unit.half_axis_x, 3),
                     R_x,
                     R_y,
                     modulus);
  }



  double
  HertzPoint::pressure(const double x, const double y) const
  {
    const double s = x / half_axis_x, t = y / half_axis_y;
    return peak_pressure * std::sqrt(std::max(0., 1. - s * s - t * t));
  }



  double
  PartialSlipLine::stick_half_width() const
  {
    return normal.half_width *
           std::sqrt(std::max(0.,
                              1. - tangential_load /
                                     (friction_coefficient * normal.load)));
  }



  double
  PartialSlipLine::traction(const double x) const
  {
    const double c     = stick_half_width();
    const double inner = c > 0. ? std::max(0., 1. - x * x / (c * c)) : 0.;
    return friction_coefficient *
           (normal.pressure(x) -
            normal.peak_pressure * c / normal.half_width * std::sqrt(inner));
  }



  double
  PartialSlipLine::loss_per_cycle(const double modulus) const
  {
    const double mu_P = friction_coefficient * normal.load;
    const double k    = tangential_load / mu_P;
    // For small k the terms cancel down to k^3/3 + k^4/6 + ...
    const double bracket =
      k < 1e-3 ? k * k * k / 3. * (1. + k / 2.) :
      k < 1.   ? 2. * (1. - k) * std::log1p(-k) + 2. * k - k * k :
                 1.;
    return 2. * mu_P * mu_P / (PI * modulus) * bracket;
  }



  double
  TwistedSphere::twist(const double c) const
  {
    const double s = c / normal.half_axis_x;
    return friction_coefficient * normal.peak_pressure / (2. * shear_modulus) *
           K_minus_E(std::sqrt(1. - s * s));
  }



  double
  TwistedSphere::torque(const double c) const
  {
    const double a = normal.half_axis_x;
    const auto   B = [&](const double s) {
      return K_minus_E(std::sqrt(std::max(0., 1. - s * s / (a * a))));
    };
    // s^2 B(s) is smooth but for a weak logarithm at s = 0.
    const dealii::QGauss<1> quadrature(40);
    double                  integral = 0;
    for (unsigned int q = 0; q < quadrature.size(); ++q)
      {
        const double s = c + (a - c) * quadrature.point(q)[0];
        integral += s * s * B(s) * quadrature.weight(q) * (a - c);
      }
    return 8. * friction_coefficient * normal.peak_pressure / 3. *
           ((c > 0. ? c * c * c * B(c) : 0.) + 3. * integral);
  }



  double
  TwistedSphere::stick_radius(const double angle) const
  {
    Assert(angle > 0., dealii::ExcMessage("The twist must be positive."));
    // The twist falls with the radius, from infinity to zero.
    return bisect([&](const double c) { return angle - twist(c); },
                  1e-12 * normal.half_axis_x,
                  normal.half_axis_x);
  }



  double
  torque_of_slipping_disc(const double mu, const double P, const double R)
  {
    return 2. / 3. * mu * P * R;
  }



  double
  capstan_ratio(const double mu, const double theta)
  {
    return std::exp(mu * theta);
  }
} // namespace NPT
