// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the cells of one weave against each other, about all six modes,
// and about laminates against classical plate theory.

#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <deal.II/lac/full_matrix.h>

#include <catch2/catch.hpp>

#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;
  using PlateTestTools::PlateRun;

  std::vector<CurveRow>
  run(const std::vector<std::string> &overrides)
  {
    std::ostringstream    screen;
    NumericalPlateTesting test(
      PlateTestParameters::read(make_parameter_text("", "cell.prm"), overrides),
      "",
      screen);
    test.run();
    return test.curve();
  }

  // Plane-stress stiffness of a ply from the small-strain stiffness of the
  // law, by classical lamination theory: invert, keep 11, 22, 12, invert.
  dealii::FullMatrix<double>
  plane_stress(const double angle)
  {
    const FiberBundleLaw<3>    law(FiberBundleConstants(),
                                dealii::Tensor<1, 3>({1., 0., 0.}));
    dealii::FullMatrix<double> S(law.small_strain_stiffness());
    S.gauss_jordan();
    const unsigned int         keep[3] = {0, 1, 5};
    dealii::FullMatrix<double> Q(3, 3), T(3, 3), QT(3, 3), result(3, 3);
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        Q(i, j) = S(keep[i], keep[j]);
    Q.gauss_jordan();
    // Strains of the plate in the axes of the ply, engineering shear.
    const double c = std::cos(angle), s = std::sin(angle);
    const double t[3][3] = {{c * c, s * s, c * s},
                            {s * s, c * c, -c * s},
                            {-2 * c * s, 2 * c * s, c * c - s * s}};
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        T(i, j) = t[i][j];
    Q.mmult(QT, T);
    T.Tmmult(result, QT);
    return result;
  }
} // namespace



TEST_CASE("Laminates have the A, B and D of classical plate theory", "[top]")
{
  // Central differences at 1e-4 leave the third derivative: 1e-8 relative.
  for (const std::string plies : {"0", "0, 90", "0, 90, 30"})
    {
      std::vector<double> angles;
      if (plies == "0")
        angles = {0.};
      else if (plies == "0, 90")
        angles = {0., 90.};
      else
        angles = {0., 90., 30.};
      const double               t = 1.2;
      dealii::FullMatrix<double> expected(6, 6);
      for (unsigned int k = 0; k < angles.size(); ++k)
        {
          const double z0 = -t / 2 + k * t / angles.size();
          const double z1 = z0 + t / angles.size();
          const auto   Q  = plane_stress(angles[k] * dealii::numbers::PI / 180);
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              {
                expected(i, j) += Q(i, j) * (z1 - z0);
                expected(i, j + 3) += Q(i, j) * (z1 * z1 - z0 * z0) / 2;
                expected(i + 3, j) += Q(i, j) * (z1 * z1 - z0 * z0) / 2;
                expected(i + 3, j + 3) +=
                  Q(i, j) * (z1 * z1 * z1 - z0 * z0 * z0) / 3;
              }
        }
      // Independent of the size of the cell. The smooth closure (of the cell of
      // 7 mm) leaves out no quadratic field, so it changes nothing.
      for (const std::string L : {"5", "7"})
        for (unsigned int m = 0; m < 6; ++m)
          {
            const std::string   elements = L == "7" ? "2" : "1";
            std::vector<double> n[2];
            for (const int sign : {1, -1})
              {
                const auto row =
                  run({"Cell/Type=laminate",
                       "Cell/Plies=" + plies,
                       "Cell/Crossing spacing=" + L,
                       std::string("Cell/Smooth closure=") +
                         (L == "7" ? "true" : "false"),
                       "Mesh/Elements along=" + elements,
                       "Mesh/Elements across=" + elements,
                       "Mesh/Elements through=1",
                       "Newton/Relative tolerance=1e-11",
                       "Load programme/Stages=tiny",
                       "Load programme/Stage tiny/Initial step=1",
                       "Load programme/Stage tiny/Maximum step=1",
                       "Load programme/Stage tiny/Targets=H" +
                         std::to_string(m + 1) +
                         (sign > 0 ? ": 1e-4" : ": -1e-4")})
                    .back();
                n[sign > 0 ? 0 : 1].assign(row.n.begin(), row.n.end());
              }
            for (unsigned int k = 0; k < 6; ++k)
              {
                const double scale =
                  (k < 3 ? 1. : t) * (m < 3 ? 1. : t) * expected(0, 0);
                CHECK((n[0][k] - n[1][k]) / 2e-4 ==
                      Approx(expected(k, m)).margin(1e-7 * scale));
              }
          }
    }
}



