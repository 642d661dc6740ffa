// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about sensitivity studies: the indices of functions with exact ones,
// what ranges mean, and a study as a user runs it.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/parameter_study.h>
#include <npt_dealii/problems/parameter_study/sensitivity_indices.h>
#include <npt_dealii/problems/parameter_study/sensitivity_ranges.h>

#include <deal.II/base/numbers.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  constexpr double pi = dealii::numbers::PI;

  // sin x + 7 sin^2 y + z^4/10 sin x, each in (-pi, pi): Ishigami and Homma
  // 1990.
  std::vector<double>
  ishigami(const unsigned int n_rows)
  {
    std::vector<double> values;
    for (const auto &point : sensitivity_points(3, n_rows))
      {
        const double x = pi * (2. * point[0] - 1.),
                     y = pi * (2. * point[1] - 1.),
                     z = pi * (2. * point[2] - 1.);
        values.push_back(std::sin(x) + 7. * std::pow(std::sin(y), 2) +
                         0.1 * std::pow(z, 4) * std::sin(x));
      }
    return values;
  }

  std::string
  refusal(const std::string &value)
  {
    try
      {
        SensitivityRanges(make_parameter_text("set A = " + value, "s.prm"));
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "none";
  }
} // namespace



TEST_CASE("The indices of Ishigami's function come out as they are", "[top]")
{
  // Exact: V = 7^2/8 + pi^4/50 + pi^8/1800 + 1/2, and its parts.
  const double b = 0.1, p4 = std::pow(pi, 4), p8 = std::pow(pi, 8);
  const double V        = 49. / 8. + b * p4 / 5. + b * b * p8 / 18. + 0.5;
  const double first[3] = {0.5 * std::pow(1. + b * p4 / 5., 2) / V,
                           49. / 8. / V,
                           0.};
  const double both     = b * b * p8 * (1. / 18. - 1. / 50.) / V; // x with z
  const double total[3] = {first[0] + both, first[1], both};
  const auto   result   = sensitivity_of(ishigami(4096), 3);
  REQUIRE(result.indices.size() == 3);
  CHECK(result.n_rows == 4096);
  CHECK(result.mean == Approx(3.5).epsilon(0.002));
  CHECK(result.deviation == Approx(std::sqrt(V)).epsilon(0.01));
  for (unsigned int i = 0; i < 3; ++i)
    {
      INFO("input " << i);
      const SensitivityIndex &index = result.indices[i];
      CHECK(std::abs(index.first - first[i]) < 0.01);
      CHECK(std::abs(index.total - total[i]) < 0.01);
      // Points that fill the cube evenly do better than their errors say.
      CHECK(std::abs(index.first - first[i]) < 2. * index.first_error);
      CHECK(std::abs(index.total - total[i]) < 2. * index.total_error);
      CHECK(index.first_error < 0.05);
      CHECK(index.total_error < 0.05);
    }
}



TEST_CASE("A sum shares its variance among its inputs, and what is missing "
          "leaves out whole rows",
          "[top]")
{
  // x + 2 y: the variances are as 1 to 4, and nothing acts together.
  std::vector<double> values;
  const auto          points = sensitivity_points(2, 256);
  for (const auto &point : points)
    values.push_back(point[0] + 2. * point[1]);
  const auto all = sensitivity_of(values, 2);
  CHECK(all.indices[0].first == Approx(0.2).margin(0.02));
  CHECK(all.indices[1].total == Approx(0.8).margin(0.02));
  CHECK(all.lowest < all.low);
  CHECK(all.median == Approx(1.5).margin(0.02));

  const double missing = std::numeric_limits<double>::quiet_NaN();
  values[0] = values[3] = values[4 * 7 + 2] = missing; // rows 0, 0 and 7
  const auto part                           = sensitivity_of(values, 2);
  CHECK(part.n_rows == 254);
  std::vector<double> without(values.begin() + 4, values.begin() + 28);
  without.insert(without.end(), values.begin() + 32, values.end());
  CHECK(part.indices[0].first == sensitivity_of(without, 2).indices[0].first);

  CHECK(sensitivity_of({missing, 1., 1., 1.}, 2).n_rows == 0);
  CHECK(sensitivity_of({1., 1., 1., 1.}, 2).indices.empty());
  // A larger design begins with the smaller one.
  const auto more = sensitivity_points(2, 300);
  CHECK(std::equal(points.begin(), points.end(), more.begin()));
}



