// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the normal law and of Coulomb's law with a tangential penalty.

#include <npt_dealii/contact/contact_parameters.h>
#include <npt_dealii/contact/coulomb_friction.h>
#include <npt_dealii/contact/geometry/surface_metric.h>
#include <npt_dealii/contact/penalty_law.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace NPT;

namespace
{
  using Vector2 = std::array<double, 2>;
  using Metric2 = std::array<double, 3>;

  // t_a a^{ab} s_b
  double
  product(const Vector2 &t, const Vector2 &s, const Metric2 &a)
  {
    const auto inverse =
      invert_symmetric<2>({{{{a[0], a[1]}}, {{a[1], a[2]}}}});
    double sum = 0.;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        sum += t[i] * inverse[i][j] * s[j];
    return sum;
  }
} // namespace



TEST_CASE("Pressure and slope of the normal law are derivatives of its energy",
          "[contact]")
{
  const PenaltyLaw law(100.);
  CHECK(!law(0.01).active);
  CHECK(law(0.01).pressure == 0.);
  CHECK(law(-0.02).pressure == Approx(-2.)); // 100 * 0.02 by hand
  for (const double multiplier : {0., -1.5})
    for (const double gap : {-0.03, -0.001, 0.005, 0.03})
      {
        const double h  = 1e-5; // quadratic energy: only rounding is left
        const auto   at = law(gap, multiplier);
        CHECK(std::abs((law(gap + h, multiplier).energy -
                        law(gap - h, multiplier).energy) /
                         (2 * h) -
                       at.pressure) < 1e-9);
        CHECK(std::abs((law(gap + h, multiplier).pressure -
                        law(gap - h, multiplier).pressure) /
                         (2 * h) -
                       at.slope) < 1e-8);
        CHECK(at.pressure <= 0.);
      }
  // No jump of the energy where contact begins.
  CHECK(std::abs(law(0.015 + 1e-14, -1.5).energy -
                 law(0.015 - 1e-14, -1.5).energy) < 1e-12);
}



TEST_CASE("One point sticks, slips and sticks again on reversal, by hand",
          "[contact]")
{
  // mu |p| = 0.3 * 10 = 3 MPa, reached after 0.03 mm.
  const CoulombFriction<1> law{0.3, 100.};
  const auto step = [&](const double traction, const double slip) {
    return law({{traction}}, {{slip}}, {{1.}}, 10.);
  };
  const auto stick = step(0., 0.02);
  CHECK(!stick.slipping);
  CHECK(stick.traction[0] == Approx(2.));
  CHECK(stick.energy == Approx(0.5 * 2. * 2. / 100.));
  CHECK(stick.dissipation == 0.);

  const auto slip = step(stick.traction[0], 0.05);
  CHECK(slip.slipping);
  CHECK(slip.traction[0] == Approx(3.)); // with the sign of the slip
  CHECK(slip.dissipation == Approx(3. * (0.07 - 0.03)));

  const auto back = step(slip.traction[0], -0.04);
  CHECK(!back.slipping);
  CHECK(back.traction[0] == Approx(-1.));
  const auto reversed = step(back.traction[0], -0.1);
  CHECK(reversed.slipping);
  CHECK(reversed.traction[0] == Approx(-3.));
  CHECK(reversed.dissipation == Approx(3. * (0.1 - 0.02)));

  // Less pressure: the same elastic slip is too much; none: no traction.
  CHECK(law({{2.}}, {{0.}}, {{1.}}, 5.).traction[0] == Approx(1.5));
  CHECK(law({{2.}}, {{0.1}}, {{1.}}, 0.).traction[0] == 0.);
  CHECK(CoulombFriction<1>{0., 100.}({{2.}}, {{0.1}}, {{1.}}, 9.).traction[0] ==
        0.);

  // A parameter of 2 mm per unit: slip 0.01 is 0.02 mm, t_1 = 2 MPa * 2 mm.
  CHECK(law({{0.}}, {{0.01}}, {{4.}}, 10.).traction[0] == Approx(4.));
  CHECK(law({{0.}}, {{1.}}, {{4.}}, 10.).traction[0] == Approx(6.));
}



