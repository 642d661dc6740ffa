// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about bundles that nothing but contact holds, and about neighbors that
// may touch.

#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/weaving_foundation.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;
  using dealii::Vector;
  using PlateTestTools::PlateRun;

  std::vector<CurveRow>
  run(const std::vector<std::string> &overrides)
  {
    std::ostringstream    screen;
    NumericalPlateTesting test(
      PlateTestParameters::read(make_parameter_text("", "floating.prm"),
                                overrides),
      "",
      screen);
    test.run();
    return test.curve();
  }

  // Strands of the whole repeat that belong to a bundle of the cell move by
  // +e_i or -e_i: bundles of the cell, by their own motion or that of images.
  Vector<double>
  rigid_motion(const PlateCell   &cell,
               const unsigned int bundle,
               const unsigned int i)
  {
    const auto         &fabric = cell.fabric();
    std::vector<double> motion(fabric.bundles().size(), 0.);
    const auto          center = [&](const unsigned int b) {
      return fabric.bundles()[b].patch.value(dealii::Point<3>(0.5, 0.5, 0.5));
    };
    motion[bundle] = 1.;
    for (unsigned int b = 0; b < motion.size(); ++b)
      for (const SymmetryOperation &g : fabric.operations())
        {
          const unsigned int across =
            fabric.bundles()[b].family == FiberBundle::Family::warp ? 1 : 0;
          if (b != bundle &&
              fabric.bundles()[b].family == fabric.bundles()[bundle].family &&
              std::abs(g(center(bundle))[across] - center(b)[across]) < 1e-6)
            motion[b] = g.Q[i];
        }
    Vector<double>     u(cell.macro().n_unknowns());
    const IGASpace<3> &space = cell.bodies().space();
    for (unsigned int b = 0; b < motion.size(); ++b)
      for (unsigned int l = 0; l < space.patch(b).n_control_points(); ++l)
        u[3 * space.control_point(b, l) + i] = motion[b];
    return u;
  }

  bool
  obeys(const dealii::AffineConstraints<double> &couplings,
        const PlateCell                         &cell,
        const Vector<double>                    &u)
  {
    for (unsigned int k = 0; k < cell.macro().first; ++k)
      if (couplings.is_constrained(k))
        {
          double value = 0;
          for (const auto &entry : *couplings.get_constraint_entries(k))
            value += entry.second * u[entry.first];
          if (std::abs(value - u[k]) > 1e-9)
            return false;
        }
    return true;
  }

  const std::vector<std::string> small = {"Mesh/Elements along=2",
                                          "Mesh/Elements across=2",
                                          "Mesh/Elements through=1"};

  std::vector<std::string>
  with(std::vector<std::string>        entries,
       const std::vector<std::string> &further)
  {
    entries.insert(entries.end(), further.begin(), further.end());
    return entries;
  }
} // namespace



TEST_CASE("A bundle floats exactly in the directions in which the couplings "
          "allow its rigid motion, and there the foundation holds it",
          "[top]")
{
  const std::vector<std::vector<std::string>> cells = {
    {"Cell/Weave=plain"},
    {"Cell/Weave=plain", "Cell/Two-fold axis=false"},
    {"Cell/Weave=plain", "Cell/Type=two-crossing cell"},
    {"Cell/Weave=2/2 rib"},
    {"Cell/Weave=2/2 rib", "Cell/Type=primitive cell"},
    {"Cell/Weave=2/2 rib",
     "Cell/Type=primitive cell",
     "Cell/Two-fold axis=false"},
    {"Cell/Weave=2/1 rib"},
    {"Cell/Weave=2/2 basket"},
    {"Cell/Weave=2/1 twill"},
    {"Cell/Weave=2/1 twill", "Cell/Type=unit cell"},
    {"Cell/Weave=2/2 twill"},
    {"Cell/Weave=crowfoot"}};
  unsigned int n_floating = 0, n_held = 0;
  for (const auto &entries : cells)
    {
      const PlateRun test(with(small, entries));
      Pins           none;
      none.used                   = false;
      const auto        couplings = test.couplings(none);
      WeavingFoundation foundation(test.cell);
      for (unsigned int b = 0; b < test.cell.fabric().bundles().size(); ++b)
        for (unsigned int i = 0; i < 3; ++i)
          {
            INFO(entries.front() << ", " << entries.back() << ", bundle " << b
                                 << ", Y" << i + 1);
            const Vector<double> u      = rigid_motion(test.cell, b, i);
            const bool           floats = obeys(couplings, test.cell, u);
            CHECK(test.cell.fabric().can_float(b)[i] == floats);
            if (floats)
              CHECK(foundation.largest_force(u, 1.) > 0.);
            else
              CHECK(foundation.largest_force(u, 1.) == 0.);
            ++(floats ? n_floating : n_held);
          }
    }
  CHECK(n_floating > 20);
  CHECK(n_held > 20);
}



