// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about error norms of curves, Pareto fronts and recommended settings.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/work_precision.h>
#include <npt_dealii/problems/plate_results/curve_family.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <limits>

using namespace NPT;

TEST_CASE("The error of a curve is the exact L2 norm of its broken lines",
          "[study]")
{
  // y = x against y = x + 0.1 (1 - x) on different points:
  // int (0.1 (1 - x))^2 = 0.01/3, int x^2 = 1/3.
  const StudyCurve reference{{0, 0.3, 1}, {0, 0.3, 1}};
  const StudyCurve curve{{0, 0.5, 0.7, 1}, {0.1, 0.55, 0.73, 1}};
  const CurveError error = compare_curves(curve, reference);
  CHECK(error.l2 == Approx(0.1).epsilon(1e-13));
  CHECK(error.end == Approx(0).margin(1e-15));
  CHECK(error.range == Approx(1).epsilon(1e-15));

  // A scaled curve errs by its factor, everywhere.
  const CurveError scaled =
    compare_curves({{0, 0.2, 1}, {0, 0.22, 1.1}}, reference);
  CHECK(scaled.l2 == Approx(0.1).epsilon(1e-13));
  CHECK(scaled.end == Approx(0.1).epsilon(1e-13));
}



TEST_CASE("Few points on a bent curve are an error of known size", "[study]")
{
  // The chord of y = |x - 1| on [0, 2] is y = 1: int x^2 = 2/3 of difference,
  // int |x - 1|^2 = 2/3 of the reference.
  CHECK(compare_curves({{0, 2}, {1, 1}}, {{0, 1, 2}, {1, 0, 1}}).l2 ==
        Approx(1).epsilon(1e-14));
}



TEST_CASE("Curves are compared over their common range, in both directions",
          "[study]")
{
  const StudyCurve reference{{0, -1, -2}, {0, -1, -2}};
  const CurveError error = compare_curves({{0, -1}, {0, -1.5}}, reference);
  CHECK(error.l2 == Approx(0.5).epsilon(1e-13));
  CHECK(error.end == Approx(0.5).epsilon(1e-13));
  CHECK(error.range == Approx(0.5).epsilon(1e-14));
  CHECK_THROWS_AS(compare_curves({{3, 4}, {0, 1}}, {{0, 1}, {0, 1}}),
                  InputError);
  CHECK_THROWS_AS(compare_curves({{0, 1}, {0, 1}}, {{0, 1}, {0, 0}}),
                  InputError);
}



TEST_CASE("A stage begins with the state that the stage before has left",
          "[study]")
{
  std::vector<CurveRow> rows(4);
  rows[1].stage = rows[2].stage = "shear";
  rows[0].stage                 = "release";
  rows[3].stage                 = "back";
  for (unsigned int r = 0; r < 4; ++r)
    {
      rows[r].H[2] = 0.1 * r;
      rows[r].n[2] = r;
    }
  rows[3].H[2]           = 0;
  const StudyCurve curve = stage_curve(rows, "shear", "H3", "n3");
  CHECK(curve.x == std::vector<double>{0, 0.1, 0.2});
  CHECK(curve.y == std::vector<double>{0, 1, 2});
  CHECK_THROWS_WITH(stage_curve(rows, "tension", "H1", "n1"),
                    "The stage 'tension' has no accepted load step.");
  CHECK_THROWS_WITH(stage_curve(rows, "shear", "H1", "n1"),
                    Catch::Contains("H1 does not increase or decrease"));
}



TEST_CASE("The Pareto front has the points that nobody beats", "[study]")
{
  const double              nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> cost{1, 2, 3, 4, 2, nan, 0.5},
    error{0.1, 0.05, 0.06, 0.001, 0.05, 0.01, nan};
  CHECK(pareto_front(cost, error) ==
        std::vector<bool>{true, true, false, true, true, false, false});

  CHECK(cheapest_within(cost, error, 0.2) == 0);
  CHECK(cheapest_within(cost, error, 0.05) == 1);
  CHECK(cheapest_within(cost, error, 0.049) == 3);
  CHECK(cheapest_within(cost, error, 1e-4) == -1);
}



TEST_CASE("Settings are recommended per curve and for all curves together",
          "[study]")
{
  const auto folder =
    std::filesystem::path(NPT_BINARY_DIR) / "test_study_files/recommended";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);

  // Fast is good for curve a only, slow for both, poor for none.
  std::vector<WorkPoint> points;
  const auto             add = [&](const unsigned int group,
                       const std::string &setting,
                       const double       cpu,
                       const double       l2,
                       const bool         complete = true) {
    WorkPoint point;
    point.group    = group;
    point.series   = setting;
    point.setting  = setting;
    point.complete = complete;
    point.cpu      = cpu;
    point.error.l2 = l2;
    points.push_back(point);
  };
  add(0, "fast", 1, 0.005);
  add(1, "fast", 1, 0.5);
  add(0, "slow", 5, 0.001);
  add(1, "slow", 6, 0.002);
  add(0, "broken", 0.1, 0.0, false);
  add(1, "broken", 0.1, 0.0, false);
  std::vector<WorkGroup> groups(2);
  groups[0].name            = "a";
  groups[1].name            = "b";
  groups[0].reference_error = 1e-5;
  groups[1].reference_error = 0.008;
  write_work_precision(
    folder.string(), groups, points, {0.01, 1e-4}, "made up");
  CHECK(points[0].on_front);
  CHECK(points[3].on_front);
  CHECK_FALSE(points[4].on_front);

  const Table table = read_table((folder / "recommended.csv").string());
  REQUIRE(table.n_rows() == 6);
  CHECK(table.text_column("curve") ==
        std::vector<std::string>{"a", "b", "all", "a", "b", "all"});
  CHECK(table.text_column("setting") ==
        std::vector<std::string>{"fast",
                                 "slow",
                                 "slow",
                                 "none of the cases",
                                 "none of the cases",
                                 "none of the cases"});
  CHECK(table.column("cpu_seconds")[2] == 11.);
  CHECK(table.column("error")[2] == 0.002);
  CHECK(table.column("reference_error") ==
        std::vector<double>{1e-5, 0.008, 0.008, 1e-5, 0.008, 0.008});
  // A reference no better than the accuracy is named.
  CHECK(table.text_column("remark")[0].empty());
  CHECK(table.text_column("remark")[1] ==
        "the reference itself is uncertain by 0.8 %");
}



TEST_CASE("Newton iterations are averaged over consecutive steps", "[study]")
{
  std::vector<CurveRow> rows(7);
  for (unsigned int r = 0; r < 7; ++r)
    rows[r].newton_iterations = r + 1;
  const auto means = mean_iterations(rows, 5);
  REQUIRE(means.size() == 2);
  CHECK(means[0].iterations == Approx(3));
  CHECK(means[1].iterations == Approx(6.5));
  CHECK(means[1].first_step == 6);
  CHECK(means[1].last_step == 7);
}
