// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the virtual work of contact: energies, tangents, balances,
// invariances, and a block on a plane by hand.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_pair.h>

#include <deal.II/lac/full_matrix.h>

#include <functional>

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
  // Where gap and slip are posed.
  struct Conditions : ContactParameters
  {
    FrictionParameters::Nodes friction_nodes;
  };

  const std::string at_points = "mortar, friction at Gauss points";

  Conditions
  contact_parameters(const std::string &method)
  {
    Conditions parameters;
    parameters.method = NPT::value_of<ContactParameters::Method>(
      method == at_points ? "mortar" : method);
    parameters.friction_nodes = method == at_points ?
                                  FrictionParameters::Nodes::Gauss_points :
                                  FrictionParameters::Nodes::contact_nodes;
    return parameters;
  }

  const std::array<std::string, 2> slip_measures = {
    {"relative displacement", "closest point"}};

  FrictionParameters
  friction_parameters(const double                    mu,
                      const std::string              &slip_measure,
                      const FrictionParameters::Nodes nodes)
  {
    FrictionParameters parameters;
    parameters.nodes        = nodes;
    parameters.coefficient  = mu;
    parameters.slip_measure = slip_measure;
    return parameters;
  }

  // Two bodies in contact: the top of the first is the secondary surface, the
  // bottom of the second the primary one.
  template <int dim>
  struct Pair
  {
    IGASpace<dim>           space;
    IGASurface<dim>         secondary, primary;
    ContactPair<dim>        contact;
    std::vector<Point<dim>> X;
    ContactState<dim>       state;
    ContactStep<dim>        step;
    ContactEvaluation<dim>  evaluation;

    Pair(const std::vector<NURBSPatch<dim>>              &patches,
         const Conditions                                &parameters,
         const double                                     mu    = 0.,
         const Basis                                      basis = Basis::NURBS,
         const typename ContactPair<dim>::SymmetryWeight &symmetry_weight = {},
         const std::string &slip_measure        = slip_measures[0],
         const double       maximum_penetration = 0.6)
      : space(patches, {}, basis)
      , secondary(space, 0, dim - 1, 1)
      , primary(space, 1, dim - 1, 0)
      , contact(ContactSurface<dim>(secondary),
                {rounded(primary)},
                parameters,
                friction_parameters(mu,
                                    slip_measure,
                                    parameters.friction_nodes),
                2. * maximum_penetration, // half the thickness by default
                symmetry_weight)
      , X(space.control_points())
      , state(contact.with_friction(contact.initial_state(), true))
    {}

    static ContactSurface<dim>
    rounded(const IGASurface<dim> &surface)
    {
      ContactSurface<dim> result(surface);
      result.set_edge_radius(0.15);
      return result;
    }

    unsigned int
    n() const
    {
      return dim * X.size();
    }

    Vector<double>
    zero() const
    {
      return Vector<double>(n());
    }

    // Displacement of a map of both bodies (upper: only the second body).
    Vector<double>
    displacement(const Map<dim> &lower, const Map<dim> &upper) const
    {
      Vector<double>     u(n());
      const unsigned int n_lower = space.patch(0).n_control_points();
      for (unsigned int A = 0; A < X.size(); ++A)
        {
          const auto w = (A < n_lower ? lower(X[A]) : upper(X[A])) - X[A];
          for (int i = 0; i < dim; ++i)
            u[dim * A + i] = w[i];
        }
      return u;
    }

    void
    begin_step(const Vector<double> &u)
    {
      step = contact.begin_step(state, u);
    }

    void
    evaluate(const Vector<double> &u)
    {
      contact.evaluate(step, u, evaluation);
    }

    void
    accept()
    {
      state = contact.accept(step, evaluation);
    }

    NPT::ContactSummary
    summary() const
    {
      return contact.summary(evaluation);
    }

    Vector<double>
    residual() const
    {
      Vector<double> r(n());
      contact.add_residual(step, evaluation, r);
      return r;
    }

    Vector<double>
    residual(const Vector<double> &u)
    {
      evaluate(u);
      return residual();
    }

    // K d and K^T d of the evaluated state.
    std::pair<Vector<double>, Vector<double>>
    tangent_times(const Vector<double> &d) const
    {
      Vector<double> Kd(n()), KTd(n());
      contact.add_tangent(step,
                          evaluation,
                          [&](const std::vector<unsigned int> &dofs,
                              const std::vector<double>       &K) {
                            const unsigned int size = dofs.size();
                            REQUIRE(K.size() == size * size);
                            for (unsigned int i = 0; i < size; ++i)
                              for (unsigned int j = 0; j < size; ++j)
                                {
                                  Kd[dofs[i]] += K[i * size + j] * d[dofs[j]];
                                  KTd[dofs[j]] += K[i * size + j] * d[dofs[i]];
                                }
                          });
      return {Kd, KTd};
    }

    Tensor<1, dim>
    force(const Vector<double> &r, const unsigned int body) const
    {
      Tensor<1, dim>     f;
      const unsigned int n_lower = space.patch(0).n_control_points();
      for (unsigned int A = body == 0 ? 0 : n_lower;
           A < (body == 0 ? n_lower : X.size());
           ++A)
        for (int i = 0; i < dim; ++i)
          f[i] += r[dim * A + i];
      return f;
    }
  };

  template <int dim>
  std::array<KnotVector, dim - 1>
  uniform_knots(const unsigned int p,
                const unsigned int a,
                const unsigned int b)
  {
    if constexpr (dim == 2)
      return {{KnotVector::uniform(p, a)}};
    else
      return {{KnotVector::uniform(p, a), KnotVector::uniform(p, b)}};
  }

  // A hump below a smaller curved plate that dips into it by a quarter in
  // the middle and is open around; some points miss the plate.
  template <int dim>
  std::vector<NURBSPatch<dim>>
  curved_pair(const unsigned int p, const bool symmetric = false)
  {
    const double s = symmetric ? 0. : 1.;
    return {slab<dim>(uniform_knots<dim>(p, 6, 5),
                      [s](const Point<dim> &u) {
                        Point<dim>   x = u;
                        const double a = 2.2 * u[0] - 1.1,
                                     b = dim == 3 ? 2. * u[1] - 1. : 0.;
                        x[0]           = a + 0.1 * s * b * a;
                        x[dim - 1]     = (u[dim - 1] - 1.) * 0.5 -
                                     0.25 * (a * a + b * b) + 0.05 * s * a;
                        if (dim == 3)
                          x[1] = b;
                        return x;
                      }),
            slab<dim>(uniform_knots<dim>(p, 3, 4), [s](const Point<dim> &u) {
              Point<dim>   x = u;
              const double a = 1.8 * u[0] - 0.9,
                           b = dim == 3 ? 1.8 * u[1] - 0.9 : 0.;
              x[0]           = a;
              if (dim == 3)
                x[1] = b + 0.1 * s * a;
              x[dim - 1] = u[dim - 1] * 0.5 - 0.27 + 0.15 * a * a +
                           0.1 * b * b + 0.04 * s * a * b;
              return x;
            })};
  }

  template <int dim>
  Vector<double>
  random_direction(const unsigned int n,
                   const unsigned int seed,
                   const double       size = 1.)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> unit(-size, size);
    Vector<double>                         d(n);
    for (double &v : d)
      v = unit(generator);
    return d;
  }

  // Rotation about a skew axis (in the plane: about its normal).
  template <int dim>
  Point<dim>
  rotate(const Point<dim> &x, const double angle)
  {
    const double c = std::cos(angle), s = std::sin(angle);
    Point<dim>   y = x;
    y[0]           = c * x[0] - s * x[1];
    y[1]           = s * x[0] + c * x[1];
    if (dim == 3)
      {
        const double y0 = y[0], y2 = y[dim - 1];
        y[0]       = c * y0 + s * y2;
        y[dim - 1] = -s * y0 + c * y2;
      }
    return y;
  }

  // Three states: first touch (a, committed: reference of slip), sheared (b,
  // committed: traction), sheared back and turned (c).
  template <int dim>
  std::array<Vector<double>, 3>
  frictional_path(const Pair<dim> &pair, const double noise = 0.004)
  {
    const auto shifted = [](const double dx, const double dy) {
      return [dx, dy](const Point<dim> &X) {
        Point<dim> x = X;
        x[0] += dx + 0.02 * X[1];
        x[1] += dim == 3 ? dy : 0.;
        x[dim - 1] -= 0.5 * dx;
        return x;
      };
    };
    const auto                    rest = [](const Point<dim> &X) { return X; };
    std::array<Vector<double>, 3> u    = {
         {pair.displacement(rest, shifted(0., 0.)),
          pair.displacement(rest, shifted(0.03, 0.02)),
          pair.displacement(rest, shifted(0.02, 0.03))}};
    for (unsigned int k = 0; k < 3; ++k)
      u[k] += random_direction<dim>(pair.n(), 10 + k, noise);
    return u;
  }

  // All positions rotated and moved: u -> Q (X + u) + t - X.
  template <int dim>
  Vector<double>
  rotated(const Pair<dim> &pair, const Vector<double> &u, const double angle)
  {
    Vector<double> v(u.size());
    for (unsigned int A = 0; A < pair.X.size(); ++A)
      {
        Point<dim> x = pair.X[A];
        for (int i = 0; i < dim; ++i)
          x[i] += u[dim * A + i];
        x = rotate(x, angle);
        for (int i = 0; i < dim; ++i)
          v[dim * A + i] = x[i] + 0.3 * (i + 1) - pair.X[A][i];
      }
    return v;
  }

  template <int dim>
  Vector<double>
  rotated_vector(const Vector<double> &r, const double angle)
  {
    Vector<double> q(r.size());
    for (unsigned int A = 0; A < r.size() / dim; ++A)
      {
        Point<dim> x;
        for (int i = 0; i < dim; ++i)
          x[i] = r[dim * A + i];
        x = rotate(x, angle);
        for (int i = 0; i < dim; ++i)
          q[dim * A + i] = x[i];
      }
    return q;
  }

  double
  difference(const Vector<double> &a, const Vector<double> &b)
  {
    Vector<double> d = a;
    d -= b;
    return d.l2_norm() / std::max(a.l2_norm(), b.l2_norm());
  }

  // Follow the path: first and second state accepted, the third evaluated.
  template <int dim>
  void
  follow(Pair<dim> &pair, const std::array<Vector<double>, 3> &u)
  {
    pair.begin_step(u[0]);
    pair.evaluate(u[0]);
    pair.accept();
    pair.begin_step(u[0]);
    pair.evaluate(u[1]);
    pair.accept();
    pair.begin_step(u[1]);
    pair.evaluate(u[2]);
  }

  template <int dim>
  double
  tangent_error(Pair<dim> &pair, const Vector<double> &u)
  {
    const double h = 1e-6; // error h^2 plus 1e-16/h, both 1e-10 of K d
    const auto   d = random_direction<dim>(pair.n(), 77);
    pair.evaluate(u);
    const auto Kd   = pair.tangent_times(d).first;
    auto       plus = u, minus = u;
    plus.add(h, d);
    minus.add(-h, d);
    auto difference_quotient = pair.residual(plus);
    difference_quotient -= pair.residual(minus);
    difference_quotient /= 2 * h;
    pair.evaluate(u);
    if (Kd.l2_norm() == 0. && difference_quotient.l2_norm() == 0.)
      return 0.;
    return difference(Kd, difference_quotient);
  }

  const std::array<std::string, 3> methods = {{"mortar", "KTS", at_points}};

  template <int dim>
  void
  check_frictionless(const unsigned int p, const std::string &method)
  {
    INFO(method << ", dim " << dim << ", degree " << p);
    Pair<dim> pair(curved_pair<dim>(p), contact_parameters(method));
    auto      u = pair.zero();
    u += random_direction<dim>(pair.n(), 3, 0.01);
    pair.begin_step(u);
    const auto r       = pair.residual(u);
    const auto summary = pair.summary();
    CHECK(summary.n_active > 2);
    CHECK(summary.n_active < pair.evaluation.nodes.size());

    const double h    = 1e-6; // error h^2 and 1e-16/h
    const auto   d    = random_direction<dim>(pair.n(), 5);
    auto         plus = u, minus = u;
    plus.add(h, d);
    minus.add(-h, d);
    pair.evaluate(plus);
    const double up = pair.summary().energy;
    pair.evaluate(minus);
    const double down = pair.summary().energy;
    CHECK(std::abs((up - down) / (2 * h) - r * d) < 1e-7 * std::abs(r * d));

    CHECK(tangent_error(pair, u) < 1e-6);
    const auto e  = random_direction<dim>(pair.n(), 6);
    const auto Ke = pair.tangent_times(e);
    CHECK(difference(Ke.first, Ke.second) < 1e-12); // rounding
  }

  template <int dim>
  void
  check_frictional(const unsigned int p,
                   const std::string &method,
                   const double       mu,
                   const double       angle,
                   const std::string &slip_measure)
  {
    INFO(method << ", " << slip_measure << ", dim " << dim << ", degree " << p
                << ", mu " << mu << ", turned " << angle);
    Pair<dim> pair(curved_pair<dim>(p),
                   contact_parameters(method),
                   mu,
                   Basis::NURBS,
                   {},
                   slip_measure);
    auto      u = frictional_path(pair);
    for (auto &v : u)
      v = rotated(pair, v, angle);
    follow(pair, u);
    unsigned int n_stick = 0, n_slip = 0; // friction nodes
    for (const auto &node : pair.evaluation.friction)
      if (node.active())
        ++(node.response.slipping ? n_slip : n_stick);
    INFO(n_stick << " sticking, " << n_slip << " slipping");
    // Points at which the pressure vanishes slip in any case.
    const unsigned int few = method == at_points ? (n_stick + n_slip) / 4 : 0;
    if (mu == 20.)
      CHECK((n_stick > 2 && n_slip <= few));
    else if (mu == 0.002)
      CHECK((n_slip > 2 && n_stick <= few));
    else
      CHECK((n_slip > 0 && n_stick > 0));
    double traction = 0.;
    for (const auto &t : pair.state.traction)
      traction = std::max(traction, std::abs(t[0]));
    CHECK(traction > 1e-3);
    CHECK(tangent_error(pair, u[2]) < 1e-6);
  }

  // The virtual work of any rigid motion is zero: forces and moments balance,
  // to rounding.
  void
  check_balance(const Pair<3> &pair, const Vector<double> &u)
  {
    const auto   r = pair.residual();
    Tensor<1, 3> force, moment;
    double       size = 0.;
    for (unsigned int A = 0; A < pair.X.size(); ++A)
      {
        Tensor<1, 3> f, arm({7., -5., 3.}); // about some point
        for (unsigned int i = 0; i < 3; ++i)
          {
            f[i] = r[3 * A + i];
            arm[i] += pair.X[A][i] + u[3 * A + i];
          }
        force += f;
        moment += cross_product_3d(arm, f);
        size += f.norm();
      }
    CHECK(size > 0.1);
    CHECK(force.norm() < 1e-14 * size);
    CHECK(moment.norm() < 1e-13 * size);
    CHECK(pair.force(r, 0).norm() > 0.1 * size);
  }

  // A long flat slab in three elements below a strip of the given width in its
  // middle; both faces at height 0.
  std::vector<NURBSPatch<2>>
  slab_and_strip(const double width)
  {
    return {slab<2>(uniform_knots<2>(2, 3, 1),
                    [](const Point<2> &u) {
                      return Point<2>(6. * u[0] - 3., u[1] - 1.);
                    }),
            slab<2>(uniform_knots<2>(2, 2, 1), [=](const Point<2> &u) {
              return Point<2>(width * (u[0] - 0.5), 0.5 * u[1]);
            })};
  }

  // Force on the slab when the strip is pressed in by a depth.
  double
  force_of_strip(const std::string &method,
                 const double       width,
                 const double       depth)
  {
    Conditions parameters          = contact_parameters(method);
    parameters.n_quadrature_points = 40;
    Pair<2>    pair(slab_and_strip(width),
                 parameters,
                 0.,
                 Basis::NURBS,
                 {},
                 slip_measures[0],
                 0.05); // its half thickness
    const auto rest    = [](const Point<2> &X) { return X; };
    const auto pressed = pair.displacement(rest, [=](const Point<2> &X) {
      return Point<2>(X[0], X[1] - depth);
    });
    pair.begin_step(pressed);
    return pair.force(pair.residual(pressed), 0)[1];
  }

  // A primary body so thin that the middle of the other one is behind it.
  template <int dim>
  void
  check_rejected_points(const std::string &method,
                        const std::string &slip_measure,
                        const double       mu)
  {
    INFO(method << ", " << slip_measure << ", dim " << dim << ", mu " << mu);
    Pair<dim>  pair(curved_pair<dim>(2),
                   contact_parameters(method),
                   mu,
                   Basis::NURBS,
                   {},
                   slip_measure,
                   0.2);
    const auto path = frictional_path(pair);
    follow(pair, path);
    unsigned int n_rejected = 0, n_mixed = 0;
    for (unsigned int I = 0; I < pair.contact.n_nodes(); ++I)
      {
        unsigned int n[2] = {0, 0};
        for (const auto &entry : pair.contact.averaging().nodes()[I].entries)
          ++n[pair.step.reach.has(entry.point)];
        n_rejected += n[0];
        if (pair.evaluation.nodes[I].active && n[0] > 0 && n[1] > 0)
          ++n_mixed;
      }
    CHECK(n_rejected > 0);
    if (method == "mortar")
      CHECK(n_mixed > 0); // averages over points of both kinds
    CHECK(pair.summary().n_active > 2);
    CHECK(tangent_error(pair, path[2]) < 1e-6);
    if constexpr (dim == 3)
      check_balance(pair, path[2]);
  }
} // namespace