TEST_CASE(
  "The A, B and D of plates do not depend on the origin and on the pinned "
  "points",
  "[top]")
{
  // Moving the origin adds rotations only, other pins a translation.
  Pins moved;
  moved.in_plane = std::array<double, 2>{{0.2, 0.9}};
  moved.vertical = {{2, 1, 1}};
  const dealii::Tensor<1, 3>                  shift({1.7, -0.6, 0.});
  const std::pair<dealii::Tensor<1, 3>, Pins> variants[] = {{{}, {}},
                                                            {shift, {}},
                                                            {{}, moved},
                                                            {shift, moved}};
  for (const std::string plies : {"0", "0, 90"})
    {
      const double t = 1.2, h = 1e-5;
      for (unsigned int m = 0; m < 6; ++m)
        {
          std::vector<std::vector<double>> stiffness;
          for (const auto &[origin, pins] : variants)
            {
              std::vector<double> column(6, 0.);
              for (const int sign : {1, -1})
                {
                  PlateRun test({"Cell/Type=laminate",
                                 "Cell/Plies=" + plies,
                                 "Mesh/Elements along=2",
                                 "Mesh/Elements across=2",
                                 "Mesh/Elements through=1",
                                 "Newton/Relative tolerance=1e-12",
                                 "Newton/Absolute tolerance=1e-13",
                                 "Load programme/Stages=tiny",
                                 "Load programme/Stage tiny/Initial step=1",
                                 "Load programme/Stage tiny/Maximum step=1",
                                 "Load programme/Stage tiny/Targets=H" +
                                   std::to_string(m + 1) +
                                   (sign > 0 ? ": 1e-5" : ": -1e-5")});
                  // Without weaving the jumps refer to these positions.
                  test.pins  = pins;
                  test.woven = test.cell.bodies().space().control_points();
                  for (dealii::Point<3> &Z : test.woven)
                    Z -= origin;
                  test.run();
                  for (unsigned int k = 0; k < 6; ++k)
                    column[k] += sign * test.state.reactions[k] / (2 * h);
                }
              stiffness.push_back(column);
            }
          // About D_11, D_11/t and D_11/t^2: smaller than the entries of A.
          const double D_11 = 58. * t * t * t / 12.;
          for (unsigned int v = 1; v < stiffness.size(); ++v)
            for (unsigned int k = 0; k < 6; ++k)
              {
                const double scale =
                  (k < 3 ? 1. / t : 1.) * (m < 3 ? 1. / t : 1.) * D_11;
                INFO("plies " << plies << ", n" << k + 1 << " over H" << m + 1);
                CHECK(stiffness[v][k] ==
                      Approx(stiffness[0][k]).epsilon(0.).margin(1e-7 * scale));
              }
        }
    }
}



TEST_CASE("The pins of a woven cell carry no force in any mode", "[top]")
{
  // Nothing outside of the cell pushes: whatever bundles exert on each other,
  // the cell as a whole is in equilibrium. The forces are summed as linear
  // jumps do it; for those that turn neighboring cells see
  // test_objective_jumps.cc.
  for (unsigned int m = 0; m < 6; ++m)
    {
      INFO("H" << m + 1);
      PlateRun test({"Cell/Type=two-crossing cell",
                     "Cell/Two-fold axis=false",
                     "Homogenization/Jumps=linear",
                     "Mesh/Elements along=3",
                     "Mesh/Elements across=3",
                     "Mesh/Elements through=1",
                     "Newton/Relative tolerance=1e-12",
                     "Load programme/Stage weave/Initial step=0.25",
                     "Load programme/Stage weave/Maximum step=0.25",
                     "Load programme/Stage shear/Targets=H" +
                       std::to_string(m + 1) + (m < 3 ? ": 0.05" : ": 1e-3"),
                     "Load programme/Stage shear/Initial step=0.5",
                     "Load programme/Stage shear/Maximum step=0.5"});
      test.run();

      // With all couplings but the pins the condensed residual shows what the
      // pins bear: three of its entries.
      Pins none;
      none.used             = false;
      const auto   pinned   = test.couplings();
      const auto   unpinned = test.couplings(none);
      const double largest  = test.contact_force().linfty_norm();
      REQUIRE(largest > 0.1); // [N]

      ConstrainedSystem      free;
      dealii::Vector<double> reduced;
      free.reinit(unpinned, test.cell.macro().n_unknowns());
      free.condense(test.trial.residual, reduced);
      unsigned int n_pins = 0;
      for (unsigned int i = 0; i < test.cell.macro().first; ++i)
        if (pinned.is_constrained(i) && !unpinned.is_constrained(i))
          {
            ++n_pins;
            CHECK(std::abs(reduced[free.independent_index(i)]) <
                  1e-8 * largest);
          }
      CHECK(n_pins == 3);
    }
}



