// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the figures of closed loops.

#include <npt_dealii/problems/plate_results/hysteresis.h>

#include <catch2/catch.hpp>

#include <cmath>

using NPT::CurveRow;

namespace
{
  // n = slope H plus or minus half the width by the sense of motion, with
  // corners of zero length: a parallelogram.
  std::vector<CurveRow>
  parallelogram(const unsigned int component,
                const double       amplitude,
                const double       slope,
                const double       width)
  {
    std::vector<CurveRow> curve;
    const auto            add = [&](const double H, const double sense) {
      CurveRow row;
      row.H[component] = H;
      row.n[component] = slope * H + 0.5 * sense * width;
      if (!curve.empty())
        {
          row.dissipation   = curve.back().dissipation;
          row.external_work = curve.back().external_work;
          const double dH   = H - curve.back().H[component];
          row.dissipation += std::abs(dH) * 0.5 * width * 10.;
          row.external_work +=
            10. * dH * (slope * (H - 0.5 * dH) + 0.5 * sense * width);
          row.stored_energy = 10. * 0.5 * slope * H * H;
        }
      curve.push_back(row);
    };
    const int n = 20;
    for (int i = 0; i <= n; ++i)
      add(amplitude * i / n, 1.);
    for (int i = n - 1; i >= -n; --i)
      add(amplitude * i / n, -1.);
    for (int i = -n + 1; i <= n; ++i)
      add(amplitude * i / n, 1.);
    return curve;
  }
} // namespace



TEST_CASE("A parallelogram gives its slope, width and area back", "[output]")
{
  for (const unsigned int component : {2, 3})
    {
      const auto loop =
        NPT::last_loop(parallelogram(component, 0.25, 3., 0.4), 10.);
      REQUIRE(loop);
      CHECK(loop->component == component);
      CHECK(loop->amplitude == Approx(0.25));
      CHECK(loop->rigidity == Approx(3.));
      CHECK(loop->width == Approx(0.4));
      CHECK(loop->loop_area == Approx(0.4 * 0.5));
      CHECK(loop->dissipation == Approx(0.4 * 0.5));
      CHECK(loop->energy_growth == Approx(0.).margin(1e-12));
    }
}



TEST_CASE("A curve that does not end with a loop has no figures", "[output]")
{
  auto curve = parallelogram(3, 0.25, 3., 0.4);
  CHECK(!NPT::last_loop({}, 10.));
  CHECK(!NPT::last_loop({curve.begin(), curve.begin() + 21}, 10.));
  CHECK(!NPT::last_loop({curve.begin(), curve.begin() + 61}, 10.));
  curve.pop_back();
  CHECK(!NPT::last_loop(curve, 10.));
}



TEST_CASE("The report of a loop names rigidity and width with their units",
          "[output]")
{
  const auto bending = NPT::last_loop(parallelogram(3, 0.25, 3., 0.4), 10.);
  REQUIRE(bending);
  const std::string text = NPT::describe(*bending);
  CHECK(text.find("Loop of n4 over H4 to +-0.25 1/mm") == 0);
  CHECK(text.find("B = 3 N mm") != std::string::npos);
  CHECK(text.find("2HB = 0.4 N,") != std::string::npos);
}



TEST_CASE("The driven component is found by its work, whatever follows it",
          "[output]")
{
  // Bending of a large cell: curvatures are small numbers. An extension
  // without force is larger and even, a torsion without moment is odd and
  // closes a loop of its own.
  auto curve = parallelogram(3, 0.0075, 3., 0.4);
  for (CurveRow &row : curve)
    {
      row.H[0] = 2. * row.H[3] * row.H[3] + std::abs(row.H[3]);
      row.H[5] = 50. * row.H[3];
      row.n[5] = 1e-12;
    }
  const auto loop = NPT::last_loop(curve, 10.);
  REQUIRE(loop);
  CHECK(loop->component == 3);
  CHECK(loop->amplitude == Approx(0.0075));
  CHECK(loop->width == Approx(0.4));
}



TEST_CASE("The report of a loop has a name and a unit for every mode",
          "[output]")
{
  for (unsigned int n = 0; n < NPT::MacroModes::n; ++n)
    {
      const NPT::MacroMode &mode = NPT::MacroModes::table[n];
      const auto loop = NPT::last_loop(parallelogram(n, 0.25, 3., 0.4), 10.);
      REQUIRE(loop);
      const std::string text = NPT::describe(*loop);
      CAPTURE(text);
      CHECK(std::string(mode.rigidity).size() > 0);
      CHECK(std::string(mode.hysteresis).size() > 0);
      CHECK_THAT(text,
                 Catch::Contains(std::string("rigidity ") + mode.rigidity +
                                 " = 3 " + mode.rigidity_unit()) &&
                   Catch::Contains(std::string("hysteresis ") +
                                   mode.hysteresis + " = 0.4 " +
                                   mode.conjugate_unit()) &&
                   !Catch::Contains("  "));
    }
}



TEST_CASE("A loop whose area is not the losses is not reported as an equation",
          "[output]")
{
  // The figures of a run with one step per branch.
  NPT::HysteresisLoop loop{};
  loop.component     = 2;
  loop.amplitude     = 0.1;
  loop.loop_area     = 3.975e-05;
  loop.dissipation   = 0.02226;
  loop.energy_growth = -2e-5;
  loop.work          = 0.06;
  loop.n_steps       = 2;
  CHECK(!loop.is_balanced());
  CHECK_THAT(NPT::describe(loop),
             !Catch::Contains("= dissipation") &&
               Catch::Contains("2 steps of the loop are too long") &&
               Catch::Contains("Maximum step"));

  loop.loop_area = 0.0221;
  CHECK(loop.is_balanced());
  CHECK_THAT(NPT::describe(loop), Catch::Contains("= dissipation 0.02226"));

  // Without friction the area is nothing but the error of the rule.
  loop.loop_area   = 1e-6;
  loop.dissipation = loop.energy_growth = 0.;
  CHECK_THAT(NPT::describe(loop),
             !Catch::Contains("= dissipation") && !Catch::Contains("too long"));
}