TEST_CASE(
  "Frictionless contact forces are the derivative of the penalty energy "
  "and their tangent is symmetric",
  "[contact]")
{
  for (const std::string &method : methods)
    {
      check_frictionless<2>(2, method);
      check_frictionless<2>(3, method);
      check_frictionless<3>(2, method);
    }
  check_frictionless<3>(3, "mortar");
}



TEST_CASE("A partner narrower than an element is felt by mortar with the force "
          "that the single points feel",
          "[contact]")
{
  // Penalty 100 N/mm^3 times depth times width. The rounded edge adds a little;
  // open points up to the reach of 0.1 beside it take away from a mean, the
  // more the narrower the strip. Without (A20) mortar would feel nothing.
  for (const double width : {0.5, 1., 2.})
    {
      const double exact = 100. * 0.02 * width;
      CHECK(force_of_strip("KTS", width, 0.02) == Approx(exact).epsilon(0.2));
      CHECK(force_of_strip("mortar", width, 0.02) ==
            Approx(exact).epsilon(0.35));
    }
}



TEST_CASE("The shares of all nodes in a point add up to its area, faded where "
          "it has no partner",
          "[contact]")
{
  Pair<2>    pair(slab_and_strip(1.),
               contact_parameters("mortar"),
               0.,
               Basis::NURBS,
               {},
               slip_measures[0],
               0.25); // half the thickness
  const auto zero = pair.zero();
  pair.begin_step(zero);
  const auto         &points = pair.contact.quadrature_points();
  std::vector<double> sum(points.size(), 0.);
  for (unsigned int I = 0; I < pair.contact.n_nodes(); ++I)
    {
      const auto &node = pair.contact.averaging().nodes()[I];
      if (pair.step.reach.of_node[I] > 0.)
        for (const auto &entry : node.entries)
          sum[entry.point] += node.area * pair.step.reach.of_node[I] *
                              pair.step.reach.weight(I, entry);
    }
  for (unsigned int q = 0; q < points.size(); ++q)
    {
      // The strip ends at 0.5, the reach is 0.5 as well.
      const double beside = std::max(0., std::abs(points[q].X[0]) - 0.5);
      const double omega  = std::min(1., std::max(0., 2. - beside / 0.5));
      CHECK(sum[q] == Approx(omega * points[q].area).margin(1e-14));
    }
}



