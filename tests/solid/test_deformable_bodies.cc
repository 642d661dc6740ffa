// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the assembly of deformable bodies.

#include <npt_dealii/material/make_material.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/solid/solid_fields.h>
#include <npt_dealii/verification/solids/benchmark_bodies.h>

#include <deal.II/lac/affine_constraints.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <map>

using namespace NPT;
using dealii::Point;
using dealii::Tensor;
using dealii::Vector;

namespace
{
  DeformableBodies
  make_tube(const DeformableBodies::SymmetryWeight &symmetry_weight = {})
  {
    NURBSPatch<3> tube = quarter_tube(1., 2., 1.);
    refine(tube, 2, {{2, 2, 1}});
    MaterialParameters          material;
    std::vector<DeformablePart> parts;
    parts.push_back({tube,
                     make_material<3>(material, Point<3>::unit_vector(2)),
                     0,
                     "the tube"});
    // Rational integrands: four points leave 4e-9 of the volume.
    return DeformableBodies(std::move(parts), Basis::NURBS, 6, symmetry_weight);
  }

  Vector<double>
  some_displacement(const DeformableBodies &bodies)
  {
    Vector<double> u(bodies.n_displacements());
    for (unsigned int k = 0; k < u.size(); ++k)
      u[k] = 0.02 * std::sin(3. * k + 1.);
    return u;
  }
} // namespace



TEST_CASE("The size of a residual is that of the forces of single cells",
          "[solid]")
{
  const auto            all = make_tube();
  const Vector<double>  u   = some_displacement(all);
  std::vector<Point<3>> centers;
  make_tube([&](const unsigned int, const Point<3> &X) {
    centers.push_back(X);
    return 1u;
  });
  REQUIRE(centers.size() == 4);
  double squares = 0;
  for (const Point<3> &center : centers)
    {
      const auto one = make_tube([&](const unsigned int, const Point<3> &X) {
        return X.distance(center) < 1e-12 ? 1u : 0u;
      });
      Vector<double> force(u.size());
      const double   size = one.add_residual(u, force);
      CHECK(size == Approx(force.l2_norm()).epsilon(1e-13));
      squares += size * size;
    }
  Vector<double> force(u.size());
  CHECK(all.add_residual(u, force) ==
        Approx(std::sqrt(squares)).epsilon(1e-13));
}



TEST_CASE("Forces are the derivative of the energy and the tangent that of the "
          "forces",
          "[solid]")
{
  // Cells with symmetry weights 2, 0 and 1 around the tube.
  const auto bodies      = make_tube([](const unsigned int, const Point<3> &X) {
    return X[0] > X[1] ? 2u : X.norm() > 1.6 ? 0u : 1u;
  });
  const Vector<double> u = some_displacement(bodies);
  Vector<double>       force(u.size());
  bodies.add_residual(u, force);

  ConstrainedSystem system;
  system.reinit(dealii::AffineConstraints<double>(), u.size());
  const auto groups = bodies.add_groups(system);
  system.build_pattern({});
  system.set_zero();
  bodies.add_tangent(u, groups, system);

  Vector<double> direction(u.size()), K_direction(u.size());
  for (unsigned int k = 0; k < u.size(); ++k)
    direction[k] = std::cos(5. * k);
  system.matrix().vmult(K_direction, direction);

  const double   h = 1e-5;
  Vector<double> forward(u), backward(u), f_forward(u.size()),
    f_backward(u.size());
  forward.add(h, direction);
  backward.add(-h, direction);
  CHECK((bodies.stored_energy(forward) - bodies.stored_energy(backward)) /
          (2. * h) ==
        Approx(force * direction).epsilon(1e-7));
  bodies.add_residual(forward, f_forward);
  bodies.add_residual(backward, f_backward);
  f_forward -= f_backward;
  f_forward /= 2. * h;
  f_forward -= K_direction;
  CHECK(f_forward.l2_norm() < 1e-6 * K_direction.l2_norm());
}



TEST_CASE("Volume averages count each point as often as its cell", "[solid]")
{
  const double volume = 3. * std::atan(1.); // of the quarter tube
  const auto   twice =
    make_tube([](const unsigned int, const Point<3> &) { return 2u; });
  double sum = 0, mean_X = 0;

  std::vector<double> X1;
  for (const Point<3> &X : twice.space().control_points())
    X1.push_back(X[0]);
  twice.for_each_point(Vector<double>(twice.n_displacements()),
                       [&](const auto &point) {
                         sum += point.dV;
                         mean_X += twice.interpolate(point, X1) * point.dV;
                         CHECK(point.P.norm() < 1e-14);
                       });
  CHECK(sum == Approx(2. * volume).epsilon(1e-9));
  // int x dV = int r cos(theta) r dr dtheta = (8 - 1) / 3, twice.
  CHECK(mean_X == Approx(14. / 3.).epsilon(1e-6));

  for (const bool by_symmetry_weight : {false, true})
    {
      double all = 0;
      for (const double integral :
           twice.integrals_of_functions(by_symmetry_weight))
        all += integral;
      CHECK(all ==
            Approx((by_symmetry_weight ? 2. : 1.) * volume).epsilon(1e-9));
    }
}