TEST_CASE("One, two and four crossings give the same frictional shear, with a "
          "smooth closure too",
          "[top]")
{
  for (const std::string smooth : {"false", "true"})
    {
      std::vector<CurveRow> last;
      for (const std::string type : {"sub-unit cell",
                                     "two-crossing cell",
                                     "unit cell",
                                     "two-crossing cell with pins"})
        last.push_back(
          run({"Cell/Type=" + type.substr(0, type.find(" with")),
               std::string("Cell/Two-fold axis=") +
                 (last.size() == 3 ? "false" : "true"),
               std::string("Load programme/Stage release/") +
                 "Friction=" + (last.size() == 3 ? "true" : "false"),
               "Cell/Smooth closure=" + smooth,
               "Mesh/Elements along=3",
               "Mesh/Elements across=3",
               "Mesh/Elements through=1",
               "Newton/Relative tolerance=1e-10",
               "Load programme/Stage shear/Initial step=0.2",
               "Load programme/Stage shear/Maximum step=0.2"})
            .back());
      // Image meshes: equal to solver tolerance.
      for (unsigned int n = 0; n < 3; ++n)
        {
          CHECK(last[1].n[n] == Approx(last[0].n[n]).epsilon(1e-9));
          CHECK(last[2].n[n] == Approx(last[0].n[n]).epsilon(1e-9));
          // One pin does not keep warp and weft from sliding off each other
          // where the axis is no constraint. Friction does when the foundation
          // fades, but some way they have gone in weaving.
          CHECK(last[3].n[n] == Approx(last[0].n[n]).epsilon(0.02));
        }
      CHECK(last[1].dissipation ==
            Approx(2 * last[0].dissipation).epsilon(1e-8));
      CHECK(last[2].dissipation ==
            Approx(4 * last[0].dissipation).epsilon(1e-8));
      CHECK(last[2].n_active == 4 * last[0].n_active);
    }
}



TEST_CASE("Exchanging warp and weft exchanges n1 and n2 and keeps n3", "[top]")
{
  // Unequal bundles in every respect. The exchange is a 2-fold axis in the
  // plane of the cell; contact nodes go with the bundle that carries them.
  const auto last = [](const bool exchanged) {
    const auto pair = [&](const std::string &a, const std::string &b) {
      return exchanged ? b + ", " + a : a + ", " + b;
    };
    const std::string stiff = exchanged ? "Fiber bundle" : "Weft";
    const std::string soft  = exchanged ? "Weft" : "Fiber bundle";
    return run({"Cell/Bundle width=" + pair("4", "3.2"),
                "Cell/Bundle thickness=" + pair("1.2", "0.9"),
                "Cell/Crossing spacing=" + pair("5", "4"),
                std::string("Cell/Secondary bundles=") +
                  (exchanged ? "warp" : "weft"),
                stiff + " material/Law=neo-Hookean",
                stiff + " material/Young modulus=30",
                soft + " material/Law=fiber bundle",
                "Mesh/Elements along=3",
                "Mesh/Elements across=3",
                "Mesh/Elements through=1",
                "Newton/Relative tolerance=1e-11",
                std::string("Load programme/Stage shear/Targets=H3: 0.1, ") +
                  (exchanged ? "H1: 0.01, H2: 0.02" : "H1: 0.02, H2: 0.01"),
                "Load programme/Stage shear/Initial step=0.5",
                "Load programme/Stage shear/Maximum step=0.5"})
      .back();
  };
  const CurveRow a = last(false), b = last(true);
  CHECK(a.n[0] > 1.2 * a.n[1]); // they do differ
  CHECK(b.n[0] == Approx(a.n[1]).epsilon(1e-8));
  CHECK(b.n[1] == Approx(a.n[0]).epsilon(1e-8));
  CHECK(b.n[2] == Approx(a.n[2]).epsilon(1e-8));
  CHECK(b.dissipation == Approx(a.dissipation).epsilon(1e-8));
}