TEST_CASE("Within a step a point that touches is pushed back from any depth, "
          "and a state that is too deep is refused",
          "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<2>    pair(slab_and_strip(3.), contact_parameters(method));
      const auto rest  = [](const Point<2> &X) { return X; };
      const auto moved = [&](const double depth) {
        return pair.displacement(rest, [=](const Point<2> &X) {
          return Point<2>(X[0], X[1] - depth);
        });
      };
      pair.begin_step(moved(0.2));
      CHECK(pair.residual(moved(0.2)).l2_norm() > 0.);
      CHECK_NOTHROW(pair.contact.check_depth(pair.evaluation));
      pair.accept();
      pair.begin_step(moved(0.2));
      double force = 0.;
      for (const double depth : {0.3, 0.55, 0.65, 0.9})
        {
          const double more = pair.force(pair.residual(moved(depth)), 0)[1];
          CHECK(more > force); // deeper, more force
          force = more;
          CHECK(pair.summary().largest_penetration == Approx(depth));
          if (depth < 0.6) // the limit
            CHECK_NOTHROW(pair.contact.check_depth(pair.evaluation));
          else
            CHECK_THROWS_AS(pair.contact.check_depth(pair.evaluation),
                            NPT::PenetrationTooDeep);
        }
    }
}



TEST_CASE("A point that began behind a body comes back only by leaving it",
          "[contact]")
{
  Pair<2>    pair(slab_and_strip(3.), contact_parameters("KTS"));
  const auto rest  = [](const Point<2> &X) { return X; };
  const auto force = [&](const double depth) {
    const auto u = pair.displacement(rest, [=](const Point<2> &X) {
      return Point<2>(X[0], X[1] - depth);
    });
    pair.begin_step(u);
    const double result = pair.residual(u).l2_norm();
    pair.accept();
    return result;
  };
  CHECK(force(0.65) == 0.); // the limit is 0.6
  CHECK(force(0.55) == 0.);
  CHECK(force(-0.01) == 0.);
  CHECK(force(0.02) > 0.);
}



