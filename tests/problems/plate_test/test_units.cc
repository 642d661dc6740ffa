// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about units: a run whose lengths and stresses are scaled gives the
// scaled curve, so that no constant of the program has a dimension.

#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace
{
  using namespace NPT;

  // What lengths and stresses are multiplied by.
  struct Units
  {
    double length, stress;

    double
    of(const std::string &unit) const
    {
      const double L = length, S = stress;
      return unit == "-" || unit.empty() || unit == "s" || unit == "degree" ?
               1. :
             unit == "mm"   ? L :
             unit == "1/mm" ? 1. / L :
             unit == "N/mm" ? S * L :
             unit == "N"    ? S * L * L :
             unit == "N mm" ? S * L * L * L :
                              throw std::logic_error("What is " + unit + "?");
    }
  };

  std::vector<CurveRow>
  run(std::vector<std::string> overrides, const Units &units)
  {
    const auto read = [&]() {
      return PlateTestParameters::read(make_parameter_text("", "units.prm"),
                                       overrides);
    };
    const auto scale =
      [&](const std::string &entry, const double value, const double factor) {
        overrides.push_back(entry + "=" +
                            EntryValue<double>::text(value * factor));
      };
    const PlateTestParameters p = read();
    const double              L = units.length, S = units.stress;
    scale("Cell/Crossing spacing", p.cell.crossing_spacing.warp, L);
    scale("Cell/Bundle width", p.cell.bundle_width.warp, L);
    scale("Cell/Bundle thickness", p.cell.bundle_thickness.warp, L);
    const auto &C = p.material.constants<FiberBundleParameters>().constants;
    const std::string material = "Fiber bundle material/";
    scale(material + "mu_iso", C.mu, S);
    scale(material + "lambda_iso", C.lambda, S);
    scale(material + "a_trn", C.a, S);
    scale(material + "b_trn", C.b, S);
    scale(material + "c_trn", C.c, S);
    scale(material + "d_trn", C.d, S);
    scale("Contact/Normal penalty", p.contact.normal_penalty, S / L);
    scale("Friction/Tangential penalty", p.friction.tangential_penalty, S / L);
    // No entry may be set twice.
    overrides.erase(std::remove_if(overrides.begin(),
                                   overrides.end(),
                                   [](const std::string &text) {
                                     return text.find("/Targets=") !=
                                            std::string::npos;
                                   }),
                    overrides.end());
    for (const LoadStage &stage : p.load_programme.stages)
      {
        std::string targets;
        const auto  add = [&](const std::string &name,
                             const double       value,
                             const std::string &unit) {
          targets += (targets.empty() ? "" : ", ") + name + ": " +
                     EntryValue<double>::text(value * units.of(unit));
        };
        for (const auto &[n, value] : stage.H_targets)
          add(MacroModes::table[n].name, value, MacroModes::table[n].unit());
        for (const auto &[n, value] : stage.n_targets)
          add(MacroModes::table[n].conjugate,
              value,
              MacroModes::table[n].conjugate_unit());
        if (!targets.empty())
          overrides.push_back("Load programme/Stage " + stage.name +
                              "/Targets=" + targets);
      }
    std::ostringstream    screen;
    NumericalPlateTesting test(read(), "", screen);
    test.run();
    return test.curve();
  }

  void
  compare(const std::vector<CurveRow> &curve,
          const std::vector<CurveRow> &scaled,
          const Units                 &units)
  {
    REQUIRE(curve.size() == scaled.size());
    for (const std::string &column : curve_columns())
      {
        // Without plates there is no pressure.
        if (column == "stage" || column == "cpu_seconds" ||
            column == "newton_order" || column == "plate_distance" ||
            column == "pressure" || column == "bundle_fraction")
          continue;
        const double unit    = units.of(curve_column_unit(column));
        double       largest = 0;
        for (const CurveRow &row : curve)
          largest = std::max(largest, std::abs(curve_value(row, column)));
        // What is zero by symmetry is round-off of its like.
        if (column == "shear_angle")
          largest = std::max(largest, 1.); // degree
        if (column[0] == 'N' || column[0] == 'n' || column == "shear_torque" ||
            column == "frame_force" || column == "bias_force" ||
            column == "warp_tension" || column == "weft_tension")
          for (const CurveRow &row : curve)
            largest = std::max(largest, 1e-4 * row.N.norm());
        if (column[0] == 'M')
          for (const CurveRow &row : curve)
            largest = std::max(largest, 1e-4 * row.M.norm());
        for (unsigned int i = 0; i < curve.size(); ++i)
          {
            INFO(column << " of step " << i + 1);
            CHECK(curve_value(scaled[i], column) / unit ==
                  Approx(curve_value(curve[i], column))
                    .epsilon(0.)
                    .margin(1e-9 * largest));
          }
      }
  }
} // namespace



TEST_CASE("A run in other units is the same run", "[top]")
{
  // One line for each cell; those that a foundation holds are to come.
  const std::vector<std::vector<std::string>> cells = {
    {"Cell/Type=sub-unit cell"},
    {"Cell/Type=sub-unit cell", "Cell/Weave=2/2 twill"},
    // {"Cell/Type=two-crossing cell"},
    // {"Cell/Type=primitive cell"},
    // {"Cell/Type=unit cell"},
    // {"Cell/Type=laminate", "Cell/Plies=0, 45"},
  };
  const std::string load = "Load programme/Stage load/";
  for (const auto &cell : cells)
    {
      std::vector<std::string> overrides = {
        "Mesh/Elements along=3",
        "Mesh/Elements across=3",
        "Mesh/Elements through=1",
        "Load programme/Stages=weave, release, relax, load",
        "Load programme/Stage relax/Targets=n1: 0, n2: 0",
        "Load programme/Stage relax/Initial step=0.5",
        "Load programme/Stage relax/Maximum step=0.5",
        load + "Targets=H3: 0.02",
        load + "Initial step=0.5",
        load + "Maximum step=0.5"};
      overrides.insert(overrides.end(), cell.begin(), cell.end());
      const auto curve = run(overrides, {1., 1.});
      for (const Units &units : {Units{1e-3, 1e6},
                                 Units{1e-3, 1e-3},
                                 Units{1e-2, 1e-6},
                                 Units{4., 1.}})
        {
          INFO(cell.back() << ", lengths by " << units.length
                           << ", stresses by " << units.stress);
          compare(curve, run(overrides, units), units);
        }
    }
}
