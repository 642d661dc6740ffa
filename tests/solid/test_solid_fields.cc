// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the fields of the bundles.

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/neo_hookean.h>
#include <npt_dealii/solid/solid_fields.h>

#include <deal.II/physics/transformations.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;
using dealii::outer_product;
using dealii::Tensor;

namespace
{
  const Tensor<1, 3> fiber({2. / 3., -1. / 3., 2. / 3.});
  const Tensor<1, 3> across({1. / 3., -2. / 3., -2. / 3.});

  Tensor<2, 3>
  identity()
  {
    return dealii::unit_symmetric_tensor<3>();
  }

  Tensor<2, 3>
  rotation()
  {
    return dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
      dealii::Point<3>(0.6, 0., 0.8), 1.1);
  }
} // namespace



TEST_CASE("Fiber stretch and shear are those of a homogeneous state, however "
          "it is turned",
          "[solid]")
{
  const FiberBundleLaw<3> law(FiberBundleConstants(), fiber);
  const double            gamma = 0.3, lambda = 1.1;
  for (const Tensor<2, 3> &R : {identity(), rotation()})
    {
      // Planes slide along the fibers, then fibers tilt over their sections.
      const PointState along =
        point_state(law,
                    R * (identity() + gamma * outer_product(fiber, across)));
      CHECK(along.fiber_shear == Approx(gamma).epsilon(1e-12));
      CHECK(along.stretch == Approx(1.).epsilon(1e-12));
      CHECK((along.fiber - R * fiber).norm() < 1e-12);
      const PointState tilt =
        point_state(law,
                    R * (identity() + gamma * outer_product(across, fiber)));
      CHECK(tilt.fiber_shear == Approx(gamma).epsilon(1e-12));
      CHECK(tilt.stretch == Approx(std::hypot(1., gamma)).epsilon(1e-12));

      const PointState pulled = point_state(
        law, R * (identity() + (lambda - 1.) * outer_product(fiber, fiber)));
      CHECK(pulled.fiber_shear == Approx(0.).margin(1e-12));
      CHECK(pulled.stretch == Approx(lambda).epsilon(1e-12));
      CHECK(pulled.volume_ratio == Approx(lambda).epsilon(1e-12));
      const Tensor<1, 3> e = R * fiber;
      CHECK(pulled.von_mises ==
            Approx(std::abs(e * pulled.stress * e -
                            R * across * pulled.stress * (R * across)))
              .epsilon(1e-10));
    }
}



TEST_CASE("The fiber of a law without one is zero", "[solid]")
{
  const auto state = point_state(NeoHookean<3>({3., 2.}), identity());
  CHECK(state.stretch == 0.);
  CHECK(state.fiber.norm() == 0.);
  CHECK(state.volume_ratio == 1.);
}
