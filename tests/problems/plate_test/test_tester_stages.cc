// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about stages that lead the yarns as testers do: trellis, picture
// frame, bias extension.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/yarn_frame.h>
#include <npt_dealii/problems/plate_test/curvature_range.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/shear_range.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;
  using Overrides = std::vector<std::string>;

  // "Type=trellis" and so on of a stage.
  Overrides
  tester_stage(const std::string &name,
               const std::string &type,
               const std::string &targets,
               const std::string &step = "0.25")
  {
    Overrides entries = {"Type=" + type,
                         "Targets=" + targets,
                         "Initial step=" + step,
                         "Maximum step=" + step};
    for (std::string &entry : entries)
      entry = "Load programme/Stage " + name + "/" + entry;
    return entries;
  }

  Overrides
  operator+(Overrides a, const Overrides &b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  // Spacings of warp and weft differ.
  Overrides
  tester_cell(const std::string &stages)
  {
    return {"Cell/Crossing spacing=5, 5.5",
            "Mesh/Elements along=3",
            "Mesh/Elements across=3",
            "Mesh/Elements through=1",
            "Contact/Method=KTS",
            "Friction/Friction coefficient=0",
            "Newton/Relative tolerance=1e-12",
            "Load programme/Stage weave/Initial step=0.2",
            "Load programme/Stage weave/Maximum step=0.2",
            "Load programme/Stages=weave, release, " + stages};
  }

  std::vector<CurveRow>
  tester_curve(const Overrides &overrides)
  {
    std::ostringstream    screen;
    NumericalPlateTesting test(
      PlateTestParameters::read(make_parameter_text("", "tester.prm"),
                                overrides),
      "",
      screen);
    test.run();
    return test.curve();
  }

  double
  energy_of(const CurveRow &row)
  {
    return row.stored_energy + row.contact_energy;
  }

  double
  column(const CurveRow &row, const std::string &name)
  {
    return curve_value(row, name);
  }

  // A homogeneous ply of 1 mm, its faces free.
  Overrides
  ply(const Overrides &law)
  {
    return Overrides{"Cell/Type=laminate",
                     "Cell/Plies=0",
                     "Cell/Bundle width=1.5",
                     "Cell/Bundle thickness=1",
                     "Cell/Crossing spacing=2",
                     "Mesh/Elements along=1",
                     "Mesh/Elements across=1",
                     "Mesh/Elements through=1",
                     "Newton/Relative tolerance=1e-12",
                     "Load programme/Stages=pull"} +
           law;
  }

  const Overrides neo_hookean_law = {"Fiber bundle material/Law=neo-Hookean",
                                     "Fiber bundle material/Young modulus=1000",
                                     "Fiber bundle material/Poisson ratio=0.3"};
} // namespace



TEST_CASE("A trellis keeps the yarns at their length and turns them by the "
          "angle",
          "[top]")
{
  const auto curve =
    tester_curve(tester_cell("trellis") +
                 tester_stage("trellis", "trellis", "shear_angle: 20"));
  unsigned int n = 0;
  for (const CurveRow &row : curve)
    {
      if (row.stage != "trellis")
        continue;
      CHECK(std::abs(column(row, "warp_stretch") - 1.) < 1e-10);
      CHECK(std::abs(column(row, "weft_stretch") - 1.) < 1e-10);
      CHECK(column(row, "shear_angle") ==
            Approx(20. * row.load_factor).epsilon(1e-10));
      ++n;
    }
  CHECK(n == 4);
}



