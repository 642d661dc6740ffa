// SPDX-License-Identifier: LGPL-2.1-or-later
// Numerical plate testing of a woven fabric: the method on one page. The
// equations of a stage are in plate_test_stage.cc, the loop over load steps in
// load_step/load_stepper.cc, what is shown in plate_test_results.cc.

#include <npt_dealii/base/available_memory.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/problems/plate_test/cell_preview.h>
#include <npt_dealii/problems/plate_test/coarser_weaving.h>
#include <npt_dealii/problems/plate_test/failure_advice.h>
#include <npt_dealii/problems/plate_test/memory_need.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <algorithm>
#include <new>
#include <utility>

namespace NPT
{
  using dealii::TimerOutput;

  NumericalPlateTesting::NumericalPlateTesting(
    const PlateTestParameters         &parameters,
    const std::string                 &directory,
    std::ostream                      &screen,
    const Ranks                       &ranks,
    std::optional<PlateTestCheckpoint> checkpoint)
    : parameters_(parameters)
    , ranks_(ranks)
    , log_(RunLog::in_folder(directory,
                             screen,
                             checkpoint ? OutputFile::Start::end :
                                          OutputFile::Start::empty))
    , timer_(screen, TimerOutput::never, TimerOutput::cpu_and_wall_times)
    , results_(parameters_, directory, log_, timer_)
    , contact_checks_(parameters_, log_)
    , linear_solver_(parameters_.linear_solver, ranks_)
    , checkpoint_(std::move(checkpoint))
    , checkpoint_file_(directory.empty() ? "" :
                                           directory + "/" + checkpoint_name)
    , last_saved_(std::chrono::steady_clock::now())
  {}



  void
  NumericalPlateTesting::run()
  {
    check_memory(); // before it is taken
    make_cell(); // weave pattern -> fiber bundles -> NURBS patches -> contact
    if (resumes())
      resume();
    else
      results_.begin(*cell_);
    contact_checks_.warn_of_coarse_averages(*cell_);

    // Weave, release, load: every stage drives the macro unknowns to its
    // targets in load steps of adaptive length, from the end of the stage
    // before it or of that which it names.
    for (unsigned int i = stage_; i < parameters_.load_programme.stages.size();
         ++i)
      run_stage(i);
    results_.finish(*cell_, linear_solver_, system_);
    results_.check_pictures();
  }



  void
  NumericalPlateTesting::preview()
  {
    make_cell();
    results_.begin_log(*cell_);
    preview_cell(*cell_, parameters_, results_.directory(), log_);
  }



  /*
   * The matrix is shared by the processes, of which each asks its own machine;
   * what else each has of its own is small in comparison.
   */
  void
  NumericalPlateTesting::check_memory() const
  {
    const double share = static_cast<double>(ranks_.n()) /
                         static_cast<double>(ranks_.n_on_machine());
    const auto obstacle =
      obstacle_of_memory(parameters_, share * available_gigabytes());
    if (ranks_.all(obstacle.empty()))
      return;
    const auto &stages = parameters_.load_programme.stages;
    throw StageFailed(obstacle.empty() ?
                        "The memory of another machine does not suffice." :
                        obstacle,
                      "out of memory",
                      stages.empty() ? "" : stages.front().name,
                      0,
                      0,
                      OutOfMemory::remedy());
  }



  void
  NumericalPlateTesting::make_cell()
  {
    TimerOutput::Scope timer(timer_, "Set up");
    cell_  = std::make_unique<PlateCell>(parameters_, ranks_);
    state_ = cell_->initial_state();
  }



  bool
  NumericalPlateTesting::resumes() const
  {
    return checkpoint_ && checkpoint_->coarser_mesh == coarser_mesh_;
  }