TEST_CASE("The tangent of the foundation is the derivative of its forces, and "
          "homogeneous deformation is free of them",
          "[top]")
{
  PlateRun test(
    with(small, {"Cell/Weave=2/2 rib", "Cell/Two-fold axis=false"}));
  const MacroUnknowns              &macro = test.cell.macro();
  WeavingFoundation                 foundation(test.cell);
  dealii::AffineConstraints<double> none;
  none.close();
  test.system.reinit(none, macro.n_unknowns());
  foundation.add_groups(test.system);
  test.system.build_pattern();
  foundation.add_tangent(0.7, test.system);

  Vector<double> u(macro.n_unknowns()), force(u.size()), Ku(u.size());
  for (unsigned int k = 0; k < u.size(); ++k)
    u[k] = std::sin(1. + k);
  foundation.add_residual(u, 0.7, force);
  test.system.matrix().vmult(Ku, u);
  Ku -= force; // it is linear
  CHECK(Ku.linfty_norm() < 1e-12 * force.linfty_norm());

  Vector<double> homogeneous(macro.n_unknowns());
  for (unsigned int n = 0; n < 3; ++n)
    homogeneous[macro.mode(n)] = 0.1 * (n + 1);
  const auto &X = test.cell.bodies().space().control_points();
  for (unsigned int A = 0; A < X.size(); ++A)
    for (unsigned int n = 0; n < 3; ++n)
      for (unsigned int i = 0; i < 2; ++i)
        homogeneous[3 * A + i] +=
          0.1 * (n + 1) * macroscopic_displacement(n, X[A])[i];
  CHECK(foundation.largest_force(homogeneous, 1.) <
        1e-12 * foundation.largest_force(u, 1.));
}



TEST_CASE("Weaving a cell that floats does not depend on the units", "[top]")
{
  // Lengths by 1e-3, stresses by 1e6: n by 1e3 and forces by one.
  const std::vector<std::string> cell      = {"Cell/Type=two-crossing cell",
                                              "Load programme/Stages=weave, release",
                                              "Newton/Relative tolerance=1e-10"};
  const auto                     in_mm     = run(with(small, cell));
  const auto                     in_metres = run(with(with(small, cell),
                                  {"Cell/Crossing spacing=5e-3",
                                                       "Cell/Bundle width=4e-3",
                                                       "Cell/Bundle thickness=1.2e-3",
                                                       "Fiber bundle material/mu_iso=3.2675e6",
                                                       "Fiber bundle material/lambda_iso=3.9042e6",
                                                       "Fiber bundle material/a_trn=-2.3451e6",
                                                       "Fiber bundle material/b_trn=16.167e6",
                                                       "Fiber bundle material/c_trn=4.7881e6",
                                                       "Fiber bundle material/d_trn=6.4613e6",
                                                       "Contact/Normal penalty=100e9",
                                                       "Friction/Tangential penalty=100e9"}));
  REQUIRE(in_metres.size() == in_mm.size());
  for (unsigned int k = 0; k < in_mm.size(); ++k)
    for (unsigned int n = 0; n < 2; ++n)
      CHECK(in_metres[k].n[n] == Approx(1e3 * in_mm[k].n[n]).epsilon(1e-9));
}



namespace
{
  // n1 and n2 of the primitive cell with side contact in the version before
  // `automatic` knew of ribs, 1af3805. Without it the wefts of a shed were in
  // one place (n2 = .091); with a pin in each of them n2 was .419.
  void
  check_rib(const std::vector<std::string> &cell)
  {
    INFO(cell.back());
    const auto curve = run(with(cell,
                                {"Cell/Weave=ou/ou/uo/uo",
                                 "Mesh/Elements along=4",
                                 "Mesh/Elements across=4",
                                 "Mesh/Elements through=1",
                                 "Load programme/Stages=weave, release"}));
    CHECK(curve.back().n[0] == Approx(0.889).epsilon(0.002));
    CHECK(curve.back().n[1] == Approx(0.248).epsilon(0.003));
  }
} // namespace

TEST_CASE("Wefts in one shed of a rib touch each other in the cell that the "
          "program chooses",
          "[top]")
{
  check_rib({"Cell/Type=automatic"});
}



