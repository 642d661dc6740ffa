// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact against exact solutions: small versions of the verification runs in
// prm/verification, and what is special in them.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/contact_benchmark.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <sstream>

namespace
{
  using namespace NPT;

  // Those of the files are for their meshes; these tests have their own.
  ContactBenchmarkParameters
  without_tolerances(ContactBenchmarkParameters parameters)
  {
    parameters.tolerances.clear();
    return parameters;
  }

  std::unique_ptr<ContactBenchmark>
  run(const ParameterText &text, const std::vector<std::string> &overrides)
  {
    static std::ostringstream screen;
    auto                      benchmark = std::make_unique<ContactBenchmark>(
      without_tolerances(ContactBenchmarkParameters::read(text, overrides)),
      "",
      screen);
    benchmark->run();
    // Action equals reaction in every benchmark: contact forces have neither a
    // resultant nor a moment, to round-off.
    CHECK(benchmark->comparison("force imbalance of contact").computed < 1e-13);
    CHECK(benchmark->comparison("moment imbalance of contact").computed <
          1e-13);
    return benchmark;
  }

  // A verification run, with changes.
  std::unique_ptr<ContactBenchmark>
  run_file(const std::string              &name,
           const std::vector<std::string> &overrides = {})
  {
    return run(read_parameter_text(NPT_SOURCE_DIR "/prm/verification/contact_" +
                                   name + ".prm"),
               overrides);
  }

