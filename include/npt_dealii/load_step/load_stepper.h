// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the loop over load steps: try, cut, accept. It exists once, for all
// problems.

#ifndef npt_dealii_load_step_load_stepper_h
#define npt_dealii_load_step_load_stepper_h

#include <npt_dealii/io/run_log.h>
#include <npt_dealii/load_step/load_step.h>
#include <npt_dealii/load_step/step_control.h>

#include <functional>
#include <optional>
#include <string>

namespace NPT
{
  /// An accepted load step, as its visitor sees it.
  struct AcceptedStep
  {
    const State          &before;
    const State          &after;
    const Increment      &increment;
    const Trial          &trial; ///< converged: residual, contact
    const LoadStepReport &report;
    unsigned int          n_cuts;     ///< failed attempts before it
    StepControl::Place    place = {}; ///< in the stage, behind the step
  };

  /// Where a stage is continued: all that LoadStepper::run() remembers.
  struct StageMemory
  {
    State                state;
    std::optional<State> previous; ///< AcceptedStep::before of the last step
    StepControl::Place   place;
  };

  /**
   * Drives a problem through a stage in load steps of adaptive length. A step
   * is a pure function of (accepted state, increment); what is remembered from
   * step to step is its length and, for the predictor, one earlier state.
   */
  class LoadStepper
  {
  public:
    /// From where Newton's method starts.
    enum class Predictor
    {
      /// Along the tangent of the accepted state. The others do this too in
      /// the first step, and where their own start cannot be evaluated.
      tangent,
      /// Along the line through the last two accepted states.
      extrapolation,
      /// In proportion to the load factor, from the start of the stage.
      proportional
    };

    using Visitor = std::function<void(const AcceptedStep &)>;

    /**
     * @param augmentation Its part on the augmented Lagrangian.
     * @param system The system of the present stage, whose pattern grows with
     *   contact.
     * @param log Told of steps that are cut.
     */
    LoadStepper(const NewtonParameters  &newton,
                const ContactParameters &augmentation,
                ConstrainedSystem       &system,
                LinearSolver            &linear_solver,
                RunLog                  &log,
                dealii::TimerOutput     *timer = nullptr);

    /**
     * Go from the start of a stage to its end.
     *
     * @param start   Accepted state, load factor 0.
     * @param name    Of the stage, for messages.
     * @param visitor Called after every accepted step.
     * @param from    Go on from there instead of the start, if given.
     * @return The state at load factor 1.
     *
     * Throws StageFailed if the step would become smaller than allowed, if
     * the memory does not suffice, or if the run is interrupted; the visitor
     * has then seen all states before.
     */
    State
    run(const EquilibriumProblem &problem,
        const State              &start,
        const StepParameters     &steps,
        const std::string        &name,
        const Predictor           predictor,
        const Visitor            &visitor,
        const StageMemory        *from = nullptr);

  private:
    void
    check(const EquilibriumProblem &problem,
          const State              &before,
          const State              &after,
          const StepControl        &control) const;
    LoadStepReport
    solve(LoadStep                   &step,
          const State                &state,
          const std::optional<State> &previous) const;

    const NewtonParameters  newton_;
    const ContactParameters augmentation_;
    ConstrainedSystem      &system_;
    LinearSolver           &linear_solver_;
    RunLog                 &log_;
    dealii::TimerOutput    *timer_;
  };
} // namespace NPT

#endif
