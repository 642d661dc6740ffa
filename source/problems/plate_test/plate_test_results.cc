// SPDX-License-Identifier: LGPL-2.1-or-later
// Curve, log, fields and pictures of a plate test.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/contact/contact_fields.h>
#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/vtu_file.h>
#include <npt_dealii/problems/load_programme/tester_targets.h>
#include <npt_dealii/problems/plate_exports/export_cell.h>
#include <npt_dealii/problems/plate_results/cell_picture.h>
#include <npt_dealii/problems/plate_results/curve_column.h>
#include <npt_dealii/problems/plate_results/hysteresis.h>
#include <npt_dealii/problems/plate_results/plots.h>
#include <npt_dealii/problems/plate_results/stage_starts.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/curvature_range.h>
#include <npt_dealii/problems/plate_test/plate_step.h>
#include <npt_dealii/problems/plate_test/plate_test_results.h>
#include <npt_dealii/problems/plate_test/shear_range.h>
#include <npt_dealii/solid/solid_fields.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::TimerOutput;

  namespace
  {
    // Of the control points [mm].
    std::vector<dealii::Point<3>>
    positions_of(const PlateCell &cell, const State &state)
    {
      const IGASpace<3>            &space = cell.bodies().space();
      std::vector<dealii::Point<3>> positions;
      for (unsigned int A = 0; A < space.n_control_points(); ++A)
        positions.push_back(
          space.control_points()[A] +
          Tensor<1, 3>(
            {state.u[3 * A], state.u[3 * A + 1], state.u[3 * A + 2]}));
      return positions;
    }

    // What testers draw of a stage; without columns for those that have modes.
    StageAxes
    tester_axes(const LoadStage &stage)
    {
      switch (stage.type)
        {
          case LoadStage::Type::trellis:
          case LoadStage::Type::picture_frame:
            return {"shear_angle", {"shear_torque", "frame_force"}};
          case LoadStage::Type::bias_extension:
            return {"shear_angle", {"bias_force", "shear_torque"}};
          case LoadStage::Type::compression:
            return {"plate_distance", {"pressure"}};
          default:
            return {};
        }
    }
  } // namespace



  PlateTestResults::PlateTestResults(const PlateTestParameters &parameters,
                                     const std::string         &directory,
                                     RunLog                    &log,
                                     TimerOutput               &timer)
    : parameters_(parameters)
    , directory_(directory)
    , log_(log)
    , timer_(timer)
    , cpu_start_(process_cpu_seconds())
    , step_table_(log)
  {}



  double
  PlateTestResults::cpu_seconds() const
  {
    return process_cpu_seconds() - cpu_start_;
  }



  void
  PlateTestResults::begin_log(const PlateCell &cell)
  {
    if (!directory_.empty())
      replace_file(directory_ + "/used_parameters.prm",
                   [&](std::ostream &out) { out << parameters_.used_file; });
    auto entries = describe_sizes(cell, parameters_);
    for (const auto &[name, value] :
         std::vector<std::pair<std::string, std::string>>{
           {"bundles", std::to_string(cell.fabric().bundles().size())},
           {"cells", std::to_string(cell.bodies().space().cells().size())},
           {"degree", std::to_string(parameters_.mesh.degree)},
           {"unknowns", std::to_string(cell.macro().n_unknowns())},
           {"contact nodes",
            std::to_string(cell.n_contact_nodes()) + " (" +
              name_of(parameters_.contact.method) + ")"}})
      entries.emplace_back(name, value);
    log_.header("npt_dealii", entries);
    if (!parameters_.reason_for_type.empty())
      log_.line("The program chose the " + parameters_.cell.type + ", " +
                parameters_.reason_for_type + ".");
    if (parameters_.chose_mirror_planes)
      log_.line("The mirror planes of the weave are constraints, because no "
                "stage drives H3 or H6.");
    if (parameters_.cell.smooth_closure == CellParameters::SmoothClosure::yes)
      log_.line("Bundles are smooth (C1) between crossings and over the "
                "periodic faces.");
    for (const std::string &remark : parameters_.remarks)
      log_.warning(remark);
    if (!parameters_.reason_for_jumps.empty())
      log_.line("Jumps are " + parameters_.reason_for_jumps + ".");
    if (!parameters_.reason_for_side_contact.empty())
      log_.line("Side contact is on, because " +
                parameters_.reason_for_side_contact + ".");
    for (const auto &doubts :
         {doubts_of_curvature(parameters_), doubts_of_shear(parameters_)})
      for (const std::string &doubt : doubts)
        log_.warning(doubt);
  }



  void
  PlateTestResults::begin(const PlateCell &cell)
  {
    begin_log(cell);
    if (!directory_.empty())
      curve_writer_ = std::make_unique<CurveWriter>(directory_ + "/curves.csv");
  }



  void
  PlateTestResults::resume(const PlateCell &cell, const Memory &memory)
  {
    memory_ = memory;
    if (!memory_.curve.empty())
      {
        const CurveRow &last = memory_.curve.back();
        cpu_start_ -= last.cpu_seconds;
        log_.line("The run goes on behind step " + std::to_string(last.step) +
                  ", stage " + last.stage + ", load factor " +
                  short_number(last.load_factor) + ".");
      }
    begin_log(cell);
    if (directory_.empty())
      return;
    curve_writer_ =
      std::make_unique<CurveWriter>(directory_ + "/curves.csv", memory_.curve);
    // Without what was written after the checkpoint.
    if (!memory_.bundle_files.empty())
      write_pvd(directory_ + "/fields.pvd", memory_.bundle_files);
    if (!memory_.contact_files.empty())
      write_pvd(directory_ + "/contact.pvd", memory_.contact_files);
  }



  void
  PlateTestResults::set_last_contact(
    const std::vector<ContactEvaluation<3>> &contact)
  {
    if (parameters_.output.fields == OutputParameters::Fields::stages)
      last_contact_ = contact;
  }



  void
  PlateTestResults::begin_stage(const LoadStage &stage)
  {
    const StageAxes axes = tester_axes(stage);
    if (axes.x_column.empty())
      {
        step_table_.show_components(stage.driven_modes());
        return;
      }
    std::vector<std::string> columns = {axes.x_column};
    columns.insert(columns.end(), axes.y_columns.begin(), axes.y_columns.end());
    step_table_.show_columns(columns);
  }



  void
  PlateTestResults::add_step(const PlateCell                     &cell,
                             const LoadStage                     &stage,
                             const AcceptedStep                  &step,
                             const std::vector<dealii::Point<3>> &woven)
  {
    memory_.energy_balance.add_step(stage.name,
                                    step.before.energies,
                                    step.after.energies);
    CurveRow         row = make_row(cell, stage, step);
    const Resultants averages =
      cell.averages(step.after.u, woven, stage.bends_along, step.after.natural);
    row.N           = averages.N;
    row.M           = averages.M;
    row.cpu_seconds = cpu_seconds();
    memory_.curve.push_back(row);
    if (curve_writer_)
      curve_writer_->write(row);
    step_table_.add_row(row, step.report.final_residual);

    const double load_factor = step.after.load_factor;
    log_.progress((memory_.stages_done + load_factor) /
                    parameters_.load_programme.stages.size(),
                  cpu_seconds());
    using Fields = OutputParameters::Fields;
    if (parameters_.output.fields == Fields::steps ||
        (parameters_.output.fields == Fields::stages && load_factor == 1.))
      {
        write_fields(cell, step.after, step.trial.contact);
        last_contact_.clear();
      }
    else if (parameters_.output.fields == Fields::stages)
      last_contact_ = step.trial.contact;
  }



  CurveRow
  PlateTestResults::make_row(const PlateCell    &cell,
                             const LoadStage    &stage,
                             const AcceptedStep &step) const
  {
    const State &state = step.after;
    CurveRow     row;
    row.step        = memory_.curve.size() + 1;
    row.stage       = stage.name;
    row.load_factor = state.load_factor;
    const bool goes_on =
      !memory_.curve.empty() && memory_.curve.back().stage == stage.name;
    const CurveRow *const before =
      goes_on ? &memory_.curve.back() :
                row_before(memory_.curve,
                           stage.name,
                           parameters_.load_programme.branches());
    if (before != nullptr)
      {
        row.dissipation   = before->dissipation;
        row.external_work = before->external_work;
      }
    // Weaving does work through its own offset, which is not counted.
    double work = 0;
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      {
        row.H[n]        = state.u[cell.macro().mode(n)];
        row.n[n]        = state.reactions[n];
        const double dH = row.H[n] - step.before.u[cell.macro().mode(n)];
        work += 0.5 * (state.reactions[n] + step.before.reactions[n]) * dH *
                cell.fabric().area();
      }
    // So do plates.
    const unsigned int k_plates = MacroUnknowns::n_macro;
    const double       closing  = state.u[cell.macro().plate_distance()] -
                           step.before.u[cell.macro().plate_distance()];
    work += 0.5 *
            (state.reactions[k_plates] + step.before.reactions[k_plates]) *
            closing;
    row.external_work += work;
    for (unsigned int k = 0; k < cell.contacts().size(); ++k)
      {
        const auto summary = cell.contacts()[k]->summary(step.trial.contact[k]);
        row.n_active += summary.n_active;
        row.n_stick += summary.n_stick;
        row.n_slip += summary.n_slip;
        row.contact_energy += summary.energy;
        row.friction_energy += summary.friction_energy;
        row.dissipation += summary.dissipation;
        row.largest_penetration =
          std::max(row.largest_penetration, summary.largest_penetration);
      }
    row.contact_energy = state.energies.contact; // with that of plates
    if (stage.type == LoadStage::Type::relax) // with what friction dissipates
      row.dissipation = (before != nullptr ? before->dissipation : 0.) +
                        state.energies.dissipation -
                        step.before.energies.dissipation;
    row.stored_energy     = state.energies.stored;
    row.newton_iterations = step.report.newton.iterations;
    row.newton_order      = step.report.newton.order();
    row.cuts              = step.n_cuts;
    const auto &columns   = Registry<CurveColumn>::instance();
    for (const std::string &name : columns.names())
      row.further[name] = columns.get(name).value({cell, step});
    return row;
  }



  void
  PlateTestResults::end_stage(const PlateCell                     &cell,
                              const LoadStage                     &stage,
                              const State                         &state,
                              const std::vector<dealii::Point<3>> &woven)
  {
    if (parameters_.output.picture)
      write_picture(cell, stage, state, woven);
    memory_.stages_done += 1;
    const auto &stages = parameters_.load_programme.stages;
    if (parameters_.output.exports.is_due(stage.name,
                                          memory_.stages_done == stages.size()))
      export_stage(cell, stage, state, woven);
  }



  void
  PlateTestResults::export_stage(const PlateCell                     &cell,
                                 const LoadStage                     &stage,
                                 const State                         &state,
                                 const std::vector<dealii::Point<3>> &woven)
  {
    if (directory_.empty())
      return;
    TimerOutput::Scope timer(timer_, "Output");
    const std::string  name =
      "cell_" + parameters_.load_programme.file_name(stage.name);
    const DeformedCell deformed{cell.fabric(),
                                cell.bodies().space(),
                                positions_of(cell, state),
                                woven,
                                gradients_of(cell.macro(), state.u),
                                stage.bends_along};
    // As a picture, an export is not worth a run.
    try
      {
        const ExportReport report = export_cell(deformed,
                                                cell.bodies().laws(),
                                                parameters_.output.exports,
                                                directory_ + "/" + name,
                                                "End of stage " + stage.name);
        for (const std::string &sentence : report.written)
          log_.line("Exported " + sentence);
        for (const std::string &sentence : report.refused)
          log_.warning("No export: " + sentence);
      }
    catch (const OutputError &failure)
      {
        log_.warning(std::string("No export: ") + failure.what());
        not_drawn_ = failure;
      }
  }



  void
  PlateTestResults::end_early(const PlateCell                     &cell,
                              const LoadStage                     &stage,
                              const State                         &state,
                              const std::vector<dealii::Point<3>> &woven)
  {
    // Else the last accepted step is the end of the stage before, which is
    // shown already.
    if (memory_.curve.empty() || memory_.curve.back().stage != stage.name)
      return;
    try
      {
        if (!last_contact_.empty())
          write_fields(cell, state, last_contact_);
      }
    catch (const std::runtime_error &failure)
      {
        log_.warning(std::string("There are no fields of the last step: ") +
                     failure.what());
      }
    if (parameters_.output.picture)
      write_picture(cell, stage, state, woven);
  }



  void
  PlateTestResults::write_fields(
    const PlateCell                         &cell,
    const State                             &state,
    const std::vector<ContactEvaluation<3>> &contact)
  {
    if (directory_.empty())
      return;
    TimerOutput::Scope timer(timer_, "Output");
    const auto        &bodies = cell.bodies();
    const double       time   = memory_.stages_done + state.load_factor;
    std::ostringstream number;
    number.width(4);
    number.fill('0');
    number << memory_.curve.size();

    const std::string bundles = "bundles-" + number.str() + ".vtu";
    write_vtu(directory_ + "/" + bundles,
              make_bundle_fields(bodies.space(),
                                 bodies.laws(),
                                 bodies.gradients(),
                                 state.u,
                                 state.natural));
    memory_.bundle_files.emplace_back(time, bundles);
    write_pvd(directory_ + "/fields.pvd", memory_.bundle_files);

    for (unsigned int k = 0; k < cell.contacts().size(); ++k)
      {
        const std::string name =
          "contact-" + std::to_string(k) + "-" + number.str() + ".vtu";
        const ContactCandidates &pair = cell.fabric().contacts()[k];
        write_vtu(directory_ + "/" + name,
                  make_contact_fields(bodies.space(),
                                      pair.secondary_bundle,
                                      pair.direction,
                                      pair.secondary_side,
                                      *cell.contacts()[k],
                                      contact[k],
                                      state.u));
        memory_.contact_files.emplace_back(time, name);
      }
    write_pvd(directory_ + "/contact.pvd", memory_.contact_files);
  }



  void
  PlateTestResults::write_picture(const PlateCell                     &cell,
                                  const LoadStage                     &stage,
                                  const State                         &state,
                                  const std::vector<dealii::Point<3>> &woven)
  {
    if (directory_.empty())
      return;
    TimerOutput::Scope timer(timer_, "Output");
    const IGASpace<3> &space = cell.bodies().space();
    PictureState       picture;
    picture.positions = positions_of(cell, state);
    for (const PointState &point :
         states_at_control_points(space,
                                  cell.bodies().laws(),
                                  cell.bodies().gradients(),
                                  state.u,
                                  state.natural))
      picture.values.push_back(point.von_mises);
    picture.woven       = woven;
    picture.bends_along = stage.bends_along;
    picture.H           = gradients_of(cell.macro(), state.u);

    std::ostringstream title;
    title << "Stage " << stage.name << ", load factor " << state.load_factor;
    for (const auto &[n, target] : stage.leads_yarns() ?
                                     std::map<unsigned int, double>() :
                                     stage.H_targets)
      title << ", " << MacroModes::table[n].name << " = "
            << MacroModes::with_unit(short_number(picture.H[n]),
                                     MacroModes::table[n].unit());
    for (const auto &[n, target] : stage.n_targets)
      title << ", " << MacroModes::table[n].conjugate << " = "
            << state.applied[n] << ' ' << MacroModes::table[n].conjugate_unit();
    for (const auto &[name, target] : stage.tester_targets)
      title << ", to " << TesterTargets::with_unit(name, target);
    const std::string name =
      "cell_" + parameters_.load_programme.file_name(stage.name);

    // A picture is not worth a run, so even a full disk does not end it here
    // but at the end.
    try
      {
        write_cell_picture(directory_,
                           name,
                           title.str(),
                           "von Mises stress [MPa]",
                           make_picture_surfaces(cell.fabric(),
                                                 space,
                                                 picture));
        memory_.cell_scripts.push_back(name + ".gp");
      }
    catch (const OutputError &failure)
      {
        log_.warning(std::string("The cell is not drawn: ") + failure.what());
        not_drawn_ = failure;
      }
  }



  void
  PlateTestResults::report_supports(const unsigned int   stage,
                                    const SupportForces &forces)
  {
    // A hundredth of what contact bears moves the curves by less than that.
    const double much = 0.01;
    if (std::abs(forces.normal) > much * forces.contact)
      log_.line("At the end of stage " +
                parameters_.load_programme.stages[stage].name +
                " the bent cell is held at its mean height by " +
                short_number(forces.normal, 2) +
                " N along the normal, spread over its volume, because there is "
                "tension along the curvature.");
    const auto  &stages   = parameters_.load_programme.stages;
    const double larger   = std::max(forces.foundation, forces.pins);
    const bool   is_small = larger <= much * forces.contact;
    const bool   fades = forces.foundation > 0. && stage + 1 < stages.size() &&
                       stages[stage + 1].type == LoadStage::Type::release;
    if (is_small && forces.foundation == 0.)
      return;
    const std::string sentence =
      "The supports at the end of stage " + stages[stage].name +
      ": foundation at most " + short_number(forces.foundation, 2) +
      " N on a bundle, pins " + short_number(forces.pins, 2) + " N, contact " +
      short_number(forces.contact, 3) + " N.";
    if (is_small || fades)
      log_.line(sentence);
    else
      log_.warning(
        sentence +
        (forces.foundation > 0. ?
           " Bundles hang on the foundation, which a stage of type release "
           "would fade out (Load programme/Stages)." :
           " The cell is not in equilibrium by itself. What to try: a smaller "
           "Relative tolerance (subsection Newton)."));
  }



  void
  PlateTestResults::draw_pictures()
  {
    TimerOutput::Scope        timer(timer_, "Output");
    std::vector<std::string> &cells = memory_.cell_scripts;
    std::vector<std::string>  scripts;
    if (parameters_.output.picture)
      {
        AxesOfStages axes;
        for (const LoadStage &stage : parameters_.load_programme.stages)
          if (const StageAxes own = tester_axes(stage); !own.x_column.empty())
            axes.emplace(stage.name, own);
        // First, because a script that fails ends gnuplot.
        if (write_curves_script(directory_,
                                axes,
                                parameters_.load_programme.branches()))
          scripts.push_back("curves.gp");
        else
          log_.warning(
            "There are no curves to draw: no stage has two load steps.");
      }
    scripts.insert(scripts.end(), cells.begin(), cells.end());
    cells.clear();
    if (scripts.empty())
      return;
    try
      {
        const std::string warning = run_gnuplot(directory_, scripts);
        if (!warning.empty())
          log_.warning(warning);
      }
    catch (const OutputError &failure)
      {
        log_.warning(failure.what());
        not_drawn_ = failure;
      }
  }



  void
  PlateTestResults::finish(const PlateCell    &cell,
                           const LinearSolver &linear_solver,
                           ConstrainedSystem  &system)
  {
    log_.finish();
    const StageStarts           starts = parameters_.load_programme.branches();
    const std::vector<CurveRow> last_test =
      memory_.curve.empty() ?
        memory_.curve :
        rows_to(memory_.curve, memory_.curve.back().stage, starts);
    if (const auto loop = last_loop(last_test, cell.fabric().area()))
      {
        log_.line(describe(*loop));
        if (!directory_.empty())
          write_hysteresis(directory_ + "/hysteresis.csv", *loop);
      }
    const auto kes = kes_values(memory_.curve, parameters_.kes, starts);
    if (!kes.empty())
      {
        log_.line(describe(kes));
        if (!directory_.empty())
          write_kes_values(directory_ + "/kes.csv", kes);
      }
    report_energies();
    warn_of_penetration();
    // All processes take part in the sums.
    const Ranks &ranks = cell.bodies().ranks();
    // A run that ends between two stages has no matrix.
    const std::size_t n_nonzeros =
      ranks.sum(system.has_pattern() ?
                  static_cast<double>(system.free_matrix().n_nonzeros()) :
                  0.);
    dealii::Utilities::System::MemoryStats memory;
    dealii::Utilities::System::get_memory_stats(memory);
    const double gigabytes = ranks.sum(1e-6 * memory.VmHWM);
    if (directory_.empty())
      return;
    draw_pictures();
    log_.line("Linear solver: " + linear_solver.description());
    log_.line("Factorizations: " + std::to_string(linear_solver.n_numeric()) +
              " (" + std::to_string(linear_solver.n_symbolic()) +
              " new patterns), " + std::to_string(system.n_free()) +
              " free unknowns, " + std::to_string(n_nonzeros) +
              " nonzeros; peak memory " + short_number(gigabytes, 2) + " GB" +
              (ranks.is_alone() ?
                 "" :
                 " on " + std::to_string(ranks.n()) + " processes"));
    if (const Ranks::Traffic *traffic = ranks.traffic())
      log_.line("Messages: " + std::to_string(traffic->n_calls) +
                " collective calls with " +
                short_number(1e-6 * traffic->bytes, 3) +
                " MB from each process; those of MUMPS come to this");
    timer_.print_summary();
  }



  void
  PlateTestResults::check_pictures() const
  {
    if (not_drawn_)
      throw OutputError(*not_drawn_);
  }



  void
  PlateTestResults::report_energies()
  {
    for (const std::string &line : memory_.energy_balance.table())
      log_.line(line);
    for (const std::string &warning : memory_.energy_balance.warnings(
           parameters_.stability.energy_tolerance))
      log_.warning(warning);
  }



  void
  PlateTestResults::warn_of_penetration()
  {
    // Up to about here results are off by some percent; deeper they describe
    // another fabric, and nothing in the curves shows it.
    const double much      = 0.05;
    const double thickness = parameters_.cell.bundle_thickness.smaller();
    const auto   deepest =
      std::max_element(memory_.curve.begin(),
                       memory_.curve.end(),
                       [](const CurveRow &a, const CurveRow &b) {
                         return a.largest_penetration < b.largest_penetration;
                       });
    if (deepest == memory_.curve.end() ||
        deepest->largest_penetration <= much * thickness)
      return;
    log_.warning(
      "The bundles penetrate each other by " +
      short_number(deepest->largest_penetration, 2) + " mm, " +
      short_number(100. * deepest->largest_penetration / thickness, 2) +
      " % of their thickness (stage " + deepest->stage + ", load factor " +
      short_number(deepest->load_factor, 3) +
      "). What to try: a larger Normal penalty, Enforcement = augmented "
      "Lagrangian (subsection Contact), or, if it begins with the first "
      "contact, a shorter Initial step of the weaving stage.");
  }
} // namespace NPT
