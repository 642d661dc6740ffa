// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the balance of energy: what is missing, when a step has jumped,
// and what the loop over steps does then.

#include <npt_dealii/load_step/branch_left.h>
#include <npt_dealii/load_step/load_stepper.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace NPT;
using dealii::Vector;

namespace
{
  /**
   * A point x on a double well pulled by a spring whose end H is driven from -1
   * to `end`,
   *
   *   E = k (H - x)^2 / 2 + (x^2 - 1)^2 / 4,
   *
   * from the well x = -1. For k > 1 there is one path. For k < 1 the point
   * snaps to the other well where x^2 = (1 - k) / 3, H = x + (x^3 - x) / k.
   */
  class DoubleWell : public EquilibriumProblem
  {
  public:
    DoubleWell(const double stiffness, const double driven_to)
      : k(stiffness)
      , end(driven_to)
    {
      dealii::AffineConstraints<double> constraints;
      constraints.close();
      system.reinit(constraints, 2);
      system.add_group({0, 1});
      system.build_pattern();
      system.set_prescribed({true, false});
    }

    Increment
    increment(const State &, const double load_factor) const override
    {
      Increment result;
      result.load_factor = load_factor;
      result.target.reinit(2);
      result.target[0] = -1. + load_factor * (end + 1.);
      return result;
    }

    void
    evaluate(const Increment &, Trial &trial) const override
    {
      const double x = trial.u[1], force = k * (trial.u[0] - x);
      trial.residual.reinit(2);
      trial.residual[0] = force;
      trial.residual[1] = x * x * x - x - force;
      trial.force_scale = 1.;
    }

    bool
    add_tangent(const Increment &,
                const Trial       &trial,
                ConstrainedSystem &matrix) const override
    {
      const double x = trial.u[1];
      matrix.add(0, {k, -k, -k, 3. * x * x - 1. + k});
      return true;
    }

    State
    accept(const State     &before,
           const Increment &increment,
           const Trial     &trial) const override
    {
      State state       = EquilibriumProblem::accept(before, increment, trial);
      state.reactions   = {trial.residual[0]};
      const double n0   = before.reactions[0];
      const double n    = trial.residual[0];
      const double dH   = state.u[0] - before.u[0];
      const double well = state.u[1] * state.u[1] - 1.;
      state.energies    = before.energies;
      state.energies.stored = 0.5 * n * n / k + 0.25 * well * well;
      state.energies.work += 0.5 * (n0 + n) * dH;
      state.energies.work_uncertainty += 0.5 * std::abs((n - n0) * dH);
      return state;
    }

    void
    check(const State &before, const State &after) const override
    {
      if (EnergyChange(before.energies, after.energies).is_jump(0.05))
        throw BranchLeft("energy is missing");
    }

    // The states of a drive in n steps at least.
    std::vector<State>
    run(const unsigned int n_steps)
    {
      NewtonParameters newton;
      newton.line_search    = false; // it cannot leave the fold
      newton.max_iterations = 200;
      RunLog         log("", screen, false, true);
      LoadStepper    stepper(newton, ContactParameters(), system, solver, log);
      StepParameters steps;
      steps.initial_step = steps.maximum_step = 1. / n_steps;
      steps.minimum_step                      = 0.02;
      std::vector<State> states(1);
      states[0].u.reinit(2);
      states[0].u[0] = states[0].u[1] = -1.;
      states[0].reactions             = {0.};
      stepper.run(*this,
                  states[0],
                  steps,
                  "pull",
                  LoadStepper::Predictor::tangent,
                  [&](const AcceptedStep &step) {
                    states.push_back(step.after);
                  });
      return states;
    }

    const double       k, end;
    ConstrainedSystem  system;
    LinearSolver       solver{LinearSolverParameters()};
    std::ostringstream screen;
  };
} // namespace



TEST_CASE("Where the driving force is monotone, a step of any length is no "
          "jump, and what is missing falls with the square of the step",
          "[load_step]")
{
  const auto missing = [](const unsigned int n) {
    DoubleWell well(2., -3.); // away from the other well
    const auto states = well.run(n);
    CHECK(states.size() == n + 1); // no cut
    CHECK(well.screen.str().find("jump") == std::string::npos);
    return std::abs(
      EnergyChange(states.front().energies, states.back().energies).missing());
  };
  missing(1);
  missing(3);
  CHECK(missing(40) == Approx(missing(20) / 4.).epsilon(0.05));
}



TEST_CASE("A step over a snap is cut down to the smallest one, which is "
          "accepted with a warning, and misses the energy that is released",
          "[load_step]")
{
  const double k      = 0.2;
  const double x_fold = -std::sqrt((1. - k) / 3.);
  const double H_fold = x_fold + (x_fold * x_fold * x_fold - x_fold) / k;
  DoubleWell   well(k, 2.);
  const auto   states = well.run(5);
  unsigned int n      = 1;
  while (n < states.size() && states[n].u[1] < 0.)
    ++n;
  REQUIRE(n < states.size());
  CHECK(states[n].u[1] > 1.);
  const double shortest = 3. / 40.; // 1/5 2^-k that is not below 0.02
  CHECK(states[n - 1].u[0] < H_fold);
  CHECK(states[n].u[0] == Approx(states[n - 1].u[0] + shortest));
  CHECK(states[n].u[0] < H_fold + shortest);
  CHECK(well.screen.str().find("jump to another branch") != std::string::npos);

  const auto energy = [&](const double H, const double x) {
    return 0.5 * k * (H - x) * (H - x) + 0.25 * std::pow(x * x - 1., 2);
  };
  // The other root of x^3 - x + k (x - H) = 0.
  const double released = energy(H_fold, x_fold) - energy(H_fold, -2. * x_fold);
  CHECK(EnergyChange(states[n - 1].energies, states[n].energies).missing() ==
        Approx(released).epsilon(0.1));
}



TEST_CASE("The balance of a stage is the sum over its steps, and warns of the "
          "stages that are off only",
          "[load_step]")
{
  Energies start, middle, end;
  start.stored            = 1.;
  middle                  = start;
  middle.work             = 2.;
  middle.stored           = 2.5;
  middle.dissipation      = 0.5;
  middle.work_uncertainty = 0.1;
  end                     = middle;
  end.work                = 1.;
  end.stored              = 1.;
  end.friction            = 0.1;
  end.work_uncertainty    = 0.2;

  EnergyBalance balance;
  balance.add_step("load", start, middle);
  balance.add_step("unload", middle, end);
  REQUIRE(balance.stages().size() == 2);
  CHECK(balance.stages()[0].total.missing() == Approx(0.).margin(1e-15));
  // 1 N mm of work is recovered of the 1.4 N mm that the energies lose.
  CHECK(balance.stages()[1].total.missing() == Approx(0.4));
  CHECK(balance.stages()[1].deviation() == Approx(0.4 / 1.4));
  const auto warnings = balance.warnings(0.05);
  REQUIRE(warnings.size() == 1);
  CHECK(warnings[0].find("stage unload") != std::string::npos);
  CHECK(balance.warnings(0.3).empty());
  CHECK(balance.table().size() == 3);

  // A stage in which next to nothing flows is not off by all of it.
  Energies after = end;
  after.stored += 1e-5;
  balance.add_step("release", end, after);
  CHECK(balance.stages()[2].deviation() < 1e-3);
}
