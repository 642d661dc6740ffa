// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the files that the fuzzer changes, and how the program reads them.

#ifndef npt_dealii_tests_fuzz_seeds_h
#define npt_dealii_tests_fuzz_seeds_h

#include <filesystem>
#include <string>
#include <vector>

#include "isolated_run.h"

namespace Fuzz
{
  enum class Kind
  {
    parameters,
    table,          ///< any CSV file
    material_table, ///< test data of an identification
    texgen,
    data_sheet
  };

  struct Seed
  {
    Kind                  kind;
    std::filesystem::path folder; ///< of its copy
    std::string           name, text;
    std::string           shown; ///< what the program shows of it
  };

  /// Run the program with these arguments in a folder.
  RunResult
  run_program_in(const std::filesystem::path    &folder,
                 const std::vector<std::string> &arguments);

  /// Have a file read and shown: `--print-defaults` of a parameter file, the
  /// columns of a table, the parameter file of a weave or a data sheet.
  RunResult
  show(Kind kind, const std::filesystem::path &folder, const std::string &name);

  /**
   * Copy the files of the project into @p work and read them: prm/ with its
   * data sheets, the curves and other data of the tests, and weaves that the
   * program itself writes.
   *
   * @param more Further files, by their extension.
   *
   * Throws std::runtime_error if the program does not read one as it stands.
   */
  std::vector<Seed>
  make_seeds(const std::filesystem::path    &source,
             const std::filesystem::path    &work,
             const std::vector<std::string> &more);
} // namespace Fuzz

#endif