TEST_CASE("The derivatives of friction are those by differences, also with "
          "the metric",
          "[contact]")
{
  const CoulombFriction<2> law{0.3, 50.};
  const Metric2            metric     = {{1.3, 0.4, 0.7}};
  const Vector2            traction_n = {{0.4, -0.7}};
  const double             h          = 1e-6; // error h^2 and 1e-16/h
  for (const double pressure : {20., 3.})
    {
      const Vector2 slip = {{0.03, -0.02}};
      const auto    at   = law(traction_n, slip, metric, pressure);
      CHECK(at.slipping == (pressure == 3.));
      const auto check = [&](const auto &derivative, const auto &vary) {
        const auto plus = vary(h), minus = vary(-h);
        for (unsigned int i = 0; i < 2; ++i)
          CHECK(std::abs((plus.traction[i] - minus.traction[i]) / (2 * h) -
                         derivative(i)) < 1e-7);
      };
      for (unsigned int j = 0; j < 2; ++j)
        check([&](const unsigned int i) { return at.by_slip[i][j]; },
              [&](const double e) {
                Vector2 s = slip;
                s[j] += e;
                return law(traction_n, s, metric, pressure);
              });
      for (unsigned int k = 0; k < 3; ++k)
        check([&](const unsigned int i) { return at.by_metric[i][k]; },
              [&](const double e) {
                Metric2 a = metric;
                a[k] += e;
                return law(traction_n, slip, a, pressure);
              });
      check([&](const unsigned int i) { return at.by_pressure[i]; },
            [&](const double e) {
              return law(traction_n, slip, metric, pressure + e);
            });
    }
}



TEST_CASE("Dissipation is never negative and is the work that is not stored",
          "[contact]")
{
  const CoulombFriction<2>               law{0.4, 80.};
  const Metric2                          metric = {{1.3, 0.4, 0.7}};
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> unit(-1., 1.);
  Vector2                                traction = {};
  double                                 energy = 0., total = 0.;
  unsigned int                           n_slip = 0;
  for (unsigned int step = 0; step < 200; ++step)
    {
      const Vector2 slip   = {{0.02 * unit(generator), 0.02 * unit(generator)}};
      const auto    answer = law(traction, slip, metric, 2.);
      CHECK(answer.dissipation >= 0.);
      // Backward Euler: traction at the end times slip exceeds the exact work
      // by the elastic term of second order, |t - t_n|^2 / (2 eps).
      const double work =
        answer.traction[0] * slip[0] + answer.traction[1] * slip[1];
      const Vector2 change = {
        {answer.traction[0] - traction[0], answer.traction[1] - traction[1]}};
      CHECK(std::abs(work - (answer.energy - energy) - answer.dissipation -
                     product(change, change, metric) / 160.) < 1e-14);
      CHECK(std::sqrt(product(answer.traction, answer.traction, metric)) <=
            0.8 * (1 + 1e-12)); // mu p
      traction = answer.traction;
      energy   = answer.energy;
      total += answer.dissipation;
      n_slip += answer.slipping ? 1 : 0;
    }
  CHECK(total > 0.);
  CHECK(n_slip > 20);
  CHECK(n_slip < 180);
}



TEST_CASE("Friction does not depend on the coordinates of the surface",
          "[contact]")
{
  const CoulombFriction<2> law{0.3, 50.};
  const Metric2            a          = {{1.3, 0.4, 0.7}};
  const Vector2            traction_n = {{0.4, -0.7}}, slip = {{0.03, -0.05}};
  // New coordinates xi' = B xi: slip' = B slip, and with C the inverse of B
  // covariant components t' = C^T t, metric a' = C^T a C.
  const double B[2][2]   = {{1.2, -0.7}, {0.4, 0.9}};
  const double det       = B[0][0] * B[1][1] - B[0][1] * B[1][0];
  const double C[2][2]   = {{B[1][1] / det, -B[0][1] / det},
                            {-B[1][0] / det, B[0][0] / det}};
  const auto   covariant = [&](const Vector2 &t) {
    return Vector2{
      {C[0][0] * t[0] + C[1][0] * t[1], C[0][1] * t[0] + C[1][1] * t[1]}};
  };
  const Vector2 new_slip = {{B[0][0] * slip[0] + B[0][1] * slip[1],
                             B[1][0] * slip[0] + B[1][1] * slip[1]}};
  Metric2       new_a    = {};
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int j = i; j < 2; ++j)
      for (unsigned int k = 0; k < 2; ++k)
        for (unsigned int l = 0; l < 2; ++l)
          new_a[i + j] += C[k][i] * a[k + l] * C[l][j];

  for (const double pressure : {30., 2.})
    {
      const auto old_answer = law(traction_n, slip, a, pressure);
      const auto new_answer =
        law(covariant(traction_n), new_slip, new_a, pressure);
      const Vector2 expected = covariant(old_answer.traction);
      CHECK(old_answer.slipping == (pressure == 2.));
      CHECK(new_answer.slipping == old_answer.slipping);
      for (unsigned int i = 0; i < 2; ++i)
        CHECK(std::abs(new_answer.traction[i] - expected[i]) < 1e-13);
      CHECK(std::abs(new_answer.dissipation - old_answer.dissipation) < 1e-13);
      CHECK(std::abs(new_answer.energy - old_answer.energy) < 1e-13);
    }
}



