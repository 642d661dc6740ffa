// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims that the files of prm/verification on solids can fail: each passes,
// and misses a tolerance if the law of the body is five per cent stiffer than
// that of the exact solution. All run with fewer meshes, degrees and bases; as
// they are they run by `make verification` and `make verification_perturbed`.

#include <npt_dealii/verification/comparison.h>
#include <npt_dealii/verification/solids/solid_benchmark.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

using namespace NPT;
namespace fs = std::filesystem;

namespace
{
  const fs::path parameter_files = NPT_SOURCE_DIR "/prm/verification";

  struct SmallRun
  {
    std::string              name;
    std::vector<std::string> changes; ///< coarser, and its tolerances
    std::string              missed;
  };

  const std::vector<SmallRun> runs = {
    {"cylinder",
     {"Benchmark/Degrees=2", "Benchmark/Elements=4, 8"},
     "NURBS, p = 2: rate"},
    {"cylinder_c0",
     {"Benchmark/Degrees=3", "Benchmark/Elements=4, 8"},
     "Bernstein, p = 3: rate"},
    {"sphere",
     {"Benchmark/Degrees=2", "Benchmark/Elements=8, 12"},
     "NURBS, p = 2: rate"},
    {"sphere_c0",
     {"Benchmark/Bases=Bernstein",
      "Benchmark/Degrees=2",
      "Benchmark/Elements=4, 6"},
     "Bernstein, p = 2: rate"},
    {"plate_with_hole",
     {"Benchmark/Bases=Bernstein",
      "Benchmark/Degrees=3",
      "Benchmark/Elements=8, 12"},
     "Bernstein, p = 3: rate"},
    // In the L2 norm the rate is still 3.3.
    {"plate_with_hole_p2",
     {"Benchmark/Bases=NURBS",
      "Benchmark/Elements=8, 16",
      "Benchmark/Tolerance of rates=0.5"},
     "NURBS, p = 2: rate"},
    {"homogeneous_neo_hookean",
     {"Benchmark/Degrees=2", "Benchmark/Bases=NURBS, Lagrange"},
     "error of the average stress"},
    {"homogeneous_fiber_bundle",
     {"Benchmark/Degrees=2", "Benchmark/Bases=NURBS"},
     "error of the average stress"}};

  std::string
  misses_of(const SmallRun &run, std::vector<std::string> overrides)
  {
    overrides.insert(overrides.begin(), run.changes.begin(), run.changes.end());
    std::ostringstream screen;
    SolidBenchmark     benchmark(
      SolidBenchmarkParameters::read(
        read_parameter_text(parameter_files / (run.name + ".prm")), overrides),
      "",
      screen);
    try
      {
        benchmark.run();
      }
    catch (const ToleranceMissed &error)
      {
        return error.what();
      }
    return "";
  }
} // namespace



TEST_CASE("Every file on solids passes, and fails when the law is not that of "
          "its exact solution",
          "[verification]")
{
  for (const SmallRun &run : runs)
    {
      INFO(run.name);
      CHECK(misses_of(run, {}) == "");
      CHECK_THAT(misses_of(run, {"Benchmark/Stiffness factor=1.05"}),
                 Catch::Contains(run.missed));
    }
}



TEST_CASE("Every file on solids names its tolerances and is run above",
          "[verification]")
{
  unsigned int n_files = 0;
  for (const auto &entry : fs::directory_iterator(parameter_files))
    {
      const std::string stem = entry.path().stem().string();
      if (stem.compare(0, 8, "contact_") == 0)
        continue;
      INFO(stem);
      const auto text = read_parameter_text(entry.path());
      if (SolidBenchmarkParameters::read(text).name == "block")
        {
          CHECK(get_entry(text, {}, "Homogeneous states/Tolerance"));
          CHECK(get_entry(text, {}, "Homogeneous states/Tolerance at a point"));
        }
      else
        CHECK(get_entry(text, {}, "Benchmark/Tolerance of rates"));
      CHECK(std::any_of(runs.begin(), runs.end(), [&](const SmallRun &run) {
        return run.name == stem;
      }));
      ++n_files;
    }
  CHECK(n_files == 8);
}
