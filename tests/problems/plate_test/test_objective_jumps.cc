// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about cells whose neighbors turn with the bent plate.

#include <npt_dealii/base/exceptions.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;
  using dealii::Vector;
  using PlateTestTools::PlateRun;
  using Overrides = std::vector<std::string>;

  // Entries of b take the places of those of a.
  Overrides
  operator+(const Overrides &a, const Overrides &b)
  {
    const auto name = [](const std::string &entry) {
      return entry.substr(0, entry.find('='));
    };
    Overrides result = b;
    for (const std::string &entry : a)
      if (std::none_of(b.begin(), b.end(), [&](const std::string &other) {
            return name(other) == name(entry);
          }))
        result.push_back(entry);
    return result;
  }

  // A plate of one ply, 1 mm thick, that goes through one stage.
  Overrides
  plate(const double L, const unsigned int n_along, const std::string &targets)
  {
    return {"Cell/Type=laminate",
            "Cell/Plies=0",
            "Cell/Bundle width=1.5",
            "Cell/Bundle thickness=1",
            "Cell/Crossing spacing=" + std::to_string(L),
            "Fiber bundle material/Law=neo-Hookean",
            "Fiber bundle material/Young modulus=1000",
            "Fiber bundle material/Poisson ratio=0.3",
            "Mesh/Degree=4",
            "Mesh/Elements along=" + std::to_string(n_along),
            "Mesh/Elements across=1",
            "Mesh/Elements through=2",
            "Newton/Relative tolerance=1e-12",
            "Homogenization/Jumps=objective",
            "Load programme/Stages=bend",
            "Load programme/Stage bend/Targets=" + targets,
            "Load programme/Stage bend/Initial step=0.25",
            "Load programme/Stage bend/Maximum step=0.25"};
  }

  State
  end_of(const Overrides &overrides)
  {
    PlateRun test(overrides);
    test.run();
    return test.state;
  }

  /*
   * Cylindrical bending of a neo-Hookean layer, E = 1000, nu = 0.3, thickness
   * 1, held along the axis: with the stretch 1 + H1 + k z along the circle and
   * z' through the thickness, equilibrium is dP_33/dZ = k P_11 + b, with a body
   * force b along the normal, and the faces are free. Runge-Kutta steps from
   * the bottom, Newton's method on the top.
   */
  struct Layer
  {
    double k, stretch;

    static constexpr double mu = 1000. / 2.6, lambda = 300. / (1.3 * 0.4);
    double
    P_33(const double through, const double along) const
    {
      return mu * (through - 1. / through) +
             lambda * std::log(through * along) / through;
    }
    double
    P_11(const double through, const double along) const
    {
      return P_33(along, through);
    }
    double
    energy(const double through, const double along) const
    {
      const double log_J = std::log(through * along);
      return 0.5 * mu * (through * through + along * along - 2.) - mu * log_J +
             0.5 * lambda * log_J * log_J;
    }

    // z, P_33, and integrals of z, of P_11, of P_11 z and of the energy.
    using Values = std::array<double, 6>;
    Values
    slope(const Values &y, const double b) const
    {
      const double along   = stretch + k * y[0];
      double       through = 1. / along;
      for (unsigned int i = 0; i < 30; ++i)
        {
          const double derivative =
            mu * (1. + 1. / (through * through)) +
            lambda * (1. - std::log(through * along)) / (through * through);
          through -= (P_33(through, along) - y[1]) / derivative;
        }
      const double P = P_11(through, along);
      return {{through, k * P + b, y[0], P, P * y[0], energy(through, along)}};
    }
    Values
    integrate(const double bottom, const double b) const
    {
      const unsigned int n = 200;
      const double       h = 1. / n;
      Values             y = {{bottom, 0., 0., 0., 0., 0.}};
      const auto         moved =
        [&](const Values &from, const double step, const Values &by) {
          Values to = from;
          for (unsigned int i = 0; i < to.size(); ++i)
            to[i] += step * by[i];
          return to;
        };
      for (unsigned int i = 0; i < n; ++i)
        {
          const Values s1 = slope(y, b), s2 = slope(moved(y, h / 2, s1), b),
                       s3 = slope(moved(y, h / 2, s2), b),
                       s4 = slope(moved(y, h, s3), b);
          for (unsigned int j = 0; j < y.size(); ++j)
            y[j] += h / 6. * (s1[j] + 2. * s2[j] + 2. * s3[j] + s4[j]);
        }
      return y;
    }

    // With a free top, and either no body force or the mean of z at zero.
    Values
    solve(const bool mean_is_zero) const
    {
      double       bottom = -0.5, b = 0.;
      const double d = 1e-6;
      for (unsigned int i = 0; i < 12; ++i)
        {
          const Values y  = integrate(bottom, b);
          const Values yz = integrate(bottom + d, b);
          if (!mean_is_zero)
            {
              bottom -= d * y[1] / (yz[1] - y[1]);
              continue;
            }
          const double e    = 1000. * d;
          const Values yb   = integrate(bottom, b + e);
          const double K[4] = {(yz[1] - y[1]) / d,
                               (yb[1] - y[1]) / e,
                               (yz[2] - y[2]) / d,
                               (yb[2] - y[2]) / e};
          const double det  = K[0] * K[3] - K[1] * K[2];
          bottom -= (K[3] * y[1] - K[1] * y[2]) / det;
          b -= (K[0] * y[2] - K[2] * y[1]) / det;
        }
      return integrate(bottom, b);
    }
  };
} // namespace