TEST_CASE("Torque and frame force are the derivative of the energy by the "
          "angle of a trellis, without friction",
          "[top]")
{
  // Central differences over two steps of .01 degree.
  const auto curve =
    tester_curve(tester_cell("trellis, more") +
                 tester_stage("trellis", "trellis", "shear_angle: 12") +
                 tester_stage("more", "trellis", "shear_angle: 12.02", "0.5"));
  const auto   last = curve.end();
  const double area = 5. * 5.5;
  const double m =
    (energy_of(last[-1]) - energy_of(last[-3])) / (0.02 * M_PI / 180.) / area;
  CHECK(column(last[-2], "shear_torque") == Approx(m).epsilon(1e-6));
  CHECK(column(last[-2], "frame_force") ==
        Approx(m / std::cos(12.01 * M_PI / 180.)).epsilon(1e-6));
  // By the work of the whole path as well, to the error of its trapezoids.
  double          work   = 0;
  const CurveRow *before = nullptr, *start = nullptr;
  for (const CurveRow &row : curve)
    {
      if (row.stage == "release")
        start = &row;
      if (row.stage == "trellis")
        work +=
          0.5 *
          (column(row, "shear_torque") + column(*before, "shear_torque")) *
          (column(row, "shear_angle") - column(*before, "shear_angle")) * M_PI /
          180. * area;
      before = &row;
    }
  CHECK(work == Approx(energy_of(last[-3]) - energy_of(*start)).epsilon(0.02));
}



TEST_CASE("In a picture frame under tension the yarns have this tension, and "
          "the work of tensions and torque is the energy",
          "[top]")
{
  const std::string tension = "warp_tension: 0.5, weft_tension: 0.3";
  const auto        curve   = tester_curve(
    tester_cell("frame, more") +
    tester_stage("frame", "picture frame", "shear_angle: 12, " + tension) +
    tester_stage(
      "more", "picture frame", "shear_angle: 12.02, " + tension, "0.5"));
  const auto last = curve.end();
  for (int k = 1; k <= 3; ++k)
    {
      CHECK(column(last[-k], "warp_tension") == Approx(0.5).epsilon(1e-9));
      CHECK(column(last[-k], "weft_tension") == Approx(0.3).epsilon(1e-9));
      CHECK(column(last[-k], "shear_angle") ==
            Approx(12.03 - 0.01 * k).epsilon(1e-9));
    }
  const double area   = 5. * 5.5;
  const auto   change = [&](const std::string &name) {
    return column(last[-1], name) - column(last[-3], name);
  };
  const double of_tensions =
    0.5 * change("warp_stretch") + 0.3 * change("weft_stretch");
  const double of_torque =
    change("shear_angle") * M_PI / 180. * column(last[-2], "shear_torque");
  CHECK((energy_of(last[-1]) - energy_of(last[-3])) / area ==
        Approx(of_tensions + of_torque).epsilon(1e-6));
}



TEST_CASE("A clamped picture frame keeps the stretch that the yarns have, and "
          "a stage after it goes on from there",
          "[top]")
{
  const auto curve =
    tester_curve(tester_cell("pull, frame, hold") +
                 tester_stage("pull", "load", "n1: 1, n2: 1", "1") +
                 tester_stage("frame", "picture frame", "shear_angle: 5", "1") +
                 tester_stage("hold", "load", "H3: 0.09", "1"));
  const auto last = curve.end();
  CHECK(column(last[-2], "warp_stretch") ==
        Approx(column(last[-3], "warp_stretch")).epsilon(1e-13));
  CHECK(column(last[-2], "weft_stretch") ==
        Approx(column(last[-3], "weft_stretch")).epsilon(1e-13));
  CHECK(column(last[-2], "shear_angle") == Approx(5.).epsilon(1e-12));
  CHECK(last[-1].H[0] == last[-2].H[0]);
  CHECK(last[-1].H[2] == 0.09);
}



