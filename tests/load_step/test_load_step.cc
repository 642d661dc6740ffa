// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about a load step in the free unknowns: Newton's method ends in the
// solution of the full equations, and the predictors are what they say.

#include <npt_dealii/load_step/load_step.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;
using dealii::AffineConstraints;
using dealii::Vector;

namespace
{
  /**
   * A chain of five points with springs of force s + c s^3 for the stretch s;
   * u_0 = 0 by a constraint, u_3 = u_1 + u_2 / 2 by another. u_4 is driven.
   */
  struct Chain
  {
    explicit Chain(const double cubic)
      : c(cubic)
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

    LoadStep::FullSystem
    equations()
    {
      return {[this](const Vector<double> &u, Vector<double> &r) {
                r.reinit(5);
                for (unsigned int e = 0; e < 4; ++e)
                  {
                    const double s     = u[e + 1] - u[e];
                    const double force = s + c * s * s * s;
                    r[e] -= force;
                    r[e + 1] += force;
                  }
                return 1.;
              },
              [this](const Vector<double> &u) {
                system.set_zero();
                for (unsigned int e = 0; e < 4; ++e)
                  {
                    const double s = u[e + 1] - u[e];
                    const double k = 1. + 3. * c * s * s;
                    system.add(e, {k, -k, -k, k});
                  }
              }};
    }

    LoadStep
    problem(const Vector<double> &accepted,
            const Vector<double> &target,
            Vector<double>       &u,
            Vector<double>       &residual)
    {
      return {system, solver, equations(), accepted, target, u, residual};
    }

    Vector<double>
    target(const double end) const
    {
      Vector<double> m(system.n_independent());
      m[system.independent_index(4)] = end;
      return m;
    }

    double            c;
    ConstrainedSystem system;
    LinearSolver      solver{LinearSolverParameters()};
  };
} // namespace



TEST_CASE("Newton's method satisfies the full equations in every admissible "
          "direction and keeps couplings and targets",
          "[solver]")
{
  Chain                chain(2.);
  const Vector<double> accepted(5), target = chain.target(1.);
  Vector<double>       u, residual, x;
  auto                 step = chain.problem(accepted, target, u, residual);
  step.follow_tangent(x);
  CHECK(solve_newton(NewtonParameters(), step.problem(), x).converged);
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
          "[solver]")
{
  Chain          chain(0.);
  Vector<double> accepted(5), target = chain.target(1.), u, residual, x, r;
  accepted[1]                               = 0.3; // no equilibrium
  accepted[3]                               = 0.3;
  target[chain.system.independent_index(1)] = 17.;
  auto step = chain.problem(accepted, target, u, residual);
  step.follow_tangent(x);
  step.evaluate(x, r);
  CHECK(r.l2_norm() < 1e-13);
  CHECK(u[4] == 1.);
}



TEST_CASE("Extrapolation goes along the line through two states", "[solver]")
{
  Chain          chain(1.);
  Vector<double> accepted(5), previous(5), u, residual, x, r;
  accepted[1]                 = 0.2;
  accepted[2]                 = 0.4;
  previous[1]                 = 0.1;
  previous[2]                 = 0.3;
  const Vector<double> target = chain.target(1.);
  auto                 step   = chain.problem(accepted, target, u, residual);
  step.extrapolate(previous, 2., x);
  step.evaluate(x, r);
  CHECK(u[1] == Approx(0.4));
  CHECK(u[2] == Approx(0.6));
  CHECK(u[3] == Approx(0.7));
  CHECK(u[4] == 1.);
}



TEST_CASE("A step without free unknowns is evaluated, not solved", "[solver]")
{
  Chain chain(1.);
  chain.system.set_prescribed(
    std::vector<bool>(chain.system.n_independent(), true));
  const Vector<double> accepted(5), target = chain.target(1.);
  Vector<double>       u, residual, x;
  auto                 step = chain.problem(accepted, target, u, residual);
  step.follow_tangent(x);
  CHECK(x.size() == 0);
  CHECK(solve_newton(NewtonParameters(), step.problem(), x).iterations == 0);
  CHECK(u[4] == 1.);
  CHECK(residual[4] == Approx(2.));
}
