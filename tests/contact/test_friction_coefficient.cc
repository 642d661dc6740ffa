// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the friction of yarns, (A38): a coefficient by the angle between
// fibers that decays with the slip.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_pair.h>

#include <cmath>
#include <memory>
#include <string>

#include "contact_test_tools.h"

using namespace ContactTests;
using dealii::Vector;
using NPT::ContactEvaluation;
using NPT::ContactPair;
using NPT::ContactParameters;
using NPT::ContactState;
using NPT::ContactStep;
using NPT::EntryValue;
using NPT::FrictionParameters;
using NPT::FrictionTable;

namespace
{
  const double pi = std::acos(-1.), depth = 0.01, eps = 100.;

  // A square strip of side 1 below, the secondary one, and a larger one above
  // it, turned by an angle about z. Fibers run along the first direction.
  struct Strips
  {
    IGASpace<3>          space;
    IGASurface<3>        secondary, primary;
    ContactPair<3>       contact;
    ContactState<3>      state;
    ContactStep<3>       step;
    ContactEvaluation<3> evaluation;

    static std::vector<NURBSPatch<3>>
    patches(const double angle)
    {
      const double c = std::cos(angle), s = std::sin(angle);
      return {slab<3>({{KnotVector::uniform(2, 2), KnotVector::uniform(2, 1)}},
                      [](const Point<3> &u) {
                        return Point<3>(u[0] - 0.5, u[1] - 0.5, u[2] - 1.);
                      }),
              slab<3>({{KnotVector::uniform(2, 1), KnotVector::uniform(2, 2)}},
                      [c, s](const Point<3> &u) {
                        const double x = 4. * u[0] - 2., y = 4. * u[1] - 2.;
                        return Point<3>(c * x - s * y, s * x + c * y, u[2]);
                      })};
    }

    static ContactParameters
    method(const ContactParameters::Method name)
    {
      ContactParameters parameters;
      parameters.method         = name;
      parameters.normal_penalty = eps;
      return parameters;
    }

    Strips(
      const double                    angle,
      const FrictionParameters       &friction,
      const ContactParameters::Method name = ContactParameters::Method::mortar)
      : space(patches(angle), {}, Basis::NURBS)
      , secondary(space, 0, 2, 1)
      , primary(space, 1, 2, 0)
      , contact(ContactSurface<3>(secondary),
                {ContactSurface<3>(primary)},
                method(name),
                friction,
                1.2)
      , state(contact.with_friction(contact.initial_state(), true))
    {
      press(0.);
      contact.evaluate(step, moved(0.), evaluation);
      state = contact.accept(step, evaluation);
    }

    // The lower strip pressed in and shifted along a skew direction.
    Vector<double>
    moved(const double distance) const
    {
      Vector<double>     u(3 * space.n_control_points());
      const unsigned int n_lower = space.patch(0).n_control_points();
      for (unsigned int A = 0; A < n_lower; ++A)
        {
          u[3 * A]     = 0.6 * distance;
          u[3 * A + 1] = 0.8 * distance;
          u[3 * A + 2] = depth;
        }
      return u;
    }

    void
    press(const double distance)
    {
      step = contact.begin_step(state, moved(distance));
    }

    void
    slide(const double from, const double to)
    {
      press(from);
      contact.evaluate(step, moved(to), evaluation);
    }

    Vector<double>
    residual() const
    {
      Vector<double> r(3 * space.n_control_points());
      contact.add_residual(step, evaluation, r);
      return r;
    }

    // Force that the lower strip exerts on the upper one in its plane.
    double
    friction_force() const
    {
      const Vector<double> r       = residual();
      const unsigned int   n_lower = space.patch(0).n_control_points();
      Tensor<1, 3>         force;
      for (unsigned int A = 0; A < n_lower; ++A)
        for (unsigned int i = 0; i < 3; ++i)
          force[i] += r[3 * A + i];
      return std::hypot(force[0], force[1]);
    }
  };

  // Pressure times area.
  const double normal_force = eps * depth;