TEST_CASE("A twill is the same in its glide cell and in its primitive cell, "
          "with a smooth closure too",
          "[top]")
{
  const std::string smooth = GENERATE("false", "true");
  // Four elements along: with three the mortar functions at the end of a strand
  // reach into the contact of the next crossing on the same side, and the cells
  // are different discretizations.
  const auto curve = [&](const std::string &type) {
    return run({"Cell/Weave=2/2 twill",
                "Cell/Type=" + type,
                "Cell/Smooth closure=" + smooth,
                "Mesh/Elements along=4",
                "Mesh/Elements across=3",
                "Mesh/Elements through=1",
                "Newton/Relative tolerance=1e-10",
                "Load programme/Stages=weave, release, still, shear",
                "Load programme/Stage weave/Initial step=0.5",
                "Load programme/Stage weave/Maximum step=0.5",
                "Load programme/Stage still/Targets=H3: 0",
                "Load programme/Stage still/Initial step=1",
                "Load programme/Stage still/Maximum step=1",
                "Load programme/Stage shear/Targets=H3: 0.05",
                "Load programme/Stage shear/Initial step=1",
                "Load programme/Stage shear/Maximum step=1"});
  };
  const auto glide     = curve("sub-unit cell");
  const auto primitive = curve("primitive cell");
  for (unsigned int n = 0; n < 3; ++n)
    CHECK(primitive.back().n[n] == Approx(glide.back().n[n]).epsilon(1e-8));
  CHECK(primitive.back().dissipation ==
        Approx(2 * glide.back().dissipation).epsilon(1e-7));
  // A glide plane turns bending moments over: the woven state has none.
  for (unsigned int n = 3; n < 6; ++n)
    CHECK(std::abs(primitive[primitive.size() - 2].n[n]) < 1e-9);
}



TEST_CASE("A satin weaves, releases and shears; without a glide plane it "
          "has moments in the woven state",
          "[top]")
{
  const auto curve = run({"Cell/Weave=5-harness satin",
                          "Mesh/Elements along=3",
                          "Mesh/Elements across=3",
                          "Mesh/Elements through=1",
                          "Load programme/Stage weave/Initial step=0.25",
                          "Load programme/Stage weave/Maximum step=0.25",
                          "Load programme/Stage shear/Targets=H3: 0.1",
                          "Load programme/Stage shear/Initial step=0.5",
                          "Load programme/Stage shear/Maximum step=0.5"});
  CHECK(curve.back().H[2] == 0.1);
  CHECK(curve.back().dissipation > 0);
  CHECK(curve.back().n[2] > 0);
  CHECK(std::abs(curve.back().n[3]) > 1e-2);
  CHECK(std::abs(curve.back().n[4]) > 1e-2);
}



TEST_CASE("A woven cell relaxes to zero tension and bends at zero tension",
          "[top]")
{
  const auto curve =
    run({"Mesh/Elements along=3",
         "Mesh/Elements across=3",
         "Mesh/Elements through=1",
         "Friction/Friction coefficient=0",
         "Newton/Relative tolerance=1e-11",
         "Load programme/Stages=weave, release, relax, bend, more",
         "Load programme/Stage relax/Targets=n1: 0, n2: 0",
         "Load programme/Stage relax/Initial step=0.25",
         "Load programme/Stage relax/Maximum step=0.25",
         "Load programme/Stage bend/Targets=H4: 0.02",
         "Load programme/Stage bend/Initial step=0.25",
         "Load programme/Stage bend/Maximum step=0.25",
         "Load programme/Stage more/Targets=H4: 0.0201",
         "Load programme/Stage more/Initial step=0.5",
         "Load programme/Stage more/Maximum step=0.5"});
  const CurveRow *relaxed = nullptr;
  for (const CurveRow &row : curve)
    {
      if (row.stage == "relax" && row.load_factor == 1.)
        relaxed = &row;
      if (row.stage == "bend")
        CHECK(std::abs(row.n[0]) + std::abs(row.n[1]) < 1e-8);
    }
  REQUIRE(relaxed != nullptr);
  // Crimp takes length: the stress-free cell is smaller, by the same in both
  // directions up to the choice of the secondary side (below 1 %).
  CHECK(relaxed->H[0] < -0.01);
  CHECK(relaxed->H[1] == Approx(relaxed->H[0]).epsilon(0.02));
  // The glide plane turns bending over, so the relaxed cell has no moments.
  for (unsigned int n = 3; n < 6; ++n)
    CHECK(std::abs(relaxed->n[n]) < 1e-6);

  // At prescribed n1 = n2 = 0 the moment is the derivative of the energy.
  const unsigned int n      = curve.size();
  const auto         energy = [](const CurveRow &row) {
    return row.stored_energy + row.contact_energy;
  };
  const double dE = energy(curve[n - 1]) - energy(curve[n - 3]);
  const double dH = curve[n - 1].H[3] - curve[n - 3].H[3];
  CHECK(dE / dH / 50. == Approx(curve[n - 2].n[3]).epsilon(1e-5));
}