TEST_CASE("Measures of slip and contact laws are known by name", "[contact]")
{
  const auto &measures = NPT::Registry<NPT::NamedSlipMeasure<3>>::instance();
  CHECK(measures.names() ==
        std::vector<std::string>{"closest point", "relative displacement"});
  for (const std::string &name : slip_measures)
    CHECK(measures.get(name).make() != nullptr);
  CHECK_THROWS_WITH(measures.get("closest points"),
                    Catch::Contains("closest point"));
  CHECK(NPT::Registry<NPT::NamedNormalLaw>::instance().contains("penalty"));
  CHECK(
    NPT::Registry<NPT::NamedFrictionLaw<2>>::instance().contains("Coulomb"));
}



TEST_CASE("Open surfaces exert no force and have no stiffness", "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<3>    pair(curved_pair<3>(2), contact_parameters(method), 0.3);
      const auto u = pair.displacement([](const Point<3> &X) { return X; },
                                       [](const Point<3> &X) {
                                         return X + Point<3>(0., 0., 0.4);
                                       });
      pair.begin_step(u);
      CHECK(pair.residual(u).l2_norm() == 0.);
      CHECK(pair.summary().n_active == 0);
      CHECK(pair.summary().energy == 0.);
      const auto d = random_direction<3>(pair.n(), 1);
      CHECK(pair.tangent_times(d).first.l2_norm() == 0.);
      CHECK(
        pair.contact.coupled_unknowns(pair.step, pair.evaluation, 0.).empty());
      CHECK(
        !pair.contact.coupled_unknowns(pair.step, pair.evaluation, 1.).empty());
    }
}



