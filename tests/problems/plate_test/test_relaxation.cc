// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the relaxation of weaving stress in a woven cell.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

namespace
{
  using namespace NPT;

  struct Run
  {
    std::vector<CurveRow> curve;

    Run(const std::string              &stages,
        const std::string              &fraction = "1",
        const std::string              &step     = "0.1",
        const std::vector<std::string> &more     = {})
    {
      std::vector<std::string> overrides = {"Mesh/Elements along=3",
                                            "Mesh/Elements across=3",
                                            "Contact/Normal penalty=1000",
                                            "Friction/Tangential penalty=1000",
                                            "Load programme/Stages=" + stages};
      if (stages.find("relax") != std::string::npos)
        for (const std::string &entry : {std::string("Type=relax"),
                                         "Relaxed fraction=" + fraction,
                                         "Initial step=" + step,
                                         "Maximum step=" + step})
          overrides.push_back("Load programme/Stage relax/" + entry);
      overrides.insert(overrides.end(), more.begin(), more.end());
      std::ostringstream    screen;
      NumericalPlateTesting test(
        PlateTestParameters::read(make_parameter_text("", "relax.prm"),
                                  overrides),
        "",
        screen);
      test.run();
      curve = test.curve();
    }

    const CurveRow &
    end(const std::string &stage) const
    {
      const CurveRow *result = nullptr;
      for (const CurveRow &row : curve)
        if (row.stage == stage)
          result = &row;
      REQUIRE(result != nullptr);
      return *result;
    }

    double
    energy(const CurveRow &row) const
    {
      return row.stored_energy + row.contact_energy + row.friction_energy;
    }
  };

  const std::string half = "Load programme/Stage relax/Relaxed fraction=0.5";
  const std::string type = "Load programme/Stage relax/Type=relax";
} // namespace



TEST_CASE("A fully relaxed cell at rest bears nothing, by both contact methods",
          "[top]")
{
  for (const std::string method : {"KTS", "mortar"})
    {
      INFO(method);
      const Run       run("weave, release, relax",
                    "1",
                    "0.1",
                    {"Contact/Method=" + method});
      const CurveRow &woven = run.end("release"), &relaxed = run.end("relax");
      for (unsigned int n = 0; n < 2; ++n)
        {
          CHECK(woven.n[n] > 0.1);
          CHECK(std::abs(relaxed.n[n]) < 1e-8 * woven.n[n]);
        }
      CHECK(relaxed.N.norm() < 1e-8 * woven.N.norm());
      CHECK(run.energy(relaxed) < 1e-14 * run.energy(woven));
    }
}



TEST_CASE("A cell that has relaxed by a half lies between, whatever the steps",
          "[top]")
{
  const Run       run("weave, release, relax", "0.5");
  const Run       in_two("weave, release, relax", "0.5", "0.5");
  const CurveRow &woven = run.end("release"), &relaxed = run.end("relax");
  CHECK(relaxed.n[0] < 0.7 * woven.n[0]);
  CHECK(relaxed.n[0] > 0.3 * woven.n[0]);
  CHECK(in_two.end("relax").n[0] == Approx(relaxed.n[0]).epsilon(1e-7));
}



TEST_CASE("What relaxes is dissipated", "[top]")
{
  const Run       run("weave, release, relax", "1", "0.025");
  const CurveRow &woven = run.end("release"), &relaxed = run.end("relax");
  const double    lost = run.energy(woven) - run.energy(relaxed);
  CHECK(relaxed.dissipation - woven.dissipation == Approx(lost).epsilon(1e-3));
  CHECK(relaxed.external_work == Approx(woven.external_work).epsilon(1e-9));
}



