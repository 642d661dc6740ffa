// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about running cases: failures, limits, resuming. The program is a
// script of the shell that does what its parameter file says.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/stability_map.h>
#include <npt_dealii/problems/parameter_study/sweep.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <sstream>

using namespace NPT;
namespace fs = std::filesystem;

namespace
{
  // Arguments: FOLDER/case.prm --output FOLDER. The case is a line of shell.
  fs::path
  make_study(const std::string &name)
  {
    const fs::path folder =
      fs::path(NPT_BINARY_DIR) / "test_study_files" / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    const fs::path program = folder / "program";
    std::ofstream(program) << "#!/bin/sh\ncd \"$3\"\necho x >> started\n"
                              ". ./case.prm\n";
    fs::permissions(program, fs::perms::owner_all);
    return folder;
  }

  std::vector<SweepCase>
  make_cases(const std::vector<std::string> &commands)
  {
    std::vector<SweepCase> cases;
    for (const std::string &command : commands)
      {
        SweepCase c;
        c.values     = {{"Command", command}};
        c.parameters = command + "\n";
        cases.push_back(c);
      }
    return cases;
  }

  // How often a case has been started.
  unsigned int
  n_starts(const fs::path &folder, const SweepCase &c)
  {
    std::ifstream in(folder / c.folder / "started");
    unsigned int  n = 0;
    for (std::string line; std::getline(in, line);)
      ++n;
    return n;
  }

  SweepOptions
  options_for(const fs::path &folder)
  {
    SweepOptions options;
    options.directory    = folder.string();
    options.side_by_side = 2;
    options.program      = (folder / "program").string();
    return options;
  }
} // namespace



TEST_CASE("A case that crashes, fails or hangs does not end the others",
          "[study]")
{
  const fs::path folder    = make_study("failures");
  SweepOptions   options   = options_for(folder);
  options.cpu_limit        = 1;
  auto               cases = make_cases({"kill -SEGV $$",
                                         "echo 'npt_dealii: Stage given up.' >&2; exit 1",
                                         "echo 'npt_dealii: a mistake' >&2; exit 2",
                                         "while :; do :; done",
                                         "exit 3",
                                         "true"});
  std::ostringstream log;
  run_cases(cases, options, log);
  CHECK(cases[0].result.status == "crashed");
  CHECK_THAT(cases[0].result.reason, Catch::Contains("egmentation"));
  CHECK(cases[1].result.status == "failed");
  CHECK(cases[1].result.message == "Stage given up. ");
  CHECK(cases[2].result.status == "refused");
  CHECK(cases[2].result.message == "a mistake ");
  CHECK(cases[3].result.status == "time limit");
  CHECK(cases[3].result.cpu_seconds > 0.);
  CHECK(cases[4].result.reason == "unexpected error");
  CHECK(cases[5].result.status == "done");

  const std::string table_name = (folder / "cases.csv").string();
  write_case_table(table_name, cases);
  const Table table = read_table(table_name);
  CHECK(table.n_rows() == 6);
  CHECK(table.text_column("case")[5] == cases[5].folder);
  CHECK(table.text_column("Command")[5] == "true");
  CHECK(table.text_column("status")[5] == "done");
}



TEST_CASE("What the program says about its end is in the result", "[study]")
{
  const fs::path folder = make_study("summary");
  RunSummary     summary;
  summary.status            = "failed";
  summary.reason            = "inverted cell";
  summary.message           = "Stage \"shear\" was given up, alas.";
  summary.stage             = "shear";
  summary.load_factor       = 0.35;
  summary.steps             = 18;
  summary.newton_iterations = 77;
  summary.cuts              = 5;
  summary.n_unknowns        = 500;
  write_run_summary((folder / "made.csv").string(), summary);

  auto cases =
    make_cases({"cp ../../made.csv summary.csv; echo x >&2; exit 1"});
  std::ostringstream log;
  run_cases(cases, options_for(folder), log);
  const RunSummary &result = cases[0].result;
  CHECK(result.status == "failed");
  CHECK(result.reason == "inverted cell");
  CHECK(result.message == summary.message);
  CHECK(result.stage == "shear");
  CHECK(result.load_factor == 0.35);
  CHECK(result.steps == 18);
  CHECK(result.newton_iterations == 77);
  CHECK(result.cuts == 5);
  CHECK(result.n_unknowns == 500);
}



TEST_CASE("Finished cases are known by their parameters and not run again",
          "[study]")
{
  const fs::path     folder  = make_study("resume");
  SweepOptions       options = options_for(folder);
  std::ostringstream log;
  auto first = make_cases({"true", "exit 1", "kill -KILL $$", "exit 2"});
  run_cases(first, options, log);

  // Another order and more cases: folders stay with the parameters; what
  // crashed is tried again, what failed by itself is not.
  auto second = make_cases({"kill -KILL $$",
                            "exit 1",
                            "true # more",
                            "true",
                            "exit 2",
                            "true # more"});
  run_cases(second, options, log);
  CHECK(second[3].folder == first[0].folder);
  CHECK(second[1].folder == first[1].folder);
  CHECK(second[5].folder == second[2].folder); // equal cases are one run
  CHECK(n_starts(folder, second[0]) == 2);
  CHECK(n_starts(folder, second[1]) == 1);
  CHECK(n_starts(folder, second[2]) == 1);
  CHECK(n_starts(folder, second[3]) == 1);
  CHECK(n_starts(folder, second[4]) == 1);
  CHECK(second[2].result.status == "done");
  CHECK(second[1].result.status == "failed");

  // Comments and blank lines say nothing about the run.
  auto reworded              = make_cases({"true"});
  reworded[0].parameters     = "# a new help text\n\n  # another\ntrue\n";
  const std::string &folder0 = first[0].folder;
  run_cases(reworded, options, log);
  CHECK(reworded[0].folder == folder0);
  CHECK(n_starts(folder, reworded[0]) == 1);

  // A run interrupted before its result was written is run again.
  fs::remove(folder / first[0].folder / "result.csv");
  options.repeat = false;
  run_cases(first, options, log);
  CHECK(n_starts(folder, first[0]) == 2);
  CHECK(n_starts(folder, first[1]) == 1);

  options.repeat = true;
  run_cases(first, options, log);
  CHECK(n_starts(folder, first[0]) == 3);
  CHECK(n_starts(folder, first[1]) == 2);
}



