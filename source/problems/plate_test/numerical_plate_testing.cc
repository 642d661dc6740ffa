// SPDX-License-Identifier: LGPL-2.1-or-later
// Numerical plate testing of a woven fabric: the method on one page in run(),
// its steps below in the order in which they are used. What is shown of it is
// in numerical_plate_testing_results.cc.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/load_step.h>
#include <npt_dealii/load_step/step_control.h>
#include <npt_dealii/problems/plate_test/cell_contacts.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::TimerOutput;
  using dealii::Vector;

  namespace
  {
    // Of the foundation in weaving [N/mm per mm^3 of bundle]: four orders
    // below the stiffness of contact, so that it moves nothing by itself.
    const double foundation_stiffness = 0.01;
  } // namespace



  NumericalPlateTesting::NumericalPlateTesting(
    const PlateTestParameters &parameters,
    const std::string         &directory,
    std::ostream              &screen)
    : parameters_(parameters)
    , directory_(directory)
    , log_(RunLog::in_folder(directory, screen))
    , step_table_(log_)
    , timer_(screen, TimerOutput::never, TimerOutput::cpu_and_wall_times)
    , cpu_start_(process_cpu_seconds())
    , macro_(0)
  {}



  void
  NumericalPlateTesting::run()
  {
    make_unit_cell(); // weave pattern -> fiber bundles -> NURBS patches
    setup_system();   // knot spans, extraction, contact pairs, gradients
    if (!directory_.empty())
      curve_writer_ = std::make_unique<CurveWriter>(directory_ + "/curves.csv");

    // Weave, release, load: every stage drives the macro unknowns to its
    // targets in load steps of adaptive length.
    for (const LoadStage &stage : parameters_.load_programme.stages)
      {
        run_stage(stage);
        if (parameters_.output.fields != "none")
          output_fields();
        if (parameters_.output.picture)
          write_picture(stage);
        stages_done_ += 1;
      }
    finish_output();
  }



  void
  NumericalPlateTesting::run_stage(const LoadStage &stage)
  {
    begin_stage(stage); // couplings, prescribed unknowns, friction on or off
    StepControl control(stage.steps, stage.name);
    while (!control.finished())
      {
        const double trial = control.trial();
        if (!solve_load_step(stage, trial)) // Newton: bundles + contact
          {
            ++cuts_;
            try
              {
                control.reject(failure_reason_); // the step may be too small
              }
            catch (const StageFailed &failure)
              {
                give_up(failure);
              }
            log_.cut(stage.name, trial, failure_reason_, control.step());
            continue;
          }
        commit_history(stage, trial); // slip becomes "old" only here
        control.accept(report_.newton.iterations);
        log_.progress((stages_done_ + control.load_factor()) /
                        parameters_.load_programme.stages.size(),
                      cpu_seconds());
        if (parameters_.output.fields == "steps" && !control.finished())
          output_fields();
      }
  }



  // ---------------------------------------------------------------- set-up

  void
  NumericalPlateTesting::make_unit_cell()
  {
    TimerOutput::Scope timer(timer_, "Set up");
    cell_ = std::make_unique<FabricCell>(parameters_.cell, parameters_.mesh);

    std::vector<DeformablePart> parts;
    for (const FiberBundle &bundle : cell_->bundles())
      parts.push_back(
        {bundle.patch,
         make_material<3>(bundle.family == FiberBundle::Family::weft ?
                            parameters_.weft_material :
                            parameters_.material,
                          bundle.direction),
         bundle.body,
         "bundle " + std::to_string(parts.size())});
    // A cell and its image under the 2-fold axis do the same work: one of them
    // is integrated, twice.
    bodies_ = std::make_unique<DeformableBodies>(
      std::move(parts),
      parameters_.mesh.basis,
      0,
      [&](const unsigned int bundle, const dealii::Point<3> &center) {
        return cell_->symmetry_weight(bundle, center);
      });
    macro_ = MacroUnknowns(bodies_->space().n_control_points());
  }



  void
  NumericalPlateTesting::setup_system()
  {
    TimerOutput::Scope timer(timer_, "Set up");

    CellContacts contacts =
      make_cell_contacts(*cell_,
                         bodies_->space(),
                         parameters_.contact,
                         parameters_.friction,
                         parameters_.cell.bundle_thickness.smaller(),
                         macro_);
    surfaces_ = std::move(contacts.surfaces);
    contacts_ = std::move(contacts.pairs);
    images_   = std::move(contacts.images);
    for (const auto &contact : contacts_)
      contact_states_.push_back(contact->initial_state());
    contact_steps_.resize(contacts_.size());
    contact_evaluations_.resize(contacts_.size());
    linear_solver_ = std::make_unique<LinearSolver>(parameters_.linear_solver);

    // Start: straight bundles whose contact partners are held one (mean)
    // thickness apart, so that they just touch.
    u_.reinit(macro_.n_unknowns());
    u_[macro_.weaving_offset()] = cell_->weaving_offset();
    for (const PeriodicImage &periodic_image : images_)
      for (unsigned int l = 0; l < periodic_image.control_points.size(); ++l)
        u_[periodic_image.first_unknown + 3 * l + 2] =
          periodic_image.offset_sign * cell_->weaving_offset();

    if (!directory_.empty())
      std::ofstream(directory_ + "/used_parameters.prm")
        << parameters_.used_file;
    unsigned int n_nodes = 0;
    for (const auto &contact : contacts_)
      n_nodes += contact->n_nodes();
    log_.header("npt_dealii",
                {{"cell", parameters_.cell.type},
                 {"bundles", std::to_string(cell_->bundles().size())},
                 {"cells", std::to_string(bodies_->space().cells().size())},
                 {"degree", std::to_string(parameters_.mesh.degree)},
                 {"unknowns", std::to_string(macro_.n_unknowns())},
                 {"contact nodes",
                  std::to_string(n_nodes) + " (" + parameters_.contact.method +
                    ")"}});
    if (!parameters_.reason_for_type.empty())
      log_.line("The program chose the " + parameters_.cell.type + ", " +
                parameters_.reason_for_type + ".");
  }



  // ---------------------------------------------------------------- stages

  void
  NumericalPlateTesting::begin_stage(const LoadStage &stage)
  {
    TimerOutput::Scope timer(timer_, "Set up");
    const bool         weaving = stage.type == LoadStage::Type::weave;

    const auto constraints =
      make_couplings(*cell_, bodies_->space(), macro_, images_, woven_, pins_);
    system_.reinit(constraints, macro_.n_unknowns());
    cell_groups_        = bodies_->add_groups(system_);
    pattern_is_current_ = false;

    // Where the macro unknowns come from and go to.
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      stage_start_[k] = stage_target_[k] = u_[macro_.first + k];
    if (weaving)
      stage_target_[MacroUnknowns::n_modes] =
        cell_->weaving_offset() * (1. - parameters_.cell.weaving_depth);
    for (const auto &target : stage.H_targets)
      {
        stage_target_[target.first]         = target.second;
        resultant_controlled_[target.first] = false;
      }
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      force_start_[n] = force_target_[n] =
        resultant_controlled_[n] ? applied_[n] : conjugate_[n];
    for (const auto &target : stage.n_targets)
      {
        force_target_[target.first]         = target.second;
        resultant_controlled_[target.first] = true;
      }

    std::vector<bool> prescribed(system_.n_independent(), false);
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      {
        const int index = system_.independent_index(macro_.first + k);
        AssertThrow(index >= 0, dealii::ExcInternalError());
        prescribed[index] =
          k == MacroUnknowns::n_modes || !resultant_controlled_[k];
      }
    system_.set_prescribed(prescribed);

    // Before contact holds them, the bundles of a cell that is coupled by
    // translations can float apart vertically, and bundles that no 2-fold axis
    // goes through also in plane. A soft foundation keeps them during weaving
    // and fades out in the release.
    if (stage.type == LoadStage::Type::load)
      foundation_.clear();
    if (weaving && cell_->needs_vertical_pin())
      {
        const auto         integrals = bodies_->integrals_of_functions(true);
        const unsigned int first     = cell_->has_floating_bundles() ? 0 : 2;
        foundation_.assign(3 * integrals.size(), 0.);
        for (unsigned int A = 0; A < integrals.size(); ++A)
          for (unsigned int i = first; i < 3; ++i)
            foundation_[3 * A + i] = foundation_stiffness * integrals[A];
      }

    // The accepted state must obey the couplings of the new stage: dropping a
    // condition never moves it, and its tiny round-off is removed here.
    Vector<double> m, expanded;
    system_.restrict_to_independent(u_, m);
    system_.expand(m, expanded);
    expanded -= u_;
    AssertThrow(expanded.linfty_norm() < 1e-8 * cell_->weaving_offset(),
                dealii::ExcMessage("The state at the start of stage " +
                                   stage.name +
                                   " violates the couplings of the stage."));
    u_ += expanded;

    const bool friction_begins = stage.friction && !friction_was_on_;
    friction_was_on_           = stage.friction;
    for (unsigned int c = 0; c < contacts_.size(); ++c)
      contact_states_[c] =
        contacts_[c]->with_friction(contact_states_[c], stage.friction);
    has_previous_ = false;
    load_factor_  = 0;
    std::vector<unsigned int> shown;
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      if (stage.H_targets.count(n) + stage.n_targets.count(n) > 0)
        shown.push_back(n);
    step_table_.show_components(shown);

    if (friction_begins)
      for (unsigned int c = 0; c < contacts_.size(); ++c)
        contact_states_[c] =
          contacts_[c]->start_friction(contact_states_[c], u_);
  }



  bool
  NumericalPlateTesting::solve_load_step(const LoadStage &stage,
                                         const double     load_factor)
  {
    foundation_share_ =
      stage.type == LoadStage::Type::release ? 1. - load_factor : 1.;

    // Targets of this step.
    Vector<double> m_target;
    system_.restrict_to_independent(u_, m_target);
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      if (k == MacroUnknowns::n_modes || !resultant_controlled_[k])
        m_target[system_.independent_index(macro_.first + k)] =
          stage_start_[k] + load_factor * (stage_target_[k] - stage_start_[k]);
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      applied_[n] =
        force_start_[n] + load_factor * (force_target_[n] - force_start_[n]);

    LoadStep step(system_,
                  *linear_solver_,
                  {[this](const Vector<double> &u, Vector<double> &r) {
                     return assemble_residual(u, r);
                   },
                   [this](const Vector<double> &u) { assemble_tangent(u); }},
                  u_,
                  m_target,
                  u_trial_,
                  residual_,
                  &timer_);

    // Only failures of the LoadStepFailure family are survivable.
    try
      {
        for (unsigned int c = 0; c < contacts_.size(); ++c)
          contact_steps_[c] = contacts_[c]->begin_step(contact_states_[c], u_);
        Vector<double> x;
        bool           started = false;
        if (has_previous_)
          {
            step.extrapolate(u_previous_,
                             (load_factor - load_factor_) /
                               (load_factor_ - load_factor_previous_),
                             x);
            try
              {
                Vector<double> r;
                step.evaluate(x, r);
                started = true;
              }
            catch (const LoadStepFailure &)
              {
                // Extrapolated too far; the tangent is the safer guess.
              }
          }
        if (!started)
          step.follow_tangent(x);

        std::vector<const ContactPair<3> *> contacts;
        for (const auto &contact : contacts_)
          contacts.push_back(contact.get());
        report_ = solve_contact_step(parameters_.newton,
                                     parameters_.contact,
                                     step.problem(),
                                     contacts,
                                     contact_steps_,
                                     contact_evaluations_,
                                     x);
        if (parameters_.stability.check_ellipticity)
          {
            TimerOutput::Scope timer(timer_, "Ellipticity");
            const auto lowest = bodies_->lowest_acoustic_eigenvalue(u_trial_);
            if (!(lowest.lowest.value > 0.))
              throw EllipticityLost(bodies_->describe(lowest));
          }

        // Newton's last residual belongs to x; everything derived from it
        // (contact state, reactions) is that of the trial state.
        return true;
      }
    catch (const LoadStepFailure &failure)
      {
        failure_reason_ = failure.what();
        return false;
      }
  }



  void
  NumericalPlateTesting::commit_history(const LoadStage &stage,
                                        const double     load_factor)
  {
    CurveRow row;
    row.step        = curve_.size() + 1;
    row.stage       = stage.name;
    row.load_factor = load_factor;

    // Conjugates: reactions of the macro unknowns over the area.
    Vector<double> reactions;
    system_.condense(residual_, reactions);
    std::array<double, MacroUnknowns::n_modes> conjugate;
    double                                     work = 0;
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      {
        // The macro residual excludes the applied load, so it is the
        // conjugate for prescribed H and prescribed n alike.
        conjugate[n] = (reactions[system_.independent_index(macro_.mode(n))]) /
                         cell_->area() +
                       (resultant_controlled_[n] ? applied_[n] : 0.);
        const double dH = u_trial_[macro_.mode(n)] - u_[macro_.mode(n)];
        work += 0.5 * (conjugate[n] + conjugate_[n]) * dH * cell_->area();
        row.H[n] = u_trial_[macro_.mode(n)];
        row.n[n] = conjugate[n];
      }
    // Weaving does work through its own offset.
    conjugate_ = conjugate;

    if (!curve_.empty())
      {
        row.dissipation   = curve_.back().dissipation;
        row.external_work = curve_.back().external_work;
      }
    row.external_work += work;
    for (unsigned int c = 0; c < contacts_.size(); ++c)
      {
        const auto summary = contacts_[c]->summary(contact_evaluations_[c]);
        row.n_active += summary.n_active;
        row.n_stick += summary.n_stick;
        row.n_slip += summary.n_slip;
        row.contact_energy += summary.energy;
        row.friction_energy += summary.friction_energy;
        row.dissipation += summary.dissipation;
        row.largest_penetration =
          std::max(row.largest_penetration, summary.largest_penetration);
        contact_states_[c] =
          contacts_[c]->accept(contact_steps_[c], contact_evaluations_[c]);
      }
    row.stored_energy     = bodies_->stored_energy(u_trial_);
    row.newton_iterations = report_.newton.iterations;
    row.newton_order      = report_.newton.order();
    row.cuts              = cuts_;
    cuts_                 = 0;

    u_previous_           = u_;
    load_factor_previous_ = load_factor_;
    u_                    = u_trial_;
    load_factor_          = load_factor;
    has_previous_         = true;
    if (stage.type != LoadStage::Type::load && load_factor == 1.)
      record_woven_positions(); // weaving has ended here

    const Resultants averages = compute_averages(u_);
    row.N                     = averages.N;
    row.M                     = averages.M;
    row.cpu_seconds           = cpu_seconds();
    curve_.push_back(row);
    if (curve_writer_)
      curve_writer_->write(row);
    step_table_.add_row(row, report_.final_residual);
  }



  /*
   * After weaving, bending and torsion refer to the woven positions of the
   * material points, without what H has stretched or sheared, and with the
   * mid-plane at their mean height so that they are cell-centered wherever the
   * pin has put the cell.
   */
  void
  NumericalPlateTesting::record_woven_positions()
  {
    const auto weight = bodies_->integrals_of_functions(true);
    woven_            = bodies_->space().control_points();
    double mean = 0, volume = 0;
    for (unsigned int A = 0; A < woven_.size(); ++A)
      {
        Tensor<1, 3> w;
        for (unsigned int i = 0; i < 3; ++i)
          w[i] = u_[3 * A + i];
        for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
          w -=
            u_[macro_.mode(n)] *
            macroscopic_displacement(n, bodies_->space().control_points()[A]);
        woven_[A] += w;
        mean += weight[A] * woven_[A][2];
        volume += weight[A];
      }
    for (dealii::Point<3> &Z : woven_)
      Z[2] -= mean / volume;
  }



  // -------------------------------------------------------------- assembly

  double
  NumericalPlateTesting::assemble_residual(const Vector<double> &u,
                                           Vector<double>       &residual)
  {
    residual.reinit(macro_.n_unknowns());
    double force_scale = 0;
    {
      TimerOutput::Scope timer(timer_, "Residual: bundles");
      force_scale = bodies_->add_residual(u, residual);
    }
    {
      TimerOutput::Scope timer(timer_, "Residual: contact");
      Vector<double>     force(macro_.n_unknowns());
      for (unsigned int c = 0; c < contacts_.size(); ++c)
        {
          const ContactStep<3> &step       = contact_steps_[c];
          ContactEvaluation<3> &evaluation = contact_evaluations_[c];
          contacts_[c]->evaluate(step, u, evaluation);
          contacts_[c]->add_residual(step, evaluation, force);
        }
      residual += force;
      // Convergence is measured against the forces before they cancel: those
      // of the cells on their control points, and of contact.
      force_scale = std::sqrt(force_scale * force_scale + force.norm_sqr());
    }
    for (unsigned int k = 0; k < foundation_.size(); ++k)
      residual[k] += foundation_share_ * foundation_[k] * u[k];
    // Prescribed resultants act on the macro unknowns.
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      if (resultant_controlled_[n])
        residual[macro_.mode(n)] -= applied_[n] * cell_->area();
    return force_scale;
  }



  void
  NumericalPlateTesting::rebuild_pattern()
  {
    TimerOutput::Scope timer(timer_, "Pattern");
    const double margin = 0.02 * parameters_.cell.bundle_thickness.smaller();
    std::vector<std::vector<unsigned int>> couplings;
    for (unsigned int c = 0; c < contacts_.size(); ++c)
      {
        const auto more =
          contacts_[c]->coupled_unknowns(contact_steps_[c],
                                         contact_evaluations_[c],
                                         margin);
        couplings.insert(couplings.end(), more.begin(), more.end());
      }
    system_.build_pattern(couplings);
    pattern_is_current_ = true;
  }



  void
  NumericalPlateTesting::assemble_tangent(const Vector<double> &u)
  {
    for (unsigned int attempt = 0; attempt < 2; ++attempt)
      {
        if (!pattern_is_current_)
          rebuild_pattern();
        system_.set_zero();
        {
          TimerOutput::Scope timer(timer_, "Tangent: contact");
          for (unsigned int c = 0; c < contacts_.size(); ++c)
            contacts_[c]->add_tangent(
              contact_steps_[c],
              contact_evaluations_[c],
              [&](const std::vector<unsigned int> &unknowns,
                  const std::vector<double>       &K) {
                if (!system_.add(unknowns, K))
                  pattern_is_current_ = false;
              });
        }
        for (unsigned int k = 0; k < foundation_.size(); ++k)
          if (foundation_[k] > 0.)
            system_.add(
              std::vector<unsigned int>(1, k),
              std::vector<double>(1, foundation_share_ * foundation_[k]));
        if (!pattern_is_current_)
          continue; // a new coupling appeared: widen the pattern
        TimerOutput::Scope timer(timer_, "Tangent: bundles");
        bodies_->add_tangent(u, cell_groups_, system_);
        return;
      }
    AssertThrow(false, dealii::ExcInternalError());
  }



  // --------------------------------------------------------------- results

  Resultants
  NumericalPlateTesting::compute_averages(const Vector<double> &u) const
  {
    std::vector<double> Z3;
    for (const dealii::Point<3> &Z :
         woven_.empty() ? bodies_->space().control_points() : woven_)
      Z3.push_back(Z[2]);
    Resultants sum;
    bodies_->for_each_point(u, [&](const auto &point) {
      sum.N += point.P * point.dV;
      sum.M += bodies_->interpolate(point, Z3) * point.P * point.dV;
    });
    return complete_by_symmetry(*cell_, sum);
  }



  double
  NumericalPlateTesting::cpu_seconds() const
  {
    return process_cpu_seconds() - cpu_start_;
  }
} // namespace NPT
