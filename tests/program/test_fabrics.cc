// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about data sheets as a user meets them, and about the fabrics that
// come with the program.

#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <catch2/catch.hpp>

#include <cmath>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  const std::string fabrics = NPT_SOURCE_DIR "/prm/fabrics";
} // namespace



TEST_CASE("Every fabric is what its data sheet gives, and is valid", "[top]")
{
  const fs::path work     = fresh_folder("fabrics");
  unsigned int   n_sheets = 0;
  for (const auto &entry : fs::directory_iterator(fabrics + "/sheets"))
    {
      const std::string name = entry.path().stem().string();
      INFO(name);
      const std::string file    = fabrics + "/" + name + ".prm";
      const std::string written = read_text(file);
      // The name of the sheet is as it was given.
      fs::create_directories(work / "prm/fabrics/sheets");
      const std::string sheet = "prm/fabrics/sheets/" + name + ".sheet";
      fs::copy_file(entry.path(), work / sheet);
      const ProgramResult result =
        run_program(work, {"--from-data-sheet", sheet});
      CHECK(result.status == 0);
      CHECK(result.err.empty());
      CHECK(result.out == written);
      // That all files are valid is tested with the others.
      ++n_sheets;
    }
  CHECK(n_sheets >= 7);
}



TEST_CASE("A data sheet is no parameter file, and the program says what it is",
          "[top]")
{
  const fs::path    work   = fresh_folder("data_sheet");
  const std::string sheet  = fabrics + "/sheets/carbon_twill.sheet";
  ProgramResult     result = run_program(work, {sheet});
  CHECK(result.status == 2);
  CHECK_THAT(result.err,
             Catch::Contains("is a data sheet") &&
               Catch::Contains("--from-data-sheet"));
  result = run_program(
    work,
    {"--from-data-sheet", sheet, "--set", "Data sheet/Areal density=300"});
  CHECK(result.status == 2);
  CHECK(result.out.empty());
  CHECK_THAT(result.err,
             Catch::Contains("Areal density is 300 g/m^2, but bundles of 198 "
                             "tex every 2 and 2 mm"));
  result = run_program(work, {"--from-data-sheet"});
  CHECK(result.status == 0);
  CHECK_THAT(result.out, Catch::Contains("subsection Data sheet"));
}



TEST_CASE("A real fabric weaves, relaxes and is stretched on a coarse mesh",
          "[top]")
{
  const fs::path      work = fresh_folder("fabric_run");
  const ProgramResult result =
    run_program(work,
                {fabrics + "/twintex.prm",
                 "--output=out",
                 "--set=Mesh/Elements along=3",
                 "--set=Mesh/Elements across=3",
                 "--set=Output/Fields=none",
                 "--set=Output/Picture=false",
                 "--set=Load programme/Stages=weave, release, relax, stretch",
                 "--set=Load programme/Stage stretch/Initial step=1",
                 "--set=Load programme/Stage stretch/Maximum step=1"});
  INFO(result.err);
  REQUIRE(result.status == 0);
  const auto curve = read_curves((work / "out/curves.csv").string());
  CHECK(curve.back().stage == "stretch");
  CHECK(curve.back().n[0] == Approx(0.1).epsilon(1e-6));
  CHECK(curve.back().n[1] == Approx(0.1).epsilon(1e-6));
}