  std::string
  message_of(const std::vector<std::string> &overrides)
  {
    try
      {
        ContactBenchmarkParameters::read(ParameterText(), overrides);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no InputError";
  }
} // namespace



TEST_CASE("The contact patch test is passed to round-off on matching meshes",
          "[top]")
{
  for (const std::string method : {"mortar", "KTS"})
    {
      const auto patch = run_file("patch_matching",
                                  {"Contact/Method=" + method,
                                   "Upper body/Elements=2",
                                   "Lower body/Elements=2"});
      CHECK(patch->comparison("stress error, maximum").computed < 1e-10);
      CHECK(patch->comparison("contact pressure error").computed < 1e-10);
      // The penalty adds p/epsilon to the approach, and nothing else.
      CHECK(std::abs(patch->comparison("displacement of the plate").error()) <
            1e-10);
    }
}



TEST_CASE("On meshes that do not match, the patch test fails by the quadrature "
          "of the secondary surface only",
          "[top]")
{
  for (const std::string method : {"mortar", "KTS"})
    {
      const auto error = [&](const std::string &n_points) {
        return run_file("patch_nonmatching",
                        {"Contact/Method=" + method,
                         "Contact/Quadrature points=" + n_points})
          ->comparison("stress error, maximum")
          .computed;
      };
      const double coarse = error("3"), fine = error("12");
      CHECK(coarse < 0.02);
      // Kinks of the second derivatives inside a secondary span: the error
      // falls with a power of the points, not exponentially.
      CHECK(fine < 0.1 * coarse);
    }
}



TEST_CASE("A block sticks, slips and reverses as computed by hand", "[top]")
{
  for (const std::string method : {"mortar", "KTS"})
    {
      const auto block = run_file("block",
                                  {"Contact/Method=" + method,
                                   "Upper body/Elements=1",
                                   "Lower body/Elements=1",
                                   "Benchmark/Load steps=7"});
      CHECK(block->comparison("tangential force, maximum error").computed <
            1e-10);
      CHECK(std::abs(block->comparison("dissipation").error()) < 1e-9);
    }
}



TEST_CASE("Two cylinders have Hertz' pressure and half width, and the error of "
          "the penalty falls with its inverse",
          "[top]")
{
  const auto cylinders = [](const std::string &penalty,
                            const std::string &method) {
    return run_file("cylinders",
                    {"Upper body/Elements=5",
                     "Lower body/Elements=4",
                     "Benchmark/Span growth=2.5",
                     "Contact/Normal penalty=" + penalty,
                     "Contact/Method=" + method});
  };
  const auto fine = cylinders("1e7", "mortar");
  CHECK(std::abs(fine->comparison("peak pressure").error()) < 0.01);
  CHECK(std::abs(fine->comparison("half width").error()) < 0.01);
  const auto KTS = cylinders("1e7", "KTS");
  CHECK(std::abs(KTS->comparison("peak pressure").error()) < 0.01);
  CHECK(std::abs(KTS->comparison("half width").error()) < 0.01);

  const auto approach = [&](const std::string &penalty) {
    return cylinders(penalty, "mortar")
      ->comparison("approach of the plates")
      .computed;
  };
  const double first = approach("2e6"), second = approach("4e6");
  const double exact  = fine->comparison("approach of the plates").computed;
  const double rest_1 = first - exact, rest_2 = second - exact;
  // Against 1e7: (1/2 - 1/10)/(1/4 - 1/10) for first order.
  CHECK(rest_1 / rest_2 == Approx(0.4 / 0.15).epsilon(0.05));
}



TEST_CASE("A slipping belt multiplies its tension by exp(mu theta)", "[top]")
{
  for (const std::string method : {"mortar", "KTS"})
    {
      const auto belt = run_file("capstan",
                                 {"Contact/Method=" + method,
                                  "Upper body/Elements=40",
                                  "Benchmark/Load steps=5"});
      CHECK(belt->comparison("sticking nodes").computed == 0.);
      CHECK(std::abs(belt->comparison("tension ratio T2/T1").error()) < 0.01);
      CHECK(std::abs(
              belt->comparison("T2/T1 of a belt of this thickness").error()) <
            0.005);
    }
}



TEST_CASE("The torque of a slipping disc is 2/3 mu P R pointwise; mortar "
          "averages lose part of the spin, less on finer meshes",
          "[top]")
{
  const auto error = [](const std::string &method, const std::string &n) {
    return run_file("disc_twist",
                    {"Contact/Method=" + method,
                     "Upper body/Elements=" + n,
                     "Benchmark/Load steps=2"})
      ->comparison("torque")
      .error();
  };
  CHECK(std::abs(error("KTS", "8")) < 1e-3);
  const double coarse = error("mortar", "4"), fine = error("mortar", "8");
  CHECK(coarse < 0.);
  CHECK(std::abs(coarse) < 0.1);
  CHECK(std::abs(fine) < 0.4 * std::abs(coarse));
}



TEST_CASE("Contact benchmarks that cannot be built are refused with a sentence",
          "[top]")
{
  CHECK(message_of({"Benchmark/Body size=100"}) ==
        "Half width times Body size is 1 mm; the body must end before 0.9 of "
        "its radius of 1 mm (subsections Benchmark and Upper body).");
  CHECK(message_of({"Upper body/Poisson ratio=0.5"}) ==
        "Poisson ratio is 0.5; it must be above -1 and below 0.5, where the "
        "material is incompressible (subsection Upper body).");
  CHECK(message_of({"Benchmark/Case=partial slip", "Lower body/Radius=2"}) ==
        "The bodies differ; the exact solution of partial slip needs equal "
        "materials and radii (subsections Upper body and Lower body).");
  CHECK(
    message_of({"Benchmark/Case=capstan", "Benchmark/Thickness=0.3"}) ==
    "Thickness is 0.3 mm; a belt must be thinner than a fifth of the radius "
    "of the drum, 1 mm (subsections Benchmark and Lower body).");
  CHECK(
    message_of({"Benchmark/Case=ironing", "Benchmark/Distance=1e300"}) ==
    "Distance is 1e+300 mm, for which the slab would have 8e+302 elements along "
    "it; it may have at most 100000, which suffice for 124.2 mm (subsections "
    "Benchmark and Lower body).");
  CHECK(
    message_of({"Benchmark/Case=block", "Friction/Friction coefficient=0"}) ==
    "Friction coefficient is 0; this case is about friction and needs a "
    "positive one (subsections Benchmark and Friction).");
  CHECK_THAT(message_of({"Benchmark/Case=hertz"}), Catch::Contains("Case"));
  CHECK(message_of({"Tolerances/Peak pressure=small"}) ==
        "Peak pressure is 'small'; it must be none, a number >= 0, or one in "
        "per cent like 1 % (subsection Tolerances).");
  // What is compared depends on the case.
  CHECK_THAT(message_of({"Benchmark/Case=block", "Tolerances/Half width=1 %"}),
             Catch::Contains("unknown entry 'Half width'"));
}
