// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the programs have in common: from the command line to the exit
// status.

#ifndef npt_dealii_base_program_h
#define npt_dealii_base_program_h

#include <npt_dealii/base/parameter_text.h>

#include <functional>
#include <string>
#include <vector>

namespace NPT
{
  struct Program
  {
    std::string name; ///< in front of messages
    std::string help; ///< of --help

    /// What a file without the entry "Problem" means; empty: such a file is an
    /// error.
    std::string default_problem;

    /// Problems that another program computes, which is started for them; it
    /// stands in the same folder.
    std::string              other_program;
    std::vector<std::string> other_problems;

    /// Exchange with TexGen, for its options; none: the program has no such
    /// options. Both write to the screen.
    std::function<void(const std::string &texgen_file)> from_texgen;
    std::function<void(const ParameterText            &text,
                       const std::vector<std::string> &overrides)>
      to_texgen;

    /// Reads a data sheet and writes a parameter file to the screen, or a form
    /// if the name is empty; none: the program has no such option.
    std::function<void(const std::string              &sheet,
                       const std::vector<std::string> &overrides)>
      from_data_sheet;
  };

  /**
   * Read the command line and the parameter file, run the registered problem
   * that the file names, and report.
   *
   * @param before_computing Called with @p argv if something will be computed,
   *   before MPI is initialized; it may start the program anew.
   *
   * MPI is initialized only for what computes. Of several processes one says
   * what is wrong; what one of them meets alone ends all.
   *
   * @return Exit status: 0 done, 1 the run ended early or missed a tolerance, 2
   *   the input cannot be used, 3 an unexpected error, 4 a file cannot be
   *   written. Messages go to standard error; SIGPIPE is ignored from here on.
   */
  int
  run_program(const Program                      &program,
              const int                           argc,
              char                              **argv,
              const std::function<void(char **)> &before_computing);
} // namespace NPT

#endif
