// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop over load steps.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/load_step/branch_left.h>
#include <npt_dealii/load_step/load_stepper.h>

#include <utility>

namespace NPT
{
  LoadStepper::LoadStepper(const NewtonParameters  &newton,
                           const ContactParameters &augmentation,
                           ConstrainedSystem       &system,
                           LinearSolver            &linear_solver,
                           RunLog                  &log,
                           dealii::TimerOutput     *timer)
    : newton_(newton)
    , augmentation_(augmentation)
    , system_(system)
    , linear_solver_(linear_solver)
    , log_(log)
    , timer_(timer)
  {}



  State
  LoadStepper::run(const EquilibriumProblem &problem,
                   const State              &start,
                   const StepParameters     &steps,
                   const std::string        &name,
                   const Predictor           predictor,
                   const Visitor            &visitor,
                   const StageMemory        *from)
  {
    State                state = start;
    std::optional<State> previous; // for the extrapolation
    unsigned int         n_cuts = 0;
    StepControl          control(steps, name);
    if (from != nullptr)
      {
        state = from->state;
        control.go_to(from->place);
        if (predictor == Predictor::extrapolation)
          previous = from->previous;
        else if (predictor == Predictor::proportional)
          previous = start;
      }
    while (!control.finished())
      {
        // Between steps, where state and results are complete.
        if (problem.ranks().any(Interruption::requested()))
          throw StageFailed("Stage " + name +
                              " was interrupted at load factor " +
                              short_number(control.load_factor()) +
                              "; the results up to there are complete.",
                            "interrupted",
                            name,
                            control.load_factor(),
                            control.n_cuts());
        const double            load_factor = control.trial();
        std::optional<LoadStep> step;
        LoadStepReport          report;
        State                   accepted;
        // Only failures of the LoadStepFailure family are survivable.
        try
          {
            step.emplace(problem,
                         state,
                         problem.increment(state, load_factor),
                         system_,
                         linear_solver_,
                         timer_);
            report   = solve(*step, state, previous);
            accepted = problem.accept(state, step->increment(), step->trial());
            check(problem, state, accepted, control);
          }
        catch (const OutOfMemory &failure)
          {
            control.reject_for_good(failure);
          }
        catch (const LoadStepFailure &failure)
          {
            ++n_cuts;
            control.reject(failure); // throws if the step becomes too small
            log_.cut(name, load_factor, failure.what(), control.step());
            continue;
          }
        control.accept(report.newton.iterations);
        visitor({state,
                 accepted,
                 step->increment(),
                 step->trial(),
                 report,
                 std::exchange(n_cuts, 0),
                 control.place()});
        if (predictor == Predictor::extrapolation)
          previous = std::move(state);
        else if (predictor == Predictor::proportional)
          previous = start;
        state = std::move(accepted);
      }
    return state;
  }



  LoadStepReport
  LoadStepper::solve(LoadStep                   &step,
                     const State                &state,
                     const std::optional<State> &previous) const
  {
    const bool extrapolated =
      previous &&
      step.extrapolate(previous->u,
                       (step.increment().load_factor - state.load_factor) /
                         (state.load_factor - previous->load_factor));
    if (!extrapolated)
      step.follow_tangent();
    return step.solve(newton_, augmentation_);
  }



  void
  LoadStepper::check(const EquilibriumProblem &problem,
                     const State              &before,
                     const State              &after,
                     const StepControl        &control) const
  {
    try
      {
        problem.check(before, after);
      }
    catch (const BranchLeft &jump)
      {
        if (!control.is_shortest())
          throw;
        log_.warning("At load factor " + short_number(after.load_factor) +
                     " a " + jump.what() +
                     ", and the step cannot be cut any more. What follows "
                     "belongs to the new branch.");
      }
  }
} // namespace NPT