TEST_CASE("Slip traction is parallel to the trial one: friction is isotropic",
          "[contact]")
{
  const CoulombFriction<2> law{0.3, 50.};
  for (const double angle : {0., 0.5, 2., 4.})
    {
      const auto answer =
        law({}, {{std::cos(angle), std::sin(angle)}}, {{1., 0., 1.}}, 2.);
      CHECK(answer.slipping);
      CHECK(std::abs(answer.traction[0] - 0.6 * std::cos(angle)) < 1e-14);
      CHECK(std::abs(answer.traction[1] - 0.6 * std::sin(angle)) < 1e-14);
    }
}



namespace
{
  // A friction law of which no other file knows, with a number of its own.
  const std::vector<OwnNumber> strong_numbers = {
    {"Friction factor",
     2.,
     "strong only: factor of mu [-].",
     std::make_shared<dealii::Patterns::Double>(0.)}};

  const Registry<NamedFrictionLaw<2>>::Registration
    strong("strong",
           {"Coulomb's law with a multiple of mu",
            [](const FrictionParameters &parameters) {
              return std::make_unique<CoulombFriction<2>>(
                parameters.coefficient * own_number(parameters.law_numbers,
                                                    strong_numbers,
                                                    "Friction factor"),
                parameters.tangential_penalty);
            },
            strong_numbers});
} // namespace

TEST_CASE("A friction law that registers itself is read with its number",
          "[contact]")
{
  dealii::ParameterHandler prm;
  FrictionParameters       friction;
  const auto               slip_traction = [&]() {
    const auto law =
      Registry<NamedFrictionLaw<2>>::instance().get("strong").make(friction);
    return (*law)({}, {{1., 0.}}, {{1., 0., 1.}}, 2.).traction[0];
  };
  CHECK(slip_traction() == Approx(0.3 * 2. * 2.)); // the default 2

  friction.add_parameters(prm);
  prm.parse_input_from_string("subsection Friction\n set Law = strong\n"
                              " set Friction factor = 1.5\nend\n");
  CHECK(friction.law == "strong");
  CHECK(slip_traction() == Approx(0.3 * 1.5 * 2.));
}



TEST_CASE("Contact and friction entries read back what the file says",
          "[contact]")
{
  dealii::ParameterHandler prm;
  ContactParameters        contact;
  FrictionParameters       friction;
  contact.add_parameters(prm);
  friction.add_parameters(prm);
  // Defaults of file and struct agree.
  CHECK(contact.method == ContactParameters().method);
  CHECK(contact.normal_penalty == ContactParameters().normal_penalty);
  CHECK(contact.maximum_penetration == ContactParameters().maximum_penetration);
  CHECK(contact.n_quadrature_points == ContactParameters().n_quadrature_points);
  CHECK(friction.coefficient == FrictionParameters().coefficient);
  CHECK(friction.tangential_penalty == FrictionParameters().tangential_penalty);
  CHECK(contact.normal_law == "penalty");
  CHECK(friction.law == "Coulomb");

  prm.parse_input_from_string("subsection Contact\n set Method = KTS\n"
                              " set Normal penalty = 7\nend\n"
                              "subsection Friction\n"
                              " set Friction coefficient = 0.1\nend\n");
  CHECK(contact.method == ContactParameters::Method::KTS);
  CHECK(contact.normal_penalty == 7.);
  CHECK(friction.coefficient == 0.1);
  CHECK_THROWS(prm.parse_input_from_string(
    "subsection Contact\n set Normal penalty = 0\nend\n"));
  CHECK_THROWS(prm.parse_input_from_string(
    "subsection Friction\n set Friction coefficient = -0.1\nend\n"));
  CHECK_THROWS(prm.parse_input_from_string(
    "subsection Contact\n set Normal law = glue\nend\n"));
  CHECK_THROWS(
    prm.parse_input_from_string("subsection Friction\n set Law = glue\nend\n"));
}
