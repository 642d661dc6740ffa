// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about a load step in the free unknowns and about the loop over steps:
// Newton's method ends in the solution of the full equations, predictors are
// what they say, and a rejected step leaves nothing.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/load_stepper.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace NPT;
using dealii::AffineConstraints;
using dealii::Vector;

namespace
{
  /**
   * A chain of five points with springs of force s + c s^3 for the stretch s;
   * u_0 = 0 by a constraint, u_3 = u_1 + u_2 / 2 by another. u_4 is driven to
   * `end` in proportion to the load factor. Steps longer than `longest` are
   * refused after they are solved.
   */
  class Chain : public EquilibriumProblem
  {
  public:
    explicit Chain(const double cubic,
                   const double pulled_to    = 1.,
                   const double longest_step = 1.)
      : c(cubic)
      , end(pulled_to)
      , longest(longest_step)
    {
      AffineConstraints<double> constraints;
      constraints.add_line(0);
      constraints.add_line(3);
      constraints.add_entry(3, 1, 1.);
      constraints.add_entry(3, 2, 0.5);
      constraints.close();
      system.reinit(constraints, 5);
      for (unsigned int e = 0; e < 4; ++e)
        system.add_group({e, e + 1});
      system.build_pattern();
      std::vector<bool> prescribed(system.n_independent(), false);
      prescribed[system.independent_index(4)] = true;
      system.set_prescribed(prescribed);
    }

    Increment
    increment(const State &accepted, const double load_factor) const override
    {
      Increment result;
      result.load_factor = load_factor;
      result.target.reinit(system.n_independent());
      result.target[system.independent_index(4)] = load_factor * end;
      // Free entries mean nothing.
      result.target[system.independent_index(1)] = 17.;
      too_long = load_factor - accepted.load_factor > longest;
      return result;
    }

    void
    evaluate(const Increment &, Trial &trial) const override
    {
      ++n_evaluations;
      const Vector<double> &u = trial.u;
      trial.residual.reinit(5);
      for (unsigned int e = 0; e < 4; ++e)
        {
          const double s = u[e + 1] - u[e];
          if (s > largest_stretch)
            throw InvertedCell("spring " + std::to_string(e));
          const double force = s + c * s * s * s;
          trial.residual[e] -= force;
          trial.residual[e + 1] += force;
        }
      trial.force_scale = 1.;
    }

    bool
    add_tangent(const Increment &,
                const Trial       &trial,
                ConstrainedSystem &matrix) const override
    {
      for (unsigned int e = 0; e < 4; ++e)
        {
          const double s = trial.u[e + 1] - trial.u[e];
          const double k = 1. + 3. * c * s * s;
          matrix.add(e, {k, -k, -k, k});
        }
      return true;
    }

    void
    check(const State &, const State &) const override
    {
      if (too_long)
        throw EllipticityLost("the step is longer than it may be");
    }

    static State
    state(const Vector<double> &u           = Vector<double>(5),
          const double          load_factor = 0.)
    {
      State result;
      result.u           = u;
      result.load_factor = load_factor;
      return result;
    }

    LoadStep
    step(const State &accepted)
    {
      return {*this, accepted, increment(accepted, 1.), system, solver};
    }

    const double         c, end, longest;
    double               largest_stretch = 1e9;
    mutable bool         too_long        = false;
    mutable unsigned int n_evaluations   = 0;
    ConstrainedSystem    system;
    LinearSolver         solver{LinearSolverParameters()};
  };

  std::vector<State>
  run(Chain &chain, const double first_step, std::ostream &screen)
  {
    RunLog      log("", screen, false, true);
    LoadStepper stepper(
      NewtonParameters(), ContactParameters(), chain.system, chain.solver, log);
    StepParameters steps;
    steps.initial_step = steps.maximum_step = first_step;
    steps.minimum_step                      = 1e-3;
    std::vector<State> states;
    stepper.run(chain,
                Chain::state(),
                steps,
                "pull",
                LoadStepper::Predictor::extrapolation,
                [&](const AcceptedStep &step) {
                  CHECK(step.before.load_factor ==
                        (states.empty() ? 0. : states.back().load_factor));
                  states.push_back(step.after);
                });
    return states;
  }
} // namespace



TEST_CASE("Newton's method satisfies the full equations in every admissible "
          "direction and keeps couplings and targets",
          "[load_step]")
{
  Chain       chain(2.);
  const State accepted = Chain::state();
  auto        step     = chain.step(accepted);
  step.follow_tangent();
  CHECK(step.solve(NewtonParameters()).newton.converged);
  const Vector<double> &u = step.trial().u, &residual = step.trial().residual;
  CHECK(u[0] == 0.);
  CHECK(u[4] == 1.);
  CHECK(u[3] == Approx(u[1] + 0.5 * u[2]));
  // du = (0, 1, 0, 1, 0) and (0, 0, 1, 1/2, 0).
  CHECK(std::abs(residual[1] + residual[3]) < 1e-7);
  CHECK(std::abs(residual[2] + 0.5 * residual[3]) < 1e-7);
  CHECK(residual[4] > 0.1);
}



