// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about one run on several processes.

#include <npt_dealii/io/table_file.h>

#include <catch2/catch.hpp>

#include <chrono>
#include <set>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  // mpirun -n N in a clean environment, also as root of a container and with
  // more processes than cores.
  ProgramResult
  run_on(const unsigned int              n,
         const fs::path                 &work,
         const std::vector<std::string> &arguments)
  {
    std::vector<std::string> all = {"-i",
                                    "PATH=" + std::string(std::getenv("PATH")),
                                    "HOME=" + work.string(),
                                    "OPENBLAS_NUM_THREADS=1",
                                    "OMPI_ALLOW_RUN_AS_ROOT=1",
                                    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                    "mpirun",
                                    "--oversubscribe",
                                    "-n",
                                    std::to_string(n),
                                    NPT_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_program(work, all, "env");
  }

  const std::vector<std::string> coarse = {
    NPT_SOURCE_DIR "/prm/shear.prm",
    "--set=Mesh/Elements along=3",
    "--set=Mesh/Elements across=3",
    "--set=Mesh/Elements through=1",
    "--set=Load programme/Stage shear/Targets=H3: 0.02",
    "--set=Load programme/Stage shear/Initial step=0.5",
    "--set=Load programme/Stage shear/Maximum step=0.5"};

  std::set<std::string>
  files_in(const fs::path &work)
  {
    std::set<std::string> names;
    for (const auto &file : fs::directory_iterator(work))
      names.insert(file.path().filename());
    return names;
  }

  // Largest difference of two columns over the largest entry.
  double
  difference(const std::vector<double> &a, const std::vector<double> &b)
  {
    REQUIRE(a.size() == b.size());
    double largest = 0, size = 0;
    for (unsigned int k = 0; k < a.size(); ++k)
      {
        largest = std::max(largest, std::abs(a[k] - b[k]));
        size    = std::max(size, std::abs(a[k]));
      }
    return size == 0 ? largest : largest / size;
  }
} // namespace

TEST_CASE("Two and three processes give the curve and the files of one",
          "[top]")
{
  const fs::path    work        = fresh_folder("parallel");
  const std::string enforcement = GENERATE("penalty", "augmented Lagrangian");
  auto              with_output = [&](const std::string &folder) {
    auto arguments = coarse;
    arguments.push_back("--set=Contact/Enforcement=" + enforcement);
    arguments.push_back("--output=" + folder);
    return arguments;
  };
  INFO(enforcement);
  REQUIRE(run_program(work, with_output("one")).status == 0);
  const Table one = read_table((work / "one/curves.csv").string());
  for (const unsigned int n : {2, 3})
    {
      if (n == 3 && enforcement != "penalty")
        continue;
      const std::string   name      = std::to_string(n);
      const auto          arguments = with_output(name);
      const ProgramResult result    = run_on(n, work, arguments);
      INFO(n << " processes: " << result.err);
      REQUIRE(result.status == 0);
      const Table several = read_table((work / name / "curves.csv").string());
      for (const std::string column :
           {"n1", "n2", "n3", "stored_energy", "dissipation", "n_slip"})
        {
          INFO(column);
          CHECK(difference(one.column(column), several.column(column)) < 1e-8);
        }
      CHECK(files_in(work / name) == files_in(work / "one"));
      // One of them speaks for all.
      CHECK(result.out.find("Factorizations") ==
            result.out.rfind("Factorizations"));
    }
}



TEST_CASE("Two processes give the curve of one with factors of single "
          "precision, too",
          "[top]")
{
  const fs::path work = fresh_folder("parallel_single");
  auto           with = [&](const std::string &factors) {
    auto arguments = coarse;
    arguments.push_back("--set=Linear solver/Factors=" + factors);
    arguments.push_back("--output=" + factors);
    return arguments;
  };
  REQUIRE(run_program(work, with("double")).status == 0);
  const ProgramResult result = run_on(2, work, with("single"));
  INFO(result.err);
  REQUIRE(result.status == 0);
  CHECK_THAT(result.out, Catch::Contains("factors in single precision"));
  const Table one = read_table((work / "double/curves.csv").string());
  const Table two = read_table((work / "single/curves.csv").string());
  for (const std::string column :
       {"n1", "n2", "n3", "stored_energy", "dissipation", "n_slip"})
    {
      INFO(column);
      CHECK(difference(one.column(column), two.column(column)) < 1e-8);
    }
}



