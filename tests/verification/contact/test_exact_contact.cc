// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the exact solutions of contact mechanics: limits that have
// closed forms, equilibrium, and Masing's rule.

#include <npt_dealii/verification/contact/exact_contact.h>

#include <catch2/catch.hpp>

#include <cmath>

namespace
{
  using namespace NPT;

  const double pi = std::acos(-1.);

  template <typename Function>
  double
  integrate(const Function &f, const double begin, const double end)
  {
    // Midpoints in an angle, so that roots at both ends do no harm.
    const unsigned int n   = 4000;
    double             sum = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const double phi = pi * (i + 0.5) / n;
        sum += f(0.5 * (begin + end) - 0.5 * (end - begin) * std::cos(phi)) *
               std::sin(phi);
      }
    return sum * 0.5 * (end - begin) * pi / n;
  }
} // namespace



TEST_CASE("Hertz' pressures carry the load", "[study]")
{
  const auto line = HertzLine::from_load(2.5, 3., 700.);
  CHECK(integrate([&](const double x) { return line.pressure(x); },
                  -line.half_width,
                  line.half_width) == Approx(2.5).epsilon(1e-6));
  CHECK(HertzLine::from_half_width(line.half_width, 3., 700.).load ==
        Approx(2.5));

  const auto   point = HertzPoint::from_load(4., 5., 2., 300.);
  const double a = point.half_axis_x, b = point.half_axis_y;
  CHECK(integrate(
          [&](const double x) {
            const double y = b * std::sqrt(1 - x * x / (a * a));
            return integrate(
              [&](const double t) { return point.pressure(x, t); }, -y, y);
          },
          -a,
          a) == Approx(4.).epsilon(1e-5));
  CHECK(HertzPoint::from_half_axis_x(a, 5., 2., 300.).load == Approx(4.));
}



TEST_CASE("The elliptic contact of equal curvatures is that of the sphere, and "
          "a long ellipse is a line contact",
          "[study]")
{
  const double P = 0.7, R = 2., E = 150.;
  const double a = std::cbrt(3. * P * R / (4. * E));
  for (const double ratio : {1., 1. + 1e-6})
    {
      const auto sphere = HertzPoint::from_load(P, R, R * ratio, E);
      CHECK(sphere.half_axis_x == Approx(a).epsilon(1e-5));
      CHECK(sphere.half_axis_y == Approx(a).epsilon(1e-5));
      CHECK(sphere.approach == Approx(a * a / R).epsilon(1e-5));
    }
  // In the middle of a very long ellipse the section sees a line contact of
  // the local load p_0 pi b / 2 per length.
  const auto long_one = HertzPoint::from_load(P, 1e5 * R, R, E);
  const auto line     = HertzLine::from_load(
    0.5 * pi * long_one.half_axis_y * long_one.peak_pressure, R, E);
  CHECK(long_one.half_axis_x > 500. * long_one.half_axis_y);
  CHECK(line.half_width == Approx(long_one.half_axis_y).epsilon(1e-4));
}



TEST_CASE("The elliptic contact satisfies Hertz' geometric condition in both "
          "directions",
          "[study]")
{
  // Johnson (4.25a, b): curvatures of the displacement under the pressure.
  const double P = 1.3, R_x = 3.7, R_y = 1.1, E = 90.;
  const auto   point = HertzPoint::from_load(P, R_x, R_y, E);
  const double a = point.half_axis_x, b = point.half_axis_y;
  const double e = std::sqrt(1. - b * b / (a * a));
  const double K = std::comp_ellint_1(e), EE = std::comp_ellint_2(e);
  const double factor = point.peak_pressure / E * b / (e * e * a * a);
  CHECK(factor * (K - EE) == Approx(0.5 / R_x));
  CHECK(factor * (a * a / (b * b) * EE - K) == Approx(0.5 / R_y));
  CHECK(point.peak_pressure / E * b * K == Approx(point.approach));
}



TEST_CASE("The traction of partial slip carries the tangential load and its "
          "loss obeys Masing's rule",
          "[study]")
{
  const double mu = 0.4, E = 500.;
  const auto   hertz = HertzLine::from_load(2., 1., E);
  for (const double k : {0.05, 0.4, 0.8, 0.99})
    {
      const PartialSlipLine slip{hertz, mu, k * mu * hertz.load};
      const double          c = slip.stick_half_width();
      const auto q = [&](const double x) { return slip.traction(x); };
      CHECK(integrate(q, -hertz.half_width, -c) + integrate(q, -c, c) +
              integrate(q, c, hertz.half_width) ==
            Approx(slip.tangential_load).epsilon(1e-5));

      // Loop area of a Masing system with the backbone f: 4 Q f(Q) - 8 int f.
      const double mu_P = mu * hertz.load;
      const auto   f    = [&](const double s) {
        return mu_P / (pi * E) * ((1 - s) * std::log1p(-s) + s);
      };
      const double area = 4 * k * mu_P * f(k) - 8 * mu_P * integrate(f, 0., k);
      CHECK(slip.loss_per_cycle(E) == Approx(area).epsilon(1e-4));
    }
  // Both expressions of small amplitudes agree.
  const PartialSlipLine below{hertz, mu, 0.99999e-3 * mu * hertz.load};
  const PartialSlipLine above{hertz, mu, 1.00001e-3 * mu * hertz.load};
  CHECK(below.loss_per_cycle(E) ==
        Approx(above.loss_per_cycle(E)).epsilon(1e-4));
}



TEST_CASE("A twisted sphere begins as Reissner and Sagoci's punch and ends at "
          "3 pi/16 mu P a",
          "[study]")
{
  const double        mu = 0.3, G = 40.;
  const auto          hertz = HertzPoint::from_load(0.8, 2., 2., 100.);
  const double        a     = hertz.half_axis_x;
  const TwistedSphere sphere{hertz, mu, G};
  CHECK(sphere.torque(0.) ==
        Approx(3. * pi / 16. * mu * hertz.load * a).epsilon(1e-5));
  // No slip: M = 16/3 G a^3 beta.
  CHECK(sphere.torque(0.9999 * a) / sphere.twist(0.9999 * a) ==
        Approx(16. / 3. * G * a * a * a).epsilon(2e-3));
  CHECK(sphere.stick_radius(sphere.twist(0.37 * a)) == Approx(0.37 * a));
  // dM = 16/3 G c^3 d beta while the stick zone shrinks.
  const double c = 0.6 * a, h = 1e-4 * a;
  CHECK((sphere.torque(c - h) - sphere.torque(c + h)) /
          (sphere.twist(c - h) - sphere.twist(c + h)) ==
        Approx(16. / 3. * G * c * c * c).epsilon(1e-5));
}
