// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the Newton loop.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/newton.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using namespace NPT;
using dealii::Vector;

namespace
{
  /// One equation f(x) = 0 with derivative df; scale 1 N.
  NewtonProblem
  scalar_problem(const std::function<double(double)> &f,
                 const std::function<double(double)> &df)
  {
    auto          slope = std::make_shared<double>(0.);
    NewtonProblem problem;
    problem.residual = [=](const Vector<double> &x, Vector<double> &r) {
      r[0] = f(x[0]);
    };
    problem.prepare_tangent = [=](const Vector<double> &x) {
      *slope = df(x[0]);
    };
    problem.solve = [=](const Vector<double> &rhs, Vector<double> &dx) {
      dx[0] = rhs[0] / *slope;
    };
    problem.force_scale = []() { return 1.; };
    return problem;
  }

  Vector<double>
  start(const double x)
  {
    Vector<double> v(1);
    v[0] = x;
    return v;
  }

  std::string
  failure_reason(const NewtonParameters &parameters,
                 const NewtonProblem    &problem,
                 Vector<double>          x)
  {
    try
      {
        solve_newton(parameters, problem, x);
      }
    catch (const LoadStepFailure &failure)
      {
        return failure.reason();
      }
    return "none";
  }
} // namespace

TEST_CASE("Newton converges quadratically on a smooth system", "[solver]")
{
  // Two springs with cubic stiffening; every x is compared with its callback.
  Vector<double> x(2), last_x(2);
  double         K[2][2];
  bool           same_x = true;
  NewtonProblem  problem;
  problem.residual = [&](const Vector<double> &at, Vector<double> &r) {
    last_x = at;
    r[0]   = at[0] + at[0] * at[0] * at[0] + (at[0] - at[1]) - 2;
    r[1]   = at[1] * at[1] * at[1] + (at[1] - at[0]) - 1;
  };
  problem.prepare_tangent = [&](const Vector<double> &at) {
    same_x  = same_x && at == last_x;
    K[0][0] = 2 + 3 * at[0] * at[0];
    K[0][1] = K[1][0] = -1;
    K[1][1]           = 1 + 3 * at[1] * at[1];
  };
  problem.solve = [&](const Vector<double> &rhs, Vector<double> &dx) {
    const double det = K[0][0] * K[1][1] - K[0][1] * K[1][0];
    dx[0]            = (K[1][1] * rhs[0] - K[0][1] * rhs[1]) / det;
    dx[1]            = (K[0][0] * rhs[1] - K[1][0] * rhs[0]) / det;
  };
  problem.force_scale   = []() { return 3.; };
  problem.state_summary = []() { return "2 springs"; };

  NewtonParameters parameters;
  parameters.relative_tolerance = 1e-10;
  parameters.keep_tangent       = false;
  const NewtonReport report     = solve_newton(parameters, problem, x);
  CHECK(report.converged);
  CHECK(report.n_tangents == report.iterations);
  CHECK(report.force_scale == 3);
  CHECK(report.residual_norms.size() == report.iterations + 1);
  CHECK(report.state_summaries.size() == report.iterations + 1);
  CHECK(report.residual_norms.back() <= 3e-10);
  CHECK(report.order() >= 1.9);
  CHECK(same_x);
}

TEST_CASE("Kept tangents lead to the same solution from fewer tangents",
          "[solver]")
{
  const NewtonProblem problem =
    scalar_problem([](double x) { return x + 0.1 * x * x - 2.; },
                   [](double x) { return 1. + 0.2 * x; });
  NewtonParameters parameters;
  parameters.relative_tolerance = 1e-10;
  Vector<double>     kept       = start(1.6);
  const NewtonReport report     = solve_newton(parameters, problem, kept);
  parameters.keep_tangent       = false;
  Vector<double>     renewed    = start(1.6);
  const NewtonReport reference  = solve_newton(parameters, problem, renewed);

  CHECK(report.converged);
  CHECK(report.n_tangents == 1);
  CHECK(reference.n_tangents == 3);
  CHECK(kept[0] == Approx(renewed[0]).epsilon(1e-10));
  // A series of corrections with a kept tangent is one iteration.
  CHECK(report.iterations == 2);
  CHECK(report.residual_norms.size() == report.kept_tangent.size() + 1);
  CHECK(std::isnan(report.order()));
  // What is left of the error is not squared away by the last correction.
  CHECK(report.residual_norms.back() <= 1e-11);
}

TEST_CASE("A kept tangent is renewed behind a kink", "[solver]")
{
  // The slope falls to a tenth at x = 1.95: the tangent before it, which has
  // led near the solution at x = 2, converges too slowly to be kept.
  const auto force = [](double x) {
    return x < 1.95 ? x + 0.01 * x * x :
                      1.95 + 0.01 * 1.95 * 1.95 + 0.1 * (x - 1.95);
  };
  const NewtonProblem problem =
    scalar_problem([&](double x) { return force(x) - force(2.); },
                   [](double x) { return x < 1.95 ? 1. + 0.02 * x : 0.1; });
  Vector<double>     x      = start(1.5);
  const NewtonReport report = solve_newton({}, problem, x);
  CHECK(report.converged);
  CHECK(x[0] == Approx(2.).epsilon(1e-6));
  CHECK(report.n_tangents >= 2);
}

