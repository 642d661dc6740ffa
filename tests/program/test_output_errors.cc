// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the program where files cannot be written, where somebody else
// writes, and where it goes on.

#include <catch2/catch.hpp>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <set>

#include "run_program.h"

using namespace TopTests;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  // Loading, unloading and loading again, so that there is a hysteresis.
  std::vector<std::string>
  arguments(const std::vector<std::string> &more = {})
  {
    std::vector<std::string> all = {
      NPT_SOURCE_DIR "/prm/shear.prm",
      "--set=Mesh/Elements along=3",
      "--set=Mesh/Elements across=3",
      "--set=Mesh/Elements through=1",
      "--set=Cell/Weaving depth=0.5",
      "--set=Load programme/Stages=weave, release, shear, back, again",
      "--set=Load programme/Stage shear/Targets=H3: 0.02",
      "--set=Load programme/Stage back/Targets=H3: -0.02",
      "--set=Load programme/Stage again/Targets=H3: 0.02"};
    for (const std::string stage : {"shear", "back", "again"})
      for (const std::string step : {"Initial", "Maximum"})
        all.push_back("--set=Load programme/Stage " + stage + "/" + step +
                      " step=0.5");
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }

  std::set<std::string>
  names_in(const fs::path &directory)
  {
    std::set<std::string> names;
    for (const auto &entry : fs::directory_iterator(directory))
      names.insert(entry.path().filename().string());
    return names;
  }

  /// What a run says that it has written, and the list itself.
  std::set<std::string>
  listed_in(const fs::path &list)
  {
    std::set<std::string> names = {list.filename().string()};
    std::ifstream         in(list);
    for (std::string line; std::getline(in, line);)
      if (!line.empty() && line[0] != '#')
        names.insert(line);
    return names;
  }
} // namespace



TEST_CASE("Every file that cannot be written is named, with status 4", "[top]")
{
  const fs::path work = fresh_folder("full_disk");
  REQUIRE(run_program(work, arguments()).status == 0);
  const std::set<std::string> files = names_in(work / "output");
  CHECK(files.count("hysteresis.csv") == 1);
  CHECK(files.count("checkpoint.bin") == 1);
  CHECK(files == listed_in(work / "output" / "files.txt"));
  for (const std::string &name : files)
    {
      // One picture of a cell is as good as the next.
      const std::string extension = fs::path(name).extension().string();
      if ((extension == ".svg" || extension == ".png") &&
          name.compare(0, 5, "cell_") == 0 && name != "cell_shear.svg")
        continue;
      INFO(name);
      fs::remove_all(work / "output");
      fs::create_directories(work / "output");
      // Behind the file, and behind what becomes it.
      for (const std::string &link : {name, name + ".part"})
        fs::create_symlink("/dev/full", work / "output" / link);
      const ProgramResult result = run_program(work, arguments());
      CHECK(result.status == 4);
      CHECK_THAT(result.err,
                 Contains("output/" + name) &&
                   Contains("cannot be written: No space left on device."));
      CHECK_THAT(result.err, !Contains("unexpected"));
    }
}



TEST_CASE("A quota is told like a full disk", "[top]")
{
  const fs::path work = fresh_folder("quota");
  // The first two end within files.txt, which the system then takes in part.
  for (const unsigned int bytes : {0, 50, 512, 4096, 16384})
    {
      INFO(bytes);
      std::string command = "cd '" + work.string() +
                            "' && prlimit --fsize=" + std::to_string(bytes) +
                            " '" NPT_PROGRAM "'";
      for (const std::string &argument : arguments())
        command += " '" + argument + "'";
      // The limit does not hold for a pipe.
      command += " 2>&1 > /dev/null";
      FILE *const pipe = popen(command.c_str(), "r");
      REQUIRE(pipe != nullptr);
      std::string said;
      for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe))
        said += static_cast<char>(c);
      pclose(pipe);
      CHECK_THAT(said, Catch::EndsWith("cannot be written: File too large.\n"));
      CHECK(std::count(said.begin(), said.end(), '\n') == 1);
    }
}