TEST_CASE("A quarter of a circle in one cell is the exact solution of pure "
          "bending",
          "[top]")
{
  // A layer of 2 mm whose curvature is 90 degrees over its length.
  const double k     = dealii::numbers::PI / 4.;
  const auto   exact = Layer{k, 1.}.solve(false);
  const State  bent  = end_of(plate(2., 4, "n1: 0, H4: " + std::to_string(k)) +
                            Overrides{"Mesh/Elements through=4"});
  // The pure moment does not depend on what H1 is measured at.
  CHECK(bent.reactions[3] == Approx(exact[4]).epsilon(1e-6));
  CHECK(bent.energies.stored / 4. == Approx(exact[5]).epsilon(1e-6));
  CHECK(std::abs(bent.reactions[0]) < 1e-8);
}



TEST_CASE("Bending under tension does not depend on the size of the cell",
          "[top]")
{
  const auto                exact = Layer{0.1, 1.05}.solve(true);
  std::vector<State>        states;
  std::vector<Resultants>   averages;
  const std::vector<double> lengths = {2., 4., 8.};
  for (const double L : lengths)
    {
      PlateRun test(plate(L, L / 2, "H1: 0.05, H4: 0.1"));
      test.run();
      states.push_back(test.state);
      averages.push_back(test.cell.averages(test.state.u,
                                            test.woven,
                                            dealii::Tensor<1, 2>({1., 0.})));
    }
  for (unsigned int i = 0; i < lengths.size(); ++i)
    {
      INFO("cell of " << lengths[i] << " mm");
      CHECK(states[i].reactions[0] == Approx(exact[3]).epsilon(1e-6));
      CHECK(states[i].reactions[3] == Approx(exact[4]).epsilon(1e-6));
      CHECK(states[i].energies.stored / (lengths[i] * lengths[i]) ==
            Approx(exact[5]).epsilon(1e-6));
      CHECK(averages[i].M[0][0] == Approx(averages[0].M[0][0]).epsilon(1e-6));
      CHECK(averages[i].N[0][0] == Approx(averages[0].N[0][0]).epsilon(1e-6));
    }
}



namespace
{
  // A coarse cell of the plain weave in tension, as weaving leaves it.
  Overrides
  weave(const std::string &targets)
  {
    return {"Cell/Type=two-crossing cell",
            "Mesh/Elements along=3",
            "Mesh/Elements across=3",
            "Mesh/Elements through=1",
            "Friction/Friction coefficient=0",
            "Newton/Relative tolerance=1e-11",
            "Homogenization/Jumps=objective",
            "Load programme/Stages=weave, release, bend",
            "Load programme/Stage weave/Initial step=0.25",
            "Load programme/Stage weave/Maximum step=0.25",
            "Load programme/Stage bend/Targets=" + targets,
            "Load programme/Stage bend/Initial step=0.5",
            "Load programme/Stage bend/Maximum step=0.5"};
  }

