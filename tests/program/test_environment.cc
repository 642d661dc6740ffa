// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the surroundings of the program: what it does not find there
// changes neither its results nor its words.

#include <catch2/catch.hpp>

#include <cstdlib>
#include <optional>
#include <sstream>

#include "run_program.h"

using namespace TopTests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  const std::vector<std::string> small_run = {
    NPT_PROGRAM,
    NPT_SOURCE_DIR "/prm/shear.prm",
    "--set=Mesh/Elements along=3",
    "--set=Mesh/Elements across=3",
    "--set=Mesh/Elements through=1",
    "--set=Cell/Weaving depth=0.5",
    "--set=Load programme/Stage shear/Targets=H3: 0.02",
    "--set=Load programme/Stage shear/Initial step=0.5",
    "--set=Load programme/Stage shear/Maximum step=0.5"};
  const std::string no_picture = "--set=Output/Picture=false";

  /// Run it by `env` or `sh`, with what stands before the program.
  ProgramResult
  run_by(const fs::path                 &work,
         const std::string              &program,
         std::vector<std::string>        arguments,
         const std::vector<std::string> &more = {})
  {
    arguments.insert(arguments.end(), small_run.begin(), small_run.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(work, arguments, program);
  }

  /// The text of a table without its CPU times.
  std::string
  without_times(const fs::path &file)
  {
    std::ifstream in(file);
    std::string   line, result;
    int           skipped = -1; // number of that column
    while (std::getline(in, line))
      {
        std::istringstream cells(line);
        std::string        cell;
        for (int column = 0; std::getline(cells, cell, ','); ++column)
          if (cell == "cpu_seconds")
            skipped = column;
          else if (column != skipped)
            result += cell + ",";
        result += "\n";
      }
    REQUIRE(skipped >= 0);
    return result;
  }

  /// The curve of the run in the environment of the tests.
  const std::string &
  usual_curve()
  {
    static const std::string curve = []() {
      const fs::path work = fresh_folder("usual_environment");
      REQUIRE(run_by(work, "env", {}, {no_picture}).status == 0);
      return without_times(work / "output/curves.csv");
    }();
    return curve;
  }

  /// Run it where folders of the system are empty and cannot be written;
  /// nothing if this user cannot arrange that.
  std::optional<ProgramResult>
  run_without(const fs::path &work, const std::vector<std::string> &folders)
  {
    const auto holds = [](const std::string &place, const std::string &path) {
      return path.compare(0, place.size() + 1, place + "/") == 0;
    };
    std::string hide;
    for (const std::string &place : folders)
      if (!holds(place, NPT_SOURCE_DIR) && !holds(place, NPT_BINARY_DIR))
        hide += "mount -t tmpfs -o ro none " + place + " && ";
    const std::vector<std::string> shell = {"-rm", "sh", "-c"};
    auto                           alone = shell;
    alone.push_back(hide + "true");
    if (run_program(work, alone, "unshare").status != 0)
      return {};
    auto run = shell;
    run.push_back(hide + "exec \"$0\" \"$@\"");
    return run_by(work, "unshare", run, {no_picture});
  }
} // namespace



TEST_CASE("Two runs with the same kernels of the BLAS are the same to the last "
          "bit, whatever the environment",
          "[program]")
{
  REQUIRE(usual_curve().size() > 1000);
  const fs::path work = fresh_folder("environment");
  const auto     same = [&](const ProgramResult &result) {
    INFO(result.err);
    CHECK(result.status == 0);
    CHECK(result.err.empty());
    CHECK(without_times(work / "output/curves.csv") == usual_curve());
  };
  same(run_by(work, "env", {}, {no_picture}));
  // Not even a path, a home, or a place for files that do not last.
  std::vector<std::string> bare = settings_of_openblas();
  bare.insert(bare.begin(), "-i");
  same(run_by(work, "env", bare, {no_picture}));
  same(run_by(work,
              "env",
              {"TMPDIR=/nonexistent/folder", "HOME=/nonexistent", "PATH="},
              {no_picture}));
}



