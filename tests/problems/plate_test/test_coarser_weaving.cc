// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on weaving on a coarser mesh first.

#include <npt_dealii/problems/plate_test/coarser_weaving.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <array>
#include <sstream>

using namespace NPT;
using Catch::Contains;

namespace
{
  PlateTestParameters
  parameters(const std::string                 &coarser,
             const std::vector<std::string>    &more = {},
             const std::array<unsigned int, 3> &mesh = {{7, 6, 1}})
  {
    std::vector<std::string> overrides = {
      "Mesh/Elements along=" + std::to_string(mesh[0]),
      "Mesh/Elements across=" + std::to_string(mesh[1]),
      "Mesh/Elements through=" + std::to_string(mesh[2]),
      "Friction/Friction coefficient=0.3",
      "Load programme/Stages=weave, release, load",
      "Load programme/Stage load/Targets=H3: 0.02",
      "Newton/Relative tolerance=1e-10",
      "Mesh/Weave on coarser mesh=" + coarser};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return PlateTestParameters::read(make_parameter_text("", "run.prm"),
                                     overrides);
  }

  // The curve; it is checked that every stage is there.
  std::vector<CurveRow>
  curve(const PlateTestParameters &given)
  {
    std::ostringstream    screen;
    NumericalPlateTesting test(given, "", screen);
    test.run();
    CHECK(test.curve().back().load_factor == 1.);
    return test.curve();
  }

  unsigned int
  n_steps_of_weaving(const std::vector<CurveRow> &rows)
  {
    unsigned int n = 0;
    for (const CurveRow &row : rows)
      n += row.stage == "weave";
    return n;
  }
} // namespace



TEST_CASE("Woven on a coarser mesh first, the state is the same in one step",
          "[top]")
{
  // 7 x 6 elements are not a refinement of 4 x 4: what is carried over is an
  // interpolation. Two kinds of seams, with free width.
  for (const std::vector<std::string> &more :
       {std::vector<std::string>{},
        {"Cell/Weave=oou/uoo/ouo",
         "Cell/Side contact=off",
         "Load programme/Stage weave/Targets=n1: 0, n2: 0"}})
    {
      const auto usual   = curve(parameters("false", more)),
                 coarser = curve(parameters("true", more));
      CHECK(n_steps_of_weaving(usual) > 5);
      CHECK(n_steps_of_weaving(coarser) == 1);
      const CurveRow &a = usual.back(), &b = coarser.back();
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        CHECK(b.n[n] == Approx(a.n[n]).epsilon(1e-7).margin(1e-8));
    }
}



TEST_CASE("Nothing is woven on a coarser mesh where the way to the woven state "
          "counts or nothing would be gained",
          "[top]")
{
  const auto is_coarser = [](const PlateTestParameters &given) {
    return coarser_weaving(given, PlateCell(given)).has_value();
  };
  CHECK(is_coarser(parameters("true")));
  CHECK_FALSE(is_coarser(parameters("false")));
  CHECK_FALSE(is_coarser(parameters("automatic"))); // few unknowns
  CHECK_FALSE(is_coarser(parameters("true", {"Mesh/Basis=Lagrange"})));
  CHECK_FALSE(is_coarser(parameters("true", {}, {{4, 4, 1}})));
  CHECK_FALSE(is_coarser(
    parameters("true", {"Load programme/Stage weave/Friction=true"})));
}



TEST_CASE("From 10,000 unknowns on the program weaves on a coarser mesh first",
          "[top]")
{
  const PlateTestParameters given = parameters("automatic", {}, {{17, 17, 3}});
  const auto                coarser = coarser_weaving(given, PlateCell(given));
  REQUIRE(coarser);
  CHECK(coarser->mesh.elements_along == 9);
  CHECK(coarser->mesh.elements_across == 9);
  CHECK(coarser->mesh.elements_through == 2);
  CHECK(coarser->load_programme.stages.size() == 1);
  CHECK_FALSE(coarser_weaving(*coarser, PlateCell(*coarser)));
  // Many unknowns because of many bundles: the coarser mesh would have few
  // contact nodes per crossing, and with them several states.
  const PlateTestParameters satin =
    parameters("automatic", {"Cell/Weave=5-harness satin"}, {{7, 7, 2}});
  const PlateCell satin_cell(satin);
  CHECK(satin_cell.macro().n_unknowns() > 10000);
  CHECK_FALSE(coarser_weaving(satin, satin_cell));
}