TEST_CASE("A ply of one material under bias extension has the force and the "
          "width of uniaxial tension",
          "[top]")
{
  const double E = 1000., nu = 0.3;
  const double mu     = E / (2. * (1. + nu));
  const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
  // The stretch s across, of width and thickness: P = 0 there.
  const double a = 1.15;
  double       s = 1.;
  for (unsigned int k = 0; k < 50; ++k)
    {
      const double log_J = std::log(a * s * s);
      const double P     = mu * (s - 1. / s) + lambda * log_J / s;
      const double dP =
        mu * (1. + 1. / (s * s)) + lambda * (2. - log_J) / (s * s);
      s -= P / dP;
    }
  const double P = mu * (a - 1. / a) + lambda * std::log(a * s * s) / a;

  const auto curve =
    tester_curve(ply(neo_hookean_law) +
                 tester_stage("pull", "bias extension", "bias_stretch: 1.15"));
  const CurveRow &end = curve.back();
  CHECK(column(end, "bias_stretch") == Approx(a).epsilon(1e-9));
  CHECK(column(end, "bias_force") == Approx(P).epsilon(1e-8));
  // U = a along, s across: U_11 = (a + s)/2, U_12 = (a - s)/2.
  CHECK(1. + end.H[0] == Approx(0.5 * (a + s)).epsilon(1e-8));
  CHECK(end.H[2] == Approx(a - s).epsilon(1e-8));
  CHECK(end.n[0] == Approx(end.n[2]).epsilon(1e-8));
  CHECK(end.n[0] == Approx(end.n[1]).epsilon(1e-8));
}



TEST_CASE("A ply with fibers under bias extension to an angle bears nothing "
          "but the force along the bias",
          "[top]")
{
  const auto curve = tester_curve(
    ply({}) + tester_stage("pull", "bias extension", "shear_angle: 8"));
  const CurveRow &end = curve.back();
  CHECK(column(end, "shear_angle") == Approx(8.).epsilon(1e-9));
  const auto stretch =
    YarnFrames::bias_stretch({{end.H[0], end.H[1], end.H[2]}});
  for (unsigned int k = 0; k < 3; ++k)
    CHECK(
      end.n[k] ==
      Approx(column(end, "bias_force") * stretch.gradient[k]).epsilon(1e-8));
  CHECK(column(end, "warp_stretch") < column(end, "weft_stretch"));
}



TEST_CASE(
  "Under bias extension a weave shears, and what weaving has left across "
  "the bias goes",
  "[top]")
{
  const auto curve =
    tester_curve(tester_cell("pull") +
                 tester_stage("pull", "bias extension", "shear_angle: 12"));
  const CurveRow &end = curve.back();
  const auto      stretch =
    YarnFrames::bias_stretch({{end.H[0], end.H[1], end.H[2]}});
  for (unsigned int k = 0; k < 3; ++k)
    CHECK(
      end.n[k] ==
      Approx(column(end, "bias_force") * stretch.gradient[k]).epsilon(1e-7));
  CHECK(column(end, "bias_force") > 0.);
  // e_b halves the angle of warp and weft at rest only.
  const double warp = column(end, "warp_stretch"),
               weft = column(end, "weft_stretch");
  CHECK(std::pow(column(end, "bias_stretch"), 2) ==
        Approx(0.5 * (warp * warp + weft * weft) +
               warp * weft * std::sin(12. * M_PI / 180.))
          .epsilon(1e-9));
}



TEST_CASE("The tangent of a led cell and of a pressed one is that by "
          "differences",
          "[top]")
{
  using PlateTestTools::PlateRun;
  for (const auto &[type, targets] :
       std::vector<std::pair<std::string, std::string>>{
         {"picture frame",
          "shear_angle: 12, warp_tension: 0.5, weft_tension: 0.3"},
         {"bias extension", "shear_angle: 12"},
         {"bias extension", "bias_stretch: 1.1"},
         {"compression", "pressure: 0.05"}})
    {
      INFO(type << ", " << targets);
      PlateRun test(tester_cell("test") +
                    tester_stage("test", type, targets, "0.5") +
                    Overrides{"Cell/Type=two-crossing cell"});
      test.run();
      const PlateTestStage problem(
        test.cell, test.parameters, 2, test.state, test.woven, test.system);
      ConstrainedSystem     &system    = test.system;
      const Increment        increment = problem.increment(problem.start(), 1.);
      dealii::Vector<double> m, direction, K_direction;
      Trial                  trial;
      const auto             residual = [&](const dealii::Vector<double> &at) {
        dealii::Vector<double> condensed;
        system.expand(at, trial.u);
        problem.evaluate(increment, trial);
        system.condense(trial.residual, condensed);
        return condensed;
      };
      system.restrict_to_independent(problem.start().u, m);
      if (type == "compression") // where gaps do not open and close
        m[system.independent_index(test.cell.macro().plate_distance())] -= 0.05;
      unsigned int random = 1;
      direction.reinit(m.size());
      for (unsigned int k = 0; k < m.size(); ++k)
        {
          random       = 1664525 * random + 1013904223;
          direction[k] = 0.1 * (random / 4294967296. - 0.5);
        }
      residual(m);
      system.build_pattern(problem.couplings(increment, trial));
      system.set_zero();
      REQUIRE(problem.add_tangent(increment, trial, system));
      system.matrix().vmult(K_direction, direction);
      const double           h = 1e-7;
      dealii::Vector<double> plus(m), minus(m);
      plus.add(h, direction);
      minus.add(-h, direction);
      dealii::Vector<double> difference = residual(plus);
      difference -= residual(minus);
      difference /= 2. * h;
      difference -= K_direction;
      CHECK(difference.l2_norm() < 1e-5 * K_direction.l2_norm());
    }
}



