// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the check that rooms include only what they may.

#include <catch2/catch.hpp>

#include "run_program.h"

using TopTests::fresh_folder;
using TopTests::read_text;

namespace
{
  // Exit status of scripts/check_layers on a tree, and what it prints.
  std::pair<int, std::string>
  check_layers(const std::filesystem::path &tree)
  {
    const auto report = tree / "report.txt";
    const int  status = std::system(("'" + std::string(NPT_SOURCE_DIR) +
                                    "/scripts/check_layers' '" + tree.string() +
                                    "' > '" + report.string() + "' 2>&1")
                                     .c_str());
    return {WEXITSTATUS(status), read_text(report)};
  }

  void
  write(const std::filesystem::path &file, const std::string &text)
  {
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
} // namespace



TEST_CASE("A forbidden include is found, and an allowed one is not",
          "[program]")
{
  const auto tree = fresh_folder("layers");
  write(tree / "CMakeLists.txt",
        "npt_add_room(base)\n"
        "npt_add_room(iga base)\n"
        "npt_add_room(problems/plate_test\n  iga base)\n");
  write(tree / "include/npt_dealii/base/a.h", "#include <vector>\n");
  write(tree / "include/npt_dealii/iga/b.h",
        "#include <npt_dealii/base/a.h>\n");
  write(tree / "source/problems/plate_test/c.cc",
        "#include <npt_dealii/iga/b.h>\n");
  CHECK(check_layers(tree).first == 0);

  write(tree / "source/base/a.cc",
        "#include <npt_dealii/base/a.h>\n\n#include <npt_dealii/iga/b.h>\n");
  const auto [status, report] = check_layers(tree);
  CHECK(status != 0);
  CHECK(report.find("source/base/a.cc:3: room base includes a header of room "
                    "iga") != std::string::npos);
}



TEST_CASE("A room may not depend on one that stands behind it", "[program]")
{
  const auto tree = fresh_folder("layer_order");
  write(tree / "CMakeLists.txt",
        "npt_add_room(base iga)\nnpt_add_room(iga base)\n");
  write(tree / "source/base/a.cc", "\n");
  write(tree / "include/npt_dealii/base/a.h", "\n");
  const auto [status, report] = check_layers(tree);
  CHECK(status != 0);
  CHECK(report.find("base depends on iga") != std::string::npos);
}
