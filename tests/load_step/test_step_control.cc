// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the step control.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/step_control.h>

#include <catch2/catch.hpp>

#include <vector>

using namespace NPT;

namespace
{
  StepParameters
  steps(const double initial, const double minimum, const double maximum)
  {
    StepParameters parameters;
    parameters.initial_step = initial;
    parameters.minimum_step = minimum;
    parameters.maximum_step = maximum;
    return parameters;
  }

  const unsigned int easy = 4, hard = 20; // Newton iterations; target is 8
} // namespace

TEST_CASE("n steps of 1/n land exactly on k/n and on 1", "[solver]")
{
  const unsigned int n = GENERATE(1, 3, 7, 10, 20, 49, 1000);
  StepControl        control(steps(1. / n, 1e-6, 1. / n));
  for (unsigned int k = 1; k <= n; ++k)
    {
      REQUIRE_FALSE(control.finished());
      REQUIRE(control.trial() == static_cast<double>(k) / n);
      control.accept(easy);
      REQUIRE(control.load_factor() == static_cast<double>(k) / n);
    }
  CHECK(control.finished());
  CHECK(control.load_factor() == 1.);
  CHECK(control.n_accepted() == n);
}

TEST_CASE("A step that does not divide the stage leaves no sliver", "[solver]")
{
  StepControl control(steps(0.3, 1e-3, 0.3));
  for (const double factor : {0.25, 0.5, 0.75, 1.})
    {
      CHECK(control.trial() == factor);
      control.accept(easy);
    }
  CHECK(control.finished());
}

TEST_CASE("A cut halves the step, success brings it back to the old factors",
          "[solver]")
{
  StepControl control(steps(0.1, 1e-3, 0.1));
  control.accept(easy);
  CHECK(control.trial() == 0.2);
  control.reject(InvertedCell("cell 7"));
  CHECK(control.trial() == Approx(0.15));
  CHECK(control.load_factor() == 0.1);
  control.reject(InvertedCell("cell 7"));
  CHECK(control.trial() == Approx(0.125));
  CHECK(control.n_cuts() == 2);
  for (const double factor : {0.125, 0.15, 0.2, 0.3, 0.4})
    {
      CHECK(control.trial() == Approx(factor).epsilon(1e-15));
      control.accept(easy);
    }
  CHECK(control.load_factor() == 0.4);
}

TEST_CASE("The step grows only after easy steps and never above the maximum",
          "[solver]")
{
  StepControl control(steps(0.05, 1e-3, 0.15));
  control.accept(hard);
  control.accept(hard);
  CHECK(control.step() == Approx(0.05));
  control.accept(easy); // at 0.15, no multiple of 0.1
  CHECK(control.step() == Approx(0.05));
  control.accept(easy); // at 0.2
  CHECK(control.step() == Approx(0.1));
  while (!control.finished())
    {
      CHECK(control.step() <= 0.15);
      control.accept(easy);
    }
  CHECK(control.load_factor() == 1.);
}

TEST_CASE("Any history of cuts and growth ends exactly at 1", "[solver]")
{
  for (unsigned int seed = 1; seed <= 50; ++seed)
    {
      StepControl  control(steps(0.07, 1e-6, 0.5));
      unsigned int random = seed;
      double       last   = 0;
      for (unsigned int k = 0; !control.finished() && k < 10000; ++k)
        {
          REQUIRE(control.trial() > last);
          REQUIRE(control.trial() <= 1);
          random = 1664525 * random + 1013904223;
          if (control.step() > 1e-4 && (random >> 16) % 3 == 0)
            control.reject(LoadStepFailure("test", ""));
          else
            control.accept((random >> 20) % 16);
          last = control.load_factor();
        }
      REQUIRE(control.finished());
      REQUIRE(control.load_factor() == 1.);
    }
}

TEST_CASE("A stage that is given up names the place, the reason and a remedy",
          "[solver]")
{
  StepControl control(steps(0.1, 0.02, 0.1), "shear");
  control.accept(easy);
  control.reject(InvertedCell("cell 7"));
  control.reject(ProjectionLost("point 3"));
  try
    {
      control.reject(NewtonStalled("active set cycling", "Period 2."));
      FAIL("not given up");
    }
  catch (const StageFailed &failure)
    {
      const std::string text = failure.what();
      CHECK_THAT(text, Catch::Contains("Stage shear"));
      CHECK_THAT(text, Catch::Contains("load factor 0.1"));
      CHECK_THAT(text, Catch::Contains("active set cycling"));
      CHECK_THAT(text, Catch::Contains("3 failed steps"));
      CHECK_THAT(text, Catch::Contains("penalties"));
    }
  CHECK(control.load_factor() == 0.1);
}



TEST_CASE("The remedy is that of the failure, not of its name", "[load_step]")
{
  const auto message_after = [](const LoadStepFailure &failure) {
    StepControl control(steps(1., 1., 1.), "shear");
    try
      {
        control.reject(failure);
      }
    catch (const StageFailed &given_up)
      {
        return std::string(given_up.what());
      }
    return std::string("not given up");
  };
  CHECK_THAT(message_after(LinearSolverFailed("singular")),
             Catch::Contains("bodies that nothing holds"));
  CHECK_THAT(message_after(EllipticityLost("bundle 2")),
             Catch::Contains("lower the target"));
  CHECK_THAT(message_after(NewtonNotConverged("iteration limit", "")),
             Catch::Contains("Maximum iterations"));
  // The name of another failure in the detail does not mislead.
  CHECK_THAT(message_after(ProjectionLost("beside an inverted cell: 3")),
             Catch::Contains("Minimum step"));
}



TEST_CASE("What no shorter step mends ends the stage at once", "[load_step]")
{
  StepControl control(steps(0.1, 1e-4, 0.1), "shear");
  control.accept(easy);
  try
    {
      control.reject_for_good(OutOfMemory("MUMPS"));
    }
  catch (const StageFailed &failure)
    {
      CHECK(failure.reason() == "out of memory");
      CHECK(failure.load_factor() == 0.1);
      CHECK(failure.n_cuts() == 1);
      CHECK_THAT(failure.what(),
                 Catch::Contains("coarser mesh") &&
                   !Catch::Contains("Minimum step"));
    }
}
