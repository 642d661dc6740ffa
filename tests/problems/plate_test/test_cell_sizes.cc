// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the head of the log and on the advice after a failure.

#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/failure_advice.h>

#include <catch2/catch.hpp>


using namespace NPT;
using Catch::Contains;

namespace
{
  PlateTestParameters
  read(const std::vector<std::string> &more = {})
  {
    std::vector<std::string> overrides = {"Mesh/Elements along=3",
                                          "Mesh/Elements across=3",
                                          "Mesh/Elements through=1"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    return PlateTestParameters::read(make_parameter_text("", "file.prm"),
                                     overrides);
  }

  std::string
  value(const PlateTestParameters &parameters, const std::string &name)
  {
    for (const auto &entry : describe_sizes(PlateCell(parameters), parameters))
      if (entry.first == name)
        return entry.second;
    return "none";
  }

  // Glass yarn.
  std::vector<std::string>
  stiff_yarn()
  {
    const std::string law = "Fiber bundle material/";
    return {law + "mu_iso=20",
            law + "lambda_iso=13.3333",
            law + "a_trn=0",
            law + "b_trn=0",
            law + "c_trn=4994",
            law + "d_trn=0",
            "Contact/Normal penalty=1000"};
  }

  std::string
  advice(const PlateTestParameters &parameters,
         const unsigned int         stage,
         const bool                 is_elliptic = true,
         const double               n1          = 0.)
  {
    const StageFailed failure(
      "", "line search failed", "", 0, 0, "lower the Minimum step");
    State state;
    state.reactions.assign(MacroModes::n, 0.);
    state.reactions[0] = n1;
    return advice_for(failure, parameters, stage, state, is_elliptic);
  }
} // namespace



TEST_CASE("Stiffness at rest is that of the engineering constants of a law",
          "[top]")
{
  const PlateTestParameters parameters =
    read({"Weft material/Law=neo-Hookean",
          "Weft material/Young modulus=30",
          "Weft material/Poisson ratio=0.2"});
  const EngineeringConstants fiber =
    FiberBundleConstants().engineering_constants();
  const StiffnessAtRest warp = stiffness_at_rest(parameters.material),
                        weft = stiffness_at_rest(parameters.weft_material);
  CHECK(warp.E_L == Approx(fiber.E_L));
  CHECK(warp.E_T == Approx(fiber.E_T));
  CHECK(warp.G_L == Approx(fiber.G_L));
  CHECK(warp.G_T == Approx(fiber.G_T));
  CHECK(weft.E_L == Approx(30.));
  CHECK(weft.E_T == Approx(30.));
  CHECK(weft.G_L == Approx(12.5));
  CHECK(weft.G_T == Approx(12.5));
  CHECK(penalty_over_stiffness(parameters) ==
        Approx(100. * 0.5 * 1.2 * (1. / fiber.E_T + 1. / 30.)));
}



TEST_CASE("The log begins with the sizes as they were understood", "[top]")
{
  const PlateTestParameters parameters = read({"Cell/Bundle thickness=1,2"});
  CHECK(value(parameters, "thickness") == "warp 1 mm, weft 2 mm");
  CHECK(value(parameters, "spacing") == "5 mm");
  CHECK_THAT(value(parameters, "cell"),
             Contains("sub-unit cell") && Contains("25 mm^2"));
  // Lens with blunt edges: area w (e + 2/3 (t/2 - e)) 2; two bundles of 5 mm
  // on 25 mm^2 of a layer of 3 mm.
  const double area_over_thickness = 4. * 2. * (0.1 + 2. / 3. * 0.4);
  const double percent =
    100. * 5. * area_over_thickness * (1. + 2.) / (25. * 3.);
  CHECK(std::stod(value(parameters, "bundles fill")) ==
        Approx(percent).epsilon(1e-3));
  CHECK_THAT(value(parameters, "bundles fill"), Contains("3 mm thick"));
}



TEST_CASE("Cells of one weave have one fraction of bundles in the layer",
          "[top]")
{
  for (const std::string type : {"two-crossing cell", "unit cell"})
    CHECK(std::stod(value(read({"Cell/Type=" + type}), "bundles fill")) ==
          Approx(std::stod(value(read(), "bundles fill"))));
}



TEST_CASE("After a failure in weaving, stiff bundles at fixed width are the "
          "cause that is named",
          "[top]")
{
  const PlateTestParameters stiff = read(stiff_yarn());
  CHECK_THAT(advice(stiff, 0),
             Contains("Targets = n1: 0, n2: 0 in stage weave"));
  CHECK_THAT(advice(stiff, 1), Contains("in stage weave")); // release
  // Not in a load stage, not where the width is free, not for soft bundles
  // unless they are under a large force.
  CHECK_THAT(advice(stiff, 2), !Contains("n1: 0"));
  auto free = stiff_yarn();
  free.push_back("Load programme/Stage weave/Targets=n1: 0, n2: 0");
  CHECK_THAT(advice(read(free), 0), !Contains("n1: 0"));
  CHECK(advice(read(), 0) == "lower the Minimum step");
  CHECK_THAT(advice(read(), 0, true, 10.),
             Contains("Targets = n1: 0 in stage weave") &&
               Contains("n1 = 10 N/mm"));
}



TEST_CASE(
  "A penalty far from the stiffness of the bundles is named in any unit",
  "[top]")
{
  CHECK_THAT(advice(read({"Contact/Normal penalty=1e5"}), 2),
             Contains("lower Normal penalty") &&
               Contains("order of 100 N/mm^3"));
  CHECK_THAT(advice(read({"Contact/Normal penalty=1"}), 2),
             Contains("raise Normal penalty") &&
               Contains("order of 100 N/mm^3"));
  // The first case with lengths in m and the same numbers of stress.
  CHECK_THAT(advice(read({"Contact/Normal penalty=1e8",
                          "Cell/Crossing spacing=5e-3",
                          "Cell/Bundle width=4e-3",
                          "Cell/Bundle thickness=1.2e-3"}),
                    2),
             Contains("lower Normal penalty") &&
               Contains("order of 100000 N/mm^3"));
}



TEST_CASE("Where ellipticity is lost nobody is sent after shorter steps",
          "[top]")
{
  CHECK_THAT(advice(read(), 2, false),
             Contains("lower the target") && Contains("ellipticity") &&
               !Contains("Minimum step"));
}



TEST_CASE("Automatic penalties are 50 times the stiffness of the bundles and "
          "scale with units",
          "[top]")
{
  const auto automatic = [](std::vector<std::string> more) {
    more.push_back("Contact/Automatic penalties=true");
    return read(more);
  };
  const PlateTestParameters p = automatic({"Contact/Normal penalty=7"});
  CHECK(penalty_over_stiffness(p) == Approx(50.).epsilon(1e-12));
  CHECK(p.friction.tangential_penalty == p.contact.normal_penalty);
  const PlateTestParameters thin =
    automatic({"Cell/Bundle thickness=0.6, 0.3"});
  CHECK(penalty_over_stiffness(thin) == Approx(50.).epsilon(1e-12));
  CHECK(thin.contact.normal_penalty / p.contact.normal_penalty ==
        Approx(1.2 / 0.45).epsilon(1e-12));
  CHECK(read({}).contact.normal_penalty == 100.);
}
