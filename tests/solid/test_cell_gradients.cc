// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on gradients that are kept or computed again.

#include <npt_dealii/iga/bezier_body.h>
#include <npt_dealii/solid/cell_gradients.h>

#include <catch2/catch.hpp>

#include <random>

using namespace NPT;

namespace
{
  // A cube of 2 x 3 x 1 spans with inner control points moved.
  IGASpace<3>
  uneven_cube()
  {
    const std::array<KnotVector, 3>        knots = {{KnotVector::uniform(2, 2),
                                                     KnotVector::uniform(2, 3),
                                                     KnotVector::uniform(2, 1)}};
    std::mt19937                           generator(1);
    std::uniform_real_distribution<double> shift(-0.02, 0.02);
    std::vector<dealii::Point<3>>          points;
    for (unsigned int k = 0; k < knots[2].n_functions(); ++k)
      for (unsigned int j = 0; j < knots[1].n_functions(); ++j)
        for (unsigned int i = 0; i < knots[0].n_functions(); ++i)
          points.emplace_back(knots[0].greville(i) + shift(generator),
                              knots[1].greville(j) + shift(generator),
                              knots[2].greville(k) + shift(generator));
    return IGASpace<3>({NURBSPatch<3>(knots, points)}, {}, Basis::NURBS);
  }
} // namespace



TEST_CASE("Gradients that are computed again are those that are kept",
          "[solid]")
{
  const IGASpace<3>      space = uneven_cube();
  const GradientsOfCells kept(space), computed(space, 0, 0);
  REQUIRE(kept.are_kept());
  REQUIRE_FALSE(computed.are_kept());
  REQUIRE(computed.size() == 6);
  // In an order that asks for the same cell again.
  for (const unsigned int c : {0u, 5u, 5u, 0u, 3u})
    {
      CHECK(computed[c].jxw == kept[c].jxw);
      CHECK(computed[c].values == kept[c].values);
      CHECK(computed[c].gradients == kept[c].gradients);
    }
  CHECK(kept[1].jxw != kept[2].jxw);
}
