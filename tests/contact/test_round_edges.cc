// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of contact between round edges: derivatives, balances, reach.

#include <npt_dealii/contact/contact_pair.h>

#include "contact_test_tools.h"

using namespace ContactTests;
using dealii::Vector;
using NPT::ContactEvaluation;
using NPT::ContactPair;
using NPT::ContactParameters;
using NPT::ContactState;
using NPT::ContactStep;
using NPT::FrictionParameters;

namespace
{
  // A bar along x, 1 wide and 0.4 high, around a center.
  NURBSPatch<3>
  bar_around(const Point<3> &center)
  {
    return slab<3>({{KnotVector::uniform(2, 3), KnotVector::uniform(2, 4)}},
                   [center](const Point<3> &u) {
                     return center +
                            Tensor<1, 3>(
                              {2. * u[0] - 1., u[1] - 0.5, 0.4 * u[2] - 0.2});
                   });
  }



  // Two parallel bars; the top of the lower one, secondary, and the bottom of
  // the upper one have round edges of radius 0.2.
  struct RoundBars
  {
    IGASpace<3>          space;
    IGASurface<3>        secondary, primary;
    ContactPair<3>       contact;
    ContactStep<3>       step;
    ContactEvaluation<3> evaluation;

    RoundBars(const Point<3>                 &upper,
              const ContactParameters::Method method,
              const double                    mu)
      : space({bar_around(Point<3>()), bar_around(upper)}, {}, Basis::NURBS)
      , secondary(space, 0, 2, 1, 0., 0.2)
      , primary(space, 1, 2, 0, 0., 0.2)
      , contact(ContactSurface<3>(secondary),
                {ContactSurface<3>(primary)},
                parameters(method),
                friction(mu),
                0.4)
    {}

    static ContactParameters
    parameters(const ContactParameters::Method method)
    {
      ContactParameters result;
      result.method              = method;
      result.n_quadrature_points = 6;
      return result;
    }

    static FrictionParameters
    friction(const double mu)
    {
      FrictionParameters result;
      result.coefficient = mu;
      return result;
    }

    Vector<double>
    random_displacement(const unsigned int seed, const double size) const
    {
      std::mt19937   generator(seed);
      Vector<double> u(3 * space.n_control_points());
      for (unsigned int A = 0; A < space.n_control_points(); ++A)
        {
          const auto w = random_vector<3>(generator, size);
          for (unsigned int i = 0; i < 3; ++i)
            u[3 * A + i] = w[i];
        }
      return u;
    }

    Vector<double>
    residual(const Vector<double> &u)
    {
      Vector<double> r(u.size());
      contact.evaluate(step, u, evaluation);
      contact.add_residual(step, evaluation, r);
      return r;
    }

    Vector<double>
    tangent_times(const Vector<double> &d) const
    {
      Vector<double> result(d.size());
      contact.add_tangent(step,
                          evaluation,
                          [&](const std::vector<unsigned int> &dofs,
                              const std::vector<double>       &K) {
                            for (unsigned int i = 0; i < dofs.size(); ++i)
                              for (unsigned int j = 0; j < dofs.size(); ++j)
                                result[dofs[i]] +=
                                  K[i * dofs.size() + j] * d[dofs[j]];
                          });
      return result;
    }
  };

  // Both round edges meet under 45 degrees, 0.018 deep.
  const Point<3> diagonal(0., 0.87, 0.27);
} // namespace



TEST_CASE("Where two round edges touch, the tangent is the derivative of the "
          "forces, and forces and moments balance",
          "[contact]")
{
  for (const auto method :
       {ContactParameters::Method::KTS, ContactParameters::Method::mortar})
    {
      const bool mortar = method == ContactParameters::Method::mortar;
      INFO((mortar ? "mortar" : "KTS"));
      // Means over control points see less; the bars are pushed deeper.
      RoundBars  bars(diagonal - (mortar ? 0.05 : 0.) * Tensor<1, 3>({0, 1, 1}),
                     method,
                     0.3);
      const auto rest = bars.random_displacement(1, 0.004);
      bars.step       = bars.contact.begin_step(
        bars.contact.with_friction(bars.contact.initial_state(), true), rest);
      auto u = rest;
      u += bars.random_displacement(2, 0.004);
      const Vector<double> r = bars.residual(u);
      REQUIRE(r.l2_norm() > 1e-3);

      const auto     d = bars.random_displacement(3, 1.);
      const double   h = 1e-6;
      const auto     K = bars.tangent_times(d);
      Vector<double> plus(u), minus(u);
      plus.add(h, d);
      minus.add(-h, d);
      Vector<double> difference = bars.residual(plus);
      difference -= bars.residual(minus);
      difference /= 2. * h;
      const double size = difference.l2_norm();
      difference -= K;
      CHECK(difference.l2_norm() < 1e-6 * size);

      Tensor<1, 3> force, moment;
      double       sum = 0.;
      for (unsigned int A = 0; A < bars.space.n_control_points(); ++A)
        {
          Tensor<1, 3> f, x = bars.space.control_points()[A];
          for (unsigned int i = 0; i < 3; ++i)
            {
              f[i] = r[3 * A + i];
              x[i] += u[3 * A + i];
            }
          force += f;
          moment += cross_product_3d(x, f);
          sum += f.norm();
        }
      CHECK(force.norm() < 1e-13 * sum);  // rounding
      CHECK(moment.norm() < 1e-12 * sum); // rounding
    }
}



TEST_CASE("Two round edges that meet under 45 degrees have the gap of two "
          "circles",
          "[contact]")
{
  RoundBars            bars(diagonal, ContactParameters::Method::KTS, 0.);
  const Vector<double> u(3 * bars.space.n_control_points());
  bars.step = bars.contact.begin_step(bars.contact.initial_state(), u);
  bars.residual(u);
  double least = 1.;
  for (const auto &c : bars.evaluation.closest)
    least = std::min(least, c.gap);
  // Centers are 0.27 apart in both directions, radii are 0.2 within 0.9 %;
  // Gauss points may miss the deepest one by a tenth of the radius.
  CHECK(least == Approx(0.27 * std::sqrt(2.) - 0.4).margin(0.006));
}



TEST_CASE("Points beside a round edge are out of reach as those beside a sharp "
          "one, although they look at the side of the body",
          "[contact]")
{
  // The thickness is 0.4: from 0.4 beside the bar on weights fade, and end at
  // 0.8. The lower bar's top reaches from -0.5 to 0.5.
  RoundBars bars(Point<3>(0., 1.5, 0.38), ContactParameters::Method::KTS, 0.);
  const Vector<double> u(3 * bars.space.n_control_points());
  bars.step = bars.contact.begin_step(bars.contact.initial_state(), u);
  for (unsigned int q = 0; q < bars.contact.quadrature_points().size(); ++q)
    {
      const double beside =
        std::max(0., 1. - bars.contact.quadrature_points()[q].X[1]);
      CHECK(std::abs(bars.step.reach.of_point[q] -
                     std::min(1., std::max(0., 2. - beside / 0.4))) < 1e-12);
    }
}
