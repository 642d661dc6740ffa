// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about files that cannot be written, and about the folder of a run.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>

#include <catch2/catch.hpp>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

using namespace NPT;
using Catch::Contains;
namespace fs = std::filesystem;

namespace
{
  /// Empty at the start.
  fs::path
  fresh(const std::string &name)
  {
    const fs::path folder = fs::path(NPT_BINARY_DIR) / "test_io_files" / name;
    fs::remove_all(folder);
    fs::create_directories(folder);
    return folder;
  }

  std::string
  content(const fs::path &file)
  {
    std::ifstream     in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  void
  put(const fs::path &file, const std::string &text)
  {
    std::ofstream(file) << text;
  }

  /// Whether another process can use a folder.
  bool
  another_may_use(const fs::path &folder)
  {
    const pid_t other = fork();
    if (other == 0)
      {
        OutputFolder::leave_all();
        int status = 1;
        try
          {
            const OutputFolder mine(folder.string());
            status = 0;
          }
        catch (const InputError &)
          {
            status = 1;
          }
        _exit(status);
      }
    int status = 0;
    waitpid(other, &status, 0);
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
} // namespace



TEST_CASE("A full disk is told with the file and the reason", "[io]")
{
  const std::string reason =
    "The file '/dev/full' cannot be written: No space left on device.";
  OutputFile full("/dev/full");
  CHECK_THROWS_WITH(full.write("x"), reason);

  const fs::path    folder = fresh("full");
  const std::string name   = (folder / "table.csv").string();
  put(name, "old");
  fs::create_symlink("/dev/full", name + ".part");
  CHECK_THROWS_AS(
    replace_file(name, [](std::ostream &out) { out << std::string(1e5, 'x'); }),
    OutputError);
  CHECK(content(name) == "old");
  CHECK_FALSE(fs::exists(fs::symlink_status(name + ".part")));
}



TEST_CASE("A file is replaced when it is complete, or not at all", "[io]")
{
  const fs::path    folder = fresh("replace");
  const std::string name   = (folder / "text.txt").string();
  const std::string text(30000, 'a');
  replace_file(name, [&](std::ostream &out) {
    out << text << 1.5;
    CHECK_FALSE(fs::exists(name));
  });
  CHECK(content(name) == text + "1.5");
  CHECK_THROWS_AS(replace_file(name,
                               [](std::ostream &out) {
                                 out << "half";
                                 throw std::logic_error("bug");
                               }),
                  std::logic_error);
  CHECK(content(name) == text + "1.5");
  CHECK_FALSE(fs::exists(name + ".part"));
  CHECK_THROWS_AS(replace_file((folder / "no" / "x").string(),
                               [](std::ostream &) {}),
                  OutputError);
}



TEST_CASE("A run removes what the run before it wrote, and nothing else",
          "[io]")
{
  const fs::path folder = fresh("folder");
  put(folder / "notes.txt", "mine");
  put(folder / "curves.csv.bak", "mine as well");
  {
    const OutputFolder first(folder.string() + "/");
    OutputFile         curves((folder / "curves.csv").string());
    replace_file((folder / "fields.pvd").string(), [](std::ostream &) {});
    put(folder / "fields.pvd.part", "of a run that was killed");
    CHECK(first.files() ==
          std::vector<std::string>{"curves.csv", "fields.pvd"});
  }
  {
    OutputFolder again(folder.string(), OutputFolder::Start::add);
    CHECK(fs::exists(folder / "curves.csv"));
    again.keep_only({"curves.csv", "notes.txt"});
    CHECK(fs::exists(folder / "curves.csv"));
    CHECK_FALSE(fs::exists(folder / "fields.pvd"));
    CHECK_FALSE(fs::exists(folder / "fields.pvd.part"));
  }
  // A list that was edited does not reach out of its folder.
  put(folder.parent_path() / "outside.txt", "mine");
  std::ofstream(folder / "files.txt", std::ios::app)
    << "../outside.txt\n..\n.\n/\n\n";
  const OutputFolder last(folder.string());
  CHECK_FALSE(fs::exists(folder / "curves.csv"));
  CHECK(content(folder / "notes.txt") == "mine");
  CHECK(content(folder / "curves.csv.bak") == "mine as well");
  CHECK(fs::exists(folder.parent_path() / "outside.txt"));
  CHECK(last.files().empty());
}



TEST_CASE("Two runs cannot use one folder at a time", "[io]")
{
  const fs::path folder = fresh("lock");
  {
    const OutputFolder first(folder.string());
    CHECK(OutputFolder::is_in_use(folder.string()));
    CHECK_FALSE(another_may_use(folder));
    CHECK_THROWS_WITH(OutputFolder(folder.string()),
                      Contains("is in use by another run"));
    CHECK(OutputFolder::find(folder.string()) == &first);
  }
  CHECK_FALSE(OutputFolder::is_in_use(folder.string()));
  CHECK(another_may_use(folder));
  CHECK(OutputFolder::find(folder.string()) == nullptr);
  CHECK_THROWS_AS(OutputFolder((folder / "no").string()), OutputError);
}
