// SPDX-License-Identifier: LGPL-2.1-or-later
// What all problems do before they run.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem.h>

#include <filesystem>
#include <system_error>

namespace NPT
{
  std::string
  make_output_directory(const CommandLine &command,
                        const std::string &of_parameters)
  {
    const std::string directory = command.output_directory.empty() ?
                                    of_parameters :
                                    command.output_directory;
    std::error_code   error;
    std::filesystem::create_directories(directory, error);
    if (!std::filesystem::is_directory(directory))
      throw InputError("The output directory '" + directory +
                       "' cannot be created: " + error.message() + ".");
    return directory;
  }
} // namespace NPT
