// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about mirror planes as constraints: they change no result, and they
// are used only where the load programme leaves the symmetry alone.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>
#include <utility>

namespace
{
  using namespace NPT;
  using Overrides    = std::vector<std::string>;
  using MirrorPlanes = CellParameters::MirrorPlanes;

  PlateTestParameters
  parameters(const Overrides &overrides)
  {
    return PlateTestParameters::read(make_parameter_text("", "cell.prm"),
                                     overrides);
  }

  CurveRow
  last_of(Overrides overrides, const std::string &mirrors)
  {
    overrides.push_back("Cell/Mirror planes=" + mirrors);
    std::ostringstream    screen;
    NumericalPlateTesting test(parameters(overrides), "", screen);
    test.run();
    return test.curve().back();
  }

  Overrides
  with_targets(const std::string &targets)
  {
    return {"Load programme/Stage shear/Targets=" + targets};
  }

  MirrorPlanes
  chosen(Overrides overrides, const std::string &targets)
  {
    overrides.push_back(with_targets(targets).front());
    return parameters(overrides).cell.mirror_planes;
  }
} // namespace



TEST_CASE("Mirror planes change no resultant in tension and bending", "[top]")
{
  const auto [weave, load] =
    GENERATE(std::make_pair("plain", "H1: 0.03, n2: 0, n3: 0"),
             std::make_pair("2/1 rib", "H1: 0.03, n2: 0, n3: 0"),
             std::make_pair("plain", "H4: 0.01"));
  const std::string method = GENERATE("KTS", "mortar");
  INFO(weave << ", " << method << ", " << load);
  Overrides overrides = {std::string("Cell/Weave=") + weave,
                         "Contact/Method=" + method,
                         "Mesh/Elements along=3",
                         "Mesh/Elements across=3",
                         "Mesh/Elements through=1",
                         "Newton/Relative tolerance=1e-10",
                         "Load programme/Stage shear/Initial step=0.5",
                         "Load programme/Stage shear/Maximum step=0.5"};
  overrides.push_back(with_targets(load).front()); // of the default file
  const CurveRow with    = last_of(overrides, "true"),
                 without = last_of(overrides, "false");
  // n6 is a reaction off the group of a plate that bends about one axis, which
  // depends on where the cell is cut; by symmetry it is zero.
  for (const unsigned int n : {0, 1, 2, 3, 4})
    {
      INFO("n" << n + 1);
      const double scale = std::abs(without.n[n < 3 ? 0 : 3]);
      CHECK(std::abs(with.n[n] - without.n[n]) <= 1e-7 * scale);
      CHECK(std::abs(with.H[n] - without.H[n]) < 1e-8);
    }
  CHECK(without.n[0] > 1e-2);
  CHECK(with.n[2] == 0.);
  CHECK(with.n[5] == 0.);
  CHECK(with.n_active == without.n_active);
  CHECK(with.stored_energy == Approx(without.stored_energy).epsilon(1e-8));
  CHECK(with.dissipation == Approx(without.dissipation).epsilon(1e-6));
}



TEST_CASE(
  "A quarter of a cell has the moments of the whole cell, flat and bent",
  "[top]")
{
  const std::string targets   = "n1: 0, n2: 0";
  Overrides         overrides = {"Cell/Type=two-crossing cell",
                                 "Mesh/Elements along=3",
                                 "Mesh/Elements across=3",
                                 "Mesh/Elements through=1",
                                 "Newton/Relative tolerance=1e-11",
                                 "Friction/Friction coefficient=0",
                                 "Load programme/Stages=weave, release, relax",
                                 "Load programme/Stage relax/Targets=" + targets,
                                 "Load programme/Stage relax/Initial step=0.5",
                                 "Load programme/Stage relax/Maximum step=0.5"};
  const CurveRow    with      = last_of(overrides, "true"),
                 without      = last_of(overrides, "false");
  // By the glide planes of the weave, which this cell does not use.
  for (const CurveRow &row : {with, without})
    for (unsigned int n = 3; n < 6; ++n)
      CHECK(std::abs(row.n[n]) < 1e-5);
}



TEST_CASE("The program uses mirror planes where the weave has them and no "
          "stage breaks them",
          "[top]")
{
  const Overrides twill    = {"Cell/Weave=2/2 twill"},
                  crowfoot = {"Cell/Weave=crowfoot"}, // with a shift only
    layers = {"Cell/Layers=2"}, pinned = {"Cell/Two-fold axis=false"};
  CHECK(chosen({}, "H1: 0.1") == MirrorPlanes::yes);
  CHECK(chosen({}, "H4: 0.01, H6: 0") == MirrorPlanes::yes);
  CHECK(chosen({}, "H1: 0.1, n3: 0") == MirrorPlanes::yes);
  CHECK(chosen({}, "H3: 0.1") == MirrorPlanes::no);
  CHECK(chosen({}, "n6: 0.1") == MirrorPlanes::no);
  CHECK(chosen({}, "n3: 0") == MirrorPlanes::no); // nothing would be left
  CHECK(chosen({}, "H1: -0.01, H2: 0") == MirrorPlanes::no);
  CHECK(chosen({}, "n2: -0.1") == MirrorPlanes::no);
  CHECK(chosen(twill, "H1: 0.1") == MirrorPlanes::no);
  CHECK(chosen(crowfoot, "H1: 0.1") == MirrorPlanes::no);
  CHECK(chosen(layers, "H1: 0.1") == MirrorPlanes::no);
  CHECK(chosen(pinned, "H1: 0.1") == MirrorPlanes::no);
}



TEST_CASE("Mirror planes that are asked for and impossible are refused",
          "[top]")
{
  using Catch::Contains;
  const auto with = [](Overrides overrides) {
    overrides.push_back("Cell/Mirror planes=true");
    overrides.push_back("Load programme/Stage shear/Targets=H1: 0.1");
    return parameters(overrides);
  };
  CHECK_THROWS_WITH(with({"Cell/Weave=2/2 twill"}),
                    Contains("the weave '2/2 twill' has none"));
  CHECK_THROWS_WITH(with({"Cell/Two-fold axis=false"}),
                    Contains("Two-fold axis is false"));
  CHECK_THROWS_WITH(with({"Cell/Layers=2"}), Contains("layers of fabric"));
  CHECK_THROWS_WITH(parameters({"Cell/Mirror planes=true"}), // H3: 0.2
                    Contains("its mirror plane") && Contains("H3"));
}