TEST_CASE("Surfaces that touch within round-off are closed", "[contact]")
{
  // A block of length 1 below a plane.
  const std::vector<NURBSPatch<2>> patches = {
    slab<2>(uniform_knots<2>(2, 3, 1),
            [](const Point<2> &u) { return Point<2>(u[0] - 0.5, u[1] - 1.); }),
    slab<2>(uniform_knots<2>(2, 4, 1),
            [](const Point<2> &u) { return Point<2>(6. * u[0] - 3., u[1]); })};
  for (const std::string &method : methods)
    {
      INFO(method);
      Pair<2>    pair(patches, contact_parameters(method));
      const auto n_active = [&](const double gap) {
        const auto u = pair.displacement([](const Point<2> &X) { return X; },
                                         [gap](const Point<2> &X) {
                                           return Point<2>(X[0], X[1] + gap);
                                         });
        pair.begin_step(u);
        CHECK(pair.residual(u).l2_norm() < 1e-7);
        return pair.summary().n_active;
      };
      const unsigned int n_closed = n_active(-1e-10);
      CHECK(n_closed == pair.contact.n_nodes());
      for (const double gap : {-2e-15, -1e-16, 0., 1e-16, 2e-15})
        CHECK(n_active(gap) == n_closed);
      CHECK(n_active(1e-10) == 0);
    }
}



TEST_CASE("In sticking, sliding and mixed states the tangent is the derivative "
          "of the forces, also after a large rotation",
          "[contact]")
{
  for (const std::string &measure : slip_measures)
    {
      for (const std::string &method : methods)
        for (const double mu : {20., 0.002, 0.05})
          {
            check_frictional<2>(2, method, mu, 0., measure);
            check_frictional<2>(3, method, mu, 2., measure);
            // Shear in two directions reaches farther: mixed at larger
            // friction.
            check_frictional<3>(
              2, method, mu == 0.05 ? 0.25 : mu, 0.8, measure);
          }
      check_frictional<3>(3, "mortar", 0.25, 0., measure);
    }
}



TEST_CASE("The tangent couples no unknowns but those announced", "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<3> pair(curved_pair<3>(2), contact_parameters(method), 0.25);
      follow(pair, frictional_path(pair));
      const unsigned int n = pair.n();
      std::vector<bool>  allowed(n * n);
      for (const auto &group :
           pair.contact.coupled_unknowns(pair.step, pair.evaluation, 0.))
        for (const unsigned int i : group)
          for (const unsigned int j : group)
            allowed[i * n + j] = true;
      unsigned int n_outside = 0, n_inside = 0;
      pair.contact.add_tangent(
        pair.step,
        pair.evaluation,
        [&](const std::vector<unsigned int> &dofs,
            const std::vector<double>       &K) {
          for (unsigned int i = 0; i < dofs.size(); ++i)
            for (unsigned int j = 0; j < dofs.size(); ++j)
              if (K[i * dofs.size() + j] != 0.)
                ++(allowed[dofs[i] * n + dofs[j]] ? n_inside : n_outside);
        });
      CHECK(n_outside == 0);
      CHECK(n_inside > 100);
    }
}



TEST_CASE("Contact forces balance, and their moments about any point, with "
          "friction too",
          "[contact]")
{
  // Gap and closest point do not change when all moves rigidly, so the virtual
  // work of a rigid motion is zero: to rounding, at any gap and slip.
  for (const std::string &method : methods)
    for (const double mu : {0., 0.25})
      {
        INFO(method << ", mu " << mu);
        Pair<3>    pair(curved_pair<3>(2), contact_parameters(method), mu);
        const auto path = frictional_path(pair);
        follow(pair, path);
        check_balance(pair, path[2]);
        const auto r    = pair.residual();
        const auto size = pair.force(r, 0).norm() + pair.force(r, 1).norm();
        CHECK(size > 0.02);
      }
}



