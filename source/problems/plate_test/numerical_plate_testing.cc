// SPDX-License-Identifier: LGPL-2.1-or-later
// Numerical plate testing of a woven fabric: the method on one page. The
// equations of a stage are in plate_test_stage.cc, the loop over load steps in
// load_step/load_stepper.cc, what is shown in plate_test_results.cc.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/problems/plate_test/cell_preview.h>
#include <npt_dealii/problems/plate_test/coarser_weaving.h>
#include <npt_dealii/problems/plate_test/failure_advice.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <new>

namespace NPT
{
  using dealii::TimerOutput;

  NumericalPlateTesting::NumericalPlateTesting(
    const PlateTestParameters &parameters,
    const std::string         &directory,
    std::ostream              &screen,
    const Ranks               &ranks)
    : parameters_(parameters)
    , ranks_(ranks)
    , log_(RunLog::in_folder(directory, screen))
    , timer_(screen, TimerOutput::never, TimerOutput::cpu_and_wall_times)
    , results_(parameters_, directory, log_, timer_)
    , contact_checks_(parameters_, log_)
    , linear_solver_(parameters_.linear_solver, ranks_)
  {}



  void
  NumericalPlateTesting::run()
  {
    make_cell(); // weave pattern -> fiber bundles -> NURBS patches -> contact
    results_.begin(*cell_);
    contact_checks_.warn_of_coarse_averages(*cell_);

    // Weave, release, load: every stage drives the macro unknowns to its
    // targets in load steps of adaptive length.
    for (unsigned int i = 0; i < parameters_.load_programme.stages.size(); ++i)
      run_stage(i);
    results_.finish(*cell_, linear_solver_, system_);
  }



  void
  NumericalPlateTesting::preview()
  {
    make_cell();
    results_.begin_log(*cell_);
    preview_cell(*cell_, parameters_, results_.directory(), log_);
  }



  void
  NumericalPlateTesting::make_cell()
  {
    TimerOutput::Scope timer(timer_, "Set up");
    cell_  = std::make_unique<PlateCell>(parameters_, ranks_);
    state_ = cell_->initial_state();
  }



  void
  NumericalPlateTesting::run_stage(const unsigned int index)
  {
    const LoadStage &stage = parameters_.load_programme.stages[index];
    results_.begin_stage(stage);
    contact_checks_.warn_of_unwoven_bundles(index);
    try
      {
        if (index > 0 || !weave_from_coarser_mesh())
          run_steps(index, state_, stage.steps, [&](const AcceptedStep &step) {
            accept_step(stage, step);
          });
        contact_checks_.check(*cell_, stage, state_, woven_, results_.curve());
      }
    catch (const StageFailed &failure)
      {
        give_up(failure, index);
      }
    catch (const std::bad_alloc &)
      {
        // Of several processes the others may have memory left; they know
        // nothing of it.
        if (!ranks_.is_alone())
          throw;
        give_up(StageFailed("Stage " + stage.name +
                              " ran out of memory at load factor " +
                              short_number(state_.load_factor) + ".",
                            "out of memory",
                            stage.name,
                            state_.load_factor,
                            0,
                            OutOfMemory::remedy()),
                index);
      }
    results_.end_stage(*cell_, stage, state_, woven_);
  }



  void
  NumericalPlateTesting::run_steps(const unsigned int          index,
                                   const State                &start,
                                   const StepParameters       &steps,
                                   const LoadStepper::Visitor &visitor)
  {
    const LoadStage &stage = parameters_.load_programme.stages[index];
    // Couplings, prescribed unknowns, friction on or off.
    const PlateTestStage problem = [&]() {
      TimerOutput::Scope timer(timer_, "Set up");
      return PlateTestStage(
        *cell_, parameters_, index, start, woven_, system_, &timer_);
    }();
    state_ = problem.start();

    // Newton: bundles + contact; a step that fails is cut.
    LoadStepper stepper(parameters_.newton,
                        parameters_.contact,
                        system_,
                        linear_solver_,
                        log_,
                        &timer_);
    stepper.run(problem,
                problem.start(),
                steps,
                stage.name,
                LoadStepper::Predictor::extrapolation,
                [&](const AcceptedStep &step) {
                  visitor(step);
                  if (state_.load_factor == 1.)
                    results_.report_supports(
                      index,
                      problem.support_forces(step.increment, step.trial));
                });
  }



