// SPDX-License-Identifier: LGPL-2.1-or-later
// Contact benchmarks: the method on one page in run(), its steps below in the
// order in which they are used.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/vtu_file.h>
#include <npt_dealii/solid/solid_fields.h>
#include <npt_dealii/verification/contact/contact_benchmark.h>
#include <npt_dealii/verification/contact/handle_problem.h>

#include <algorithm>
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
    , case_(*ContactCases::instance().get(parameters.benchmark.name))
    , model_(case_.make_model(parameters))
    , linear_solver_(parameters.linear_solver)
    , comparisons_(all_quantities(case_), parameters.tolerances)
  {}



  void
  ContactBenchmark::run()
  {
    setup_system(); // bodies, couplings, the contact pair

    for (unsigned int index = 0; index < model_.stages.size(); ++index)
      {
        const ContactStage &stage = model_.stages[index];
        run_stage(index); // Newton in load steps of adaptive length
        compare(stage);   // with the exact solution, where there is one
        if (parameters_.output.fields)
          output_fields();
      }
    finish_output();
    judge(comparisons_.list()); // throws if a tolerance is missed
  }



  void
  ContactBenchmark::run_stage(const unsigned int index)
  {
    const ContactStage &stage = model_.stages[index];
    // Which handles are driven; friction on or off.
    const HandleProblem problem({*bodies_,
                                 cell_groups_,
                                 contacts_,
                                 static_cast<unsigned int>(
                                   model_.handles.size()),
                                 model_.force_factor,
                                 1e-3 * parameters_.benchmark.half_width},
                                model_.stages,
                                index,
                                state_,
                                system_);
    StepParameters      steps;
    steps.initial_step = steps.maximum_step = 1. / stage.n_steps;
    steps.minimum_step                      = steps.initial_step / 256.;
    ContactParameters augmentation          = parameters_.contact;
    augmentation.set_thickness(model_.body_height);
    LoadStepper stepper(
      parameters_.newton, augmentation, system_, linear_solver_, log_);
    stepper.run(problem,
                problem.start(),
                steps,
                stage.name,
                LoadStepper::Predictor::tangent,
                [&](const AcceptedStep &step) { add_row(stage, step); });
  }



  // ---------------------------------------------------------------- set-up

  void
  ContactBenchmark::setup_system()
  {
    std::vector<DeformablePart> parts;
    for (const bool upper : {true, false})
      {
        auto body =
          upper ? parameters_.benchmark.upper : parameters_.benchmark.lower;
        if (upper)
          body.young_modulus *= parameters_.benchmark.stiffness_factor;
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
    FrictionParameters friction = parameters_.friction;
    friction.coefficient *= parameters_.benchmark.friction_factor;
    contacts_.push_back(
      std::make_unique<ContactPair<3>>(ContactSurface<3>(*surfaces_[0]),
                                       primary,
                                       parameters_.contact,
                                       friction,
                                       model_.body_height));

    const unsigned int n_handles = model_.handles.size();
    HandleCouplings    couplings(bodies_->space());
    model_.couple(couplings);
    system_.reinit(couplings.close(), bodies_->n_displacements() + n_handles);
    cell_groups_ = bodies_->add_groups(system_);
    state_.u.reinit(bodies_->n_displacements() + n_handles);
    state_.applied.assign(n_handles, 0.);
    state_.reactions.assign(n_handles, 0.);
    state_.contact.push_back(contacts_[0]->initial_state());

    if (!directory_.empty())
      {
        replace_file(directory_ + "/used_parameters.prm",
                     [&](std::ostream &out) { out << parameters_.used_file; });
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
                  std::to_string(contacts_[0]->n_nodes()) + " (" +
                    name_of(parameters_.contact.method) + ")"}});
  }



  void
  ContactBenchmark::add_row(const ContactStage &stage, const AcceptedStep &step)
  {
    state_      = step.after;
    evaluation_ = step.trial.contact[0];

    const unsigned int n_handles = model_.handles.size();
    ContactRow         row;
    row.step        = rows_.size() + 1;
    row.stage       = stage.name;
    row.load_factor = state_.load_factor;
    for (unsigned int k = 0; k < n_handles; ++k)
      {
        row.value.push_back(state_.u[bodies_->n_displacements() + k]);
        row.force.push_back(state_.reactions[k]);
      }

    const ContactSummary summary = contacts_[0]->summary(evaluation_);
    row.n_active                 = summary.n_active;
    row.n_stick                  = summary.n_stick;
    row.n_slip                   = summary.n_slip;
    row.largest_penetration      = summary.largest_penetration;
    row.dissipation = (rows_.empty() ? 0. : rows_.back().dissipation) +
                      model_.force_factor * summary.dissipation;
    row.iterations = step.report.newton.iterations;
    balance(step, row);

    if (table_)
      {
        std::vector<TableCell> cells = {row.step, row.stage, row.load_factor};
        for (unsigned int k = 0; k < n_handles; ++k)
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
         << std::setprecision(4) << std::setw(8) << row.load_factor
         << std::setw(4) << row.iterations << " it." << std::setw(7)
         << row.n_active << " active" << std::setw(7) << row.n_slip
         << " slipping, forces";
    line << std::scientific << std::setprecision(4);
    for (const double force : row.force)
      line << ' ' << std::setw(11) << force;
    log_.line(line.str());
    rows_.push_back(row);
  }



  void
  ContactBenchmark::balance(const AcceptedStep &step, ContactRow &row) const
  {
    Vector<double> force(state_.u.size());
    contacts_[0]->add_residual(step.increment.contact[0],
                               step.trial.contact[0],
                               force);
    Tensor<1, 3> sum, moment;
    double       forces = 0, moments = 0;
    for (unsigned int A = 0; A < bodies_->space().n_control_points(); ++A)
      {
        Tensor<1, 3> f, x = bodies_->space().control_points()[A];
        for (unsigned int c = 0; c < 3; ++c)
          {
            f[c] = force[3 * A + c];
            x[c] += state_.u[3 * A + c];
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

  void
  ContactBenchmark::compare(const ContactStage &stage)
  {
    const ContactResults results(
      rows_, *bodies_, *contacts_[0], evaluation_, state_.u);
    if (stage.name != model_.stages.back().name)
      {
        case_.compare_stage(stage.name, parameters_, results, comparisons_);
        return;
      }
    case_.compare(parameters_, results, comparisons_);
    double force = 0, moment = 0;
    for (const ContactRow &row : rows_)
      {
        force  = std::max(force, row.force_imbalance);
        moment = std::max(moment, row.moment_imbalance);
      }
    comparisons_.compare("force imbalance of contact", force, 0.);
    comparisons_.compare("moment imbalance of contact", moment, 0.);
    comparisons_.report("largest penetration",
                        rows_.back().largest_penetration);
    comparisons_.check_complete();
  }



  void
  ContactBenchmark::output_fields()
  {
    if (directory_.empty())
      return;
    const std::string name = "bodies-" + std::to_string(rows_.size()) + ".vtu";
    write_vtu(directory_ + "/" + name,
              make_bundle_fields(bodies_->space(),
                                 bodies_->laws(),
                                 bodies_->gradients(),
                                 state_.u));
    files_.emplace_back(rows_.size(), name);
    write_pvd(directory_ + "/fields.pvd", files_);
  }



  void
  ContactBenchmark::finish_output()
  {
    for (const Comparison &item : comparisons_.list())
      {
        std::ostringstream line;
        line << std::left << std::setw(34) << item.quantity << std::right
             << std::setw(14) << short_number(item.computed) << ' ' << std::left
             << std::setw(6) << item.unit;
        if (item.exact && *item.exact != 0.)
          line << " exact " << std::setw(12) << short_number(*item.exact)
               << " difference " << short_number(100. * item.error(), 3)
               << " %";
        if (item.allowed)
          line << (item.is_missed() ? " MISSES" : " within") << " tolerance";
        log_.line(line.str());
      }
    log_.line("CPU time " +
              short_number(process_cpu_seconds() - cpu_start_, 3) + " s");
    if (directory_.empty())
      return;
    comparisons_.write(directory_);
    if (parameters_.output.picture &&
        std::ifstream(directory_ + "/profile.gp").good())
      {
        const std::string warning = run_gnuplot(directory_ + "/profile.gp");
        if (!warning.empty())
          log_.warning(warning);
      }
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        ContactBenchmarkParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters))
        return;
      const std::string directory =
        make_output_directory(command, parameters.output.directory);
      const OutputFolder folder(directory);
      ContactBenchmark   benchmark(parameters, directory, std::cout);
      benchmark.run();
    }

    const Registry<Problem>::Registration
      registration("contact benchmark",
                   {5, "a comparison of contact with exact solutions", start});
  } // namespace
} // namespace NPT