namespace
{
  // Send SIGTERM to the first process once, when the first step of a stage is
  // on the screen.
  ProgramResult
  run_and_stop(const unsigned int       n,
               const fs::path          &work,
               const std::string       &stage,
               std::vector<std::string> arguments)
  {
    const std::string script =
      "mpirun --oversubscribe -n " + std::to_string(n) +
      " sh -c 'echo $$ > pid.$OMPI_COMM_WORLD_RANK; exec \"$0\" \"$@\"' \"$@\""
      " | while read -r step stage rest; do"
      " if [ \"$stage\" = " +
      stage +
      " ] && [ -f pid.0 ]; then kill -TERM $(cat pid.0); rm pid.0; fi; done";
    std::vector<std::string> all = {"-i",
                                    "PATH=" + std::string(std::getenv("PATH")),
                                    "HOME=" + work.string(),
                                    "OPENBLAS_NUM_THREADS=1",
                                    "OMPI_ALLOW_RUN_AS_ROOT=1",
                                    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1",
                                    "sh",
                                    "-c",
                                    script,
                                    "sh",
                                    NPT_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_program(work, all, "env");
  }
} // namespace



TEST_CASE("A run that goes on with another number of processes, between stages "
          "and within one, has the curve of one process",
          "[top]")
{
  const fs::path work = fresh_folder("change_of_processes");
  std::ofstream(work / "stages.prm") << "# All entries are given by --set.\n";
  const auto with = [&](const std::string              &stages,
                        const std::vector<std::string> &more) {
    std::vector<std::string> all = coarse;
    all[0]                       = "stages.prm"; // none has its own subsection
    for (std::string &argument : all)
      if (argument.find("Initial step") != std::string::npos ||
          argument.find("Maximum step") != std::string::npos)
        argument.replace(argument.find("=0.5"), 4, "=0.1");
    if (stages.find("shear") == std::string::npos)
      all.resize(4);
    all.push_back("--set=Load programme/Stages=" + stages);
    all.push_back("--set=Contact/Method=KTS");
    all.push_back("--set=Friction/Friction coefficient=0.3");
    all.push_back("--set=Output/Picture=false");
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  REQUIRE(
    run_program(work, with("weave, release, shear", {"--output=one"})).status ==
    0);
  REQUIRE(run_on(2, work, with("weave", {})).status == 0);
  REQUIRE(run_program(work, with("weave, release", {"--continue"})).status ==
          0);
  run_and_stop(3, work, "shear", with("weave, release, shear", {"--continue"}));
  CHECK_THAT(read_text(work / "output/summary.csv"),
             Catch::Contains("interrupted,shear"));
  run_and_stop(2, work, "shear", with("weave, release, shear", {"--continue"}));
  const ProgramResult last =
    run_program(work, with("weave, release, shear", {"--continue"}));
  INFO(last.err);
  REQUIRE(last.status == 0);
  const Table one     = read_table((work / "one/curves.csv").string()),
              several = read_table((work / "output/curves.csv").string());
  for (const std::string column : {"load_factor",
                                   "n1",
                                   "n2",
                                   "n3",
                                   "stored_energy",
                                   "dissipation",
                                   "n_slip"})
    {
      INFO(column);
      CHECK(difference(one.column(column), several.column(column)) < 1e-8);
    }
}



TEST_CASE("Of several processes one says what is wrong, with the exit status "
          "of one",
          "[top]")
{
  const fs::path work      = fresh_folder("parallel_errors");
  auto           arguments = coarse;
  const auto n_times = [](const std::string &text, const std::string &words) {
    unsigned int n = 0;
    for (auto at = text.find(words); at != std::string::npos;
         at      = text.find(words, at + 1))
      ++n;
    return n;
  };
  const auto n_said = [&](const std::string &text) {
    return n_times(text, "npt_dealii: ");
  };
  SECTION("input that cannot be used")
  {
    arguments.push_back("--set=Cell/Bundle width=-1");
    const ProgramResult result = run_on(2, work, arguments);
    CHECK(result.status == 2);
    CHECK(n_said(result.err) == 1);
    CHECK_FALSE(fs::exists(work / "output"));
  }
  SECTION("a solver that works on one process")
  {
    arguments.push_back("--set=Linear solver/Type=ILU");
    const ProgramResult result = run_on(2, work, arguments);
    CHECK(result.status == 2);
    CHECK_THAT(result.err, Catch::Contains("choose MUMPS"));
    CHECK_FALSE(fs::exists(work / "output"));
  }
  SECTION("a folder that cannot be made")
  {
    std::ofstream(work / "file") << "no folder\n";
    arguments.push_back("--output=file/below");
    const ProgramResult result = run_on(2, work, arguments);
    CHECK(result.status == 2);
    CHECK(n_said(result.err) == 1);
  }
  SECTION("results that cannot be written, which only the first one notices")
  {
    // Opens, and is full.
    fs::create_directories(work / "full");
    fs::create_symlink("/dev/full", work / "full/curves.csv");
    arguments.push_back("--output=full");
    const auto          start  = std::chrono::steady_clock::now();
    const ProgramResult result = run_on(2, work, arguments);
    const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - start;
    CHECK(result.status == 4);
    CHECK(n_times(result.err, "full/curves.csv' cannot be written") == 1);
    CHECK(seconds.count() < 100); // the others would wait for ever
  }
  SECTION("a summary that cannot be written at the end")
  {
    fs::create_directories(work / "taken/summary.csv");
    arguments.push_back("--output=taken");
    const ProgramResult result = run_on(2, work, arguments);
    CHECK(result.status == 4);
    CHECK(n_said(result.err) == 1);
  }
  SECTION("a command line that nobody understands")
  {
    arguments.push_back("--nonsense");
    const ProgramResult result = run_on(2, work, arguments);
    CHECK(result.status == 2);
    CHECK(n_said(result.err) == 1);
  }
  SECTION("a stage that fails")
  {
    arguments.push_back("--set=Newton/Maximum iterations=1");
    arguments.push_back("--set=Load programme/Stage weave/Minimum step=0.02");
    arguments.push_back("--output=failed");
    const ProgramResult result = run_on(2, work, arguments);
    CHECK(result.status == 1);
    CHECK(n_said(result.err) == 1);
    CHECK_THAT(read_text(work / "failed/summary.csv"),
               Catch::Contains("failed"));
  }
}