  FrictionParameters
  of_yarns(const std::string &table)
  {
    FrictionParameters friction;
    friction.coefficient        = 0.3;
    friction.tangential_penalty = eps;
    friction.by_angle           = EntryValue<FrictionTable>::value(table);
    return friction;
  }
} // namespace



TEST_CASE("Two strips slide at the coefficient of the angle between them",
          "[contact]")
{
  const auto friction = of_yarns("0: 0.4, 30: 0.25, 90: 0.1");
  const auto expected = [](const double degrees) {
    return degrees <= 30. ? 0.4 - 0.15 * degrees / 30. :
                            0.25 - 0.15 * (degrees - 30.) / 60.;
  };
  for (const auto nodes : {FrictionParameters::Nodes::Gauss_points,
                           FrictionParameters::Nodes::contact_nodes})
    for (const double degrees : {0., 12., 30., 63., 90.})
      // Fibers have no sense of direction.
      for (const double turn : {degrees, 180. - degrees, -degrees})
        {
          FrictionParameters at = friction;
          at.nodes              = nodes;
          Strips strips(turn * pi / 180., at);
          strips.slide(0., 0.1);
          CHECK(strips.friction_force() ==
                Approx(expected(degrees) * normal_force).epsilon(1e-12));
          for (const auto &node : strips.evaluation.friction)
            CHECK(node.response.slipping);
        }
}



TEST_CASE("A table with one value gives the bits of the constant coefficient",
          "[contact]")
{
  for (const auto method :
       {ContactParameters::Method::mortar, ContactParameters::Method::KTS})
    {
      Strips constant(0.7, of_yarns(""), method),
        table(0.7, of_yarns("0: 0.3, 45: 0.3, 90: 0.3"), method);
      for (const double to : {0.002, 0.004, 0.02})
        {
          constant.slide(0., to);
          table.slide(0., to);
          CHECK(table.residual() == constant.residual());
        }
      CHECK(constant.step.friction_factor.empty());
      CHECK(constant.contact.accept(constant.step, constant.evaluation)
              .slip_path.empty());
    }
}



TEST_CASE("A sliding block falls from static to dynamic friction by the slip "
          "that was accepted",
          "[contact]")
{
  FrictionParameters friction = of_yarns("");
  friction.dynamic_ratio      = 0.5;
  friction.slip_length        = 0.02;
  Strips     strips(0.3, friction);
  const auto mu = [&](const double slip) {
    return 0.3 * (0.5 + 0.5 * std::exp(-slip / 0.02));
  };
  double slip = 0., at = 0., elastic = 0.;
  for (unsigned int k = 0; k < 12; ++k)
    {
      strips.slide(at, at + 0.01);
      const double now = mu(slip);
      CHECK(strips.friction_force() ==
            Approx(now * normal_force).epsilon(1e-10));
      // What did not become elastic: (new limit - old limit) / eps_T.
      slip += 0.01 - (now * depth - elastic);
      elastic = now * depth;
      at += 0.01;
      strips.state = strips.contact.accept(strips.step, strips.evaluation);
      for (const double path : strips.state.slip_path)
        CHECK(path == Approx(slip).epsilon(1e-10));
    }
  CHECK(mu(slip) < 0.3 * 0.502);

  // Open: the static friction is there again.
  auto open = strips.moved(at);
  for (unsigned int A = 0; A < strips.space.patch(0).n_control_points(); ++A)
    open[3 * A + 2] = -0.01;
  strips.press(at);
  strips.contact.evaluate(strips.step, open, strips.evaluation);
  strips.state = strips.contact.accept(strips.step, strips.evaluation);
  for (const double path : strips.state.slip_path)
    CHECK(path == 0.);
  strips.slide(at, at + 0.1);
  CHECK(strips.friction_force() == Approx(0.3 * normal_force).epsilon(1e-12));
}