TEST_CASE("Whatever the problem, reading its file does not start MPI",
          "[program]")
{
  const fs::path work  = fresh_folder("reading");
  const auto     reads = [&](const std::string              &file,
                         const std::vector<std::string> &options) {
    // Open MPI would find no way to send messages, and no folder.
    std::vector<std::string> arguments = {"-i",
                                          "OMPI_MCA_pml=nothing",
                                          "TMPDIR=/nonexistent",
                                          NPT_PROGRAM,
                                          NPT_SOURCE_DIR "/prm/" + file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramResult result = run_program(work, arguments, "env");
    INFO(file << ": " << result.err);
    CHECK(result.status == 0);
    CHECK(result.err.empty());
    return result.out;
  };
  for (const std::string file : {"shear.prm",
                                 "nmt.prm",
                                 "identify.prm",
                                 "studies/stability_friction.prm",
                                 "verification/contact_patch_matching.prm",
                                 "verification/cylinder.prm"})
    reads(file, {"--validate"});
  std::ofstream(work / "weave.tg3") << reads("shear.prm", {"--to-texgen"});
  const ProgramResult read = run_program(
    work,
    {"-i", "OMPI_MCA_pml=nothing", NPT_PROGRAM, "weave.tg3", "--from-texgen"},
    "env");
  CHECK(read.status == 0);
  CHECK_THAT(read.out, Contains("subsection Cell"));
}



TEST_CASE("In a language with decimal commas all files have decimal points",
          "[program]")
{
  const fs::path work = fresh_folder("locale");
  // Made here, since most machines do not have it.
  const int made =
    std::system(("localedef -i de_DE -f UTF-8 '" +
                 (work / "de_DE.UTF-8").string() + "' > /dev/null 2>&1")
                  .c_str());
  if (made != 0 || !fs::exists(work / "de_DE.UTF-8/LC_NUMERIC"))
    {
      WARN("There is no localedef, or no German to make.");
      return;
    }
  for (const std::string language : {"C", "de_DE.UTF-8"})
    {
      const ProgramResult result = run_by(work,
                                          "env",
                                          {"LOCPATH=" + work.string(),
                                           "LC_ALL=" + language,
                                           "LANGUAGE=de"},
                                          {"--output=" + language});
      INFO(result.err);
      CHECK(result.status == 0);
      CHECK(without_times(work / language / "curves.csv") == usual_curve());
    }
  unsigned int n_files = 0;
  for (const auto &entry : fs::directory_iterator(work / "C"))
    {
      const std::string name = entry.path().filename().string();
      // Not those with CPU times, versions or folders in them.
      if (name == "curves.csv" || name == "log.txt" || name == "summary.csv" ||
          name == "checkpoint.bin" || name == "used_parameters.prm")
        continue;
      INFO(name);
      CHECK(read_text(entry.path()) == read_text(work / "de_DE.UTF-8" / name));
      ++n_files;
    }
  CHECK(n_files > 10);
}



TEST_CASE("Without /sys, /dev/shm and a /tmp to write the run is the same",
          "[program]")
{
  const fs::path work   = fresh_folder("without_system");
  const auto     result = run_without(work, {"/sys", "/dev/shm", "/tmp"});
  if (!result)
    {
      WARN("This user cannot hide folders of the system.");
      return;
    }
  INFO(result->err);
  CHECK(result->status == 0);
  CHECK(result->err.empty());
  CHECK(without_times(work / "output/curves.csv") == usual_curve());
}



// The address sanitizer takes terabytes of addresses.
#ifndef NPT_SANITIZED
TEST_CASE("What does not fit into the memory is refused before it is taken",
          "[program]")
{
  const fs::path work   = fresh_folder("memory");
  const auto     run_in = [&](const std::string              &kilobytes,
                          const std::vector<std::string> &more) {
    return run_by(work,
                  "sh",
                  {"-c", "ulimit -v " + kilobytes + " && exec \"$0\" \"$@\""},
                  more);
  };
  // Two gigabytes are enough for a small cell.
  const ProgramResult small = run_in("2000000", {no_picture});
  INFO(small.err);
  CHECK(small.status == 0);
  CHECK(without_times(work / "output/curves.csv") == usual_curve());

  // With less than its buffer OpenBLAS would try for ever to get it. Another
  // BLAS may do with so little; the libraries of a Debug build may not.
  for (const std::string kilobytes : {"700000", "600000"})
    {
      const ProgramResult too_small = run_in(kilobytes, {no_picture});
      INFO(too_small.err);
      if (too_small.status == 0)
        CHECK(without_times(work / "output/curves.csv") == usual_curve());
      else if (too_small.status == 127)
        CHECK_THAT(too_small.err, Contains("error while loading shared"));
      else
        {
          CHECK(too_small.status == 1);
          CHECK_THAT(too_small.err,
                     Contains("memory") && Contains("a coarser mesh"));
        }
    }

  const ProgramResult refused =
    run_program(work,
                {"-c",
                 "ulimit -v 2000000 && exec \"$0\" \"$@\"",
                 NPT_PROGRAM,
                 NPT_SOURCE_DIR "/prm/shear.prm",
                 "--set=Mesh/Elements along=100",
                 "--set=Mesh/Elements across=100",
                 "--set=Mesh/Elements through=8"},
                "sh");
  CHECK(refused.status == 1);
  CHECK_THAT(refused.err,
             Contains("100 x 100 x 8 elements per crossing takes at least") &&
               Contains("GB are available") && Contains("a coarser mesh"));
  CHECK_THAT(read_text(work / "output/summary.csv"),
             Contains("failed,out of memory"));
}
#endif



TEST_CASE("A solver that the memory does not suffice for is no body that "
          "nothing holds",
          "[program]")
{
  const fs::path      work   = fresh_folder("memory_of_solver");
  const ProgramResult result = run_by(work,
                                      "env",
                                      {},
                                      {no_picture,
                                       "--set=Linear solver/Type=MUMPS",
                                       "--set=Linear solver/Maximum "
                                       "memory=1e-4"});
  CHECK(result.status == 1);
  CHECK_THAT(result.err,
             Contains("out of memory") && Contains("a coarser mesh") &&
               !Contains("holds"));
  CHECK_THAT(read_text(work / "output/summary.csv"), Contains("out of memory"));
}



TEST_CASE(
  "Which libraries are loaded at the start, and whether their functions "
  "are looked for then or later, changes nothing",
  "[program]")
{
  for (const std::string variable :
       {"NPT_LOAD_ALL_LIBRARIES=1", "LD_BIND_NOW=1"})
    {
      INFO(variable);
      const fs::path      work = fresh_folder("libraries");
      const ProgramResult result =
        run_by(work, "env", {variable}, {no_picture});
      INFO(result.err);
      REQUIRE(result.status == 0);
      CHECK(without_times(work / "output/curves.csv") == usual_curve());
    }
}