TEST_CASE("Points behind the primary body neither press nor slide: the tangent "
          "remains the derivative of the forces, and these balance",
          "[contact]")
{
  for (const std::string &measure : slip_measures)
    for (const std::string &method : methods)
      for (const double mu : {20., 0.05})
        {
          check_rejected_points<2>(method, measure, mu);
          check_rejected_points<3>(method, measure, mu);
        }
}



TEST_CASE("Turning and moving everything turns the forces and leaves the rest",
          "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<3>    a(curved_pair<3>(2), contact_parameters(method), 0.25);
      Pair<3>    b(curved_pair<3>(2), contact_parameters(method), 0.25);
      const auto path   = frictional_path(a);
      auto       turned = path;
      for (auto &u : turned)
        u = rotated(b, u, 1.1);
      follow(a, path);
      follow(b, turned);
      // Rounding of slips: 1e-16 times eps_T / forces.
      CHECK(difference(rotated_vector<3>(a.residual(), 1.1), b.residual()) <
            1e-11);
      const auto p = a.summary(), q = b.summary();
      CHECK(p.n_slip == q.n_slip);
      CHECK(p.n_stick == q.n_stick);
      CHECK(std::abs(p.energy - q.energy) < 1e-12 * p.energy);
      CHECK(std::abs(p.friction_energy - q.friction_energy) <
            1e-10 * p.friction_energy);
      CHECK(std::abs(p.dissipation - q.dissipation) < 1e-10 * p.dissipation);
    }
}



TEST_CASE("Both C0 bases give the same pressures on polynomial bodies",
          "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<3> a(curved_pair<3>(2),
                contact_parameters(method),
                0.3,
                Basis::Bernstein);
      Pair<3> b(curved_pair<3>(2),
                contact_parameters(method),
                0.3,
                Basis::Lagrange);
      for (Pair<3> *pair : {&a, &b})
        {
          // Affine: the same motion whatever the control points are.
          const auto u =
            pair->displacement([](const Point<3> &X) { return X; },
                               [](const Point<3> &X) {
                                 return Point<3>(X[0] + 0.02 + 0.01 * X[1],
                                                 X[1],
                                                 X[2] - 0.01 + 0.01 * X[0]);
                               });
          pair->begin_step(pair->zero());
          pair->evaluate(pair->zero());
          pair->accept();
          pair->evaluate(u);
        }
      double error = 0., largest = 0.;
      for (unsigned int I = 0; I < a.evaluation.nodes.size(); ++I)
        {
          const auto &p = a.evaluation.nodes[I], &q = b.evaluation.nodes[I];
          error   = std::max(error, std::abs(p.pressure - q.pressure));
          largest = std::max(largest, -p.pressure);
        }
      for (unsigned int J = 0; J < a.evaluation.friction.size(); ++J)
        for (unsigned int i = 0; i < 2; ++i)
          error =
            std::max(error,
                     std::abs(a.evaluation.friction[J].response.traction[i] -
                              b.evaluation.friction[J].response.traction[i]));
      CHECK(largest > 1.);
      CHECK(error < 1e-10 * largest); // penalty 100 times rounding 1e-13
      const auto fa = a.force(a.residual(), 0), fb = b.force(b.residual(), 0);
      CHECK((fa - fb).norm() < 1e-11 * fa.norm());
    }
}



TEST_CASE("Half of the nodes counted twice gives the force of a symmetric pair",
          "[contact]")
{
  // 2-fold axis along z: (x, y, z) -> (-x, -y, z).
  const auto half = [](const Point<3> &X) -> unsigned int {
    const double tiny = 1e-9;
    if (std::abs(X[0]) > tiny)
      return X[0] > 0. ? 2 : 0;
    if (std::abs(X[1]) > tiny)
      return X[1] > 0. ? 2 : 0;
    return 1;
  };
  for (const std::string &method : methods)
    {
      const auto patches = curved_pair<3>(2, true);
      Pair<3>    full(patches, contact_parameters(method), 0.2);
      Pair<3>    condensed(
        patches, contact_parameters(method), 0.2, Basis::NURBS, half);
      // A twist keeps the symmetry.
      for (Pair<3> *pair : {&full, &condensed})
        {
          pair->begin_step(pair->zero());
          pair->evaluate(pair->zero());
          pair->accept();
          pair->evaluate(
            pair->displacement([](const Point<3> &X) { return X; },
                               [](const Point<3> &X) {
                                 return Point<3>(X[0] - 0.05 * X[1],
                                                 X[1] + 0.05 * X[0],
                                                 X[2] - 0.01);
                               }));
        }
      const auto r = full.residual(), h = condensed.residual();
      auto       sum = full.zero();
      for (unsigned int A = 0; A < full.X.size(); ++A)
        {
          unsigned int partner = 0;
          while (full.X[partner].distance(
                   Point<3>(-full.X[A][0], -full.X[A][1], full.X[A][2])) >
                   1e-9 ||
                 (partner < full.space.patch(0).n_control_points()) !=
                   (A < full.space.patch(0).n_control_points()))
            ++partner;
          for (unsigned int i = 0; i < 3; ++i)
            sum[3 * A + i] =
              0.5 * (h[3 * A + i] + (i < 2 ? -1. : 1.) * h[3 * partner + i]);
        }
      CHECK(difference(sum, r) < 1e-12); // rounding
      CHECK(difference(h, r) > 0.1);     // not the same before folding
      const auto p = full.summary(), q = condensed.summary();
      CHECK(p.n_active == q.n_active);
      CHECK(p.n_slip == q.n_slip);
      CHECK(q.energy == Approx(p.energy).epsilon(1e-12));
      CHECK(q.dissipation == Approx(p.dissipation).epsilon(1e-12));
    }
}