// Two minutes on a busy machine.
TEST_CASE("Wefts in one shed of a rib touch each other in the primitive cell, "
          "with the 2-fold axis and without",
          "[top][.slow]")
{
  check_rib({"Cell/Type=primitive cell"});
  check_rib({"Cell/Type=primitive cell", "Cell/Two-fold axis=false"});
}



TEST_CASE("Side contact is on where lines may come near each other", "[top]")
{
  using SideContact = CellParameters::SideContact;
  const auto side   = [](const std::vector<std::string> &targets,
                       const std::vector<std::string> &cell = {}) {
    std::vector<std::string> entries = cell;
    std::string              stages  = "weave, release";
    for (unsigned int k = 0; k < targets.size(); ++k)
      {
        const std::string name = "s" + std::to_string(k);
        stages += ", " + name;
        entries.push_back("Load programme/Stage " + name +
                          "/Targets=" + targets[k]);
      }
    entries.push_back("Load programme/Stages=" + stages);
    return PlateTestParameters::read(make_parameter_text("", "side.prm"),
                                     entries)
      .cell.side_contact;
  };
  // Default cell: width 4, spacing 5, so from 4.4 mm on, .88 of the spacing.
  const std::vector<std::vector<std::string>> apart = {
    {"H1: -0.11"},
    {"H3: 0.2"},
    {"H1: 0.2"},
    {"n1: 0, n2: 0, n3: 0", "H4: 0.05"},
    {"n1: 2, n2: 2", "H3: 0.2"}};
  const std::vector<std::vector<std::string>> near = {
    {"H1: -0.13"},
    {"H1: -0.13", "H1: 0"},
    {"H1: -0.05, H2: -0.05, H3: 0.45"},
    {"H3: 0.6"},
    {"H5: 0.15"},
    {"n1: -0.1"},
    {"n1: 2, n2: 0"},
    {"n3: 0.1"},
    {"n6: 0.1"}};
  for (const auto &targets : apart)
    {
      INFO(targets.front());
      CHECK(side(targets) == SideContact::off);
    }
  for (const auto &targets : near)
    {
      INFO(targets.front());
      CHECK(side(targets) == SideContact::on);
    }
  // A twill shears by itself when n3 = 0.
  CHECK(side({"n3: 0"}, {"Cell/Weave=2/2 twill"}) == SideContact::on);
  CHECK(side({"n1: 0, n2: 0"}, {"Cell/Weave=2/2 twill"}) == SideContact::off);
  // The weft may take all of the crimp where the warp is held.
  CHECK(side({"n2: 0"}) == SideContact::on);
  // The same cell in other units.
  CHECK(side({"H1: -0.11"},
             {"Cell/Crossing spacing=5e-3",
              "Cell/Bundle width=4e-3",
              "Cell/Bundle thickness=1.2e-3"}) == SideContact::off);
  for (const std::string weave : {"2/1 rib", "2/2 rib", "2/2 basket"})
    CHECK(side({"H3: 0.1"}, {"Cell/Weave=" + weave}) == SideContact::on);
  // What the file says counts.
  CHECK(side({"H1: -0.13"}, {"Cell/Side contact=off"}) == SideContact::off);
}



TEST_CASE("Seams are smooth in all weaves but the plain one, unless the file "
          "says otherwise",
          "[top]")
{
  using SmoothClosure = CellParameters::SmoothClosure;
  const auto closure  = [](const std::vector<std::string> &entries) {
    return PlateTestParameters::read(make_parameter_text("", "smooth.prm"),
                                     entries)
      .cell.smooth_closure;
  };
  CHECK(closure({}) == SmoothClosure::no);
  CHECK(closure({"Cell/Weave=2/1 twill"}) == SmoothClosure::yes);
  CHECK(closure({"Cell/Weave=2/2 rib"}) == SmoothClosure::yes);
  CHECK(closure({"Cell/Weave=ouou/uouo"}) == SmoothClosure::no);
  CHECK(closure({"Cell/Weave=5-harness satin"}) == SmoothClosure::yes);
  CHECK(closure({"Cell/Weave=5-harness satin", "Cell/Smooth closure=false"}) ==
        SmoothClosure::no);
  CHECK(closure({"Cell/Weave=5-harness satin", "Mesh/Basis=Bernstein"}) ==
        SmoothClosure::no);
  CHECK(closure({"Cell/Smooth closure=true"}) == SmoothClosure::yes);
}