TEST_CASE("A full relaxation in one step moves nothing, dissipates what the "
          "energies lose, and is loaded from there",
          "[top]")
{
  // A weave without glide planes, held by contact alone.
  const Run       run("weave, release, relax, pull",
                "1",
                "1",
                {"Cell/Weave=2/1 twill",
                       "Cell/Two-fold axis=false",
                       "Mesh/Elements through=1",
                       "Contact/Method=KTS",
                       "Load programme/Stage pull/Targets=n1: 0.01, n2: 0.01",
                       "Load programme/Stage pull/Initial step=0.5",
                       "Load programme/Stage pull/Maximum step=0.5"});
  const CurveRow &woven = run.end("release"), &relaxed = run.end("relax");
  CHECK(relaxed.load_factor == 1.);
  CHECK(std::abs(relaxed.n[0]) < 1e-7 * woven.n[0]);
  CHECK(relaxed.dissipation - woven.dissipation ==
        Approx(run.energy(woven) - run.energy(relaxed)).epsilon(1e-8));
  CHECK(run.end("pull").n[0] == Approx(0.01).epsilon(1e-6));
  CHECK(run.end("pull").H[0] > relaxed.H[0]);
}



TEST_CASE("A relaxed cell resists shear less, and its resultant is the "
          "derivative of its energy without friction",
          "[top]")
{
  const std::vector<std::string> frictionless = {
    "Friction/Friction coefficient=0",
    "Load programme/Stage shear/Targets=H3: 0.05",
    "Load programme/Stage shear/Initial step=0.02",
    "Load programme/Stage shear/Maximum step=0.02"};
  const Run run("weave, release, relax, shear", "0.5", "0.1", frictionless);
  const CurveRow *before = nullptr;
  double          work   = 0;
  for (const CurveRow &row : run.curve)
    {
      if (before != nullptr && row.stage == "shear")
        work += 0.5 * (row.n[2] + before->n[2]) * (row.H[2] - before->H[2]);
      before = &row;
    }
  const double area = 25.; // of a crossing [mm^2]
  const double gain =
    run.energy(run.end("shear")) - run.energy(run.end("relax"));
  CHECK(area * work == Approx(gain).epsilon(2e-3)); // trapezoids
  const Run straight("weave, release, shear", "", "", frictionless);
  CHECK(run.end("shear").n[0] < 0.8 * straight.end("shear").n[0]);
}



TEST_CASE("Stages that relax nothing, too early or by accident are refused",
          "[top]")
{
  const auto refused = [](const std::vector<std::string> &overrides) {
    try
      {
        PlateTestParameters::read(make_parameter_text("", "relax.prm"),
                                  overrides);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  CHECK_THAT(refused(
               {"Load programme/Stages=weave, relax, release", type, half}),
             Catch::Contains("Stage relax relaxes, but no stage before it"));
  CHECK_THAT(refused({"Load programme/Stages=weave, release, relax", type}),
             Catch::Contains("must relax something"));
  CHECK_THAT(refused({"Load programme/Stage shear/Relaxed fraction=0.5"}),
             Catch::Contains("is not of type relax"));
}



TEST_CASE("Dry bundles are woven, relax and are sheared without a loss of "
          "ellipticity, and at rest bear nothing",
          "[top]")
{
  std::ostringstream    screen;
  NumericalPlateTesting test(
    PlateTestParameters::read(read_parameter_text(
                                NPT_SOURCE_DIR "/prm/fabrics/twintex_dry.prm"),
                              {"Mesh/Elements along=4",
                               "Mesh/Elements across=3",
                               "Load programme/Stage shear/Targets=H3: 0.3",
                               "Load programme/Stage shear/Initial step=0.1",
                               "Load programme/Stage shear/Maximum step=0.1"}),
    "",
    screen);
  test.run();
  double woven = 0;
  for (const CurveRow &row : test.curve())
    {
      if (row.stage == "release")
        woven = row.n[0];
      if (row.stage == "relax" && row.load_factor == 1.)
        CHECK(std::abs(row.n[0]) < 1e-8 * woven);
    }
  CHECK(woven > 1.);
  CHECK(test.curve().back().H[2] == Approx(0.3));
  CHECK(screen.str().find("ellipticity") == std::string::npos);
}
