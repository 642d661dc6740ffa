// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about bundles that contact must not miss.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;

  struct Run
  {
    std::vector<CurveRow> curve;
    std::string           log; // warnings and cuts
    std::string           failure;
  };

  Run
  run(const std::vector<std::string> &overrides)
  {
    const auto parameters =
      PlateTestParameters::read(make_parameter_text("", "test.prm"), overrides);
    std::ostringstream    screen;
    NumericalPlateTesting test(parameters, "", screen);
    Run                   result;
    try
      {
        test.run();
      }
    catch (const StageFailed &failure)
      {
        result.failure = failure.reason();
      }
    result.curve = test.curve();
    result.log   = screen.str();
    return result;
  }

  std::vector<std::string>
  mesh(const std::string &n, const std::vector<std::string> &more)
  {
    std::vector<std::string> overrides = {"Mesh/Elements along=" + n,
                                          "Mesh/Elements across=" + n,
                                          "Mesh/Elements through=1"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return overrides;
  }
} // namespace



TEST_CASE(
  "Bundles narrower than the elements do not go through each other, and "
  "mortar gives what single points give",
  "[top]")
{
  const std::vector<std::string> narrow    = {"Cell/Bundle width=1",
                                              "Cell/Bundle thickness=0.3",
                                              "Load programme/Stages=weave"};
  auto                           by_points = narrow;
  by_points.push_back("Contact/Method=KTS");
  const Run mortar = run(mesh("5", narrow));
  const Run KTS    = run(mesh("5", by_points));
  CHECK(mortar.failure.empty());
  // A mesh of two spans through the thickness gives 0.00516 as well.
  CHECK(KTS.curve.back().n[0] == Approx(0.00516).epsilon(0.01));
  CHECK(mortar.curve.back().n[0] ==
        Approx(KTS.curve.back().n[0]).epsilon(0.02));
  CHECK_THAT(mortar.log, Catch::Contains("only 1 elements wide"));
  CHECK_THAT(mortar.log, Catch::Contains("contact nodes per crossing"));
}



TEST_CASE("Results do not depend on the depth beyond which a step is refused",
          "[top]")
{
  const Run usual = run(mesh("5", {"Load programme/Stages=weave"}));
  for (const std::string limit : {"0.05", "1"})
    {
      const Run other = run(mesh("5",
                                 {"Load programme/Stages=weave",
                                  "Contact/Maximum penetration=" + limit}));
      CHECK(other.failure.empty());
      CHECK(other.curve.back().n[0] ==
            Approx(usual.curve.back().n[0]).epsilon(1e-9));
    }
  // A penalty that cannot keep the points within the limit.
  CHECK(run(mesh("3",
                 {"Load programme/Stages=weave",
                  "Contact/Normal penalty=1",
                  "Contact/Maximum penetration=0.01"}))
          .failure == "penetration too deep");
}



TEST_CASE(
  "Bundles that lie in each other end the run, whether contact is posed "
  "between them or not",
  "[top]")
{
  // Two wefts of a rib slide into one place.
  const Run rib = run(mesh("4",
                           {"Cell/Weave=ou/ou/uo/uo",
                            "Cell/Side contact=off",
                            "Load programme/Stages=weave"}));
  CHECK(rib.failure == "bundles overlap");
  CHECK(rib.curve.back().load_factor == 1.);

  // Hardly any contact stiffness.
  CHECK(run(mesh("3",
                 {"Contact/Normal penalty=0.3",
                  "Contact/Maximum penetration=1",
                  "Load programme/Stages=weave"}))
          .failure == "bundles overlap");
}



TEST_CASE("A load stage without weaving says that it tests straight bars",
          "[top]")
{
  const Run bars = run(mesh("3",
                            {"Load programme/Stages=shear",
                             "Load programme/Stage shear/Targets=H3: 0.01",
                             "Load programme/Stage shear/Initial step=1",
                             "Load programme/Stage shear/Maximum step=1"}));
  CHECK_THAT(bars.log, Catch::Contains("straight bars"));
}
