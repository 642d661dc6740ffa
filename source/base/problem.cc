// SPDX-License-Identifier: LGPL-2.1-or-later
// What all problems do before they run.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem.h>

#include <filesystem>
#include <iostream>
#include <system_error>

namespace NPT
{
  std::string
  make_output_directory(const CommandLine &command,
                        const std::string &of_parameters,
                        const Ranks       &ranks)
  {
    const std::string directory = command.output_directory.empty() ?
                                    of_parameters :
                                    command.output_directory;
    std::string       obstacle;
    if (ranks.is_first())
      {
        std::error_code error;
        std::filesystem::create_directories(directory, error);
        std::error_code other; // may say no more than that it is not known
        if (!std::filesystem::is_directory(directory, other))
          obstacle =
            "The output directory '" + directory +
            "' cannot be created: " + (error ? error : other).message() + ".";
      }
    obstacle = ranks.broadcast(obstacle);
    if (!obstacle.empty())
      throw InputError(obstacle);
    return ranks.is_first() ? directory : "";
  }



  void
  silence_all_but_first(const Ranks &ranks)
  {
    if (!ranks.is_first())
      {
        std::cout.rdbuf(nullptr);
        std::cerr.rdbuf(nullptr);
      }
  }
} // namespace NPT