TEST_CASE("A start that is a solution needs no tangent", "[solver]")
{
  NewtonProblem problem =
    scalar_problem([](double x) { return x; }, [](double) { return 1.; });
  problem.prepare_tangent = [](const Vector<double> &) {
    FAIL("tangent without need");
  };
  Vector<double>     x      = start(1e-8);
  const NewtonReport report = solve_newton({}, problem, x);
  CHECK(report.converged);
  CHECK(report.iterations == 0);
  CHECK(std::isnan(report.order()));

  problem.force_scale = []() { return 0.; };
  SECTION("Where all forces vanish, round-off of the force unit is enough")
  {
    problem.force_unit = 1e4;
    x                  = start(0.9e-10);
    CHECK(solve_newton({}, problem, x).converged);
  }
  SECTION("Where all forces vanish, the absolute tolerance is enough")
  {
    NewtonParameters parameters;
    parameters.absolute_tolerance = 1e-10;
    x                             = start(0.9e-10);
    CHECK(solve_newton(parameters, problem, x).converged);
  }
  SECTION("The norm is the one of the problem")
  {
    problem.norm       = [](const Vector<double> &) { return 1e-11; };
    problem.force_unit = 1e4;
    x                  = start(1.);
    CHECK(solve_newton({}, problem, x).iterations == 0);
  }
}

TEST_CASE("The order leaves out a last residual of round-off", "[solver]")
{
  NewtonReport report;
  report.force_scale    = 1;
  report.residual_norms = {1e-1, 1e-3, 1e-7, 1e-15};
  CHECK(report.order() == Approx(2.));
  report.residual_norms = {1e-2, 1e-6, 1e-15};
  CHECK(std::isnan(report.order()));
}

TEST_CASE("The line search rescues what plain Newton lets diverge", "[solver]")
{
  const auto problem = scalar_problem([](double x) { return std::atan(x); },
                                      [](double x) { return 1 / (1 + x * x); });
  NewtonParameters parameters;
  parameters.nonmonotone_memory = GENERATE(1, 3);
  Vector<double>     x          = start(3);
  const NewtonReport report     = solve_newton(parameters, problem, x);
  CHECK(report.converged);
  CHECK(report.n_line_search_cuts > 0);
  CHECK(std::abs(x[0]) < 1e-7);

  parameters.line_search = false;
  CHECK(failure_reason(parameters, problem, start(3)) != "none");
}

TEST_CASE("A non-monotone step is taken where a monotone one is cut",
          "[solver]")
{
  // A force with kinks, as where contact opens: coming from the soft side the
  // full step to the stiff side raises the residual once (10, 0.91, 4.8) and
  // leads to the solution x = -0.01.
  const auto problem = scalar_problem(
    [](double x) {
      return x > 1 ? 1 + 9 * (x - 1) : x > 0 ? 0.2 + 0.8 * x : 0.2 + 20 * x;
    },
    [](double x) { return x > 1 ? 9. :
                          x > 0 ? 0.8 :
                                  20.; });

  NewtonParameters parameters;
  parameters.keep_tangent = false;
  Vector<double> x        = start(2);
  auto           report   = solve_newton(parameters, problem, x);
  CHECK(x[0] == Approx(-0.01));
  CHECK(report.n_line_search_cuts == 0);
  CHECK(report.iterations == 3);
  CHECK(report.residual_norms[2] > report.residual_norms[1]);

  parameters.nonmonotone_memory = 1;
  x                             = start(2);
  report                        = solve_newton(parameters, problem, x);
  CHECK(x[0] == Approx(-0.01));
  CHECK(report.n_line_search_cuts > 0);
  CHECK(report.iterations > 3);
}

TEST_CASE("Cycles of period two and three are recognized", "[solver]")
{
  NewtonParameters parameters;
  parameters.line_search = false;
  SECTION("two: 0 -> 1 -> 0 of a cubic")
  {
    const auto problem =
      scalar_problem([](double x) { return x * x * x - 2 * x + 2; },
                     [](double x) { return 3 * x * x - 2; });
    CHECK(failure_reason(parameters, problem, start(0)) ==
          "active set cycling");
  }
  SECTION("three: 1 -> 2 -> 4 -> 1")
  {
    const auto problem =
      scalar_problem([](double x) { return x; },
                     [](double x) { return x < 3 ? -1 : 4. / 3; });
    CHECK(failure_reason(parameters, problem, start(1)) ==
          "active set cycling");
  }
  SECTION("the line search breaks a cycle, 1.39 -> -1.39 of an arctangent")
  {
    const auto problem =
      scalar_problem([](double x) { return std::atan(x); },
                     [](double x) { return 1 / (1 + x * x); });
    const double x0 = 1.3917452002707349; // atan x = 2 x / (1 + x^2)
    CHECK(failure_reason(parameters, problem, start(x0)) == "stagnated");
    parameters.line_search = true;
    Vector<double> x       = start(x0);
    CHECK(solve_newton(parameters, problem, x).converged);
    CHECK(std::abs(x[0]) < 1e-7);
  }
  SECTION("a constant residual is stagnation")
  {
    const auto problem = scalar_problem([](double x) { return 1 + 1e-9 * x; },
                                        [](double) { return 1.; });
    CHECK(failure_reason(parameters, problem, start(0)) == "stagnated");
  }
}

