// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims that curves, pictures, loops and load programmes know every mode of
// the table of macroscopic modes by its name and unit.

#include <npt_dealii/base/parameter_text.h>
#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/problems/plate_results/driving_component.h>
#include <npt_dealii/problems/plate_results/hysteresis.h>
#include <npt_dealii/problems/plate_results/plots.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace NPT;

namespace
{
  LoadStage
  last_stage(const std::string &targets)
  {
    return PlateTestParameters::read(
             make_parameter_text("", "mode.prm"),
             {"Cell/Type=automatic",
              "Load programme/Stages=weave, release, pull",
              "Load programme/Stage pull/Targets=" + targets})
      .load_programme.stages.back();
  }
} // namespace



TEST_CASE("Every mode has a column for its gradient and its conjugate, with "
          "their units",
          "[output]")
{
  const std::vector<std::string> columns = curve_columns();
  for (unsigned int k = 0; k < MacroModes::n; ++k)
    {
      const MacroMode &mode = MacroModes::table[k];
      CHECK(std::count(columns.begin(), columns.end(), mode.name) == 1);
      CHECK(curve_column_unit(mode.name) == mode.unit());
      CHECK(curve_column_unit(mode.conjugate) == mode.conjugate_unit());
      CHECK(column_label(mode.name).find(mode.meaning) == 0);

      CurveRow row;
      row.H[k] = 0.25;
      row.n[k] = -3.;
      CHECK(curve_value(row, mode.name) == 0.25);
      CHECK(curve_value(row, mode.conjugate) == -3.);
    }
  CHECK(CurveRow().H.size() == MacroModes::n);
  CHECK(CurveRow().n.size() == MacroModes::n);
}



TEST_CASE("A stage that drives one mode is drawn over this mode, a loop is "
          "told by its letters",
          "[output]")
{
  for (unsigned int k = 0; k < MacroModes::n; ++k)
    {
      const MacroMode      &mode = MacroModes::table[k];
      std::vector<CurveRow> rows(3);
      for (unsigned int r = 0; r < rows.size(); ++r)
        {
          rows[r].stage = "load";
          rows[r].H[k]  = 0.1 * r;
          rows[r].n[k]  = 2. * r;
        }
      REQUIRE(driving_component(rows) == k);
      const auto plots = default_plots(rows);
      REQUIRE(plots.size() == 2);
      CHECK(plots[0].x_column == mode.name);
      CHECK(plots[0].y_columns == std::vector<std::string>{mode.conjugate});
      // Without contact: the resultants of the extensions.
      CHECK(plots[1].y_columns == std::vector<std::string>{"n1", "n2"});

      HysteresisLoop loop{};
      loop.component         = k;
      const std::string text = describe(loop);
      CHECK(text.find(std::string("Loop of ") + mode.conjugate + " over " +
                      mode.name + " to") == 0);
      CHECK(text.find(std::string(mode.rigidity) + " = 0 " +
                      mode.rigidity_unit() + ",") != std::string::npos);
    }
}



TEST_CASE("A load stage prescribes every mode by name, as gradient or as "
          "resultant",
          "[parameters]")
{
  for (unsigned int k = 0; k < MacroModes::n; ++k)
    {
      const MacroMode  &mode = MacroModes::table[k];
      const std::string name = mode.name, conjugate = mode.conjugate;
      const LoadStage   driven = last_stage(name + ": 0.01");
      CHECK(driven.H_targets == std::map<unsigned int, double>{{k, 0.01}});
      CHECK(driven.n_targets.empty());
      const LoadStage loaded = last_stage(conjugate + ": 2");
      CHECK(loaded.H_targets.empty());
      CHECK(loaded.n_targets == std::map<unsigned int, double>{{k, 2.}});
    }
}
