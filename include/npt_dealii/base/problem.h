// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a program knows of a problem: its name, its text, and how it is
// run from a parameter file.

#ifndef npt_dealii_base_problem_h
#define npt_dealii_base_problem_h

#include <npt_dealii/base/command_line.h>
#include <npt_dealii/base/parameter_text.h>
#include <npt_dealii/base/ranks.h>
#include <npt_dealii/base/registry.h>

#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * A value of the entry "Problem". Each problem registers itself in its own
   * room, at the end of the file that runs it:
   *
   * @code
   *   namespace
   *   {
   *     const Registry<Problem>::Registration
   *       registration("plate test",
   *                    {0, "numerical plate testing of a woven cell", start});
   *   }
   * @endcode
   */
  struct Problem
  {
    /// Place in lists of problems; equal ranks are sorted by name.
    unsigned int rank = 100;

    /// What it does, as a part of the sentence "What the program does: ...".
    std::string text;

    /**
     * Read the parameters and do what the command line asks for: run, validate,
     * print defaults, and geometry if has_geometry. Throws InputError before
     * anything is computed, StageFailed if the run ends early.
     */
    std::function<void(const ParameterText &, const CommandLine &)> start;

    /// Whether there is something that --geometry-only can show.
    bool has_geometry = false;

    /// Whether several processes share its work. Otherwise all would compute
    /// the same and write into one folder.
    bool runs_in_parallel = false;

    /// Whether one process alone needs MPI to compute: the solver MUMPS does.
    /// Several processes always have it, and none that only reads.
    bool needs_mpi = true;

    /// Whether --continue means something.
    bool can_continue = false;

    /// Name of the problem that runs instead for this file, or empty: a plate
    /// test with a wanted accuracy is many plate tests.
    std::function<std::string(const ParameterText &, const CommandLine &)>
      becomes = {};

    /// Whether a file may name it.
    bool is_listed = true;
  };



  /// Print or check the parameters if that is all that was asked for; returns
  /// whether it was.
  /// @param remarks Sentences that a run would have in its log as warnings.
  template <typename Parameters>
  bool
  done_with_parameters(const CommandLine              &command,
                       const Parameters               &parameters,
                       const std::vector<std::string> &remarks = {})
  {
    if (command.action == CommandLine::Action::print_defaults)
      std::cout << parameters.used_file;
    else if (command.action == CommandLine::Action::validate)
      {
        for (const std::string &remark : remarks)
          std::cout << "Warning: " << remark << '\n';
        std::cout << command.parameter_file << " is valid." << std::endl;
      }
    else
      return false;
    return true;
  }

  /// The directory of the command line, or else the one of the parameters;
  /// created if missing. Empty on all processes but the first. Throws
  /// InputError if that is impossible.
  std::string
  make_output_directory(const CommandLine &command,
                        const std::string &of_parameters,
                        const Ranks       &ranks = {});

  /// From now on only the first process shows anything on the screen.
  void
  silence_all_but_first(const Ranks &ranks);
} // namespace NPT

#endif
