// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the two programs: npt_dealii starts verify for benchmarks, and a
// missed tolerance is an exit status.

#include <catch2/catch.hpp>

#include "run_program.h"

using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  const std::string patch_test =
    NPT_SOURCE_DIR "/prm/verification/contact_patch_matching.prm";
} // namespace



TEST_CASE("A benchmark runs by npt_dealii as by verify", "[program]")
{
  const fs::path work = fresh_folder("benchmark");
  for (const std::string program : {NPT_PROGRAM, NPT_VERIFY})
    {
      const std::string   name   = fs::path(program).filename().string();
      const ProgramResult result = run_program(work,
                                               {patch_test,
                                                "--output",
                                                name,
                                                "--set=Upper body/Elements=2",
                                                "--set=Lower body/Elements=2"},
                                               program);
      INFO(result.err);
      CHECK(result.status == 0);
    }
  CHECK(read_text(work / "npt_dealii/comparison.csv") ==
        read_text(work / "verify/comparison.csv"));
  CHECK_FALSE(read_text(work / "verify/comparison.csv").empty());
}



TEST_CASE("Without its library or verify beside it npt_dealii says what is "
          "missing",
          "[program]")
{
  const fs::path    work    = fresh_folder("alone");
  const std::string program = (work / "npt_dealii").string();
  fs::copy_file(NPT_PROGRAM, program);
  // Builds without NPT_FAST_START have no library.
  const fs::path library =
    fs::path(NPT_PROGRAM).parent_path() / "libnpt_dealii.so";
  if (fs::exists(library))
    {
      const ProgramResult no_library = run_program(work, {patch_test}, program);
      CHECK(no_library.status == 127);
      CHECK_THAT(no_library.err,
                 Catch::Contains("error while loading shared") &&
                   Catch::Contains(
                     "Keep this file and libnpt_dealii.so in one folder."));
      fs::copy_file(library, work / "libnpt_dealii.so");
    }
  const ProgramResult result = run_program(work, {patch_test}, program);
  fs::remove(program);
  fs::remove(work / "libnpt_dealii.so");
  CHECK(result.status == 2);
  CHECK_THAT(result.err,
             Catch::Contains("Problem is contact benchmark, which the program "
                             "verify computes") &&
               Catch::Contains((work / "verify").string()));
}



TEST_CASE("A missed tolerance ends with status 1, a sentence, and complete "
          "results",
          "[program]")
{
  const fs::path      work = fresh_folder("missed");
  const ProgramResult result =
    run_program(work,
                {patch_test,
                 "--output",
                 "results",
                 "--set=Benchmark/Stiffness factor=1.05",
                 "--set=Tolerances/Displacement of the plate=1 %"});
  CHECK(result.status == 1);
  CHECK_THAT(result.err,
             Catch::Contains(
               "verify: The comparison with the exact solution failed: "
               "displacement of the plate is -0.1") &&
               Catch::Contains("exact -0.16241") &&
               Catch::Contains("allowed 1 %"));
  CHECK_THAT(read_text(work / "results/comparison.csv"),
             Catch::Contains("displacement of the plate"));
  CHECK(fs::exists(work / "results/profile.csv") == false); // of other cases
}



TEST_CASE("verify refuses what is no benchmark", "[program]")
{
  const fs::path work = fresh_folder("no_benchmark");
  ProgramResult  result =
    run_program(work, {NPT_SOURCE_DIR "/prm/nmt.prm"}, NPT_VERIFY);
  CHECK(result.status == 2);
  CHECK(result.err == "verify: Problem is 'material test'; it must be contact "
                      "benchmark or solid benchmark for the program verify\n");
  result = run_program(work, {"--print-defaults"}, NPT_VERIFY);
  CHECK(result.status == 2);
  CHECK(result.err == "verify: Problem is not set; it must be contact "
                      "benchmark or solid benchmark.\n");
}