TEST_CASE("Following the tangent solves linear equations, whatever the free "
          "entries of the target and the residual of the accepted state are",
          "[load_step]")
{
  Chain          chain(0.);
  Vector<double> u(5), r;
  u[1]                 = 0.3; // no equilibrium
  u[3]                 = 0.3;
  const State accepted = Chain::state(u);
  auto        step     = chain.step(accepted);
  step.follow_tangent();
  step.evaluate(step.start(), r);
  CHECK(r.l2_norm() < 1e-13);
  CHECK(step.trial().u[4] == 1.);
}



TEST_CASE("Extrapolation goes along the line through two states", "[load_step]")
{
  Chain          chain(1.);
  Vector<double> u(5), previous(5);
  u[1]                 = 0.2;
  u[2]                 = 0.4;
  previous[1]          = 0.1;
  previous[2]          = 0.3;
  const State accepted = Chain::state(u);
  auto        step     = chain.step(accepted);
  REQUIRE(step.extrapolate(previous, 2.));
  CHECK(step.trial().u[1] == Approx(0.4));
  CHECK(step.trial().u[2] == Approx(0.6));
  CHECK(step.trial().u[3] == Approx(0.7));
  CHECK(step.trial().u[4] == 1.);
}



TEST_CASE("An extrapolated start is evaluated once", "[load_step]")
{
  Chain       chain(0.);
  const State accepted = Chain::state();
  auto        step     = chain.step(accepted);
  REQUIRE(step.extrapolate(accepted.u, 1.));
  CHECK(chain.n_evaluations == 1);
  const LoadStepReport report = step.solve(NewtonParameters());
  // Linear: one correction, and its evaluation.
  CHECK(report.newton.iterations == 1);
  CHECK(chain.n_evaluations == 2);
}



TEST_CASE("A start that is extrapolated too far is refused, not fatal",
          "[load_step]")
{
  Chain chain(1.);
  chain.largest_stretch = 0.5;
  Vector<double> u(5), previous(5);
  u[1]                 = 0.3;
  const State accepted = Chain::state(u);
  auto        step     = chain.step(accepted);
  CHECK_FALSE(step.extrapolate(previous, 2.));
}



TEST_CASE("A step without free unknowns is evaluated, not solved",
          "[load_step]")
{
  Chain chain(1.);
  chain.system.set_prescribed(
    std::vector<bool>(chain.system.n_independent(), true));
  const State accepted                          = Chain::state();
  Increment   all                               = chain.increment(accepted, 1.);
  all.target                                    = 0.;
  all.target[chain.system.independent_index(4)] = 1.;
  LoadStep step(chain, accepted, all, chain.system, chain.solver);
  step.follow_tangent();
  CHECK(step.solve(NewtonParameters()).newton.iterations == 0);
  CHECK(step.trial().u[4] == 1.);
  CHECK(step.trial().residual[4] == Approx(2.));
}



TEST_CASE("Rejected steps leave nothing: the curve is that of a run that never "
          "tried them",
          "[load_step]")
{
  std::ostringstream screen;
  // Every first attempt of half the stage is refused and cut to a quarter.
  Chain      cut(1., 1., 0.3), small(1.);
  const auto with_cuts    = run(cut, 0.5, screen);
  const auto without_cuts = run(small, 0.25, screen);
  REQUIRE(with_cuts.size() == 4);
  REQUIRE(without_cuts.size() == 4);
  CHECK(screen.str().find("loss of ellipticity") != std::string::npos);
  for (unsigned int k = 0; k < 4; ++k)
    {
      CHECK(with_cuts[k].load_factor == without_cuts[k].load_factor);
      for (unsigned int i = 0; i < 5; ++i)
        CHECK(with_cuts[k].u[i] == without_cuts[k].u[i]);
    }
}



TEST_CASE("A stage that cannot be finished has shown all accepted steps",
          "[load_step]")
{
  std::ostringstream screen;
  Chain              chain(1.);
  chain.largest_stretch = 0.3; // reached before the end
  double last           = 0;
  try
    {
      RunLog         log("", screen, false, true);
      LoadStepper    stepper(NewtonParameters(),
                          ContactParameters(),
                          chain.system,
                          chain.solver,
                          log);
      StepParameters steps;
      steps.initial_step = steps.maximum_step = 0.25;
      steps.minimum_step                      = 1e-2;
      stepper.run(chain,
                  Chain::state(),
                  steps,
                  "pull",
                  LoadStepper::Predictor::tangent,
                  [&](const AcceptedStep &step) {
                    last = step.after.load_factor;
                  });
      FAIL("The stage was finished.");
    }
  catch (const StageFailed &failure)
    {
      CHECK(failure.reason() == "inverted cell");
      CHECK(failure.load_factor() == last);
      CHECK(last > 0.);
    }
}