TEST_CASE("What was tried and not accepted leaves no trace, to the last bit",
          "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<3>    pair(curved_pair<3>(2), contact_parameters(method), 0.25);
      const auto path = frictional_path(pair);
      follow(pair, path);
      const auto r = pair.residual();
      const auto d = random_direction<3>(pair.n(), 4);
      const auto K = pair.tangent_times(d).first;

      // Another displacement, and back, in the same storage.
      auto other = path[2];
      other.add(0.05, d);
      CHECK(difference(pair.residual(other), r) > 1e-3);
      CHECK(pair.residual(path[2]) == r);
      CHECK(pair.tangent_times(d).first == K);

      // A rejected step, and the step again.
      pair.evaluate(other);
      pair.begin_step(path[1]);
      CHECK(pair.residual(path[2]) == r);

      // The same state begins a step again after another was accepted.
      const ContactState<3> state = pair.state;
      pair.accept();
      CHECK(pair.state.traction != state.traction);
      pair.begin_step(path[2]);
      pair.evaluate(other);
      pair.state = state;
      pair.begin_step(path[1]);
      CHECK(pair.residual(path[2]) == r);
    }
}



TEST_CASE(
  "Multipliers of Gauss points take over what control points resolve and "
  "leave the rest: a repetition changes them by a field of as many "
  "dimensions as there are control points",
  "[contact]")
{
  for (const std::string &method : {std::string("KTS"), at_points})
    {
      INFO(method);
      Conditions parameters = contact_parameters(method);
      parameters.enforcement =
        ContactParameters::Enforcement::augmented_lagrangian;
      Pair<2>    pair(curved_pair<2>(2), parameters, 0.25);
      const auto path = frictional_path(pair);
      follow(pair, path);
      // The change of the field over its means over the supports, which is what
      // the multipliers lack after the next repetition if nothing moves.
      const auto before = pair.step;
      pair.contact.augment(pair.step, pair.evaluation);
      const auto &points = pair.contact.quadrature_points();
      REQUIRE(points.size() > pair.secondary.n_control_points());
      const auto is_in_space = [&](const std::function<double(unsigned)> &f) {
        // Least squares by the control points' functions leave nothing.
        const unsigned int         n = pair.secondary.n_control_points();
        dealii::FullMatrix<double> M(n, n);
        Vector<double>             b(n), x(n);
        double                     size = 0, rest = 0;
        const auto for_each = [&](const unsigned q, const auto &visit) {
          for (unsigned int l = 0; l < points[q].averaging.lattice.size(); ++l)
            visit(points[q].averaging.lattice[l], points[q].averaging.value[l]);
        };
        for (unsigned int q = 0; q < points.size(); ++q)
          for_each(q, [&](const unsigned A, const double N_A) {
            b[A] += N_A * f(q);
            for_each(q, [&](const unsigned B, const double N_B) {
              M(A, B) += N_A * N_B;
            });
          });
        M.gauss_jordan();
        M.vmult(x, b);
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            double left = f(q);
            for_each(q, [&](const unsigned A, const double N_A) {
              left -= N_A * x[A];
            });
            rest = std::max(rest, std::abs(left));
            size = std::max(size, std::abs(f(q)));
          }
        CHECK(size > 0);
        return rest < 1e-10 * size;
      };
      CHECK(is_in_space([&](const unsigned int q) {
        return pair.step.traction_multiplier[q][0] -
               before.traction_multiplier[q][0];
      }));
      CHECK_FALSE(is_in_space([&](const unsigned int q) {
        return pair.evaluation.friction[q].response.traction[0] -
               before.traction_multiplier[q][0];
      }));
    }
}



TEST_CASE("Without friction nothing of friction is computed", "[contact]")
{
  for (const std::string &method : methods)
    {
      Pair<3>    never(curved_pair<3>(2), contact_parameters(method), 0.);
      Pair<3>    off(curved_pair<3>(2), contact_parameters(method), 0.25);
      const auto path = frictional_path(never);
      follow(off, path);
      off.state = off.contact.with_friction(off.state, false);
      follow(never, path);
      follow(off, path);
      CHECK(never.residual() == off.residual());
      const auto d = random_direction<3>(off.n(), 4);
      CHECK(never.tangent_times(d).first == off.tangent_times(d).first);
      for (const Pair<3> *pair : {&never, &off})
        {
          for (const auto &node : pair->evaluation.friction)
            {
              CHECK(node.slip == std::array<double, 2>{});
              CHECK(node.response.traction == std::array<double, 2>{});
            }
          for (const auto &t : pair->state.traction)
            CHECK(t == std::array<double, 2>{});
          CHECK(pair->summary().n_slip == 0);
          CHECK(pair->summary().n_stick == 0);
          CHECK(pair->summary().dissipation == 0.);
        }
      // Switched on: the first step starts without slip.
      off.accept();
      off.state = off.contact.with_friction(off.state, true);
      off.begin_step(path[2]);
      off.evaluate(path[2]);
      for (const auto &node : off.evaluation.friction)
        CHECK(std::hypot(node.slip[0], node.slip[1]) < 1e-12);
    }
}