TEST_CASE("A case that ran out of time is run again if it gets more", "[study]")
{
  const fs::path     folder  = make_study("more_time");
  SweepOptions       options = options_for(folder);
  std::ostringstream log;
  options.cpu_limit = 1;
  auto cases        = make_cases({"while :; do :; done"});
  run_cases(cases, options, log);
  run_cases(cases, options, log);
  CHECK(n_starts(folder, cases[0]) == 1);
  options.cpu_limit = 3;
  run_cases(cases, options, log);
  CHECK(n_starts(folder, cases[0]) == 2);
}



TEST_CASE("A stability map has one row per cell and names each outcome",
          "[study]")
{
  const fs::path       folder = make_study("map");
  std::vector<MapCell> cells(4);
  for (unsigned int i = 0; i < 4; ++i)
    {
      cells[i].x                        = i % 2;
      cells[i].y                        = i / 2;
      cells[i].result.status            = i < 2 ? "done" : "failed";
      cells[i].result.stage             = i < 3 ? "shear" : "weave";
      cells[i].result.reason            = i < 2 ? "" : "inverted cell";
      cells[i].result.load_factor       = i < 2 ? 1 : 0.29;
      cells[i].result.cuts              = i;
      cells[i].result.steps             = 10;
      cells[i].result.newton_iterations = 35;
    }
  write_stability_map(folder.string(),
                      {"Normal penalty", {"10", "100"}},
                      {"Initial step", {"0.1", "0.2"}},
                      {"mortar"},
                      cells,
                      "shear",
                      "made up");
  const Table table = read_table((folder / "map.csv").string());
  CHECK(table.text_column("outcome") ==
        std::vector<std::string>{"done, no cuts",
                                 "done, with cuts",
                                 "inverted cell",
                                 "inverted cell"});
  CHECK(table.text_column("text")[2] == "29%");
  CHECK(table.text_column("text")[3] == "weave");
  CHECK(table.column("iterations_per_step")[0] == 3.5);
  CHECK(table.text_column("Normal penalty")[3] == "100");
  CHECK(table.text_column("Initial step")[3] == "0.2");
}



TEST_CASE("A study that is interrupted ends its cases and goes on with them",
          "[study]")
{
  const fs::path folder  = make_study("interrupted");
  SweepOptions   options = options_for(folder);
  // The first start waits for a signal and says that it came.
  auto cases = make_cases(
    {"echo $4 >> options; [ -e told ] && exit 0; trap 'echo x > told; trap - "
     "TERM; kill -TERM $$' TERM; kill -TERM $PPID; while :; do sleep 0.1; done",
     "exit 0"});
  options.side_by_side = 1;
  std::ostringstream log;
  {
    const Interruption interruption;
    try
      {
        run_cases(cases, options, log);
        FAIL("The study was not interrupted.");
      }
    catch (const StageFailed &failure)
      {
        CHECK(failure.reason() == "interrupted");
      }
  }
  CHECK(fs::exists(folder / "cases" / "0001" / "told"));
  CHECK_FALSE(fs::exists(folder / "cases" / "0001" / "result.csv"));
  CHECK_FALSE(fs::exists(folder / "cases" / "0002" / "started"));

  options.continues = true;
  run_cases(cases, options, log);
  CHECK(cases[0].result.status == "done");
  CHECK(cases[1].result.status == "done");
  std::ifstream given(folder / "cases" / "0001" / "options");
  std::string   first, second;
  std::getline(given, first);
  std::getline(given, second);
  CHECK(first.empty());
  CHECK(second == "--continue");
}



TEST_CASE("Of a case that was killed the curve says how far it came", "[study]")
{
  const fs::path     folder = make_study("killed");
  auto               cases  = make_cases({"kill -KILL $$"});
  std::ostringstream log;
  // What a run had written by then.
  fs::create_directories(folder / "cases" / "0001");
  std::ofstream(folder / "cases" / "0001" / "case.prm") << cases[0].parameters;
  RunSummary summary;
  summary.status = "running";
  write_run_summary((folder / "cases" / "0001" / "summary.csv").string(),
                    summary);
  CurveRow row;
  row.step        = 1;
  row.stage       = "weave";
  row.load_factor = 0.5;
  CurveWriter((folder / "cases" / "0001" / "curves.csv").string()).write(row);

  SweepOptions options = options_for(folder);
  options.continues    = true; // which leaves these files
  run_cases(cases, options, log);
  CHECK(cases[0].result.status == "crashed");
  CHECK(cases[0].result.stage == "weave");
  CHECK(cases[0].result.load_factor == 0.5);
  CHECK(cases[0].result.steps == 1);
}