  void
  NumericalPlateTesting::resume()
  {
    state_           = checkpoint_->memory.state;
    previous_        = checkpoint_->memory.previous;
    place_           = checkpoint_->memory.place;
    woven_           = checkpoint_->woven;
    not_elliptic_in_ = checkpoint_->not_elliptic_in;
    stage_           = checkpoint_->stage;
    stage_start_     = checkpoint_->stage_start;
    start_woven_     = checkpoint_->start_woven;
    ends_            = checkpoint_->ends;
    contact_checks_.set_overlap_warned_of(checkpoint_->overlap_warned_of);
    AssertThrow(state_.u.size() == cell_->macro().n_unknowns() &&
                  state_.contact.size() == cell_->contacts().size(),
                dealii::ExcMessage("The checkpoint does not fit the cell."));
    for (const std::string &difference :
         check_fit(checkpoint_name, *checkpoint_, parameters_))
      log_.line("Since the checkpoint: " + difference);
    results_.resume(*cell_, checkpoint_->results);
  }



  /*
   * Not only the state, also the round-off of the next steps is to be that of a
   * run that was not stopped. Of several processes each has a pattern of its
   * own, and the curve is the same to round-off only.
   */
  void
  NumericalPlateTesting::resume_stage(const PlateTestStage &problem)
  {
    if (ranks_.is_alone() && checkpoint_->has_pattern)
      {
        system_.build_pattern(
          {checkpoint_->couplings.begin(), checkpoint_->couplings.end()});
        solver_memory_ = checkpoint_->solver_memory;
        linear_solver_.remember(solver_memory_,
                                system_.free_matrix().pattern_id());
      }
    couplings_ = system_.couplings();
    if (state_.load_factor == 1.)
      return; // no more matrix of this stage
    if (!previous_)
      return;
    Increment increment = problem.increment(*previous_, state_.load_factor);
    for (unsigned int k = 0; k < state_.contact.size(); ++k)
      {
        increment.contact[k].multiplier    = state_.contact[k].multiplier;
        increment.contact[k].penalty_scale = state_.contact[k].penalty_scale;
      }
    Trial trial;
    trial.u = state_.u;
    problem.evaluate(increment, trial);
    results_.set_last_contact(trial.contact);
  }



  void
  NumericalPlateTesting::run_stage(const unsigned int index)
  {
    const LoadStage &stage = parameters_.load_programme.stages[index];
    results_.begin_stage(stage);
    contact_checks_.warn_of_unwoven_bundles(index);
    stage_ = index;
    if (!resumes())
      {
        go_to_start(index);
        stage_start_ = state_;
        start_woven_ = woven_;
      }
    try
      {
        if (resumes() || index > 0 || !weave_from_coarser_mesh())
          run_steps(index,
                    stage_start_,
                    stage.steps,
                    [&](const AcceptedStep &step) {
                      accept_step(stage, step);
                    });
        checkpoint_.reset();
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
    keep_end(stage);
    results_.end_stage(*cell_, stage, state_, woven_);
  }



  void
  NumericalPlateTesting::go_to_start(const unsigned int index)
  {
    const auto &stages = parameters_.load_programme.stages;
    const auto  before = stage_before(stages, index);
    if (!before || *before + 1 == index)
      return;
    const auto end = ends_.find(stages[*before].name);
    AssertThrow(end != ends_.end(), dealii::ExcInternalError());
    state_ = end->second.state;
    woven_ = end->second.woven;
    log_.line("Stage " + stages[index].name + " begins at the end of stage " +
              stages[*before].name + ".");
  }



  void
  NumericalPlateTesting::keep_end(const LoadStage &stage)
  {
    const auto &stages = parameters_.load_programme.stages;
    if (stage.type == LoadStage::Type::release ||
        stage.type == LoadStage::Type::relax ||
        std::any_of(stages.begin(), stages.end(), [&](const LoadStage &other) {
          return other.start == stage.name;
        }))
      ends_[stage.name] = {state_, woven_};
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
        *cell_, parameters_, index, start, start_woven_, system_, &timer_);
    }();
    if (resumes())
      resume_stage(problem);
    else
      state_ = problem.start();
    if (resumes() && state_.load_factor == 1.)
      return; // all that is left is the end of the stage

