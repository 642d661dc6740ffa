// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact benchmarks: the method on one page in run(), its steps below in the
// order in which they are used.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/vtu_file.h>
#include <npt_dealii/load_step/augmented_lagrangian.h>
#include <npt_dealii/load_step/load_step.h>
#include <npt_dealii/load_step/step_control.h>
#include <npt_dealii/solid/solid_fields.h>
#include <npt_dealii/verification/contact/contact_benchmark.h>

#include <fstream>
#include <iomanip>
#include <sstream>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  ContactBenchmark::ContactBenchmark(
    const ContactBenchmarkParameters &parameters,
    const std::string                &directory,
    std::ostream                     &screen)
    : parameters_(parameters)
    , directory_(directory)
    , log_(RunLog::in_folder(directory, screen))
    , cpu_start_(process_cpu_seconds())
    , model_(make_contact_model(parameters))
  {}



  void
  ContactBenchmark::run()
  {
    setup_system(); // bodies, couplings, the contact pair

    for (const ContactStage &stage : model_.stages)
      {
        run_stage(stage); // Newton in load steps of adaptive length
        compare(stage);   // with the exact solution, where there is one
        if (parameters_.output.fields)
          output_fields();
      }
    finish_output();
  }



  void
  ContactBenchmark::run_stage(const ContactStage &stage)
  {
    begin_stage(stage); // which handles are driven; friction on or off
    StepParameters steps;
    steps.initial_step = steps.maximum_step = 1. / stage.n_steps;
    steps.minimum_step                      = steps.initial_step / 256.;
    StepControl control(steps, stage.name);
    while (!control.finished())
      {
        const double trial = control.trial();
        if (!solve_load_step(trial))
          {
            control.reject(failure_reason_); // throws if the step is too small
            log_.cut(stage.name, trial, failure_reason_, control.step());
            continue;
          }
        accept_load_step(stage, trial); // slip becomes "old" only here
        control.accept(report_.iterations);
      }
  }



  // ---------------------------------------------------------------- set-up

  void
  ContactBenchmark::setup_system()
  {
    std::vector<DeformablePart> parts;
    for (const bool upper : {true, false})
      {
        const auto &body =
          upper ? parameters_.benchmark.upper : parameters_.benchmark.lower;
        parts.push_back({model_.patches[upper ? 0 : 1],
                         std::make_unique<NeoHookean<3>>(body.constants()),
                         upper ? 0u : 1u,
                         upper ? "the upper body" : "the lower body"});
      }
    bodies_ =
      std::make_unique<DeformableBodies>(std::move(parts), Basis::NURBS);

    surfaces_[0] = std::make_unique<IGASurface<3>>(bodies_->space(), 0, 2, 0);
    surfaces_[1] = std::make_unique<IGASurface<3>>(bodies_->space(), 1, 2, 1);
    std::vector<ContactSurface<3>> primary(1, ContactSurface<3>(*surfaces_[1]));
    primary[0].set_edge_radius(parameters_.contact.edge_radius *
                               model_.body_height);
    contact_ =
      std::make_unique<ContactPair<3>>(ContactSurface<3>(*surfaces_[0]),
                                       primary,
                                       parameters_.contact,
                                       parameters_.friction,
                                       parameters_.contact.maximum_penetration *
                                         model_.body_height);
    contact_state_ = contact_->initial_state();

    const unsigned int n_handles = model_.handles.size();
    HandleCouplings    couplings(bodies_->space());
    model_.couple(couplings);
    system_.reinit(couplings.close(), bodies_->n_displacements() + n_handles);
    cell_groups_   = bodies_->add_groups(system_);
    linear_solver_ = std::make_unique<LinearSolver>(parameters_.linear_solver);
    handles_.resize(n_handles);
    u_.reinit(bodies_->n_displacements() + n_handles);

    if (!directory_.empty())
      {
        std::ofstream(directory_ + "/used_parameters.prm")
          << parameters_.used_file;
        std::vector<std::string> columns = {"step", "stage", "load factor"};
        for (const std::string &name : model_.handles)
          {
            columns.push_back("value " + name);
            columns.push_back("force " + name);
          }
        for (const std::string name : {"dissipation [N mm]",
                                       "penetration [mm]",
                                       "active",
                                       "stick",
                                       "slip",
                                       "force imbalance",
                                       "moment imbalance",
                                       "iterations"})
          columns.push_back(name);
        table_ = std::make_unique<TableWriter>(
          directory_ + "/steps.csv",
          columns,
          std::vector<std::string>{
            "Handles: displacement [mm] and force [N]; forces and dissipation "
            "are those of the whole body, per mm for plane strain."});
      }
    log_.header("npt_dealii",
                {{"cells", std::to_string(bodies_->space().cells().size())},
                 {"degree", std::to_string(parameters_.benchmark.degree)},
                 {"independent unknowns",
                  std::to_string(system_.n_independent())},
                 {"contact nodes",
                  std::to_string(contact_->n_nodes()) + " (" +
                    parameters_.contact.method + ")"}});
  }



  void
  ContactBenchmark::begin_stage(const ContactStage &stage)
  {
    for (unsigned int k = 0; k < handles_.size(); ++k)
      {
        HandleState &handle = handles_[k];
        handle.value        = [](const double start, double) { return start; };
        for (const HandleDrive &drive : stage.drives)
          if (drive.handle == k)
            {
              handle.by_force = drive.force;
              handle.value    = drive.value;
            }
        // A force that is switched on goes on from the present reaction.
        handle.start = handle.by_force ? handle.reaction :
                                         u_[bodies_->n_displacements() + k];
      }
    std::vector<bool> prescribed(system_.n_independent(), false);
    for (unsigned int k = 0; k < handles_.size(); ++k)
      prescribed[system_.independent_index(bodies_->n_displacements() + k)] =
        !handles_[k].by_force;
    system_.set_prescribed(prescribed);
    pattern_is_current_ = false;

    const bool friction_begins = stage.friction && !friction_was_on_;
    friction_was_on_           = stage.friction;
    contact_state_ = contact_->with_friction(contact_state_, stage.friction);
    if (friction_begins)
      contact_state_ = contact_->start_friction(contact_state_, u_);
  }



  // ------------------------------------------------------------- load step

  bool
  ContactBenchmark::solve_load_step(const double load_factor)
  {
    const unsigned int first = bodies_->n_displacements();
    Vector<double>     m_target;
    system_.restrict_to_independent(u_, m_target);
    for (unsigned int k = 0; k < handles_.size(); ++k)
      {
        const double value = handles_[k].value(handles_[k].start, load_factor);
        if (handles_[k].by_force)
          handles_[k].applied = value / model_.force_factor;
        else
          m_target[system_.independent_index(first + k)] = value;
      }

    LoadStep step(system_,
                  *linear_solver_,
                  {[this](const Vector<double> &u, Vector<double> &r) {
                     return assemble_residual(u, r);
                   },
                   [this](const Vector<double> &u) { assemble_tangent(u); }},
                  u_,
                  m_target,
                  u_trial_,
                  residual_);

    try
      {
        contact_step_[0] = contact_->begin_step(contact_state_, u_);
        Vector<double> x;
        if (system_.n_free() == 0)
          {
            // Rigid bodies, all moved by hand: nothing is left to solve for.
            step.evaluate(x, x);
            report_           = NewtonReport();
            report_.converged = true;
            return true;
          }
        step.follow_tangent(x);
        const auto report = solve_contact_step(parameters_.newton,
                                               parameters_.contact,
                                               step.problem(),
                                               {contact_.get()},
                                               contact_step_,
                                               contact_evaluation_,
                                               x);
        report_           = report.newton;
        return true;
      }
    catch (const LoadStepFailure &failure)
      {
        failure_reason_ = failure.what();
        return false;
      }
  }



  void
  ContactBenchmark::accept_load_step(const ContactStage &stage,
                                     const double        load_factor)
  {
    ContactRow row;
    row.step        = rows_.size() + 1;
    row.stage       = stage.name;
    row.load_factor = load_factor;
    u_              = u_trial_;

    // The residual excludes applied forces only for handles driven by value.
    Vector<double> reactions;
    system_.condense(residual_, reactions);
    const unsigned int first = bodies_->n_displacements();
    for (unsigned int k = 0; k < handles_.size(); ++k)
      {
        HandleState &handle = handles_[k];
        handle.reaction     = model_.force_factor *
                          (reactions[system_.independent_index(first + k)] +
                           (handle.by_force ? handle.applied : 0.));
        row.value.push_back(u_[first + k]);
        row.force.push_back(handle.reaction);
      }

    const auto summary      = contact_->summary(contact_evaluation_[0]);
    row.n_active            = summary.n_active;
    row.n_stick             = summary.n_stick;
    row.n_slip              = summary.n_slip;
    row.largest_penetration = summary.largest_penetration;
    row.dissipation         = (rows_.empty() ? 0. : rows_.back().dissipation) +
                      model_.force_factor * summary.dissipation;
    row.iterations = report_.iterations;
    balance(row);
    contact_state_ = contact_->accept(contact_step_[0], contact_evaluation_[0]);

    if (table_)
      {
        std::vector<TableCell> cells = {row.step, row.stage, row.load_factor};
        for (unsigned int k = 0; k < handles_.size(); ++k)
          {
            cells.emplace_back(row.value[k]);
            cells.emplace_back(row.force[k]);
          }
        for (const TableCell &cell :
             std::vector<TableCell>{row.dissipation,
                                    row.largest_penetration,
                                    row.n_active,
                                    row.n_stick,
                                    row.n_slip,
                                    row.force_imbalance,
                                    row.moment_imbalance,
                                    row.iterations})
          cells.push_back(cell);
        table_->add_row(cells);
      }
    std::ostringstream line;
    line << std::left << std::setw(12) << stage.name << std::right << std::fixed
         << std::setprecision(4) << std::setw(8) << load_factor << std::setw(4)
         << row.iterations << " it." << std::setw(7) << row.n_active
         << " active" << std::setw(7) << row.n_slip << " slipping, forces";
    line << std::scientific << std::setprecision(4);
    for (const double force : row.force)
      line << ' ' << std::setw(11) << force;
    log_.line(line.str());
    rows_.push_back(row);
  }



  // -------------------------------------------------------------- assembly

  double
  ContactBenchmark::assemble_residual(const Vector<double> &u,
                                      Vector<double>       &residual)
  {
    residual.reinit(u.size());
    const double solids = bodies_->add_residual(u, residual);

    Vector<double> force(u.size());
    contact_->evaluate(contact_step_[0], u, contact_evaluation_[0]);
    contact_->add_residual(contact_step_[0], contact_evaluation_[0], force);
    residual += force;
    for (unsigned int k = 0; k < handles_.size(); ++k)
      if (handles_[k].by_force)
        residual[bodies_->n_displacements() + k] -= handles_[k].applied;
    // Convergence is measured against the forces before they cancel.
    return std::sqrt(solids * solids + force.norm_sqr());
  }



  void
  ContactBenchmark::assemble_tangent(const Vector<double> &u)
  {
    for (unsigned int attempt = 0; attempt < 2; ++attempt)
      {
        if (!pattern_is_current_)
          {
            system_.build_pattern(
              contact_->coupled_unknowns(contact_step_[0],
                                         contact_evaluation_[0],
                                         1e-3 *
                                           parameters_.benchmark.half_width));
            pattern_is_current_ = true;
          }
        system_.set_zero();
        contact_->add_tangent(contact_step_[0],
                              contact_evaluation_[0],
                              [&](const std::vector<unsigned int> &unknowns,
                                  const std::vector<double>       &K) {
                                if (!system_.add(unknowns, K))
                                  pattern_is_current_ = false;
                              });
        if (!pattern_is_current_)
          continue; // a new coupling appeared: widen the pattern
        bodies_->add_tangent(u, cell_groups_, system_);
        return;
      }
    AssertThrow(false, dealii::ExcInternalError());
  }



  void
  ContactBenchmark::balance(ContactRow &row) const
  {
    Vector<double> force(u_.size());
    contact_->add_residual(contact_step_[0], contact_evaluation_[0], force);
    Tensor<1, 3> sum, moment;
    double       forces = 0, moments = 0;
    for (unsigned int A = 0; A < bodies_->space().n_control_points(); ++A)
      {
        Tensor<1, 3> f, x = bodies_->space().control_points()[A];
        for (unsigned int c = 0; c < 3; ++c)
          {
            f[c] = force[3 * A + c];
            x[c] += u_[3 * A + c];
          }
        sum += f;
        moment += cross_product_3d(x, f);
        forces += f.norm();
        moments += cross_product_3d(x, f).norm();
      }
    row.force_imbalance  = forces > 0. ? sum.norm() / forces : 0.;
    row.moment_imbalance = moments > 0. ? moment.norm() / moments : 0.;
  }



  // --------------------------------------------------------------- results

  const ContactComparison &
  ContactBenchmark::comparison(const std::string &quantity) const
  {
    for (const ContactComparison &comparison : comparisons_)
      if (comparison.quantity == quantity)
        return comparison;
    AssertThrow(false,
                dealii::ExcMessage("There is no comparison of '" + quantity +
                                   "'."));
    return comparisons_.front();
  }



  void
  ContactBenchmark::output_fields()
  {
    if (directory_.empty())
      return;
    const std::string name = "bodies-" + std::to_string(rows_.size()) + ".vtu";
    write_vtu(directory_ + "/" + name,
              make_bundle_fields(
                bodies_->space(), bodies_->laws(), bodies_->gradients(), u_));
    files_.emplace_back(rows_.size(), name);
    write_pvd(directory_ + "/fields.pvd", files_);
  }



  void
  ContactBenchmark::finish_output()
  {
    for (const ContactComparison &item : comparisons_)
      {
        std::ostringstream line;
        line << std::left << std::setw(34) << item.quantity << std::right
             << std::setw(14) << short_number(item.computed) << ' ' << std::left
             << std::setw(6) << item.unit;
        if (item.exact != 0.)
          line << " exact " << std::setw(12) << short_number(item.exact)
               << " difference " << short_number(100. * item.error(), 3)
               << " %";
        log_.line(line.str());
      }
    log_.line("CPU time " +
              short_number(process_cpu_seconds() - cpu_start_, 3) + " s");
    if (directory_.empty())
      return;
    TableWriter table(directory_ + "/comparison.csv",
                      {"quantity", "unit", "computed", "exact", "error"},
                      {"Error: relative, absolute where zero is exact."});
    for (const ContactComparison &item : comparisons_)
      table.add_row(
        {item.quantity, item.unit, item.computed, item.exact, item.error()});
    if (parameters_.output.picture &&
        std::ifstream(directory_ + "/profile.gp").good())
      {
        const std::string warning = run_gnuplot(directory_ + "/profile.gp");
        if (!warning.empty())
          log_.warning(warning);
      }
  }
} // namespace NPT