TEST_CASE("A block pressed on a plane carries penalty times depth times length",
          "[contact]")
{
  const auto patches = [](const unsigned int n_spans) {
    return std::vector<NURBSPatch<2>>{
      slab<2>(uniform_knots<2>(2, n_spans, 1),
              [](const Point<2> &u) {
                return Point<2>(u[0] - 0.5, u[1] - 1.);
              }),
      slab<2>(uniform_knots<2>(2, 4, 1), [](const Point<2> &u) {
        return Point<2>(6. * u[0] - 3., u[1]);
      })};
  };
  for (const std::string &measure : slip_measures)
    for (const std::string &method : methods)
      for (const unsigned int n_spans : {1, 3})
        {
          // The block is the lower, secondary body, length 1.
          Pair<2> pair(patches(n_spans),
                       contact_parameters(method),
                       0.3,
                       Basis::NURBS,
                       {},
                       measure);
          auto    state = [&](const double slip) {
            return pair.displacement(
              [slip](const Point<2> &X) {
                return Point<2>(X[0] + slip, X[1] + 0.01);
              },
              [](const Point<2> &X) { return X; });
          };
          pair.begin_step(pair.zero());
          pair.evaluate(state(0.));
          pair.accept();
          const double N = 100. * 0.01 * 1.;

          // The force on a body is minus its part of the virtual work. Slip
          // begins after 0.003 = mu p / eps_T; steps of 0.001 end there.
          double                    position = 0., previous = 0.;
          double                    work = 0., dissipation = 0.;
          const double              amplitude = 0.010;
          std::vector<unsigned int> legs      = {10, 20, 20, 20};
          for (unsigned int leg = 0; leg < legs.size(); ++leg)
            {
              if (leg == 2)
                work = dissipation = 0.; // the loop from here on
              for (unsigned int i = 1; i <= legs[leg]; ++i)
                {
                  pair.begin_step(state(position));
                  position += leg % 2 == 0 ? 0.001 : -0.001;
                  pair.evaluate(state(position));
                  const auto r     = pair.residual();
                  const auto force = -1. * pair.force(r, 0);
                  CHECK(std::abs(force[1] + N) < 1e-12); // rounding
                  CHECK((force + -1. * pair.force(r, 1)).norm() < 1e-12);
                  // Opposes the motion of the secondary: elastic, then mu N.
                  const double traveled =
                    leg == 0 ? i * 0.001 : i * 0.001 - 0.003;
                  const double expected = std::min(100. * traveled, 0.3 * N);
                  CHECK(
                    std::abs(force[0] + (leg % 2 == 0 ? expected : -expected)) <
                    1e-10); // penalty times rounding
                  work -= 0.5 * (force[0] + previous) *
                          (leg % 2 == 0 ? 0.001 : -0.001);
                  previous = force[0];
                  CHECK(pair.summary().dissipation >= 0.);
                  dissipation += pair.summary().dissipation;
                  pair.accept();
                }
            }
          // A parallelogram: 2 mu N high, 2 (A - 0.003) wide.
          CHECK(work ==
                Approx(4. * 0.3 * N * (amplitude - 0.003)).epsilon(1e-9));
          CHECK(dissipation == Approx(work).epsilon(1e-9));
        }
}



TEST_CASE("What friction dissipates under growing pressure does not depend on "
          "the steps",
          "[contact]")
{
  // A block of length 1 that slides under a pressure that grows with its path:
  // mu |p| = 0.3 + 6 s, of which the penalty stores a part of the slip.
  const std::vector<NURBSPatch<2>> patches = {
    slab<2>(uniform_knots<2>(2, 1, 1),
            [](const Point<2> &u) { return Point<2>(u[0] - 0.5, u[1] - 1.); }),
    slab<2>(uniform_knots<2>(2, 4, 1),
            [](const Point<2> &u) { return Point<2>(6. * u[0] - 3., u[1]); })};
  for (const std::string &measure : slip_measures)
    for (const std::string &method : methods)
      for (const unsigned int n_steps : {1, 2, 5})
        {
          INFO(measure << ", " << method << ", " << n_steps << " steps");
          Pair<2>    pair(patches,
                       contact_parameters(method),
                       0.3,
                       Basis::NURBS,
                       {},
                       measure);
          const auto at = [&](const double s) {
            return pair.displacement(
              [s](const Point<2> &X) {
                return Point<2>(X[0] + s, X[1] + 0.01 + 0.2 * s);
              },
              [](const Point<2> &X) { return X; });
          };
          double     dissipation = 0.;
          const auto step        = [&](const double from, const double to) {
            pair.begin_step(at(from));
            pair.evaluate(at(to));
            dissipation += pair.summary().dissipation;
            pair.accept();
          };
          step(0., 0.);
          step(0., 0.01); // slips from 0.3/94 on, where the block is at rest
          const auto limit = [](const double s) { return 0.3 + 6. * s; };
          const auto exact = [&](const double from, const double to) {
            return 0.5 * (limit(from) + limit(to)) * 0.94 * (to - from);
          };
          CHECK(dissipation == Approx(exact(0.3 / 94., 0.01)).epsilon(1e-9));
          dissipation = 0.;
          for (unsigned int k = 0; k < n_steps; ++k)
            step(0.01 + 0.03 * k / n_steps, 0.01 + 0.03 * (k + 1) / n_steps);
          CHECK(dissipation == Approx(exact(0.01, 0.04)).epsilon(1e-9));
        }
}