TEST_CASE("Targets that a tester's stage does not have are refused by name",
          "[top]")
{
  const auto refused = [](const std::string &type, const std::string &targets) {
    try
      {
        PlateTestParameters::read(make_parameter_text("", "tester.prm"),
                                  tester_cell("test") +
                                    tester_stage("test", type, targets));
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("none");
  };
  CHECK_THAT(refused("trellis", "H3: 0.2"),
             Catch::Contains("names H3") && Catch::Contains("shear_angle") &&
               Catch::Contains("Stage test"));
  CHECK_THAT(refused("trellis", "bias_stretch: 1.1"),
             Catch::Contains("names bias_stretch"));
  CHECK_THAT(refused("load", "shear_angle: 10"),
             Catch::Contains("names shear_angle") &&
               Catch::Contains("H1 to H6"));
  CHECK_THAT(refused("trellis", "shear_angle: 90"),
             Catch::Contains("above -85 and below 85 degree"));
  CHECK_THAT(refused("picture frame", "shear_angle: 9, warp_tension: 1"),
             Catch::Contains("name both warp_tension and weft_tension"));
  CHECK_THAT(refused("bias extension", "shear_angle: 9, bias_stretch: 1.1"),
             Catch::Contains("one of them"));
  CHECK_THAT(refused("compression", "n1: 0"), Catch::Contains("one of them"));
  CHECK_THAT(refused("compression", "pressure: -1"),
             Catch::Contains("above 0 MPa"));
  CHECK(refused("compression", "pressure: 0.1, n1: 0, n2: 0") == "none");
}



TEST_CASE(
  "Curvatures that make no sense for a cell are doubted, others are not",
  "[top]")
{
  const auto doubts = [](const std::string &H4, const std::string &jumps) {
    return doubts_of_curvature(PlateTestParameters::read(
      make_parameter_text("", "bend.prm"),
      {"Homogenization/Jumps=" + jumps,
       "Load programme/Stages=weave, release, bend",
       "Load programme/Stage bend/Targets=H4: " + H4}));
  };
  // Crossings 5 mm apart, a layer of 2.4 mm.
  CHECK(doubts("0.01", "linear").empty());
  CHECK(doubts("0.1", "objective").empty());
  const auto of_slopes = doubts("0.05", "linear");
  REQUIRE(of_slopes.size() == 1);
  CHECK_THAT(of_slopes[0], Catch::Contains("Jumps = objective"));
  const auto of_instrument = doubts("0.25", "objective");
  REQUIRE(of_instrument.size() == 2);
  CHECK_THAT(of_instrument[0], Catch::Contains("radius of 4 mm"));
  CHECK_THAT(of_instrument[1],
             Catch::Contains("less than the distance of the crossings, 5 mm"));
  // The weft is bent less, but over crossings that are farther apart.
  const auto of_weft = doubts_of_curvature(PlateTestParameters::read(
    make_parameter_text("", "bend.prm"),
    {"Homogenization/Jumps=linear",
     "Cell/Crossing spacing=20, 4.2",
     "Load programme/Stages=weave, release, bend",
     "Load programme/Stage bend/Targets=H4: 0.02, H5: 0.015"}));
  REQUIRE(of_weft.size() == 1);
  CHECK_THAT(of_weft[0], Catch::Contains("bends by H5"));
}



TEST_CASE(
  "Of a sub-unit cell shear is doubted where bundles touch beyond half a "
  "spacing",
  "[top]")
{
  CellParameters cell;
  cell.crossing_spacing = WarpWeft{6., 5.};
  cell.bundle_width     = WarpWeft{4., 3.};
  const double angle    = shear_angle_of_sub_unit_cell(cell);
  // The corner of the rhombus of two bands, along each: that of the first is
  // where the cell ends.
  const auto corner = [&](const double width, const double other_width) {
    return 0.5 * (other_width / std::cos(angle) + width * std::tan(angle));
  };
  CHECK(corner(4., 3.) == Approx(0.5 * 5.).epsilon(1e-12));
  CHECK(corner(3., 4.) < 0.5 * 6.);
  cell.bundle_width = WarpWeft{5., 5.};
  CHECK(shear_angle_of_sub_unit_cell(cell) == Approx(0.).margin(1e-12));

  const auto doubts = [](const std::string &type, const std::string &target) {
    return doubts_of_shear(PlateTestParameters::read(
      make_parameter_text("", "shear.prm"),
      {"Cell/Type=" + type,
       "Load programme/Stages=weave, release, shear",
       "Load programme/Stage shear/Targets=H3: " + target}));
  };
  // Bundles of 4 mm every 5 mm: 12.7 degrees. asin(0.4 / 1.04) = 22.6 degrees.
  CHECK(doubts("sub-unit cell", "0.2").empty());
  CHECK(doubts("two-crossing cell", "-0.4").empty());
  const auto of_much_shear = doubts("sub-unit cell", "-0.4");
  REQUIRE(of_much_shear.size() == 1);
  CHECK_THAT(of_much_shear[0],
             Catch::Contains("Stage shear shears by 22.6 degrees; beyond 12.7 "
                             "degrees") &&
               Catch::Contains("Type = two-crossing cell"));
}



TEST_CASE("A KES test of a stage that there is not is refused with the nearest "
          "name",
          "[top]")
{
  std::string message;
  try
    {
      PlateTestParameters::read(make_parameter_text("", "kes.prm"),
                                {"KES/Shear stages=sheer"});
    }
  catch (const InputError &error)
    {
      message = error.what();
    }
  CHECK_THAT(message,
             Catch::Contains("Shear stages names sheer") &&
               Catch::Contains("did you mean 'shear'") &&
               Catch::Contains("subsection KES"));
}



TEST_CASE("Stages of a test that do not follow each other, and layers that are "
          "sheared after they were pressed, are refused",
          "[top]")
{
  const auto message_of = [](const std::vector<std::string> &overrides) {
    try
      {
        PlateTestParameters::read(
          make_parameter_text(
            "subsection Load programme\n"
            "set Stages = weave, release, press, there, back, again\n"
            "subsection Stage press\nset Type = compression\n"
            "set Targets = pressure: 0.1\nend\n"
            "subsection Stage there\nset Targets = H3: 0.1\nend\n"
            "subsection Stage back\nset Targets = H3: -0.1\nend\n"
            "subsection Stage again\nset Targets = H3: 0.1\nend\nend\n",
            "kes.prm"),
          overrides);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("none");
  };
  CHECK(message_of({"KES/Shear stages=there, back, again"}) == "none");
  for (const std::string stages : {"there, again", "back, there"})
    CHECK_THAT(message_of({"KES/Shear stages=" + stages}),
               Catch::Contains("do not follow each other in Stages"));
  CHECK_THAT(message_of({"Cell/Layers=2"}),
             Catch::Contains("Stage there comes after stage press"));
}
