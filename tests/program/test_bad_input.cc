// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about broken parameter files: each file of tests/data/bad_input is
// refused with the message in its head, by reading and by the program.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <functional>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
namespace fs = std::filesystem;

namespace
{
  const fs::path folder = fs::path(NPT_SOURCE_DIR) / "tests/data/bad_input";

  std::vector<fs::path>
  broken_files()
  {
    std::vector<fs::path> files;
    for (const auto &entry : fs::directory_iterator(folder))
      if (entry.path().extension() == ".prm")
        files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  /// The comment lines behind "# Expected message:", joined by blanks.
  std::string
  expected_message(const fs::path &file)
  {
    std::ifstream in(file);
    std::string   line, message;
    bool          inside = false;
    while (std::getline(in, line))
      if (line == "# Expected message:")
        inside = true;
      else if (inside && line.compare(0, 2, "# ") == 0)
        message += (message.empty() ? "" : " ") + line.substr(2);
      else if (inside)
        break;
    return message;
  }

  std::string
  message_of(const std::function<void()> &action)
  {
    try
      {
        action();
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "no InputError";
  }

  std::string
  without_folder(std::string text)
  {
    const std::string prefix = folder.string() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos;
         at             = text.find(prefix))
      text.erase(at, prefix.size());
    return text;
  }
} // namespace



TEST_CASE("Every broken parameter file is refused with its own sentence",
          "[top]")
{
  const auto files = broken_files();
  REQUIRE(files.size() >= 20);
  for (const fs::path &file : files)
    {
      // Which problem it is, is decided by the program before.
      if (file.filename() == "problem_unknown.prm")
        continue;
      INFO(file.filename().string());
      const std::string expected = expected_message(file);
      CHECK_FALSE(expected.empty());
      // Names of included files are relative to the file, so they are found
      // from any folder; messages say which.
      const std::string message = message_of([&]() {
        PlateTestParameters::read(read_parameter_text(file.string()));
      });
      if (file.filename() == "include_missing.prm")
        CHECK_THAT(message, Catch::EndsWith("did you mean 'shear.prm'?"));
      else
        CHECK(without_folder(message) == expected);
    }
}



TEST_CASE("The program refuses a broken file with exit status 2 before it "
          "makes a folder",
          "[top]")
{
  // Of each kind (the first word of the name) one file: a start takes 0.3 s.
  std::string last_kind;
  for (const fs::path &file : broken_files())
    {
      const std::string name = file.filename().string();
      const std::string kind = name.substr(0, name.find('_'));
      if (kind == last_kind)
        continue;
      last_kind = kind;
      INFO(name);
      const fs::path work = fresh_folder("bad_input");
      fs::copy_file(file, work / name);
      const ProgramResult result =
        run_program(work, {name, "--output", "results"});
      CHECK(result.status == 2);
      CHECK(result.err == "npt_dealii: " + expected_message(file) + "\n");
      CHECK(result.out.empty());
      CHECK_FALSE(fs::exists(work / "results"));
      CHECK_FALSE(fs::exists(work / "output"));
    }
}



TEST_CASE("A mistake in an override is refused like one in the file", "[top]")
{
  const std::string good    = NPT_SOURCE_DIR "/prm/shear.prm";
  const auto        message = [&](const std::string &override_text) {
    return message_of([&]() {
      PlateTestParameters::read(read_parameter_text(good),
                                {"Cell/Type=sub-unit cell", override_text});
    });
  };
  CHECK(message("Friction/Friction coefficient=-1") ==
        "--set 'Friction/Friction coefficient=-1': entry 'Friction "
        "coefficient' in subsection 'Friction' is '-1'; it must be a number "
        ">= 0");
  CHECK(message("Friction/Coefficient=0.1") ==
        "--set 'Friction/Coefficient=0.1': unknown entry 'Coefficient' in "
        "subsection 'Friction'; did you mean 'Friction coefficient'?");
  CHECK(message("Load programme/Stage shear/Targets=H5: 0.1") ==
        "Stage shear prescribes H5, which the sub-unit cell cannot represent: "
        "its glide plane along Y1 turns this mode into its opposite, so that "
        "the cell would rotate instead of deforming; only H1, H2 and H3 are "
        "allowed (subsection Stage shear).");
  // A stage list on the command line declares its stages, and others of the
  // file are not used.
  const auto parameters = PlateTestParameters::read(
    read_parameter_text(good),
    {"Load programme/Stages=weave, release, tension"});
  CHECK(parameters.load_programme.stages.back().name == "tension");
  REQUIRE(parameters.remarks.size() == 1);
  CHECK_THAT(parameters.remarks[0],
             Catch::Contains("subsection 'Stage shear' is not used, because "
                             "Stages no longer names it"));
}



TEST_CASE("Without the right file the program says where it looked", "[top]")
{
  const fs::path work = fresh_folder("missing");
  CHECK(message_of([&]() {
          PlateTestParameters::read(
            read_parameter_text(NPT_SOURCE_DIR "/prm/sheer.prm"));
        }) == "file '" NPT_SOURCE_DIR
              "/prm/sheer.prm' not found; did you mean 'shear.prm'?");
  const ProgramResult result = run_program(work, {"sheer.prm"});
  CHECK(result.status == 2);
  CHECK(result.err == "npt_dealii: file 'sheer.prm' not found; that folder "
                      "contains no .prm file\n");
  CHECK_FALSE(fs::exists(work / "output"));
}



TEST_CASE("A file of any problem may come from a pipe", "[top]")
{
  // The second problem is computed by another program, which finds the pipe
  // empty.
  const fs::path work = fresh_folder("pipe");
  for (const std::string file : {"shear.prm", "verification/cylinder.prm"})
    {
      INFO(file);
      const std::string command =
        "cd '" + work.string() + "' && cat '" NPT_SOURCE_DIR "/prm/" + file +
        "' | '" NPT_PROGRAM "' /dev/stdin --validate > out.txt 2> err.txt";
      CHECK(std::system(command.c_str()) == 0);
      CHECK_THAT(read_text(work / "out.txt"), Catch::EndsWith("is valid.\n"));
      CHECK(read_text(work / "err.txt").empty());
    }
}