TEST_CASE("A range is sampled from end to end, and one in double braces goes "
          "along with it",
          "[top]")
{
  const SensitivityRanges ranges(
    make_parameter_text("set A = {1 .. 3}\n"
                        "set B = n1: {0.1 .. 10 log}, n2: {{-1 .. 1}}, x",
                        "study.prm"));
  REQUIRE(ranges.inputs().size() == 2);
  CHECK(ranges.inputs()[0].value(0.25) == 1.5);
  CHECK(ranges.inputs()[1].value(0.5) == Approx(1.));
  CHECK(ranges.inputs()[1].logarithmic);
  const auto           points = sensitivity_points(2, 4);
  const ParameterLoops loops(ranges.sampled(4));
  REQUIRE(loops.n_cases() == 16);
  REQUIRE(loops.loops().size() == 2);
  // The first point of Sobol's sequence is the middle.
  CHECK(loops.value(0, 0) == "2");
  CHECK(loops.value(1, 0) == "n1: 1, n2: 0, x");
  for (unsigned int c = 0; c < 16; ++c)
    CHECK(std::stod(loops.value(0, c)) ==
          Approx(1. + 2. * points[c][0]).epsilon(1e-5));

  CHECK_THAT(refusal("{1 | 2}"), Contains("s.prm:1: '{1 | 2}' is no range"));
  CHECK_THAT(refusal("{2 .. 1}"), Contains("does not grow"));
  CHECK_THAT(refusal("{0 .. 1 log}"), Contains("must begin above 0"));
  CHECK_THAT(refusal("{0 .. 1"), Contains("do not match"));
  CHECK_THAT(refusal("{0 .. 1}}"), Contains("do not match"));
  CHECK_THAT(refusal("{{0 .. 1}}"), Contains("there is none"));
  CHECK_THAT(refusal("{0 .. x}"), Contains("is no range"));
  CHECK_THAT(refusal("1"), Contains("needs ranges"));
}



TEST_CASE("A sensitivity study tells which input matters, and leaves out what "
          "ends early",
          "[top]")
{
  // Pulled straight bars: the moduli act in proportion, friction not at all.
  const fs::path work = fresh_folder("sensitivity");
  std::ofstream(work / "study.prm")
    << "set Problem = parameter study\n"
       "subsection Study\n set Kind = sensitivity\n set Rows = 16\n"
       " set Curve = H1: n1, n2\n set At = 0.01, 0.02, 0.5\nend\n"
       "subsection Cell\n set Type = laminate\nend\n"
       "subsection Mesh\n set Elements along = 1\n set Elements across = 1\n"
       " set Elements through = 1\nend\n"
       "subsection Friction\n set Friction coefficient = {0.1 .. 0.2}\nend\n"
       "subsection Fiber bundle material\n set c_trn = {1 .. 20}\nend\n"
       "subsection Load programme\n set Stages = tension\n"
       " subsection Stage tension\n  set Targets = H1: 0.02\n"
       "  set Initial step = 0.5\n  set Maximum step = 0.5\n end\nend\n";
  const ProgramResult result = run_program(work, {"study.prm"});
  INFO(result.out + result.err);
  REQUIRE(result.status == 0);
  CHECK_THAT(result.out,
             Contains("n1 at H1 0.5: 0 of 16 rows (64 cases do not "
                      "come so far)."));
  const fs::path results = work / "output-study";
  const Table    indices = read_table((results / "sensitivity.csv").string());
  const auto     inputs  = indices.text_column("input");
  const auto     total   = indices.column("total");
  REQUIRE(indices.n_rows() == 8); // two inputs at two abscissas, n1 and n2
  for (unsigned int r = 0; r < 4; ++r)
    {
      INFO("row " << r);
      CHECK(inputs[r] == (r % 2 == 0 ? "Friction coefficient" : "c_trn"));
      // Of sixteen rows.
      CHECK(total[r] == Approx(r % 2 == 0 ? 0. : 1.).margin(0.3));
    }
  const Table band = read_table((results / "sensitivity_band.csv").string());
  REQUIRE(band.n_rows() == 6);
  CHECK(band.column("rows_left_out") ==
        std::vector<double>{0, 0, 16, 0, 0, 16});
  CHECK(band.column("mean")[1] > 1.9 * band.column("mean")[0]);
  CHECK(fs::exists(results / "sensitivity.svg"));

  // More rows go on with the cases that there are.
  const ProgramResult more =
    run_program(work, {"study.prm", "--set", "Study/Rows=17", "--validate"});
  CHECK(more.status == 0);
  CHECK_THAT(more.out, Contains("68 cases"));
  const auto message = [&](const std::string &entry) {
    return run_program(work, {"study.prm", "--set", entry}).err;
  };
  CHECK_THROWS_WITH(StudyParameters::read(make_parameter_text(
                      "subsection Study\n set Kind = sensitivity\nend\n"
                      "subsection Cell\n set Bundle width = {3 .. 4}\n"
                      "end\n",
                      "study.prm")),
                    Contains("At is empty"));
  CHECK_THAT(message("Study/Base={a.prm | b.prm}"), Contains("a.prm"));
  CHECK_THAT(message("Study/Kind=sweep"), Contains("0.1 .. 0.2"));
}
