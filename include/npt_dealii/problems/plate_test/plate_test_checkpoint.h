// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a plate test must remember to go on as if it had never been
// stopped, and how that is kept on disk.

#ifndef npt_dealii_problems_plate_test_plate_test_checkpoint_h
#define npt_dealii_problems_plate_test_plate_test_checkpoint_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>
#include <npt_dealii/problems/plate_test/plate_test_results.h>

#include <deal.II/base/point.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace NPT
{
  /// Name of the checkpoint in the folder of a plate test.
  inline const std::string checkpoint_name = "checkpoint.bin";

  /// Where a stage has ended, for others that begin there.
  struct StageEnd
  {
    State                         state;
    std::vector<dealii::Point<3>> woven;
  };

  /**
   * A plate test behind an accepted load step; a value. What it does not hold
   * is made anew from the parameters: the cell, the equations of the stage.
   */
  struct PlateTestCheckpoint
  {
    /// PlateTestParameters::used_file, and what the program chose by itself.
    std::string parameters, choices;
    /// Elements of the mesh on which it weaves first, if that is where the test
    /// is; empty: its own mesh.
    std::string coarser_mesh;

    unsigned int                  stage = 0;   ///< the present one
    State                         stage_start; ///< PlateTestStage's `before`
    std::vector<dealii::Point<3>> start_woven; ///< and its `woven`
    StageMemory                   memory;      ///< the last accepted step
    std::vector<dealii::Point<3>> woven;       ///< behind that step
    std::string                   not_elliptic_in;
    double                        overlap_warned_of = 0; ///< [mm]

    /// Ends of earlier stages, by name: of those that others name as their
    /// Start, and of those that finish the fabric, for tests that are added.
    std::map<std::string, StageEnd> ends;

    /// What decides the round-off of the next steps, of a run on one process:
    /// the pattern of the matrix and how it is factorized.
    bool                                has_pattern = false;
    std::set<std::vector<unsigned int>> couplings;
    LinearSolverMemory                  solver_memory;

    PlateTestResults::Memory results;
    std::vector<std::string> files; ///< of the folder, OutputFolder::files()
  };

  /// Throws OutputError.
  void
  write_checkpoint(const std::string         &filename,
                   const PlateTestCheckpoint &checkpoint);

  /**
   * The checkpoint that the first process finds, on all processes; nothing if
   * there is none. Throws InputError on all of them if it cannot be read or is
   * of another test, see check_fit().
   *
   * @param directory Empty on all processes but the first.
   */
  std::optional<PlateTestCheckpoint>
  read_checkpoint(const std::string         &directory,
                  const PlateTestParameters &parameters,
                  const Ranks               &ranks);

  /**
   * Compare the parameters of a checkpoint with those of the run that would go
   * on with it. Newton's method, the linear solver, stability, output and
   * checkpoints may differ, and the stages behind the present one, too.
   *
   * @return The entries that differ, for the log.
   *
   * Throws InputError for any other difference, with the entry and its values.
   */
  std::vector<std::string>
  check_fit(const std::string         &filename,
            const PlateTestCheckpoint &checkpoint,
            const PlateTestParameters &parameters);

  /// What the program decided for these parameters and cannot be changed any
  /// more: the type of the cell, side contact, smooth closure.
  std::string
  choices_of_program(const PlateTestParameters &parameters);
} // namespace NPT

#endif
