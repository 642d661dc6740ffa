// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on macroscopic gradients that leave nothing of the cell.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/problems/load_programme/macro_limits.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

#include "plate_run.h"

using namespace NPT;

namespace
{
  KnownGradients
  known(const std::array<double, MacroModes::n> &H)
  {
    KnownGradients result;
    std::copy(H.begin(), H.end(), result.begin());
    return result;
  }

  // Smallest eigenvalue of 1 + the in-plane gradient of the macroscopic
  // displacement (A1), by differences, which are exact there, at many heights.
  double
  smallest_stretch(const std::array<double, MacroModes::n> &H,
                   const double                             half_thickness)
  {
    double     smallest = 1e300;
    const auto w        = [&](const dealii::Point<3> &Y) {
      dealii::Tensor<1, 3> sum;
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        sum += H[n] * macroscopic_displacement(n, Y);
      return sum;
    };
    for (int i = -10; i <= 10; ++i)
      {
        const double z  = 0.1 * i * half_thickness;
        const auto   e1 = w({0.5, 0, z}) - w({-0.5, 0, z}),
                   e2   = w({0, 0.5, z}) - w({0, -0.5, z});
        const double a = 1 + e1[0], d = 1 + e2[1], b = e1[1];
        smallest =
          std::min(smallest, 0.5 * (a + d) - std::hypot(0.5 * (a - d), b));
      }
    return smallest;
  }

  std::string
  refusal(const std::vector<std::string> &overrides)
  {
    try
      {
        PlateTestParameters::read(make_parameter_text("", "file.prm"),
                                  overrides);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }
} // namespace



TEST_CASE("Gradients are refused exactly where they leave a plane of the layer "
          "no extent",
          "[top]")
{
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> number(-1.2, 1.2);
  unsigned int                           n_refused = 0;
  for (unsigned int i = 0; i < 2000; ++i)
    {
      const double                      h = i % 2 == 0 ? 1.2 : 0.0012;
      std::array<double, MacroModes::n> H;
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        H[n] = number(random) /
               (MacroModes::table[n].kind == MacroMode::Kind::bending ? h : 1.);
      const bool refused = !obstacle_of_gradients(known(H), h).empty();
      REQUIRE(refused == !(smallest_stretch(H, h) > 0.));
      n_refused += refused;
    }
  CHECK(n_refused > 500);
  CHECK(n_refused < 1990);
}



TEST_CASE("A gradient that is not prescribed forbids nothing", "[top]")
{
  // H3 = 3 is too much at H1 = H2 = 0, but not with the width free.
  KnownGradients H = known({{0., 0., 3., 0., 0., 0.}});
  CHECK(!obstacle_of_gradients(H, 1.2).empty());
  H[1].reset();
  CHECK(obstacle_of_gradients(H, 1.2).empty());
  // The extension along Y1 is still there.
  H[0] = -1.;
  CHECK(!obstacle_of_gradients(H, 1.2).empty());
}



TEST_CASE("Targets without a meaning are refused with the allowed range when "
          "the file is read",
          "[top]")
{
  using Catch::Contains;
  const std::string program = "Load programme/Stages=weave, release, s, t",
                    s       = "Load programme/Stage s/Targets=",
                    t       = "Load programme/Stage t/Targets=";
  CHECK_THAT(refusal({program, s + "H1: -1.5", t + "n1: 0"}),
             Contains("H1 = -1.5") && Contains("must be above -1") &&
               Contains("Stage s)"));
  CHECK_THAT(refusal({program, s + "H1: -0.9", t + "H1: 0"}), Contains("none"));
  CHECK_THAT(refusal({program, s + "H1: -0.5", t + "H3: 1.5"}),
             Contains("H1 = -0.5 and H3 = 1.5") &&
               Contains("|H3| must be below 1.41421") && Contains("Stage t)"));
  // Of a component that a resultant controls nothing is known, until a target
  // names it again.
  CHECK_THAT(refusal({program, s + "n1: 0, n2: 0", t + "H3: 2.5"}),
             Contains("none"));
  CHECK_THAT(refusal({program, s + "n1: 0, n2: 0", t + "H2: -1"}),
             Contains("H2 = -1") && Contains("Stage t)"));
  CHECK_THAT(refusal({program, s + "H4: 0.9", t + "H4: 0"}),
             Contains("H4 = 0.9 1/mm") &&
               Contains("|H4| must be below 0.833333 1/mm"));
  CHECK_THAT(refusal({program, s + "H6: 1.7", t + "H6: 0"}),
             Contains("H6 = 1.7 1/mm") && Contains("face of the layer"));
  CHECK_THAT(refusal({program, s + "H6: 1.6", t + "H6: 0"}), Contains("none"));
}



TEST_CASE("A step to gradients that leave nothing of the cell fails, whatever "
          "led there",
          "[top]")
{
  PlateTestTools::PlateRun test({"Mesh/Elements along=3",
                                 "Mesh/Elements across=3",
                                 "Mesh/Elements through=1",
                                 "Load programme/Stages=weave"});
  const PlateTestStage     stage(
    test.cell, test.parameters, 0, test.state, {}, test.system);
  State after                        = test.state;
  after.u[test.cell.macro().mode(0)] = -0.9;
  CHECK_NOTHROW(stage.check(test.state, after));
  after.u[test.cell.macro().mode(0)] = -1.1;
  CHECK_THROWS_AS(stage.check(test.state, after), CellCollapsed);
}
