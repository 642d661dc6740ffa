// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about cases that are computed by a copy of the process of the study.
// This test program does not initialize MPI, as a study does not.

#include <npt_dealii/problems/parameter_study/case_process.h>
#include <npt_dealii/problems/parameter_study/sweep.h>

#include <catch2/catch.hpp>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <stdexcept>

#include "run_program.h"

using namespace NPT;
namespace fs = std::filesystem;

namespace
{
  // Stands for the program: does what the parameter file says.
  int
  obey(const std::vector<std::string> &arguments)
  {
    const std::string what = TopTests::read_text(arguments.at(0));
    if (what == "crash")
      std::raise(SIGSEGV);
    else if (what == "abort")
      std::abort();
    else if (what == "throw")
      throw std::runtime_error("nobody catches this");
    else if (what == "leave")
      _exit(3);
    else if (what == "end")
      std::exit(2);
    else if (what == "spin")
      for (volatile unsigned int i = 0;; i = i + 1)
        ;
    else if (what == "fail")
      {
        std::cerr << "npt_dealii: Stage given up.\n";
        return 1;
      }
    return 0;
  }

  std::vector<SweepCase>
  study_cases(const std::vector<std::string> &parameters)
  {
    std::vector<SweepCase> cases;
    for (const std::string &text : parameters)
      cases.push_back({{{"What", text}}, text, "", {}});
    return cases;
  }

  SweepOptions
  copies_in(const fs::path &folder)
  {
    SweepOptions options;
    options.directory    = folder.string();
    options.side_by_side = 2;
    options.program      = "/nonexistent";
    options.run          = obey;
    return options;
  }

  void
  handle(int)
  {}
} // namespace



TEST_CASE("A copy that crashes, throws or leaves does not end the study",
          "[study]")
{
  const fs::path folder = TopTests::fresh_folder("copies_fail");
  auto           cases  = study_cases(
    {"crash", "abort", "throw", "leave", "end", "fail", "spin", "work"});
  SweepOptions options = copies_in(folder);
  options.cpu_limit    = 1;
  std::ostringstream log;
  run_cases(cases, options, log);
  const auto reason = [&](const unsigned int c) {
    CHECK(cases[c].result.status == "crashed");
    return cases[c].result.reason;
  };
  CHECK_THAT(reason(0), Catch::Contains("egmentation"));
  CHECK_THAT(reason(1), Catch::Contains("bort"));
  CHECK_THAT(reason(2), Catch::Contains("bort"));
  CHECK(reason(3) == "unexpected error");
  CHECK(cases[4].result.status == "refused");
  CHECK(cases[5].result.status == "failed");
  CHECK(cases[5].result.message == "Stage given up. ");
  CHECK(cases[6].result.status == "time limit");
  CHECK(cases[6].result.cpu_seconds > 0.9);
  CHECK(cases[6].result.cpu_seconds < 1.3);
  CHECK(cases[7].result.status == "done");
}



TEST_CASE("A copy begins as a program started anew and leaves nothing behind",
          "[study]")
{
  const fs::path folder = TopTests::fresh_folder("copies_begin");
  // What this process has in store, and would do at its end.
  std::FILE *const unwritten =
    std::fopen((folder / "unwritten.txt").c_str(), "w");
  std::fputs("once\n", unwritten);
  static std::string at_end;
  at_end = (folder / "at_end.txt").string();
  std::atexit([]() { std::ofstream(at_end) << "the end\n"; });
  std::cout << std::hex;
  const auto interrupt = std::signal(SIGINT, handle);
  const auto user      = std::signal(SIGUSR1, SIG_IGN);

  SweepOptions options = copies_in(folder);
  options.run          = [](const std::vector<std::string> &arguments) {
    char       letter;
    const bool has_input = read(0, &letter, 1) > 0;
    std::cout << arguments.size() << ' ' << arguments[1] << ' '
              << std::getenv("OPENBLAS_NUM_THREADS") << ' ' << 10 << ' '
              << (std::signal(SIGINT, SIG_DFL) == SIG_DFL) << ' '
              << (std::signal(SIGUSR1, SIG_DFL) == SIG_IGN) << ' ' << has_input;
    std::fputs(" printed", stdout);
    return 0;
  };
  auto               cases = study_cases({"work"});
  std::ostringstream log;
  run_cases(cases, options, log);
  std::cout << std::dec;
  std::signal(SIGINT, interrupt);
  std::signal(SIGUSR1, user);
  std::fclose(unwritten);

  CHECK(cases[0].result.status == "done");
  CHECK(TopTests::read_text(folder / cases[0].folder / "screen.txt") ==
        "3 --output 1 10 1 1 0 printed");
  CHECK(TopTests::read_text(folder / "unwritten.txt") == "once\n");
  CHECK_FALSE(fs::exists(at_end));
}



TEST_CASE("A limit that no run can reach is as good as none", "[study]")
{
  SweepOptions options = copies_in(TopTests::fresh_folder("copies_no_limit"));
  options.cpu_limit    = 1e300;
  auto               cases = study_cases({"work"});
  std::ostringstream log;
  run_cases(cases, options, log);
  CHECK(cases[0].result.status == "done");
}



TEST_CASE("A copy computes case after case; what one leaves behind is not the "
          "next one's",
          "[study]")
{
  const fs::path folder  = TopTests::fresh_folder("copies_go_on");
  SweepOptions   options = copies_in(folder);
  options.side_by_side   = 1;
  options.cpu_limit      = 1;
  options.run            = [](const std::vector<std::string> &arguments) {
    static int                 n_before = 0;
    const std::string          what     = TopTests::read_text(arguments.at(0));
    const bool                 works    = what.compare(0, 4, "work") == 0;
    const std::clock_t         begin    = std::clock();
    volatile unsigned long int i        = 0;
    while (works && std::clock() - begin < 0.6 * CLOCKS_PER_SEC)
      i = i + 1;
    if (what == "crash")
      std::raise(SIGSEGV);
    std::cout << n_before++ << ' ' << std::showpos << 1;
    return what == "unwritten" ? 4 : 0;
  };
  auto cases = study_cases({"work", "work 2", "unwritten", "crash", "rest"});
  std::ostringstream log;
  run_cases(cases, options, log);
  const auto screen = [&](const unsigned int c) {
    return TopTests::read_text(folder / cases[c].folder / "screen.txt");
  };
  CHECK(screen(0) == "0 +1");
  CHECK(cases[0].result.status == "done");
  CHECK(cases[0].result.cpu_seconds > 0.55);
  // The same process; its limit and its time count from here.
  CHECK(screen(1) == "1 +1");
  CHECK(screen(2) == "2 +1");
  CHECK(cases[2].result.reason == "output");
  // A status out of the ordinary, or a crash, ends it.
  CHECK(screen(3).empty());
  CHECK_THAT(cases[3].result.reason, Catch::Contains("egmentation"));
  CHECK(screen(4) == "0 +1");
  CHECK(cases[4].result.status == "done");
  CHECK(cases[4].result.cpu_seconds < 0.3);
}
