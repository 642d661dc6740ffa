// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about error bars: what made-up runs with known errors give.

#include <npt_dealii/problems/accuracy/error_bars.h>
#include <npt_dealii/problems/accuracy/error_controlled_test.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;

namespace
{
  LoadStage
  stage_of(const std::string                    &name,
           const std::map<unsigned int, double> &H,
           const std::map<unsigned int, double> &n = {})
  {
    LoadStage stage(name);
    stage.type      = LoadStage::Type::load;
    stage.H_targets = H;
    stage.n_targets = n;
    return stage;
  }

  // A run of one load stage with y = exact + error, error a function of x.
  AnswerCurve
  curve(const std::function<double(double)> &y, const unsigned int n_steps = 10)
  {
    AnswerCurve result;
    result.stage  = "shear";
    result.driven = "H3";
    result.answer = "n3";
    for (unsigned int i = 1; i <= n_steps; ++i)
      {
        const double t = double(i) / n_steps;
        result.load_factor.push_back(t);
        result.x.push_back(0.2 * t);
        result.y.push_back(y(0.2 * t));
      }
    return result;
  }
} // namespace



TEST_CASE("Every component that a load stage changes has a curve", "[accuracy]")
{
  std::vector<CurveRow> rows(6);
  const double          H3[] = {0., 0.1, 0.2, 0.2, 0.2, 0.2};
  for (unsigned int i = 0; i < rows.size(); ++i)
    {
      rows[i].stage       = i == 0 ? "weave" : i < 3 ? "shear" : "pull";
      rows[i].load_factor = i == 0 ? 1. : i < 3 ? 0.5 * i : (i - 2) / 3.;
      rows[i].H[2]        = H3[i];
      rows[i].n[2]        = 10. * H3[i];
      rows[i].n[0]        = i < 3 ? 0. : i - 2.;
      rows[i].H[0]        = 0.1 * rows[i].n[0];
    }
  LoadStage weave("weave");
  weave.type        = LoadStage::Type::weave;
  const auto curves = answer_curves({weave,
                                     stage_of("shear", {{2, 0.2}}),
                                     stage_of("pull", {{2, 0.2}}, {{0, 3.}})},
                                    rows);
  REQUIRE(curves.size() == 2); // H3 is held while n1 grows
  CHECK(curves[0].stage == "shear");
  CHECK(curves[0].driven == "H3");
  CHECK(curves[0].answer == "n3");
  CHECK(curves[0].x == std::vector<double>{0.1, 0.2});
  CHECK(curves[1].driven == "n1");
  CHECK(curves[1].answer == "H1");
  CHECK(curves[1].load_factor.size() == 3);
  CHECK(curves[1].y.back() == Approx(0.3));
}



TEST_CASE("An error by the penalty is extrapolated away, and half of the "
          "correction is its bar",
          "[accuracy]")
{
  const auto exact = [](const double x) { return 5. * x; };
  const auto soft  = [](const double by) {
    return [by](const double x) { return 5. * x * (1. - 0.01 * by); };
  };
  const Probes<AnswerCurve> runs = {curve(soft(1.)),
                                    curve(soft(1.)),
                                    curve(soft(1.)),
                                    curve(soft(1.)),
                                    curve(soft(penalty_ratio)),
                                    curve(soft(1.), 5)};
  const ErrorBars           bars = estimate_errors(runs);
  for (std::size_t i = 0; i < bars.value.size(); ++i)
    CHECK(bars.value[i] == Approx(exact(bars.main.x[i])).epsilon(1e-12));
  // A little more: the bar of each step counts its neighbors as well.
  CHECK(bars.relative == Approx(1.25 * 0.0054).epsilon(0.1));
  CHECK(bars.relative_parts[0] == 0.);
  CHECK(bars.relative_parts[1] == 0.);
  CHECK(bars.relative_parts[3] < 1e-15);
}



TEST_CASE("Errors of second order by the mesh lie within the bar, also where "
          "the curves cross",
          "[accuracy]")
{
  // The error of a mesh with elements h is h^2 e(x), which changes its sign.
  const auto error = [](const double x) { return std::cos(40. * x); };
  const auto on    = [&](const double h) {
    return [=](const double x) { return 5. * x + h * h * error(x); };
  };
  const double              h    = 0.1;
  const Probes<AnswerCurve> runs = {curve(on(h), 20),
                                    curve(on(1.4 * h), 20),
                                    curve(on(2. * h), 20),
                                    curve(on(2. * h), 20),
                                    curve(on(2. * h), 20),
                                    curve(on(2. * h), 10)};
  const ErrorBars           bars = estimate_errors(runs);
  for (std::size_t i = 0; i < bars.value.size(); ++i)
    {
      const double true_error = std::abs(bars.value[i] - 5. * bars.main.x[i]);
      CHECK(bars.bar[i] > 0.9 * true_error);
    }
  CHECK(bars.relative_parts[3] < 1e-15); // met at common steps only
}



TEST_CASE("A run that ends early shortens the curve to what all have reached",
          "[accuracy]")
{
  const auto  line  = [](const double x) { return x; };
  AnswerCurve early = curve(line);
  early.load_factor.resize(6);
  early.x.resize(6);
  early.y.resize(6);
  const ErrorBars bars = estimate_errors({curve(line),
                                          early,
                                          curve(line),
                                          curve(line),
                                          curve(line),
                                          curve(line, 5)});
  CHECK(bars.value.size() == 6);
  CHECK(bars.relative < 1e-15);
}



TEST_CASE("A finer target begins with a finer setting, and refining ends",
          "[accuracy]")
{
  const auto setting = [](const std::string &target) {
    return first_setting(
      PlateTestParameters::read({}, {"Accuracy/Target=" + target}));
  };
  CHECK(setting("1 %").n_elements == 5);
  CHECK(setting("0.3 %").n_elements == 7);
  CHECK(setting("0.001").n_elements == 9);
  CHECK(setting("1 %").penalty == Approx(1000.).epsilon(0.01)); // default cell
  CHECK(setting("0.1 %").penalty > 2. * setting("1 %").penalty);
  AccuracySetting s = setting("1 %");
  CHECK(s.coarser_mesh() == 4);
  unsigned int n = 0;
  while (s.refine(ErrorSource::mesh))
    {
      CHECK(s.coarser_mesh() < s.n_elements);
      ++n;
    }
  CHECK(n == 5); // 7, 9, 13, 17, 25
  while (s.refine(ErrorSource::step))
    ++n;
  CHECK(s.step < 2e-3);
}



TEST_CASE("Targets that mean nothing are refused by name", "[accuracy]")
{
  for (const std::string target :
       {"1", "0 %", "1 percent", "-1 %", "fine", "%"})
    CHECK_THROWS_WITH(PlateTestParameters::read({},
                                                {"Accuracy/Target=" + target}),
                      Catch::Contains("Target is '" + target + "'"));
  CHECK_NOTHROW(PlateTestParameters::read({}, {"Accuracy/Target=1%"}));
}
