// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the numerical plate test: the whole method, from the parameter file
// to curves, in the order of run().

#ifndef npt_dealii_problems_plate_test_numerical_plate_testing_h
#define npt_dealii_problems_plate_test_numerical_plate_testing_h

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/fabric_couplings.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/resultants.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/augmented_lagrangian.h>
#include <npt_dealii/problems/plate_test/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>
#include <npt_dealii/problems/plate_test/step_table.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/solid/solid_kernel.h>

#include <deal.II/base/timer.h>

#include <memory>

namespace NPT
{
  /**
   * Numerical plate test of a woven fabric with frictional contact.
   *
   * Unknowns are u = (w of all control points, H1..H6, weaving offset); the
   * couplings of the cell leave the independent ones m, u = C m, of which H1
   * to H6 and the offset are prescribed (or loaded by resultants). A load step
   * solves
   *
   * @f[ C^T ( f_{int}(u) + f_{contact}(u) ) = f_{macro} @f]
   *
   * for the free m by Newton's method. The state changes only when a step is
   * accepted.
   *
   * To build another kind of test, derive from this class or copy it and
   * change run(), as one does with a deal.II tutorial program.
   */
  class NumericalPlateTesting
  {
  public:
    /**
     * @param directory Existing folder for all results; empty: write nothing
     *   (tests).
     * @param screen Where the log is shown.
     */
    NumericalPlateTesting(const PlateTestParameters &parameters,
                          const std::string         &directory,
                          std::ostream              &screen);
    virtual ~NumericalPlateTesting() = default;

    /// The whole test. Throws StageFailed if a stage cannot be finished; all
    /// results up to there are complete on disk.
    virtual void
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
      return curve_;
    }

    /// Unknowns of Newton's method in the present stage.
    unsigned int
    n_unknowns() const
    {
      return system_.n_free();
    }

  protected:
    void
    make_unit_cell();
    void
    setup_system();
    void
    run_stage(const LoadStage &stage);

    /// Couplings and prescribed unknowns of a stage.
    void
    begin_stage(const LoadStage &stage);
    /// One load step from the accepted state to a load factor of the stage;
    /// false: it failed, and the accepted state is unchanged.
    bool
    solve_load_step(const LoadStage &stage, const double load_factor);
    void
    commit_history(const LoadStage &stage, const double load_factor);
    void
    record_woven_positions();

    /// Residual of the full system at u: bundles, contact. Returns the forces
    /// before they cancel [N].
    double
    assemble_residual(const dealii::Vector<double> &u,
                      dealii::Vector<double>       &residual);
    /// Tangent of the state last seen by assemble_residual().
    void
    assemble_tangent(const dealii::Vector<double> &u);
    void
    rebuild_pattern();
    Resultants
    compute_averages(const dealii::Vector<double> &u) const;

    // Results, numerical_plate_testing_results.cc.
    void
    output_fields();
    /// Write script and points of the picture of the deformed cell at the end
    /// of a stage; draw_cells() draws them all. What goes wrong is a warning in
    /// the log.
    void
    write_picture(const LoadStage &stage);
    void
    draw_cells();
    void
    finish_output();
    void
    warn_of_penetration();
    /// Throw the failure of a stage again, with the state of the material.
    [[noreturn]] void
    give_up(const StageFailed &failure);

    double
    cpu_seconds() const;

    const PlateTestParameters parameters_;
    const std::string         directory_;
    RunLog                    log_;
    StepTable                 step_table_;
    dealii::TimerOutput       timer_;
    const double              cpu_start_;

    // The cell and its discretization.
    std::unique_ptr<FabricCell>                  cell_;
    std::unique_ptr<DeformableBodies>            bodies_; // bundles
    std::vector<std::unique_ptr<IGASurface<3>>>  surfaces_;
    std::vector<std::unique_ptr<ContactPair<3>>> contacts_;
    // Of each pair: accepted state, present load step, last displacement.
    std::vector<ContactState<3>>      contact_states_;
    std::vector<ContactStep<3>>       contact_steps_;
    std::vector<ContactEvaluation<3>> contact_evaluations_;
    MacroUnknowns                     macro_;
    std::vector<PeriodicImage>        images_;
    std::vector<dealii::Point<3>>     woven_; // positions, by control point
    Pins                              pins_;

    // The system of the present stage.
    ConstrainedSystem             system_;
    DeformableBodies::CellGroups  cell_groups_; // in system_
    std::unique_ptr<LinearSolver> linear_solver_;
    bool                          pattern_is_current_ = false;
    bool                          friction_was_on_    = false;

    // The accepted state, and the one before for extrapolation.
    dealii::Vector<double> u_;          // full
    dealii::Vector<double> u_previous_; // full, same stage
    bool                   has_previous_ = false;
    double                 load_factor_ = 0, load_factor_previous_ = 0;
    std::array<double, MacroUnknowns::n_macro> stage_start_, stage_target_;
    std::array<bool, MacroUnknowns::n_modes>   resultant_controlled_{};
    std::array<double, MacroUnknowns::n_modes> force_start_{}, force_target_{};
    std::array<double, MacroUnknowns::n_modes> conjugate_{};
    std::array<double, MacroUnknowns::n_modes> applied_{};
    std::vector<double> foundation_;           // per unknown, weave and release
    double              foundation_share_ = 1; // what the release has left

    // The trial state of the last successful solve_load_step().
    dealii::Vector<double> u_trial_, residual_;
    ContactStepReport      report_;

    std::vector<CurveRow>                       curve_;
    std::unique_ptr<CurveWriter>                curve_writer_;
    std::vector<std::pair<double, std::string>> bundle_files_, contact_files_;
    unsigned int                                cuts_        = 0;
    double                                      stages_done_ = 0;
    std::vector<std::string>                    cell_scripts_;
    std::string                                 failure_reason_;
  };
} // namespace NPT

#endif