TEST_CASE("An inverted cell is reported with the name of its part", "[solid]")
{
  const auto     bodies = make_tube();
  Vector<double> u(bodies.n_displacements()), force(u.size());
  for (unsigned int A = 0; A < bodies.space().n_control_points(); ++A)
    u[3 * A] = -2. * bodies.space().control_points()[A][0];
  CHECK_THROWS_WITH(bodies.add_residual(u, force),
                    Catch::Contains("cell 0 of the tube"));
}



TEST_CASE("Fields of an affine displacement are those of its gradient at every "
          "Bezier point",
          "[solid]")
{
  const auto         bodies = make_tube();
  const Tensor<2, 3> F({{1.05, 0.1, 0.}, {0.2, 0.95, 0.}, {0., 0.1, 1.}});
  Vector<double>     u(bodies.n_displacements());
  const auto        &control_points = bodies.space().control_points();
  for (unsigned int A = 0; A < control_points.size(); ++A)
    {
      const Tensor<1, 3> X = control_points[A];
      const Tensor<1, 3> w = F * X - X;
      for (unsigned int i = 0; i < 3; ++i)
        u[3 * A + i] = w[i];
    }
  const PointState expected = point_state(*bodies.laws()[0], F);
  const BezierMesh mesh =
    make_bundle_fields(bodies.space(), bodies.laws(), bodies.gradients(), u);

  const std::map<std::string, std::vector<double>> constant = {
    {"von_Mises_stress", {expected.von_mises}},
    {"volume_ratio", {expected.volume_ratio}},
    {"fiber_direction",
     {expected.fiber[0], expected.fiber[1], expected.fiber[2]}},
    {"fiber_stretch", {expected.stretch}},
    {"fiber_shear", {expected.fiber_shear}}};
  unsigned int n_seen = 0;
  for (const auto &field : mesh.point_data)
    if (const auto known = constant.find(field.name); known != constant.end())
      {
        ++n_seen;
        INFO(field.name);
        double worst = 0;
        for (unsigned int i = 0; i < field.values.size(); ++i)
          worst = std::max(worst,
                           std::abs(field.values[i] -
                                    known->second[i % known->second.size()]));
        CHECK(worst < 1e-10);
      }
  CHECK(n_seen == constant.size());
}



TEST_CASE("Bodies without fibers have no fiber fields, and where they join "
          "others the means are those of the fibers",
          "[solid]")
{
  // Two blocks of one body, the second without a fiber.
  const auto make = [](const std::string &first) {
    std::vector<DeformablePart> parts;
    for (const auto &law : {first, std::string("neo-Hookean")})
      {
        MaterialParameters material(law);
        NURBSPatch<3>      block = unit_block();
        refine(block, 2, {{1, 1, 1}});
        auto points = block.control_points();
        for (Point<3> &X : points)
          X[0] += parts.size();
        parts.push_back({NURBSPatch<3>(block.knot_vectors(), points),
                         make_material<3>(material, Point<3>::unit_vector(2)),
                         0,
                         "a block"});
      }
    return DeformableBodies(std::move(parts), Basis::NURBS);
  };
  const auto fields = [](const DeformableBodies &bodies) {
    Vector<double> u(bodies.n_displacements());
    for (unsigned int A = 0; A < bodies.space().n_control_points(); ++A)
      u[3 * A + 2] = 0.1 * bodies.space().control_points()[A][2];
    return make_bundle_fields(bodies.space(),
                              bodies.laws(),
                              bodies.gradients(),
                              u);
  };

  for (const auto &field : fields(make("neo-Hookean")).point_data)
    CHECK(field.name.rfind("fiber", 0) == std::string::npos);

  double largest = 0, smallest = 2;
  for (const auto &field : fields(make("fiber bundle")).point_data)
    if (field.name == "fiber_stretch")
      for (unsigned int i = 0; i < 27; ++i) // the first block
        {
          largest  = std::max(largest, field.values[i]);
          smallest = std::min(smallest, field.values[i]);
        }
  CHECK(largest == Approx(1.1).epsilon(1e-12));
  CHECK(smallest == Approx(1.1).epsilon(1e-12));
}