  // Compare n of the last state with central differences of the energy.
  void
  check_derivatives(const std::function<Overrides(const std::string &)> &run,
                    const std::map<std::string, double>                 &H,
                    const double                                         area,
                    const double                                         step)
  {
    const auto text = [](const std::map<std::string, double> &targets) {
      std::string result;
      for (const auto &[name, value] : targets)
        {
          std::ostringstream number;
          number.precision(17);
          number << value;
          result += (result.empty() ? "" : ", ") + name + ": " + number.str();
        }
      return result;
    };
    const State at = end_of(run(text(H)));
    for (const auto &entry : H)
      {
        const unsigned int n         = MacroModes::number_of(entry.first);
        double             energy[2] = {0., 0.};
        for (const int sign : {1, -1})
          {
            auto moved = H;
            moved[entry.first] += sign * step;
            const State state = end_of(run(text(moved)));
            energy[sign > 0 ? 0 : 1] =
              state.energies.stored + state.energies.contact;
          }
        INFO(entry.first);
        CHECK((energy[0] - energy[1]) / (2. * step * area) ==
              Approx(at.reactions[n]).epsilon(1e-6));
      }
  }
} // namespace



TEST_CASE("The resultants of bent cells are derivatives of the energy", "[top]")
{
  check_derivatives(
    [](const std::string &targets) { return plate(2., 2, targets); },
    {{"H1", 0.05}, {"H2", -0.02}, {"H3", 0.1}, {"H4", 0.2}},
    4.,
    1e-4);
  check_derivatives(weave, {{"H1", 0.01}, {"H4", 0.02}}, 50., 1e-5);
}



TEST_CASE("The tangent of bent cells is that by differences, also with "
          "respect to H1..H6",
          "[top]")
{
  // The ply is bent obliquely and sheared; the weave has images.
  for (const Overrides &overrides :
       {plate(2., 2, "H1: 0.05, H3: 0.1, H4: 0.1, H5: 0.1, H6: 0.2") +
          Overrides{"Mesh/Degree=2"},
        weave("H1: 0.01, H4: 0.02")})
    {
      PlateRun test(overrides);
      test.run();
      const bool         is_plate = test.cell.contacts().empty();
      const unsigned int last =
        test.parameters.load_programme.stages.size() - 1;
      const PlateTestStage problem(
        test.cell, test.parameters, last, test.state, test.woven, test.system);
      ConstrainedSystem &system    = test.system;
      const Increment    increment = problem.increment(problem.start(), 1.);
      Vector<double>     m, direction, K_direction;
      Trial              trial;
      const auto         residual = [&](const Vector<double> &at) {
        Vector<double> condensed;
        system.expand(at, trial.u);
        problem.evaluate(increment, trial);
        system.linearize(trial.u);
        system.condense(trial.residual, condensed);
        return condensed;
      };
      system.restrict_to_independent(problem.start().u, m);
      // Out of equilibrium, with a force on the mean height.
      unsigned int random = 1;
      direction.reinit(m.size());
      for (unsigned int k = 0; k < m.size(); ++k)
        {
          random       = 1664525 * random + 1013904223;
          direction[k] = random / 4294967296. - 0.5;
          if (system.unknown(k) >= test.cell.macro().first)
            direction[k] *= 0.1;
        }
      m.add(is_plate ? 1e-2 : 0., direction);
      m[system.independent_index(test.cell.macro().support())] = 0.02;
      residual(m);
      system.build_pattern(problem.couplings(increment, trial));
      system.set_zero();
      REQUIRE(problem.add_tangent(increment, trial, system));
      system.matrix().vmult(K_direction, direction);
      const double   h = 1e-6;
      Vector<double> plus(m), minus(m);
      plus.add(h, direction);
      minus.add(-h, direction);
      Vector<double> difference = residual(plus);
      difference -= residual(minus);
      difference /= 2. * h;
      difference -= K_direction;
      INFO((is_plate ? "plate" : "weave"));
      CHECK(difference.l2_norm() < 1e-6 * K_direction.l2_norm());
      // The rows of H1..H6 are large; look at the others as well.
      for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
        {
          const int row   = system.independent_index(test.cell.macro().mode(n));
          difference[row] = 0.;
          K_direction[row] = 0.;
        }
      CHECK(difference.l2_norm() < 1e-6 * K_direction.l2_norm());
    }
}



