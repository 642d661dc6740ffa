// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on what runs leave that do not come to their end, and on
// loops that runs report.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <csignal>
#include <sstream>

#include "run_program.h"

using namespace NPT;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  PlateTestParameters
  coarse(const std::vector<std::string> &more, const std::string &n_along = "3")
  {
    std::vector<std::string> overrides = {
      "Mesh/Elements along=" + n_along,
      "Mesh/Elements across=3",
      "Mesh/Elements through=1",
      "Load programme/Stage weave/Initial step=0.1"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return PlateTestParameters::read(make_parameter_text("", "coarse.prm"),
                                     overrides);
  }

  // Raises a signal when a word appears on it.
  class TellTale : public std::stringbuf
  {
  public:
    explicit TellTale(const std::string &word)
      : word_(word)
    {}

  protected:
    std::streamsize
    xsputn(const char *text, const std::streamsize n) override
    {
      if (std::string(text, n).find(word_) != std::string::npos)
        std::raise(SIGINT);
      return std::stringbuf::xsputn(text, n);
    }

  private:
    const std::string word_;
  };

  // What a run says when it ends early.
  StageFailed
  failure_of(NumericalPlateTesting &test)
  {
    try
      {
        test.run();
      }
    catch (const StageFailed &failure)
      {
        return failure;
      }
    FAIL("The run came to its end.");
    throw;
  }

  // Fields and picture of the last accepted step, and the curves.
  void
  check_results(const fs::path              &folder,
                const NumericalPlateTesting &test,
                const std::string           &stage)
  {
    const CurveRow &last = test.curve().back();
    REQUIRE(last.stage == stage);
    CHECK(last.load_factor < 1.);
    const std::string number = std::to_string(last.step);
    CHECK(
      fs::exists(folder / ("bundles-" + std::string(4 - number.size(), '0') +
                           number + ".vtu")));
    CHECK(fs::exists(folder / ("cell_" + stage + ".gp")));
    CHECK(fs::exists(folder / "curves.gp"));
  }
} // namespace



TEST_CASE("A stage that fails leaves fields, pictures, warnings and the advice "
          "that fits",
          "[top]")
{
  // Compression far beyond the loss of ellipticity, with a soft penalty. No
  // step may be cut, so that the first failure ends the stage.
  const fs::path        folder = TopTests::fresh_folder("stage_that_fails");
  std::ostringstream    screen;
  NumericalPlateTesting test(
    coarse({"Contact/Normal penalty=10",
            "Contact/Maximum overlap=1",
            "Stability/On loss of ellipticity=stop",
            "Load programme/Stages=weave, release, squeeze",
            "Load programme/Stage squeeze/Targets=H1: -0.95",
            "Load programme/Stage squeeze/Initial step=0.1",
            "Load programme/Stage squeeze/Maximum step=0.1",
            "Load programme/Stage squeeze/Minimum step=0.1"}),
    folder.string(),
    screen);
  const StageFailed failure = failure_of(test);
  CHECK(failure.reason() == "loss of ellipticity");
  CHECK(failure.stage() == "squeeze");
  CHECK_THAT(failure.advice(),
             Contains("lower the target") && !Contains("Minimum step"));
  check_results(folder, test, "squeeze");
  const std::string log = TopTests::read_text(folder / "log.txt");
  CHECK_THAT(log, Contains("penetrate each other"));
  CHECK_THAT(log, Contains(failure.what()));
  CHECK_THAT(log, Contains("Factorizations"));
}



TEST_CASE("Stiff yarn that cannot be woven at fixed width is woven after the "
          "advice",
          "[top]")
{
  // E_L = 40 GPa, E_T = 50 MPa.
  const std::vector<std::string> yarn = {"Fiber bundle material/mu_iso=20",
                                         "Fiber bundle material/lambda_iso="
                                         "13.3333",
                                         "Fiber bundle material/a_trn=0",
                                         "Fiber bundle material/b_trn=0",
                                         "Fiber bundle material/c_trn=4994",
                                         "Fiber bundle material/d_trn=0",
                                         "Contact/Normal penalty=1000",
                                         "Friction/Tangential penalty=1000",
                                         "Friction/Friction coefficient=0.2",
                                         "Load programme/Stage weave/"
                                         "Minimum step=0.01"};
  std::ostringstream             screen;
  NumericalPlateTesting          fixed(coarse(yarn, "4"), "", screen);
  const StageFailed              failure = failure_of(fixed);
  CHECK(failure.stage() == "weave");
  CHECK_THAT(failure.advice(),
             Contains("Targets = n1: 0, n2: 0 in stage weave"));

  auto advised = yarn;
  advised.push_back("Load programme/Stage weave/Targets=n1: 0, n2: 0");
  NumericalPlateTesting free(coarse(advised, "4"), "", screen);
  free.run();
  unsigned int cuts = 0;
  for (const CurveRow &row : free.curve())
    cuts += row.cuts;
  // The thin edges lose their ellipticity; the step that meets it is halved
  // twice.
  CHECK(cuts <= 2);
  // 5 x 5 elements have 1.06 N/mm; this mesh is 5 % off.
  CHECK(free.curve().back().n[2] == Approx(1.06).epsilon(0.08));
}



TEST_CASE("A run that is interrupted ends after its step with all its results",
          "[top]")
{
  const fs::path        folder = TopTests::fresh_folder("interrupted");
  TellTale              tell_tale("  2.000e-02"); // the first step of the shear
  std::ostream          screen(&tell_tale);
  const Interruption    interruption;
  NumericalPlateTesting test(coarse(
                               {"Load programme/Stage shear/Targets=H3: 0.2",
                                "Load programme/Stage shear/Initial step=0.1",
                                "Load programme/Stage shear/Maximum step=0.1"}),
                             folder.string(),
                             screen);
  CHECK_FALSE(Interruption::requested());
  const StageFailed failure = failure_of(test);
  CHECK(Interruption::requested());
  CHECK(failure.reason() == "interrupted");
  CHECK(failure.load_factor() == Approx(0.1));
  check_results(folder, test, "shear");
}



TEST_CASE("A loop with one step per branch is not reported as an equation",
          "[top]")
{
  const fs::path folder = TopTests::fresh_folder("loop_of_long_steps");
  const auto     stage  = [](const std::string &name, const std::string &H3) {
    const std::string entry = "Load programme/Stage " + name + "/";
    return std::vector<std::string>{entry + "Targets=H3: " + H3,
                                    entry + "Initial step=1",
                                    entry + "Maximum step=1"};
  };
  std::vector<std::string> overrides = {
    "Load programme/Stages=weave, release, l, r, b", "Output/Picture=false"};
  for (const auto &entries :
       {stage("l", "0.05"), stage("r", "-0.05"), stage("b", "0.05")})
    overrides.insert(overrides.end(), entries.begin(), entries.end());
  std::ostringstream    screen;
  NumericalPlateTesting test(coarse(overrides), folder.string(), screen);
  test.run();
  CHECK_THAT(screen.str(),
             Contains("Loop of n3 over H3") && !Contains("= dissipation") &&
               Contains("steps of the loop are too long"));
}
