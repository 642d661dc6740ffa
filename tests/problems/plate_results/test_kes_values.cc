// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the characteristic values of Kawabata's tests, on curves of
// straight pieces.

#include <npt_dealii/problems/plate_results/kes_values.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;

namespace
{
  // y = slope x and half the width by the sense of motion, which changes
  // within no length.
  TestCurve
  loop_with_corners(const double amplitude,
                    const double slope,
                    const double width)
  {
    TestCurve  curve;
    const auto add = [&](const double x, const double sense) {
      curve.x.push_back(x);
      curve.y.push_back(slope * x + 0.5 * sense * width);
    };
    const int n = 16;
    for (int i = 0; i <= n; ++i)
      add(amplitude * i / n, 1.);
    for (int i = n - 1; i >= -n; --i)
      add(amplitude * i / n, -1.);
    for (int i = -n + 1; i <= n; ++i)
      add(amplitude * i / n, 1.);
    return curve;
  }

  std::vector<CurveRow>
  rows_of_stage(const TestCurve   &curve,
                const std::string &stage,
                const unsigned int mode)
  {
    std::vector<CurveRow> rows;
    for (std::size_t i = 0; i < curve.x.size(); ++i)
      {
        CurveRow row;
        row.stage   = stage;
        row.H[mode] = curve.x[i];
        row.n[mode] = curve.y[i];
        rows.push_back(row);
      }
    return rows;
  }

  const KesValue &
  value_named(const std::vector<KesValue> &values, const std::string &name)
  {
    for (const KesValue &value : values)
      if (value.name == name)
        return value;
    FAIL("there is no " + name);
    return values.front();
  }
} // namespace



TEST_CASE("A loop of straight branches gives its slope and width back at every "
          "place",
          "[output]")
{
  const LoopValues loop(loop_with_corners(8., 0.3, 0.08));
  CHECK(loop.amplitude() == 8.);
  CHECK(loop.slope(0.5, 2.5) == Approx(0.3).epsilon(1e-13));
  CHECK(loop.width(0.5) == Approx(0.08).epsilon(1e-13));
  CHECK(loop.width(5.) == Approx(0.08).epsilon(1e-13));
  CHECK(std::isnan(loop.width(8.1)));
}



TEST_CASE("A cycle of straight pieces has the linearity, work and resilience "
          "of its areas",
          "[output]")
{
  // Loading (0,0), (2,1), (3,4); unloading to (2,.5), (1,0).
  const CycleValues cycle({{0., 2., 3., 2., 1.}, {0., 1., 4., 0.5, 0.}}, 0.);
  CHECK(cycle.work == Approx(1. + 2.5));
  CHECK(cycle.x_end - cycle.x_start == 3.);
  CHECK(cycle.linearity == Approx(3.5 / (0.5 * 4. * 3.)));
  CHECK(cycle.resilience == Approx(100. * (2.25 + 0.25) / 3.5));
  // From y = .5 on, which is passed at x = 1 and left at x = 2.
  const CycleValues later({{0., 2., 3., 2., 1.}, {0., 1., 4., 0.5, 0.}}, 0.5);
  CHECK(later.x_start == Approx(1.));
  CHECK(later.work == Approx(0.75 + 2.5));
  CHECK(later.resilience == Approx(100. * 2.25 / 3.25));
  // A curve that begins above has no begin, one that ends above no end.
  const CycleValues no_begin({{2., 3., 2.}, {1., 4., 0.}}, 0.5);
  CHECK(std::isnan(no_begin.x_start));
  CHECK(std::isnan(no_begin.work));
  CHECK(std::isnan(no_begin.resilience));
  const CycleValues no_end({{0., 3., 2.}, {0., 4., 1.}}, 0.5);
  CHECK(no_end.work > 0.);
  CHECK(std::isnan(no_end.resilience));
}



TEST_CASE("Bending has B and 2HB in both units", "[output]")
{
  // To 2.5 /cm with B = .1 gf cm^2/cm and 2HB = .05 gf cm/cm.
  const double B     = 0.1 * KesUnits::gf_cm2_per_cm;
  const double width = 0.05 * KesUnits::gf_cm_per_cm;
  const auto rows = rows_of_stage(loop_with_corners(0.25, B, width), "bend", 3);
  KesParameters parameters;
  parameters.bending = {"bend"};
  const auto values  = kes_values(rows, parameters);
  REQUIRE(values.size() == 2);
  CHECK(value_named(values, "B").value == Approx(0.00980665).epsilon(1e-12));
  CHECK(value_named(values, "B").kes_value == Approx(0.1).epsilon(1e-12));
  CHECK(value_named(values, "2HB").kes_value == Approx(0.05).epsilon(1e-12));
}



TEST_CASE("Shear, tension and compression have their values by name",
          "[output]")
{
  KesParameters parameters;
  parameters.shear       = {"shear"};
  parameters.tension     = {"pull"};
  parameters.compression = {"press"};

  // 1 gf/cm/degree, 2HG = .6 gf/cm.
  std::vector<CurveRow> rows;
  const TestCurve       shear =
    loop_with_corners(8., KesUnits::gf_per_cm, 0.6 * KesUnits::gf_per_cm);
  for (std::size_t i = 0; i < shear.x.size(); ++i)
    {
      CurveRow row;
      row.stage                  = "shear";
      row.further["shear_angle"] = shear.x[i];
      row.further["frame_force"] = shear.y[i];
      rows.push_back(row);
    }
  // To 500 gf/cm at 4 %, linear, and back to 1 % of strain.
  const double F    = 500. * KesUnits::gf_per_cm;
  const auto   pull = rows_of_stage({{0., 0.04, 0.01}, {0., F, 0.}}, "pull", 0);
  rows.insert(rows.end(), pull.begin(), pull.end());
  // Linear from .5 gf/cm^2 at 1 mm to 50 at .6 mm, and back to .8 mm.
  const double unit = KesUnits::gf_per_cm2;
  for (const auto &[T, p] : {std::make_pair(1., 0.5 * unit),
                             std::make_pair(0.6, 50. * unit),
                             std::make_pair(0.8, 0.5 * unit)})
    {
      CurveRow row;
      row.stage                     = "press";
      row.further["plate_distance"] = T;
      row.further["pressure"]       = p;
      rows.push_back(row);
    }

  const auto values = kes_values(rows, parameters);
  const auto kes    = [&](const std::string &name) {
    return value_named(values, name).kes_value;
  };
  CHECK(kes("G") == Approx(1.).epsilon(1e-12));
  CHECK(kes("2HG") == Approx(0.6).epsilon(1e-12));
  CHECK(kes("2HG5") == Approx(0.6).epsilon(1e-12));
  CHECK(kes("EMT") == Approx(4.));
  CHECK(kes("LT") == Approx(1.));
  CHECK(kes("WT") == Approx(0.5 * 500. * 0.04).epsilon(1e-12));
  CHECK(kes("RT") == Approx(75.));
  CHECK(kes("T0") == Approx(1.));
  CHECK(kes("Tm") == Approx(0.6));
  const double W = 0.5 * (0.5 + 50.) * 0.04; // gf cm/cm^2
  CHECK(kes("WC") == Approx(W).epsilon(1e-12));
  CHECK(kes("LC") == Approx(W / (0.5 * 50. * 0.04)).epsilon(1e-12));
  CHECK(kes("RC") == Approx(50.));
}
