// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines numerical plate testing: the whole method, from the parameter file to
// curves, in the order of run().

#ifndef npt_dealii_problems_plate_test_numerical_plate_testing_h
#define npt_dealii_problems_plate_test_numerical_plate_testing_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/problems/plate_test/contact_checks.h>
#include <npt_dealii/problems/plate_test/plate_cell.h>
#include <npt_dealii/problems/plate_test/plate_test_checkpoint.h>
#include <npt_dealii/problems/plate_test/plate_test_results.h>

#include <deal.II/base/timer.h>

#include <chrono>
#include <map>
#include <memory>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * Numerical plate test of a woven fabric with frictional contact: a cell is
   * woven, released, and driven by macroscopic stretch, shear, bending and
   * torsion; its resultants are the curve.
   *
   * The equations of a stage are those of PlateTestStage, the loop over load
   * steps is LoadStepper's. What changes during the test is a State, and only
   * by accepted steps.
   *
   * To build another kind of test, write another EquilibriumProblem or another
   * run(), as one does with a deal.II tutorial program; see doc/extending.
   */
  class NumericalPlateTesting
  {
  public:
    /**
     * @param directory Existing folder for all results; empty: write nothing
     *   (tests).
     * @param screen Where the log is shown.
     * @param ranks The processes that compute the test together; all but the
     *   first get no folder and a screen that shows nothing.
     * @param checkpoint Where to go on, the same on all processes; else the
     *   test begins at its start.
     */
    NumericalPlateTesting(const PlateTestParameters         &parameters,
                          const std::string                 &directory,
                          std::ostream                      &screen,
                          const Ranks                       &ranks      = {},
                          std::optional<PlateTestCheckpoint> checkpoint = {});

    /// The whole test. Throws StageFailed if a stage cannot be finished or the
    /// run is interrupted; all results up to there are complete on disk.
    void
    run();

    /// Show the cell without computing anything: sizes in the log; geometry.vtu
    /// (straight bundles that just touch) and images.vtu (pieces of neighboring
    /// cells that are candidates for contact) in the directory.
    void
    preview();

    /// One row per accepted step.
    const std::vector<CurveRow> &
    curve() const
    {
      return results_.curve();
    }

    /// The cell; there is one once run() or preview() has begun.
    const PlateCell &
    cell() const
    {
      return *cell_;
    }

    /// The last accepted state.
    const State &
    state() const
    {
      return state_;
    }

    /// Positions to which bending and torsion refer; empty before weaving ends.
    const std::vector<dealii::Point<3>> &
    woven_positions() const
    {
      return woven_;
    }

    /// Unknowns of Newton's method in the present stage.
    unsigned int
    n_unknowns() const
    {
      return system_.n_free();
    }

  private:
    /// Throws StageFailed if the matrix will not fit into the memory.
    void
    check_memory() const;
    void
    make_cell();
    /// Take up the checkpoint.
    void
    resume();
    void
    run_stage(const unsigned int index);
    /// Go back to where the stage begins, if that is not the present state.
    void
    go_to_start(const unsigned int index);
    /// Remember the end of a stage, if another one may begin there.
    void
    keep_end(const LoadStage &stage);
    /// The load steps of a stage, from a state on.
    void
    run_steps(const unsigned int          index,
              const State                &start,
              const StepParameters       &steps,
              const LoadStepper::Visitor &visitor);
    /// What the stage of the checkpoint had besides its equations.
    void
    resume_stage(const PlateTestStage &problem);
    /// The weave stage in one step from the woven state of a coarser mesh;
    /// false if that is not wanted or does not serve.
    bool
    weave_from_coarser_mesh();
    void
    accept_step(const LoadStage &stage, const AcceptedStep &step);
    /// Remember what the next step depends on, and write it if that is due.
    void
    keep_step(const AcceptedStep &step);
    /// Whether there is a checkpoint, and on this mesh.
    bool
    resumes() const;
    PlateTestCheckpoint
    make_checkpoint() const;
    void
    save();
    void
    warn_of_ellipticity(const LoadStage &stage, const AcceptedStep &step);
    /// Complete the results, and throw the failure of a stage again, with the
    /// state of the material and the advice for it.
    [[noreturn]] void
    give_up(const StageFailed &failure, const unsigned int index);

    const PlateTestParameters  parameters_;
    const Ranks                ranks_;
    RunLog                     log_;
    dealii::TimerOutput        timer_;
    PlateTestResults           results_;
    ContactChecks              contact_checks_;
    std::unique_ptr<PlateCell> cell_;

    // The system of the present stage, and its solver.
    ConstrainedSystem system_;
    LinearSolver      linear_solver_;

    // The accepted state.
    State                         state_;
    std::vector<dealii::Point<3>> woven_;
    bool                          is_elliptic_ = true;
    std::string                   not_elliptic_in_; // last stage

    // Ends of stages where others begin, by name.
    std::map<std::string, StageEnd> ends_;

    // What else a checkpoint needs: the stage with what it was made from, and
    // the last accepted step.
    unsigned int                        stage_ = 0;
    State                               stage_start_;
    std::vector<dealii::Point<3>>       start_woven_;
    std::optional<State>                previous_;
    StepControl::Place                  place_;
    std::set<std::vector<unsigned int>> couplings_;
    LinearSolverMemory                  solver_memory_;

    // Given to go on from, until that is done.
    std::optional<PlateTestCheckpoint> checkpoint_;

    // Where checkpoints go; empty: nowhere. A test that weaves for one on a
    // finer mesh writes that one's.
    std::string                           checkpoint_file_;
    std::string                           coarser_mesh_; // if it is such a test
    unsigned int                          n_unsaved_steps_ = 0;
    std::chrono::steady_clock::time_point last_saved_;
  };
} // namespace NPT

#endif
