// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines running the programs as a user does and collecting what it says.

#ifndef npt_dealii_tests_run_program_h
#define npt_dealii_tests_run_program_h

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace TopTests
{
  inline std::string
  read_text(const std::filesystem::path &path)
  {
    std::ifstream     in(path, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    return content.str();
  }



  /// A folder of its own for each test case, empty at the start.
  inline std::filesystem::path
  fresh_folder(const std::string &name)
  {
    const auto folder =
      std::filesystem::path(NPT_BINARY_DIR) / "test_top_files" / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
  }



  /// What the environment says to OpenBLAS ("OPENBLAS_CORETYPE=Haswell"). Its
  /// kernels, and so the last bits of a result, follow from that.
  inline std::vector<std::string>
  settings_of_openblas()
  {
    std::vector<std::string> settings;
    for (char **variable = environ; *variable != nullptr; ++variable)
      if (std::string(*variable).rfind("OPENBLAS_", 0) == 0)
        settings.emplace_back(*variable);
    return settings;
  }



  struct ProgramResult
  {
    int         status; ///< exit status, -1 if it crashed
    std::string out;
    std::string err;
  };



  /// Run a program in a folder, which also receives what it writes on the
  /// screen (out.txt, err.txt).
  inline ProgramResult
  run_program(const std::filesystem::path    &folder,
              const std::vector<std::string> &arguments,
              const std::string              &program = NPT_PROGRAM)
  {
    const auto quoted = [](const std::string &text) {
      std::string result = "'";
      for (const char c : text)
        result += c == '\'' ? std::string("'\\''") : std::string(1, c);
      return result + "'";
    };
    std::string command =
      "cd " + quoted(folder.string()) + " && " + quoted(program);
    for (const std::string &argument : arguments)
      command += " " + quoted(argument);
    command += " > out.txt 2> err.txt";

    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1,
            read_text(folder / "out.txt"),
            read_text(folder / "err.txt")};
  }
} // namespace TopTests

#endif