    // Newton: bundles + contact; a step that fails is cut.
    LoadStepper stepper(parameters_.newton,
                        parameters_.contact,
                        system_,
                        linear_solver_,
                        log_,
                        &timer_);
    stepper.run(
      problem,
      problem.start(),
      steps,
      stage.name,
      LoadStepper::Predictor::extrapolation,
      [&](const AcceptedStep &step) {
        is_elliptic_ = problem.checked_is_elliptic();
        visitor(step);
        if (state_.load_factor == 1.)
          results_.report_supports(index,
                                   problem.support_forces(step.increment,
                                                          step.trial));
        keep_step(step);
      },
      resumes() ? &checkpoint_->memory : nullptr);
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
    if (checkpoint_)
      log_.line("The run goes on with weaving on " + checkpoint_->coarser_mesh +
                " elements.");
    try
      {
        State        start;
        unsigned int n_steps = 0;
        {
          TimerOutput::Scope    timer(timer_, "Coarser mesh");
          NumericalPlateTesting test(
            *coarser, "", nowhere, ranks_, std::exchange(checkpoint_, {}));
          test.checkpoint_file_ = checkpoint_file_;
          test.coarser_mesh_    = mesh;
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



  void
  NumericalPlateTesting::keep_step(const AcceptedStep &step)
  {
    previous_ = step.before;
    place_    = step.place;
    // They only grow within a stage.
    if (system_.couplings().size() != couplings_.size() ||
        step.before.load_factor == 0.)
      couplings_ = system_.couplings();
    solver_memory_ = linear_solver_.memory();
    ++n_unsaved_steps_;

    const CheckpointParameters         &due = parameters_.checkpoint;
    const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - last_saved_;
    if (state_.load_factor == 1. ||
        (due.every_steps > 0 && n_unsaved_steps_ >= due.every_steps) ||
        (due.every_minutes > 0 && elapsed.count() >= 60. * due.every_minutes))
      save();
  }



  PlateTestCheckpoint
  NumericalPlateTesting::make_checkpoint() const
  {
    PlateTestCheckpoint checkpoint;
    checkpoint.parameters        = parameters_.used_file;
    checkpoint.choices           = choices_of_program(parameters_);
    checkpoint.coarser_mesh      = coarser_mesh_;
    checkpoint.stage             = stage_;
    checkpoint.stage_start       = stage_start_;
    checkpoint.start_woven       = start_woven_;
    checkpoint.memory.state      = state_;
    checkpoint.memory.previous   = previous_;
    checkpoint.memory.place      = place_;
    checkpoint.woven             = woven_;
    checkpoint.not_elliptic_in   = not_elliptic_in_;
    checkpoint.overlap_warned_of = contact_checks_.overlap_warned_of();
    checkpoint.has_pattern       = system_.has_pattern();
    checkpoint.solver_memory     = solver_memory_;
    if (ranks_.is_alone())
      checkpoint.couplings = couplings_;
    else
      checkpoint.has_pattern = false;
    checkpoint.ends    = ends_;
    checkpoint.results = results_.memory();
    const std::string directory =
      checkpoint_file_.substr(0, checkpoint_file_.rfind('/'));
    if (const auto *folder = OutputFolder::find(directory))
      checkpoint.files = folder->files();
    return checkpoint;
  }



  /// The last accepted step, if it is not saved yet. Only the process that has
  /// a folder does so.
  void
  NumericalPlateTesting::save()
  {
    if (n_unsaved_steps_ == 0 || checkpoint_file_.empty() ||
        !parameters_.checkpoint.is_wanted())
      return;
    {
      TimerOutput::Scope timer(timer_, "Output");
      write_checkpoint(checkpoint_file_, make_checkpoint());
    }
    n_unsaved_steps_ = 0;
    last_saved_      = std::chrono::steady_clock::now();
  }



  /*
   * Where the run does not stop at a loss of ellipticity: the first one of
   * every stage is said.
   */
  void
  NumericalPlateTesting::warn_of_ellipticity(const LoadStage    &stage,
                                             const AcceptedStep &step)
  {
    if (is_elliptic_ || stage.name == not_elliptic_in_)
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
    save();
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
