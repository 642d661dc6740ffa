// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims that the contact files of prm/verification can fail: each passes, and
// misses a tolerance as soon as a constant of the computed bodies is not the
// one of the exact solution. Files that take more than some seconds are run
// with fewer elements or steps and tolerances for these; as they are they run
// by `make verification` and `make verification_perturbed`.

#include <npt_dealii/verification/contact/contact_benchmark.h>
#include <npt_dealii/verification/contact/contact_case.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <sstream>

using namespace NPT;
namespace fs = std::filesystem;

namespace
{
  const fs::path folder = NPT_SOURCE_DIR "/prm/verification";

  /// How a file is run here.
  struct SmallRun
  {
    std::string              name;
    std::vector<std::string> changes;      ///< coarser, and its tolerances
    std::string              perturbation; ///< unknown to the exact solution
    std::string              missed;       ///< what it must change
  };

  const std::string stiffer = "Benchmark/Stiffness factor=1.05";
  const std::string rougher = "Benchmark/Friction factor=1.1";

  const std::vector<SmallRun> runs = {
    {"patch_matching", {}, stiffer, "displacement of the plate"},
    {"patch_nonmatching", {}, stiffer, "displacement of the plate"},
    {"block", {}, stiffer, "tangential force, maximum error"},
    {"block", {}, rougher, "force while slipping"},
    {"capstan", {}, rougher, "tension ratio T2/T1"},
    {"disc_twist", {"Benchmark/Load steps=5"}, rougher, "torque"},
    {"cylinders", {}, stiffer, "peak pressure"},
    // Four spans: errors of the peak pressure 2.2 and 3.5 % (8.8 and 10.3 % on
    // three, below 1 % in the files), to which 5 % of stiffness add 3.3 %. The
    // tolerances lie between.
    {"sphere",
     {"Upper body/Elements=4",
      "Benchmark/Body size=6",
      "Benchmark/Span growth=3",
      "Tolerances/Peak pressure=3.5 %",
      "Tolerances/Half axis along x=0.5 %",
      "Tolerances/Half axis along y=0.5 %",
      "Tolerances/Pressure profile, L2=0.13"},
     stiffer,
     "peak pressure"},
    {"crossed_cylinders",
     {"Upper body/Elements=4",
      "Lower body/Elements=4",
      "Benchmark/Body size=6",
      "Benchmark/Span growth=3",
      "Tolerances/Peak pressure=5 %",
      "Tolerances/Half axis along x=0.5 %",
      "Tolerances/Half axis along y=0.5 %",
      "Tolerances/Pressure profile, L2=0.13"},
     stiffer,
     "peak pressure"},
    {"partial_slip",
     {"Upper body/Elements=6",
      "Lower body/Elements=6",
      "Benchmark/Body size=8",
      "Benchmark/Span growth=3",
      "Benchmark/Load steps=3",
      "Tolerances/Peak pressure=0.8 %",
      "Tolerances/Pressure profile, L2=0.06",
      // 0.109 with friction at Gauss points.
      "Tolerances/Traction profile, L2=0.12",
      // Known to half a span, a/12 = c/6.
      "Tolerances/Stick half width=17 %"},
     rougher,
     "loss per cycle"},
    {"sphere_twist",
     {"Upper body/Elements=3",
      "Benchmark/Body size=8",
      "Benchmark/Span growth=3",
      "Benchmark/Load steps=2",
      "Tolerances/Peak pressure=10 %",
      // Off by 1.9 %, and by 4.6 % with the other friction.
      "Tolerances/Torque=3 %",
      // Three spans do not resolve the sticking zone.
      "Tolerances/Stick radius=none"},
     rougher,
     "torque"},
    {"ironing",
     {"Benchmark/Load steps=12",
      "Benchmark/Distance=0.2",
      "Benchmark/Span growth=3",
      "Benchmark/Body size=4",
      "Upper body/Elements=3"},
     rougher,
     "force ratio Q/P"}};

  fs::path
  file_of(const std::string &name)
  {
    return folder / ("contact_" + name + ".prm");
  }

  /// What run() says of missed tolerances; empty if none is missed. Any other
  /// failure is an error of the test.
  std::string
  misses_of(const SmallRun &run, std::vector<std::string> overrides)
  {
    overrides.insert(overrides.begin(), run.changes.begin(), run.changes.end());
    std::ostringstream screen;
    ContactBenchmark   benchmark(
      ContactBenchmarkParameters::read(read_parameter_text(file_of(run.name)),
                                       overrides),
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



TEST_CASE("Every contact file passes, and fails when stiffness or friction is "
          "not that of its exact solution",
          "[verification]")
{
  std::string last;
  for (const SmallRun &run : runs)
    {
      INFO(run.name + " " + run.perturbation);
      if (run.name != last)
        CHECK(misses_of(run, {}) == "");
      last = run.name;
      CHECK_THAT(misses_of(run, {run.perturbation}),
                 Catch::Contains(run.missed + " is "));
    }
}



TEST_CASE("Every contact file has a tolerance for every compared quantity and "
          "is run above",
          "[verification]")
{
  unsigned int n_files = 0;
  for (const auto &entry : fs::directory_iterator(folder))
    {
      const std::string stem = entry.path().stem().string();
      if (stem.compare(0, 8, "contact_") != 0)
        continue;
      INFO(stem);
      const auto parameters =
        ContactBenchmarkParameters::read(read_parameter_text(entry.path()));
      const auto &contact_case =
        *ContactCases::instance().get(parameters.benchmark.name);
      for (const ComparedQuantity &quantity : all_quantities(contact_case))
        if (quantity.has_exact_value)
          {
            INFO(quantity.name);
            CHECK(parameters.tolerances.count(quantity.name) == 1);
          }
      CHECK(std::any_of(runs.begin(), runs.end(), [&](const SmallRun &run) {
        return file_of(run.name) == entry.path();
      }));
      ++n_files;
    }
  CHECK(n_files == 11);
}