  /*
   * What the coarser test has done in its steps counts as the work of weaving:
   * the difference to the energy here is that of the meshes.
   */
  bool
  NumericalPlateTesting::weave_from_coarser_mesh()
  {
    const auto coarser = coarser_weaving(parameters_, *cell_);
    if (!coarser)
      return false;
    const LoadStage &stage    = parameters_.load_programme.stages.front();
    const State      straight = state_;
    std::ostream     nowhere(nullptr);
    std::string      mesh;
    for (const unsigned int n : {coarser->mesh.elements_along,
                                 coarser->mesh.elements_across,
                                 coarser->mesh.elements_through})
      mesh += (mesh.empty() ? "" : " x ") + std::to_string(n);
    try
      {
        State        start;
        unsigned int n_steps = 0;
        {
          TimerOutput::Scope    timer(timer_, "Coarser mesh");
          NumericalPlateTesting test(*coarser, "", nowhere, ranks_);
          test.run();
          start   = carry_over(test.cell(), test.state(), *cell_);
          n_steps = test.curve().size();
        }
        log_.line("Woven on " + mesh + " elements first, in " +
                  std::to_string(n_steps) +
                  (n_steps == 1 ? " step" : " steps") +
                  "; that state is the start on the mesh of this run.");
        StepParameters one_step;
        one_step.initial_step = one_step.minimum_step = one_step.maximum_step =
          1.;
        run_steps(0, start, one_step, [&](const AcceptedStep &step) {
          State woven         = step.after;
          woven.energies.work = start.energies.work;
          accept_step(stage,
                      {straight,
                       woven,
                       step.increment,
                       step.trial,
                       step.report,
                       step.n_cuts});
        });
      }
    catch (const StageFailed &failure)
      {
        // The same would happen again on the way in steps.
        if (failure.reason() == "interrupted" ||
            failure.reason() == "out of memory")
          throw;
        log_.line("Weaving on " + mesh +
                  " elements first does not serve: " + failure.account());
        state_ = straight;
      }
    return state_.load_factor == 1.;
  }



  void
  NumericalPlateTesting::accept_step(const LoadStage    &stage,
                                     const AcceptedStep &step)
  {
    state_ = step.after;
    if ((stage.type == LoadStage::Type::weave ||
         stage.type == LoadStage::Type::release) &&
        state_.load_factor == 1.)
      woven_ = cell_->woven_positions(state_.u); // weaving has ended here
    results_.add_step(*cell_, stage, step, woven_);
    warn_of_ellipticity(stage, step);
  }



  /*
   * Where the run does not stop at a loss of ellipticity: the first one of
   * every stage is said.
   */
  void
  NumericalPlateTesting::warn_of_ellipticity(const LoadStage    &stage,
                                             const AcceptedStep &step)
  {
    if (parameters_.stability.stops_at_loss() || stage.name == not_elliptic_in_)
      return;
    TimerOutput::Scope timer(timer_, "Ellipticity");
    auto loss = cell_->bodies().loss_of_ellipticity(state_.u, state_.natural);
    if (!loss)
      return;
    not_elliptic_in_ = stage.name;
    // Where on the way between the two states it was, to 1/256 of the step.
    double elliptic = 0, lost = 1;
    while (lost - elliptic > 1. / 300.)
      {
        const double           middle = 0.5 * (elliptic + lost);
        dealii::Vector<double> u(step.before.u);
        u.sadd(1. - middle, middle, step.after.u);
        if (const auto found =
              cell_->bodies().loss_of_ellipticity(u, state_.natural))
          {
            loss = found;
            lost = middle;
          }
        else
          elliptic = middle;
      }
    const double from = step.before.load_factor, to = step.after.load_factor;
    log_.warning("Stage " + stage.name +
                 ": the material loses its ellipticity at load factor " +
                 short_number(from + lost * (to - from), 4) +
                 " between the steps " + short_number(from) + " and " +
                 short_number(to) + " (" + cell_->bodies().describe(*loss) +
                 "). What follows depends on the mesh; On loss of ellipticity "
                 "= stop ends the run here (subsection Stability).");
  }



  /*
   * Whatever ended the stage: a material that lost its ellipticity before is
   * the likelier cause, so that is looked up and said.
   */
  void
  NumericalPlateTesting::give_up(const StageFailed &failure,
                                 const unsigned int index)
  {
    const LoadStage &stage   = parameters_.load_programme.stages[index];
    std::string      account = failure.account(), reason = failure.reason();
    bool             is_elliptic = reason != "loss of ellipticity";
    if (is_elliptic && !tells_its_cause(failure))
      {
        const DeformableBodies &bodies = cell_->bodies();
        const auto              lowest =
          bodies.lowest_acoustic_eigenvalue(state_.u, state_.natural);
        is_elliptic = lowest.lowest.value > 0.;
        account += is_elliptic ?
                     " The material is elliptic at the last accepted step (" :
                     " The material has lost its ellipticity (";
        account += bodies.describe(lowest) + ").";
        if (!is_elliptic)
          reason = "loss of ellipticity";
      }
    const StageFailed complete(
      account,
      reason,
      failure.stage(),
      failure.load_factor(),
      failure.n_cuts(),
      advice_for(failure, parameters_, index, state_, is_elliptic));
    results_.end_early(*cell_, stage, state_, woven_);
    log_.note(complete.what());
    results_.finish(*cell_, linear_solver_, system_);
    throw complete;
  }
} // namespace NPT
