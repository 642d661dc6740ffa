// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about fabrics that are pressed between two plates.

#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;
  using Overrides = std::vector<std::string>;

  std::vector<CurveRow>
  pressed(Overrides overrides, const Overrides &more)
  {
    overrides.insert(overrides.end(), more.begin(), more.end());
    std::ostringstream    screen;
    NumericalPlateTesting test(
      PlateTestParameters::read(make_parameter_text("", "press.prm"),
                                overrides),
      "",
      screen);
    test.run();
    return test.curve();
  }

  Overrides
  press_stage(const std::string &name,
              const std::string &targets,
              const std::string &step)
  {
    Overrides entries = {"Type=compression",
                         "Targets=" + targets,
                         "Initial step=" + step,
                         "Maximum step=" + step};
    for (std::string &entry : entries)
      entry = "Load programme/Stage " + name + "/" + entry;
    return entries;
  }

  // Between plates, with its width held.
  const Overrides pressed_ply = {"Cell/Type=laminate",
                                 "Cell/Plies=0",
                                 "Cell/Bundle width=1.5",
                                 "Cell/Bundle thickness=1",
                                 "Cell/Crossing spacing=2",
                                 "Fiber bundle material/Law=neo-Hookean",
                                 "Fiber bundle material/Young modulus=1000",
                                 "Fiber bundle material/Poisson ratio=0.3",
                                 "Mesh/Elements along=1",
                                 "Mesh/Elements across=1",
                                 "Mesh/Elements through=1",
                                 "Contact/Normal penalty=10000",
                                 "Newton/Relative tolerance=1e-12",
                                 "Load programme/Stages=press"};

  Overrides
  woven(const std::string &type)
  {
    return {"Cell/Type=" + type,
            "Mesh/Elements along=3",
            "Mesh/Elements across=3",
            "Mesh/Elements through=1",
            "Contact/Method=KTS",
            "Contact/Normal penalty=1000",
            "Friction/Friction coefficient=0",
            "Newton/Relative tolerance=1e-12",
            "Load programme/Stage weave/Initial step=0.2",
            "Load programme/Stage weave/Maximum step=0.2"};
  }

  double
  value(const CurveRow &row, const std::string &name)
  {
    return curve_value(row, name);
  }

  std::vector<CurveRow>
  only(const std::vector<CurveRow> &curve, const std::string &stage)
  {
    std::vector<CurveRow> rows;
    for (const CurveRow &row : curve)
      if (row.stage == stage)
        rows.push_back(row);
    return rows;
  }
} // namespace



TEST_CASE("A ply between plates has the pressure of uniaxial strain, less what "
          "the penalty lets in",
          "[top]")
{
  const double E = 1000., nu = 0.3, penalty = 10000.;
  const double mu     = E / (2. * (1. + nu));
  const double lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
  const auto   by_distance =
    pressed(pressed_ply, press_stage("press", "plate_distance: 0.9", "0.25"));
  for (const CurveRow &row : by_distance)
    {
      // Thickness is the distance and a penetration p / penalty on both sides.
      const double p     = value(row, "pressure");
      const double h     = value(row, "plate_distance") + 2. * p / penalty;
      const double exact = -(mu * (h - 1. / h) + lambda * std::log(h) / h);
      CHECK(p == Approx(exact).epsilon(1e-9));
      CHECK(value(row, "bundle_fraction") ==
            Approx(1. / value(row, "plate_distance")).epsilon(1e-12));
    }
  CHECK(value(by_distance.back(), "plate_distance") == 0.9);
  // By pressure to the same place.
  const double p           = value(by_distance.back(), "pressure");
  const auto   by_pressure = pressed(
    pressed_ply,
    press_stage("press", "pressure: " + EntryValue<double>::text(p), "0.25"));
  CHECK(value(by_pressure.back(), "plate_distance") ==
        Approx(0.9).epsilon(1e-9));
}



TEST_CASE("The force of the plates on a weave is the derivative of its energy "
          "by their distance, and grows as they close",
          "[top]")
{
  for (const std::string type : {"sub-unit cell", "two-crossing cell"})
    {
      INFO(type);
      Overrides stages = press_stage("press", "plate_distance: 2.2", "0.2");
      for (const std::string &entry :
           press_stage("more", "plate_distance: 2.199", "0.5"))
        stages.push_back(entry);
      stages.push_back("Load programme/Stages=weave, release, press, more");
      const auto   curve  = pressed(woven(type), stages);
      const auto   last   = curve.end();
      const double area   = type == "sub-unit cell" ? 25. : 50.;
      const auto   energy = [](const CurveRow &row) {
        return row.stored_energy + row.contact_energy;
      };
      CHECK((energy(last[-1]) - energy(last[-3])) / 0.001 / area ==
            Approx(value(last[-2], "pressure")).epsilon(1e-5));
      const auto rows = only(curve, "press");
      for (unsigned int i = 1; i < rows.size(); ++i)
        {
          CHECK(value(rows[i], "plate_distance") <
                value(rows[i - 1], "plate_distance"));
          CHECK(value(rows[i], "pressure") > value(rows[i - 1], "pressure"));
        }
      CHECK(rows.back().external_work -
              only(curve, "release").back().external_work ==
            Approx(energy(rows.back()) - energy(only(curve, "release").back()))
              .epsilon(0.05)); // trapezoids
    }
}