TEST_CASE("Two and four crossings bend by the same moment, in tension, about "
          "both axes and between them, with a smooth closure too",
          "[top]")
{
  for (const std::string smooth : {"false", "true"})
    for (const std::string targets :
         {"H4: 0.02", "H5: -0.02", "H4: 0.01, H5: 0.01, H6: 0.02"})
      {
        INFO(targets << ", smooth closure " << smooth);
        // In steps of a quarter four smooth crossings weave themselves into
        // another state.
        const Overrides further = {
          "Cell/Smooth closure=" + smooth,
          "Load programme/Stage weave/Initial step=0.1",
          "Load programme/Stage weave/Maximum step=0.1"};
        const State two = end_of(weave(targets) + further);
        const State four =
          end_of(weave(targets) + further + Overrides{"Cell/Type=unit cell"});
        CHECK(two.reactions[0] > 0.5);
        for (unsigned int n = 0; n < 3; ++n)
          CHECK(four.reactions[n] ==
                Approx(two.reactions[n]).epsilon(1e-8).margin(1e-8));
        CHECK(2. * two.energies.stored ==
              Approx(four.energies.stored).epsilon(1e-8));
        // Of the moments those do the work that is done.
        if (targets.find("H6") == std::string::npos)
          {
            const unsigned int n = targets.find("H4") == 0 ? 3 : 4;
            CHECK(four.reactions[n] == Approx(two.reactions[n]).epsilon(1e-8));
          }
        else
          CHECK(
            four.reactions[3] + four.reactions[4] + 2. * four.reactions[5] ==
            Approx(two.reactions[3] + two.reactions[4] + 2. * two.reactions[5])
              .epsilon(1e-8));
      }
}



TEST_CASE("A plain weave bends up as it bends down", "[top]")
{
  const State up = end_of(weave("H4: 0.02")), down = end_of(weave("H4: -0.02"));
  CHECK(up.reactions[3] > 0.01);
  CHECK(down.reactions[3] == Approx(-up.reactions[3]).epsilon(1e-8));
  CHECK(down.reactions[0] == Approx(up.reactions[0]).epsilon(1e-8));
}



TEST_CASE("The pins of a bent woven cell carry no force", "[top]")
{
  for (const std::string mode : {"H4", "H5"})
    {
      PlateRun test(weave(mode + ": 0.02") +
                    Overrides{"Cell/Two-fold axis=false",
                              "Newton/Relative tolerance=1e-12"});
      test.run();
      const auto direction =
        test.parameters.load_programme.stages.back().bends_along;
      REQUIRE(direction);
      const auto sum = test.cell.objective_jumps(*direction)
                         ->sum_in_frames(test.trial.u, test.trial.residual);
      const double largest = test.contact_force().linfty_norm();
      REQUIRE(largest > 0.1); // [N]
      for (unsigned int i = 0; i < 3; ++i)
        CHECK(std::abs(sum[i]) < (i < 2 ? 1e-8 : 10.) * largest);
    }
}



TEST_CASE("A cell that is bent about one axis, back, and about the other one "
          "forgets the first",
          "[top]")
{
  const Overrides stages = {
    "Load programme/Stages=weave, release, bend, back, other",
    "Load programme/Stage back/Targets=H4: 0",
    "Load programme/Stage back/Initial step=1",
    "Load programme/Stage back/Maximum step=1",
    "Load programme/Stage other/Targets=H5: 0.02",
    "Load programme/Stage other/Initial step=0.5",
    "Load programme/Stage other/Maximum step=0.5"};
  const State after  = end_of(weave("H4: 0.02") + stages);
  const State direct = end_of(weave("H5: 0.02"));
  for (unsigned int n = 0; n < MacroModes::n; ++n)
    CHECK(after.reactions[n] ==
          Approx(direct.reactions[n]).epsilon(1e-7).margin(1e-8));
}



TEST_CASE("Objective jumps are refused where a plate bends about two axes, "
          "and automatic ones are linear then",
          "[top]")
{
  const auto directions = [](const std::string &jumps,
                             const std::string &targets) {
    std::string result;
    for (const LoadStage &stage :
         PlateTestParameters::read(make_parameter_text("", "run.prm"),
                                   weave(targets) +
                                     Overrides{"Homogenization/Jumps=" + jumps})
           .load_programme.stages)
      result += stage.bends_along ? "b" : "-";
    return result;
  };
  CHECK(directions("automatic", "H4: 0.02") == "--b");
  CHECK(directions("automatic", "n4: 0.02") == "--b");
  CHECK(directions("automatic", "H4: 0.02, n1: 0") == "--b");
  CHECK(directions("automatic", "H4: 0.01, H5: 0.04, H6: -0.04") == "--b");
  CHECK(directions("automatic", "H3: 0.02") == "---");
  CHECK(directions("linear", "H4: 0.02") == "---");
  for (const std::string two : {"H6: 0.02",
                                "n6: 0",
                                "H4: 0.02, H5: 0.02",
                                "n4: 0.02, n5: 0",
                                "n4: 0.02, H5: 0.01"})
    {
      CHECK(directions("automatic", two) == "---");
      CHECK_THROWS_AS(directions("objective", two), InputError);
    }
}
