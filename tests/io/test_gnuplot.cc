// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about calling gnuplot: whatever it does, the run goes on.

#include <npt_dealii/io/gnuplot.h>

#include <catch2/catch.hpp>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

using namespace NPT;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  /// A gnuplot made of shell commands, before all others, for a test case.
  class GnuplotOfShell
  {
  public:
    explicit GnuplotOfShell(const std::string &commands)
      : folder(fs::path(NPT_BINARY_DIR) / "test_gnuplot_files")
      , path_before(std::getenv("PATH"))
    {
      fs::remove_all(folder);
      fs::create_directories(folder);
      std::ofstream(folder / "gnuplot") << "#!/bin/sh\n" << commands;
      fs::permissions(folder / "gnuplot", fs::perms::owner_all);
      setenv("PATH", (folder.string() + ":" + path_before).c_str(), 1);
    }

    ~GnuplotOfShell()
    {
      setenv("PATH", path_before.c_str(), 1);
    }

    const fs::path folder;

  private:
    const std::string path_before;
  };
} // namespace



TEST_CASE("A gnuplot that hangs is ended with all that it has started, and the "
          "warning says so",
          "[io]")
{
  const GnuplotOfShell hanging(
    "(sleep 3; touch too_late) & wait; touch too_late\n");
  using Clock      = std::chrono::steady_clock;
  const auto start = Clock::now();
  CHECK_THAT(run_gnuplot(hanging.folder.string(), {"a.gp", "b.gp"}, 0.1),
             Contains("gnuplot had not drawn") && Contains("a.gp, ") &&
               Contains("b.gp after 0.1 s and was ended"));
  CHECK(std::chrono::duration<double>(Clock::now() - start).count() < 3);
  CHECK(std::system("sleep 3.2") == 0);
  CHECK_FALSE(fs::exists(hanging.folder / "too_late"));
}



TEST_CASE("What gnuplot answers is told apart", "[io]")
{
  {
    const GnuplotOfShell good("cat > read.txt; echo $* > scripts.txt\n");
    CHECK(run_gnuplot((good.folder / "it's a.gp").string()).empty());
    std::string line;
    std::ifstream(good.folder / "scripts.txt") >> line;
    CHECK(line == "it's");
    // It cannot wait for somebody who types.
    CHECK(fs::file_size(good.folder / "read.txt") == 0);
  }
  {
    const GnuplotOfShell bad("echo words; exit 1\n");
    CHECK_THAT(run_gnuplot((bad.folder / "a.gp").string()),
               Contains("gnuplot failed on") && Contains("a.gp"));
  }
  {
    const GnuplotOfShell crashing("kill -SEGV $$\n");
    CHECK_THAT(run_gnuplot((crashing.folder / "a.gp").string()),
               Contains("gnuplot failed on"));
  }
}



TEST_CASE("A picture that is drawn after another one has nothing of it", "[io]")
{
  const fs::path folder = fs::path(NPT_BINARY_DIR) / "test_gnuplot_files";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto write = [&](const std::string &name, const std::string &settings) {
    write_gnuplot_script((folder / (name + ".gp")).string(),
                         {name, 200, 100, 1, 1, "", settings},
                         [](std::ostream &out) { out << "plot x\n"; });
  };
  write("first", "set title 'contact'; set xlabel 'of the first'");
  write("second", "");
  const auto picture = [&]() {
    std::ifstream     in(folder / "second.svg");
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  };
  if (!run_gnuplot((folder / "second.gp").string()).empty())
    {
      WARN("gnuplot is not installed");
      return;
    }
  const std::string alone = picture();
  REQUIRE(alone.size() > 100);
  CHECK(run_gnuplot(folder.string(), {"first.gp", "second.gp"}).empty());
  CHECK(picture() == alone);
}