TEST_CASE("With the friction of yarns the tangent is the derivative of the "
          "residual, and a step a function of its start",
          "[contact]")
{
  FrictionParameters friction = of_yarns("0: 0.5, 90: 0.2");
  friction.dynamic_ratio      = 0.6;
  friction.slip_length        = 0.02;
  for (const auto nodes : {FrictionParameters::Nodes::Gauss_points,
                           FrictionParameters::Nodes::contact_nodes})
    for (const double distance : {0.001, 0.02}) // sticks, slips
      {
        friction.nodes = nodes;
        Strips strips(0.4, friction);
        strips.slide(0., 0.03);
        strips.state = strips.contact.accept(strips.step, strips.evaluation);
        strips.press(0.03);
        const Vector<double> u = strips.moved(0.03 + distance);
        std::mt19937         generator(7);
        Vector<double>       d(u.size());
        for (double &value : d)
          value = random_vector<3>(generator)[0];
        const auto at = [&](const double t) {
          Vector<double> v = u;
          v.add(t, d);
          strips.contact.evaluate(strips.step, v, strips.evaluation);
          return strips.residual();
        };
        const double   h          = 1e-6;
        Vector<double> difference = at(h);
        difference -= at(-h);
        difference *= 0.5 / h;
        const Vector<double> here = at(0.);
        Vector<double>       Kd(u.size());
        strips.contact.add_tangent(
          strips.step,
          strips.evaluation,
          [&](const std::vector<unsigned int> &dofs,
              const std::vector<double>       &K) {
            for (unsigned int i = 0; i < dofs.size(); ++i)
              for (unsigned int j = 0; j < dofs.size(); ++j)
                Kd[dofs[i]] += K[i * dofs.size() + j] * d[dofs[j]];
          });
        difference -= Kd;
        // Central differences: h^2 and round-off over h.
        CHECK(difference.linfty_norm() < 1e-6 * Kd.linfty_norm());

        strips.press(0.03);
        CHECK(at(0.) == here);
      }
}



TEST_CASE("Fibers across the parameters of a surface count by their own "
          "direction, also when the body is stretched",
          "[contact]")
{
  const Strips          strips(0., of_yarns(""));
  ContactSurface<3>     surface(strips.secondary);
  std::vector<Point<3>> positions;
  for (unsigned int l = 0; l < strips.secondary.n_control_points(); ++l)
    {
      const Point<3> &X = strips.secondary.reference_position(l);
      positions.emplace_back(2. * X[0], X[1], X[2]);
    }
  NPT::SurfaceShape<2> shape;
  strips.secondary.evaluate({{0.3, 0.6}}, 1, shape);
  CHECK(surface.fiber_direction(shape, positions)[0] == Approx(1.));
  surface.set_fiber(Tensor<1, 3>({std::sqrt(0.5), std::sqrt(0.5), 0.}));
  const Tensor<1, 3> fiber = surface.fiber_direction(shape, positions);
  CHECK(fiber[0] == Approx(2. / std::sqrt(5.)));
  CHECK(fiber[1] == Approx(1. / std::sqrt(5.)));
}



TEST_CASE("Tables of friction are read as they are written, and wrong ones are "
          "refused by their sentence",
          "[contact]")
{
  const std::string text = "0: 0.35, 45.5: 0.27, 90: 0";
  CHECK(EntryValue<FrictionTable>::text(
          EntryValue<FrictionTable>::value(text)) == text);
  CHECK(EntryValue<FrictionTable>::text(FrictionTable()).empty());
  using Catch::Matchers::Contains;
  const auto refused = [](const std::string &table, const std::string &words) {
    CHECK_THROWS_WITH(EntryValue<FrictionTable>::value(table),
                      Contains(words) && Contains("subsection Friction"));
  };
  refused("0: 0.3, 91: 0.2", "0 to 90");
  refused("-1: 0.3", "0 to 90");
  refused("0: 0.3, 45: 0.2, 45: 0.1", "must rise");
  refused("0: -0.3", "must be >= 0");
  refused("0.3", "no pair");
  refused("0: much", "no pair");

  FrictionParameters friction = of_yarns("0: 0.3");
  friction.coefficient        = 0.;
  CHECK_THROWS_WITH(friction.check(), Contains("Coefficient by angle"));
  friction.by_angle = {};
  CHECK_NOTHROW(friction.check());
  friction.dynamic_ratio = 0.5;
  CHECK_THROWS_WITH(friction.check(), Contains("Dynamic friction ratio"));
}