TEST_CASE("One crossing between plates stands for two, and plates press from "
          "both sides alike",
          "[top]")
{
  std::vector<double> pressures;
  for (const std::string type : {"sub-unit cell", "two-crossing cell"})
    {
      Overrides overrides = woven(type);
      for (const std::string &entry :
           press_stage("press", "plate_distance: 2.25", "0.5"))
        overrides.push_back(entry);
      overrides.push_back("Load programme/Stages=weave, release, press");
      PlateTestTools::PlateRun test(overrides);
      test.run();
      pressures.push_back(-test.state.reactions[MacroUnknowns::n_macro] /
                          test.cell.fabric().area());
      // All forces on the bundles sum to nothing: action is reaction.
      double sum = 0, size = 0;
      for (unsigned int k = 2; k < test.cell.macro().first; k += 3)
        {
          sum += test.trial.residual[k];
          size += std::abs(test.trial.residual[k]);
        }
      if (type == "two-crossing cell")
        {
          for (const PeriodicImage &image : test.cell.images())
            for (unsigned int l = 0; l < image.control_points.size(); ++l)
              sum += test.trial.residual[image.first_unknown + 3 * l + 2];
          CHECK(std::abs(sum) < 1e-8 * size);
        }
    }
  CHECK(pressures[1] == Approx(pressures[0]).epsilon(1e-7));
}



TEST_CASE("A relaxed weave is pressed to a pressure and let go, with friction",
          "[top]")
{
  Overrides stages =
    press_stage("press", "pressure: 0.02, n1: 0, n2: 0", "0.1");
  for (const std::string &entry :
       press_stage("back", "pressure: 0.0002", "0.1"))
    stages.push_back(entry);
  for (const std::string entry : {"Type=relax",
                                  "Relaxed fraction=1",
                                  "Initial step=0.25",
                                  "Maximum step=0.25"})
    stages.push_back("Load programme/Stage rest/" + entry);
  stages.push_back("Load programme/Stages=weave, release, rest, press, back");
  Overrides cell = woven("sub-unit cell");
  for (std::string &entry : cell)
    if (entry == "Friction/Friction coefficient=0")
      entry = "Friction/Friction coefficient=0.3";
  const auto curve = pressed(cell, stages);
  const auto press = only(curve, "press"), back = only(curve, "back");
  CHECK(value(press.back(), "pressure") == Approx(0.02).epsilon(1e-9));
  CHECK(value(back.back(), "pressure") == Approx(0.0002).epsilon(1e-7));
  for (unsigned int i = 1; i < press.size(); ++i)
    CHECK(value(press[i], "plate_distance") <
          value(press[i - 1], "plate_distance"));
  for (unsigned int i = 1; i < back.size(); ++i)
    CHECK(value(back[i], "plate_distance") >
          value(back[i - 1], "plate_distance"));
}



TEST_CASE("Two layers whose crests meet hollows are thinner than two of one, "
          "and the force of the plates is the derivative of their energy",
          "[top]")
{
  std::vector<double> thickness;
  for (const bool is_nested : {false, true})
    {
      Overrides overrides = woven(is_nested ? "automatic" : "sub-unit cell");
      for (const std::string &entry :
           press_stage("press", "pressure: 0.02", "0.5"))
        overrides.push_back(entry);
      for (const std::string &entry :
           press_stage("more", "pressure: 0.0201", "0.5"))
        overrides.push_back(entry);
      for (const std::string entry : {"Type=relax",
                                      "Relaxed fraction=1",
                                      "Initial step=1",
                                      "Maximum step=1"})
        overrides.push_back("Load programme/Stage rest/" + entry);
      if (is_nested)
        {
          overrides.push_back("Cell/Layers=2");
          overrides.push_back("Cell/Layer shift=2.5, 2.5");
        }
      overrides.push_back(
        "Load programme/Stages=weave, release, rest, press, more");
      const auto curve = pressed(overrides, {});
      const auto rows  = only(curve, "press");
      CHECK(value(rows[1], "plate_distance") <
            value(rows[0], "plate_distance"));
      thickness.push_back(value(rows[1], "plate_distance"));
      const double area   = is_nested ? 50. : 25.;
      const auto   last   = curve.end();
      const auto   energy = [](const CurveRow &row) {
        return row.stored_energy + row.contact_energy;
      };
      CHECK((energy(last[-1]) - energy(last[-3])) / area /
              (value(last[-3], "plate_distance") -
               value(last[-1], "plate_distance")) ==
            Approx(value(last[-2], "pressure")).epsilon(1e-4));
    }
  CHECK(thickness[1] < 1.9 * thickness[0]);
  CHECK(thickness[1] > thickness[0]);
}
