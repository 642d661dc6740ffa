// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about what a plate test says of its stability: where ellipticity is
// lost, and whether work, energies and dissipation balance.

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
    explicit Run(std::vector<std::string> overrides)
    {
      overrides.insert(overrides.begin(),
                       {"Mesh/Elements along=4",
                        "Mesh/Elements across=4",
                        "Mesh/Elements through=1"});
      NumericalPlateTesting test(
        PlateTestParameters::read(make_parameter_text("", "stability.prm"),
                                  overrides),
        "",
        screen);
      try
        {
          test.run();
        }
      catch (const StageFailed &failure)
        {
          reason  = failure.reason();
          message = failure.what();
        }
      curve = test.curve();
      state = test.state();
    }

    bool
    says(const std::string &text) const
    {
      return screen.str().find(text) != std::string::npos;
    }

    std::ostringstream    screen;
    std::string           reason, message;
    std::vector<CurveRow> curve;
    State                 state;
  };

  std::vector<std::string>
  compression(const std::string &step, const std::string &on_loss = "stop")
  {
    const std::string squeeze = "Load programme/Stage squeeze/";
    return {"Load programme/Stages=weave, release, squeeze",
            squeeze + "Targets=H1: -0.3",
            squeeze + "Initial step=" + step,
            squeeze + "Maximum step=" + step,
            squeeze + "Minimum step=0.001",
            "Stability/On loss of ellipticity=" + on_loss};
  }
} // namespace



TEST_CASE("Compression ends where ellipticity is lost, whatever the step",
          "[top]")
{
  for (const std::string step : {"0.1", "0.05"})
    {
      INFO("step " << step);
      const Run run(compression(step));
      CHECK(run.reason == "loss of ellipticity");
      CHECK(run.message.find("bundle") != std::string::npos);
      // -0.1017 by a check in steps of 0.0003.
      CHECK(run.curve.back().H[0] == Approx(-0.1017).margin(0.0006));
    }
}



TEST_CASE("A run that goes on without ellipticity says so", "[top]")
{
  auto overrides = compression("0.1", "warn");
  // Beyond the loss the bundles fold into each other.
  overrides.push_back("Contact/Maximum overlap=1");
  const Run run(overrides);
  CHECK(run.reason.empty());
  CHECK(run.curve.back().H[0] == Approx(-0.3));
  const std::string text =
    "Stage squeeze: the material loses its ellipticity at "
    "load factor ";
  REQUIRE(run.says(text));
  const std::string log = run.screen.str();
  // H1 = -0.1017, between the steps to which the program cuts those of 0.1.
  CHECK(std::stod(log.substr(log.find(text) + text.size())) ==
        Approx(0.339).margin(0.006));
  CHECK(run.says("between the steps 0.325 and 0.35 (bundle"));
}



TEST_CASE("Work, also of weaving, is the growth of the energies plus the "
          "dissipation, up to the steps",
          "[top]")
{
  const auto missing = [](const std::string &step) {
    const std::string shear = "Load programme/Stage shear/";
    const Run         run({"Load programme/Stages=weave, release, shear",
                           "Load programme/Stage weave/Maximum step=0.025",
                           shear + "Targets=H3: 0.1",
                           shear + "Initial step=" + step,
                           shear + "Maximum step=" + step});
    const Energies   &e = run.state.energies;
    CHECK(run.reason.empty());
    CHECK_FALSE(run.says("energy balance"));
    // The account is that of the curve.
    const CurveRow &last = run.curve.back();
    CHECK(e.content() == Approx(last.stored_energy + last.contact_energy +
                                last.friction_energy));
    CHECK(e.dissipation == Approx(last.dissipation));
    CHECK(e.work > last.external_work); // which lacks the weaving
    return e.work - e.content() - e.dissipation;
  };
  const double content = 3.;
  CHECK(std::abs(missing("0.1")) < 0.02 * content);
}
