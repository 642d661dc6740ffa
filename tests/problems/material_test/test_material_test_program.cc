// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about material tests and identification as a user runs them: the
// parameter files in prm/, exit status, and messages.

#include <catch2/catch.hpp>

#include "run_program.h"

using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  const std::string nmt      = NPT_SOURCE_DIR "/prm/nmt.prm";
  const std::string identify = NPT_SOURCE_DIR "/prm/identify.prm";

  std::string
  set(const std::string &entry)
  {
    return "--set=" + entry;
  }
} // namespace



TEST_CASE("The chain from fibers to a plate's material runs from files",
          "[top]")
{
  const fs::path folder = fresh_folder("material_test_chain");
  const auto     tests  = run_program(folder,
                                 {nmt,
                                       set("Micro mesh/Elements around=3"),
                                       set("Micro mesh/Elements in fiber=1"),
                                       set("Micro mesh/Elements in matrix=1")});
  INFO(tests.err);
  REQUIRE(tests.status == 0);
  CHECK(fs::exists(folder / "output-nmt/bundle_material.prm"));
  const auto fit = run_program(folder, {identify});
  INFO(fit.err);
  REQUIRE(fit.status == 0);
  CHECK(fs::exists(folder / "output-identify/fit.csv"));
  CHECK_THAT(fit.out, Catch::Contains("95 %"));

  // What the plate test includes.
  std::ofstream(folder / "plate.prm")
    << "include output-identify/bundle_material.prm\n";
  CHECK(run_program(folder, {"plate.prm", "--validate"}).status == 0);
}



TEST_CASE("The whole chain takes less than 60 s of CPU time", "[top][.slow]")
{
  // With the mesh and the steps of prm/nmt.prm.
  const fs::path folder = fresh_folder("material_test_time");
  for (const std::string packing : {"square", "hexagonal"})
    {
      const auto run =
        run_program(folder, {nmt, set("Micro cell/Packing=" + packing)});
      REQUIRE(run.status == 0);
      const std::string text = "CPU time ";
      const auto        at   = run.out.find(text);
      REQUIRE(at != std::string::npos);
      CHECK(std::stod(run.out.substr(at + text.size())) < 60.);
    }
}



TEST_CASE("Unusable material tests end with status 2 and one sentence", "[top]")
{
  const fs::path folder = fresh_folder("material_test_errors");
  const auto     error  = [&](const std::vector<std::string> &arguments) {
    const auto run = run_program(folder, arguments);
    CHECK(run.status == 2);
    return run.err;
  };
  CHECK_THAT(error({nmt, set("Micro cell/Volume fraction=0.8")}),
             Catch::Contains("Volume fraction is 0.8") &&
               Catch::Contains("smaller than 0.785398"));
  CHECK_THAT(error({nmt, set("Micro cell/Fiber radius=0.6")}),
             Catch::Contains("touch or overlap"));
  std::ofstream(folder / "few.csv") << "H11,P11\n0.1,2\n0.2,3\n";
  CHECK_THAT(error({identify, set("Data/Files=few.csv")}),
             Catch::Contains("2 stress values, fewer than the six"));
  std::ofstream(folder / "wrong.prm") << "set Problem = materials test\n";
  CHECK_THAT(error({"wrong.prm"}),
             Catch::Contains("Problem is 'materials test'") &&
               Catch::Contains("did you mean 'material test'"));
}
