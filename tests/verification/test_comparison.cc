// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about comparisons with exact values and their tolerances.

#include <npt_dealii/io/table_file.h>
#include <npt_dealii/verification/comparison.h>

#include <deal.II/base/parameter_handler.h>

#include <catch2/catch.hpp>

#include <limits>

#include "run_program.h"

using namespace NPT;

namespace
{
  std::string
  message_of(const std::vector<Comparison> &comparisons)
  {
    try
      {
        judge(comparisons);
      }
    catch (const ToleranceMissed &error)
      {
        return error.what();
      }
    return "no miss";
  }
} // namespace



TEST_CASE("An error is relative to the exact value, and absolute where zero is "
          "exact",
          "[verification]")
{
  CHECK(Comparison{"force", "N", 1.5, -2., {}}.error() == 1.75);
  CHECK(Comparison{"force", "N", 1.5, 0., {}}.error() == 1.5);
}



TEST_CASE("A missed tolerance is told with quantity, computed, exact and "
          "allowed value",
          "[verification]")
{
  CHECK(message_of({{"peak pressure", "MPa", 13.5, 15., 0.05},
                    {"half width", "mm", 0.99, 1., 0.02},
                    {"residual", "N", 2e-3, 0., 1e-3}}) ==
        "The comparison with the exact solution failed: peak pressure is 13.5 "
        "MPa, exact 15 MPa: off by -10 %, allowed 5 %; residual is 0.002 N, "
        "exact 0 N, allowed 0.001 N.");
}



TEST_CASE("What is not a number misses its tolerance, and what has none is not "
          "judged",
          "[verification]")
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THAT(message_of({{"torque", "N mm", nan, 1., 0.5}}),
             Catch::Contains("torque"));
  CHECK(message_of({{"torque", "N mm", 5., 1., {}},
                    {"penetration", "mm", 5., {}, {}},
                    {"sticking nodes", "-", 0., 0., 0.}}) == "no miss");
}



TEST_CASE("Tolerances are numbers, per cent or none, in entries named by the "
          "quantities",
          "[verification]")
{
  const std::vector<ComparedQuantity> quantities = {{"peak pressure", "MPa"},
                                                    {"force ratio Q/P", "-"},
                                                    {"half width", "mm"},
                                                    {"approach", "mm", false}};
  dealii::ParameterHandler            prm;
  declare_tolerances(prm, quantities);
  prm.parse_input_from_string("subsection Tolerances\n"
                              "set Peak pressure = 1.5 %\n"
                              "set Force ratio Q over P = 0.25\n"
                              "end\n");
  const Tolerances tolerances = parse_tolerances(prm, quantities);
  REQUIRE(tolerances.size() == 2);
  CHECK(tolerances.at("peak pressure") == Approx(0.015).epsilon(1e-15));
  CHECK(tolerances.at("force ratio Q/P") == 0.25);

  for (const std::string text :
       {"1 mm", "-1", "nan", "%", "", "1e-400", "0x10"})
    CHECK_THROWS_AS(parse_tolerance(text, "Half width", "Tolerances"),
                    InputError);
}



TEST_CASE("The table of comparisons says nothing where there is no value",
          "[verification]")
{
  const auto file = TopTests::fresh_folder("comparison") / "comparison.csv";
  write_comparisons(file.string(),
                    {{"peak pressure, L2", "MPa", 13.5, 15., 0.05},
                     {"approach", "mm", 0.5, {}, {}}});
  const Table table = read_table(file.string());
  REQUIRE(table.n_rows() == 2);
  CHECK(table.rows[0] ==
        std::vector<std::string>{
          "peak pressure, L2", "MPa", "13.5", "15", "-0.1", "0.05"});
  CHECK(table.rows[1] ==
        std::vector<std::string>{"approach", "mm", "0.5", "", "", ""});
}
