// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about bodies whose stress has relaxed: they are those built in the
// relaxed shape.

#include <npt_dealii/material/make_material.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/verification/solids/benchmark_bodies.h>

#include <deal.II/lac/affine_constraints.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;
using dealii::Point;
using dealii::Tensor;
using dealii::Vector;

namespace
{
  // A homogeneous deformation with stretch, shear and rotation.
  Tensor<2, 3>
  some_gradient()
  {
    Tensor<2, 3> F;
    const double values[] = {
      1.10, 0.20, -0.05, -0.15, 0.95, 0.10, 0.04, 0.08, 0.90};
    for (unsigned int e = 0; e < 9; ++e)
      F[e / 3][e % 3] = values[e];
    return F;
  }

  // A cube of a law, mapped by F, with its fibers along F e_1.
  DeformableBodies
  make_block(const std::string &law, const Tensor<2, 3> &F)
  {
    NURBSPatch<3> cube = unit_block();
    refine(cube, 2, {{2, 1, 1}});
    std::vector<Point<3>> X;
    for (const Point<3> &Y : cube.control_points())
      X.push_back(Point<3>(F * Y));
    Tensor<1, 3> fiber = F * Tensor<1, 3>({1., 0., 0.});
    fiber /= fiber.norm();
    MaterialParameters material;
    material.law = law;
    std::vector<DeformablePart> parts;
    parts.push_back({NURBSPatch<3>({{cube.knot_vector(0),
                                     cube.knot_vector(1),
                                     cube.knot_vector(2)}},
                                   X,
                                   cube.weights()),
                     make_material<3>(material, fiber),
                     0,
                     "the block"});
    return DeformableBodies(std::move(parts), Basis::NURBS);
  }

  Vector<double>
  displacement_by(const DeformableBodies &bodies, const Tensor<2, 3> &F)
  {
    Vector<double> u(bodies.n_displacements());
    for (unsigned int A = 0; A < bodies.space().n_control_points(); ++A)
      {
        const Point<3>    &X = bodies.space().control_points()[A];
        const Tensor<1, 3> w = F * X - Tensor<1, 3>(X);
        for (unsigned int i = 0; i < 3; ++i)
          u[3 * A + i] = w[i];
      }
    return u;
  }

  Vector<double>
  wavy_displacement(const DeformableBodies &bodies)
  {
    Vector<double> u(bodies.n_displacements());
    for (unsigned int k = 0; k < u.size(); ++k)
      u[k] = 0.03 * std::sin(3. * k + 1.);
    return u;
  }

  Vector<double>
  forces(const DeformableBodies &bodies,
         const Vector<double>   &u,
         const NaturalState     &natural = {})
  {
    Vector<double> f(u.size());
    bodies.add_residual(u, f, natural);
    return f;
  }

  const std::vector<std::string> laws = {"fiber bundle", "neo-Hookean"};
} // namespace



TEST_CASE("A relaxed body answers as one that was built in its shape",
          "[solid]")
{
  const Tensor<2, 3> F = some_gradient();
  for (const std::string &law : laws)
    {
      INFO(law);
      const auto relaxed = make_block(law, dealii::unit_symmetric_tensor<3>());
      const auto built   = make_block(law, F);
      const Vector<double> u0 = displacement_by(relaxed, F);
      CHECK(forces(relaxed, u0).l2_norm() > 0.1);
      const NaturalState natural = relaxed.relax(u0, {}, 1.);
      CHECK(forces(relaxed, u0, natural).l2_norm() < 1e-12);
      CHECK(std::abs(relaxed.stored_energy(u0, natural)) < 1e-13);

      Vector<double> u = u0;
      u += wavy_displacement(relaxed);
      const Vector<double> v          = wavy_displacement(built);
      Vector<double>       difference = forces(relaxed, u, natural);
      difference -= forces(built, v);
      CHECK(difference.l2_norm() < 1e-12 * forces(built, v).l2_norm());
      CHECK(relaxed.stored_energy(u, natural) ==
            Approx(built.stored_energy(v)).epsilon(1e-11));
      // First Piola-Kirchhoff stress on the same Cauchy stress.
      Tensor<2, 3> of_relaxed, of_built;
      relaxed.for_each_point(
        u,
        [&](const auto &point) {
          of_relaxed += point.P * transpose(point.F) * point.dV;
        },
        natural);
      built.for_each_point(v, [&](const auto &point) {
        of_built += point.P * transpose(point.F) * point.dV;
      });
      CHECK((of_relaxed - of_built).norm() < 1e-11 * of_built.norm());
    }
}



TEST_CASE("With a natural state forces are the derivative of the energy and "
          "the tangent that of the forces",
          "[solid]")
{
  for (const std::string &law : laws)
    {
      INFO(law);
      const auto bodies = make_block(law, dealii::unit_symmetric_tensor<3>());
      const NaturalState natural =
        bodies.relax(wavy_displacement(bodies), {}, 0.7);
      const Vector<double> u = displacement_by(bodies, some_gradient());
      const Vector<double> f = forces(bodies, u, natural);

      ConstrainedSystem system;
      system.reinit(dealii::AffineConstraints<double>(), u.size());
      const auto groups = bodies.add_groups(system);
      system.build_pattern({});
      system.set_zero();
      bodies.add_tangent(u, groups, system, natural);
      Vector<double> direction(u.size()), K_direction(u.size());
      for (unsigned int k = 0; k < u.size(); ++k)
        direction[k] = std::cos(5. * k);
      system.matrix().vmult(K_direction, direction);

      const double   h = 1e-5;
      Vector<double> forward(u), backward(u);
      forward.add(h, direction);
      backward.add(-h, direction);
      CHECK((bodies.stored_energy(forward, natural) -
             bodies.stored_energy(backward, natural)) /
              (2. * h) ==
            Approx(f * direction).epsilon(1e-6));
      Vector<double> slope = forces(bodies, forward, natural);
      slope -= forces(bodies, backward, natural);
      slope /= 2. * h;
      slope -= K_direction;
      CHECK(slope.l2_norm() < 1e-6 * K_direction.l2_norm());
    }
}



TEST_CASE("Relaxing by a half and by a half of the rest is relaxing by three "
          "quarters",
          "[solid]")
{
  const auto bodies =
    make_block("fiber bundle", dealii::unit_symmetric_tensor<3>());
  const Vector<double> u          = displacement_by(bodies, some_gradient());
  const NaturalState   half       = bodies.relax(u, {}, 0.5);
  const NaturalState   twice      = bodies.relax(u, half, 0.5);
  const NaturalState   once       = bodies.relax(u, {}, 0.75);
  Vector<double>       difference = forces(bodies, u, twice);
  difference -= forces(bodies, u, once);
  CHECK(difference.l2_norm() < 1e-11 * forces(bodies, u, once).l2_norm());
  CHECK(bodies.stored_energy(u, once) < bodies.stored_energy(u, half));
  CHECK(bodies.stored_energy(u, half) < bodies.stored_energy(u));
  CHECK(bodies.relax(u, {}, 0.) ==
        bodies.relax(Vector<double>(u.size()), {}, 1.)); // both the identity
}