TEST_CASE("A folder that cannot be written is told before anything is computed",
          "[top]")
{
  const fs::path work = fresh_folder("read_only");
  fs::create_directories(work / "output");
  // Nobody can make a file in this one; permissions do not stop root.
  const std::string output = geteuid() == 0 ? "/proc/self" : "output";
  fs::permissions(work / "output",
                  fs::perms::owner_read | fs::perms::owner_exec);
  const ProgramResult result =
    run_program(work, arguments({"--output", output}));
  fs::permissions(work / "output", fs::perms::owner_all);
  CHECK(result.status == 4);
  CHECK_THAT(result.err,
             Contains("'" + output + "/files.txt' cannot be written: "));
  CHECK(result.out.empty());
}



TEST_CASE("A reader who leaves does not end the run", "[top]")
{
  const fs::path work    = fresh_folder("head");
  std::string    command = "cd '" + work.string() + "' && { '" NPT_PROGRAM "'";
  for (const std::string &argument : arguments({"--set=Output/Picture=false"}))
    command += " '" + argument + "'";
  command += "; echo $? > status; } | true";
  CHECK(std::system(command.c_str()) == 0);
  CHECK(read_text(work / "status") == "0\n");
  CHECK_THAT(read_text(work / "output" / "summary.csv"), Contains("done"));
}



TEST_CASE("A second run does not get into the folder of the first", "[top]")
{
  const fs::path work = fresh_folder("in_use");
  fs::create_directories(work / "output");
  const int list = open((work / "output" / "files.txt").c_str(),
                        O_RDWR | O_CREAT | O_CLOEXEC,
                        0644);
  REQUIRE(list >= 0);
  REQUIRE(flock(list, LOCK_EX | LOCK_NB) == 0);
  const ProgramResult result = run_program(work, arguments());
  close(list);
  CHECK(result.status == 2);
  CHECK_THAT(result.err, Contains("'output' is in use by another run"));
  CHECK(names_in(work / "output") == std::set<std::string>{"files.txt"});
}



TEST_CASE("A folder has the files of its last run, and those of others",
          "[top]")
{
  const fs::path work = fresh_folder("clean");
  REQUIRE(run_program(work, arguments({"--set=Output/Fields=steps"})).status ==
          0);
  std::ofstream(work / "output" / "notes.txt") << "mine";
  REQUIRE(run_program(work,
                      arguments({"--set=Output/Fields=none",
                                 "--set=Output/Picture=false"}))
            .status == 0);
  const std::set<std::string> files = names_in(work / "output");
  CHECK(files.count("notes.txt") == 1);
  CHECK(files.count("curves.csv") == 1);
  for (const std::string gone :
       {"fields.pvd", "curves.svg", "cell_shear.svg", "bundles-0001.vtu"})
    {
      INFO(gone);
      CHECK(files.count(gone) == 0);
    }
}



TEST_CASE("What cannot go on says so", "[top]")
{
  const fs::path work = fresh_folder("continue");
  // Without a checkpoint the run begins.
  const ProgramResult first = run_program(work, arguments({"--continue"}));
  CHECK(first.status == 0);
  CHECK_THAT(first.out, Contains("There is no checkpoint"));
  const std::string curve = read_text(work / "output" / "curves.csv");

  const ProgramResult again = run_program(work, arguments({"--continue"}));
  CHECK(again.status == 0);
  CHECK(read_text(work / "output" / "curves.csv") == curve);
  CHECK_THAT(read_text(work / "output" / "log.txt"),
             Contains("The run goes on behind step"));

  const ProgramResult other = run_program(
    work, arguments({"--continue", "--set=Friction/Friction coefficient=0.1"}));
  CHECK(other.status == 2);
  CHECK_THAT(other.err,
             Contains("output/checkpoint.bin") &&
               Contains("Friction coefficient = 0.1 instead of"));
  CHECK(read_text(work / "output" / "curves.csv") == curve);

  const ProgramResult no_test =
    run_program(work, {NPT_SOURCE_DIR "/prm/nmt.prm", "--continue"});
  CHECK(no_test.status == 2);
  CHECK_THAT(no_test.err, Contains("Problem is material test"));
}