TEST_CASE("A correction is shortened where they jump to and fro", "[solver]")
{
  // Full corrections of sign(x) |x|^p lead from x to -0.98 x: norms
  // fall by 1 % each, which the line search accepts 1400 times.
  const double p       = 0.505;
  const auto   problem = scalar_problem(
    [p](double x) { return std::copysign(std::pow(std::abs(x), p), x); },
    [p](double x) { return p * std::pow(std::abs(x), p - 1); });
  NewtonParameters parameters;
  parameters.relative_tolerance = 1e-6;
  parameters.max_iterations     = 150;
  Vector<double>     x          = start(1);
  const NewtonReport report     = solve_newton(parameters, problem, x);
  CHECK(report.converged);
  CHECK(report.n_line_search_cuts == 0);
  CHECK(std::abs(x[0]) < 1e-11);
}

TEST_CASE("Only an iteration about to converge exceeds its limit", "[solver]")
{
  // A tangent off by a constant factor leaves this part of each residual.
  const double part = GENERATE(0.08, 0.2);
  const auto   problem =
    scalar_problem([](double x) { return x; },
                   [part](double) { return 1 / (1 - part); });
  NewtonParameters parameters;
  parameters.keep_tangent       = false;
  parameters.max_iterations     = 8;
  parameters.relative_tolerance = std::pow(part, 9.5); // after ten corrections
  CHECK(failure_reason(parameters, problem, start(1)) ==
        (part < 0.1 ? "none" : "iteration limit"));
  parameters.max_iterations = 7; // and a quarter: eight
  CHECK(failure_reason(parameters, problem, start(1)) == "iteration limit");
}

TEST_CASE("A trial that cannot be evaluated is a step too long", "[solver]")
{
  const bool throws  = GENERATE(true, false);
  const auto problem = scalar_problem(
    [throws](double x) {
      if (x <= 0 && throws)
        throw InvertedCell("J = " + std::to_string(x));
      return std::log(x); // NaN for x < 0
    },
    [](double x) { return 1 / x; });
  Vector<double>     x      = start(5); // first correction leads to x = -3.05
  const NewtonReport report = solve_newton({}, problem, x);
  CHECK(report.converged);
  CHECK(report.n_line_search_cuts > 0);
  CHECK(x[0] == Approx(1.));

  NewtonParameters parameters;
  parameters.line_search = false;
  CHECK(failure_reason(parameters, problem, start(5)) ==
        (throws ? "inverted cell" : "invalid residual"));
  CHECK(failure_reason({}, problem, start(-1)) ==
        (throws ? "inverted cell" : "invalid residual"));
}

TEST_CASE("A bug is not taken for a hard step", "[solver]")
{
  const auto problem = scalar_problem(
    [](double x) -> double {
      if (x < 1)
        throw std::logic_error("bug");
      return x;
    },
    [](double) { return 1.; });
  Vector<double> x = start(2);
  CHECK_THROWS_AS(solve_newton({}, problem, x), std::logic_error);
}

TEST_CASE("Newton says why it gave up", "[solver]")
{
  const auto       root = scalar_problem([](double x) { return x * x - 2; },
                                   [](double x) { return 2 * x; });
  NewtonParameters parameters;
  parameters.max_iterations = 2;
  CHECK(failure_reason(parameters, root, start(10)) == "iteration limit");

  const auto uphill =
    scalar_problem([](double x) { return x; }, [](double) { return -1.; });
  CHECK(failure_reason({}, uphill, start(1)) == "line search failed");

  const auto runaway =
    scalar_problem([](double x) { return x; }, [](double) { return -1e-5; });
  parameters.line_search    = false;
  parameters.max_iterations = 100;
  CHECK(failure_reason(parameters, runaway, start(1)) == "diverged");
}

TEST_CASE("Newton parameters are read from their subsection", "[solver]")
{
  NewtonParameters         parameters;
  dealii::ParameterHandler prm;
  parameters.add_parameters(prm);
  prm.parse_input_from_string("subsection Newton\n"
                              "  set Line search = false\n"
                              "  set Non-monotone memory = 1\n"
                              "end\n");
  CHECK_FALSE(parameters.line_search);
  CHECK(parameters.nonmonotone_memory == 1);
  CHECK(parameters.relative_tolerance == 1e-7);
  CHECK(parameters.absolute_tolerance == 0.);
  CHECK(parameters.max_iterations == 25);
  CHECK(parameters.max_halvings == 8);
}
