// SPDX-License-Identifier: LGPL-2.1-or-later
// The equations of a stage of a plate test.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/load_step/branch_left.h>
#include <npt_dealii/problems/load_programme/macro_limits.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::TimerOutput;
  using dealii::Vector;

  namespace
  {
    // Plates and layers begin so much of the thickness deep in the highest
    // points, so that a pressure finds something to act on. With a penalty the
    // stiffness does not depend on the depth, and the energy is round-off.
    const double plate_overlap = 1e-9;

    // Nodes nearer than this fraction of the thickness are about to touch:
    // their couplings enter the pattern.
    const double pattern_margin = 0.05;

    // A loss of ellipticity is believed of steps no longer than this fraction
    // of the Maximum step.
    constexpr double shortest_step_to_doubt = 0.26;

    constexpr unsigned int n_membrane_modes = 3;

    // A soft foundation keeps bundles that float before contact holds them
    // during weaving, and fades out in the release.
    bool
    has_foundation(const std::vector<LoadStage> &stages,
                   const unsigned int            index)
    {
      bool weaving_began = false;
      for (const unsigned int k : path_to(stages, index))
        weaving_began =
          weaving_began || stages[k].type == LoadStage::Type::weave;
      return weaving_began && (stages[index].type == LoadStage::Type::weave ||
                               stages[index].type == LoadStage::Type::release);
    }

    std::optional<TimerOutput::Scope>
    section(TimerOutput *timer, const std::string &name)
    {
      std::optional<TimerOutput::Scope> scope;
      if (timer != nullptr)
        scope.emplace(*timer, name);
      return scope;
    }
  } // namespace



  PlateTestStage::PlateTestStage(const PlateCell           &cell,
                                 const PlateTestParameters &parameters,
                                 const unsigned int         index,
                                 const State               &before,
                                 const std::vector<dealii::Point<3>> &woven,
                                 ConstrainedSystem                   &system,
                                 TimerOutput                         *timer,
                                 const Pins                          &pins)
    : cell_(cell)
    , parameters_(parameters)
    , index_(index)
    , stage_(parameters.load_programme.stages[index])
    , stage_before_(
        index == 0 ?
          nullptr :
          &parameters.load_programme
             .stages[*stage_before(parameters.load_programme.stages, index)])
    , system_(system)
    , timer_(timer)
  {
    const auto &stages = parameters.load_programme.stages;
    if (stage_.bends_along)
      jumps_ = cell.objective_jumps(*stage_.bends_along);
    const double size = length_unit(parameters.cell);
    frame_            = FrameDrive(stage_,
                        cell.macro(),
                        before,
                        cell.fabric().area(),
                        force_unit() / (size * size));
    if (stage_.type == LoadStage::Type::compression)
      plates_ = PressPlates(cell,
                            parameters.contact.normal_penalty,
                            parameters.contact.n_quadrature_points);
    system.reinit(make_couplings(cell.fabric(),
                                 cell.bodies().space(),
                                 cell.macro(),
                                 cell.images(),
                                 woven,
                                 pins,
                                 jumps_.get(),
                                 {frame_.uses_support(), plates_.are_used()}),
                  cell.macro().n_unknowns(),
                  jumps_);
    if (has_foundation(stages, index))
      foundation_ = WeavingFoundation(cell);
    cell_groups_ = cell.bodies().add_groups(system);
    set_loads(stages, before);
    set_prescribed(system);
    add_groups_of_jumps(system);
    foundation_.add_groups(system);
    frame_.add_group(system);
    plates_.add_groups(system);
    start_ =
      make_start(before, stage_before_ != nullptr && stage_before_->friction);
    friction_let_go_ = before.energies.friction - start_.energies.friction;
    if (plates_.are_used())
      {
        plates_.rest_springs(start_.u);
        set_plate_loads();
      }
    if (stage_.type == LoadStage::Type::relax)
      begin_relaxation();
  }



  double
  PlateTestStage::relaxed_fraction(const double load_factor) const
  {
    return stage_.relaxed_fraction * load_factor;
  }



  void
  PlateTestStage::begin_relaxation()
  {
    std::vector<ContactEvaluation<3>> contact(contacts().size());
    const auto                        steps = begin_contact(start_);
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        contacts()[k]->evaluate(steps[k], start_.u, contact[k]);
        gaps_at_start_.emplace_back();
        for (const NodeState<3> &node : contact[k].nodes)
          gaps_at_start_.back().push_back(node.gap);
      }
    start_.energies.relaxation_rate = relaxation_rate(contact);
  }



  // -dE/dphi of contact at a fixed displacement, linear in phi.
  double
  PlateTestStage::relaxation_rate(
    const std::vector<ContactEvaluation<3>> &contact) const
  {
    double rate = 0;
    for (unsigned int k = 0; k < contacts().size(); ++k)
      rate += contacts()[k]->relaxation_rate(contact[k], gaps_at_start_[k]);
    return rate;
  }



  // Where the macro unknowns come from and go to.
  void
  PlateTestStage::set_loads(const std::vector<LoadStage> &stages,
                            const State                  &before)
  {
    for (const unsigned int k : path_to(stages, index_))
      {
        if (k == index_)
          break;
        for (const auto &target : stages[k].H_targets)
          resultant_controlled_[target.first] = false;
        for (const auto &target : stages[k].n_targets)
          resultant_controlled_[target.first] = true;
        if (stages[k].leads_yarns())
          lead_yarns(false);
      }

    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      from_[k] = to_[k] = before.u[cell_.macro().first + k];
    if (stage_.type == LoadStage::Type::weave)
      to_[MacroUnknowns::n_modes] =
        cell_.fabric().weaving_offset() * (1. - parameters_.cell.weaving_depth);
    for (const auto &target : stage_.H_targets)
      {
        to_[target.first]                   = target.second;
        resultant_controlled_[target.first] = false;
      }
    // A component that is freed goes on from its present reaction.
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      force_from_[n] = force_to_[n] =
        resultant_controlled_[n] ? before.applied[n] : before.reactions[n];
    for (const auto &target : stage_.n_targets)
      {
        force_to_[target.first]             = target.second;
        resultant_controlled_[target.first] = true;
      }
    if (!stage_.leads_yarns())
      return;
    // What the drive exerts is its own.
    lead_yarns(frame_.uses_support());
    for (unsigned int n = 0; n < n_membrane_modes; ++n)
      force_from_[n] = force_to_[n] = 0.;
  }



  void
  PlateTestStage::lead_yarns(const bool by_forces)
  {
    for (unsigned int n = 0; n < n_membrane_modes; ++n)
      resultant_controlled_[n] = by_forces;
  }



  bool
  PlateTestStage::pressure_controlled() const
  {
    return stage_.tester_target("pressure").has_value();
  }



  void
  PlateTestStage::set_plate_loads()
  {
    plate_distance_from_ = start_.u[cell_.macro().plate_distance()];
    plate_distance_to_ =
      stage_.tester_target("plate_distance").value_or(plate_distance_from_);
    pressure_from_ =
      -start_.reactions[MacroUnknowns::n_macro] / cell_.fabric().area();
    pressure_to_ = stage_.tester_target("pressure").value_or(pressure_from_);
  }



  void
  PlateTestStage::set_prescribed(ConstrainedSystem &system) const
  {
    std::vector<bool> prescribed(system.n_independent(), false);
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      {
        const int index = system.independent_index(cell_.macro().first + k);
        AssertThrow(index >= 0, dealii::ExcInternalError());
        prescribed[index] =
          k == MacroUnknowns::n_modes || !resultant_controlled_[k];
      }
    if (plates_.are_used())
      prescribed[system.independent_index(cell_.macro().plate_distance())] =
        !pressure_controlled();
    system.set_prescribed(prescribed);
  }



  double
  PlateTestStage::foundation_share(const double load_factor) const
  {
    return stage_.type == LoadStage::Type::release ? 1. - load_factor : 1.;
  }



  State
  PlateTestStage::make_start(const State &before,
                             const bool   friction_was_on) const
  {
    // The accepted state must obey the couplings of the new stage: dropping a
    // condition never moves it, and its tiny round-off is removed here. Only
    // the first objective stage moves the cell, which the pins have put
    // somewhere else, to its mean height.
    State start = before;
    if (jumps_ != nullptr &&
        (stage_before_ == nullptr || !stage_before_->bends_along))
      {
        jumps_->raise(-mean_height_.value(start.u), start.u);
        start.u[cell_.macro().support()] = 0.; // of a frame before
      }
    if (jumps_ == nullptr)
      start.u[cell_.macro().support()] = frame_.support_at_start();
    move_plates(start);
    Vector<double> m, expanded;
    system_.restrict_to_independent(start.u, m);
    system_.expand(m, expanded);
    expanded -= start.u;
    AssertThrow(expanded.linfty_norm() < 1e-8 * cell_.fabric().weaving_offset(),
                dealii::ExcMessage("The state at the start of stage " +
                                   stage_.name +
                                   " violates the couplings of the stage."));
    start.u += expanded;
    start.load_factor = 0;

    for (unsigned int k = 0; k < start.contact.size(); ++k)
      {
        const ContactPair<3> &pair = *contacts()[k];
        start.contact[k] =
          pair.with_friction(start.contact[k], stage_.friction);
        if (stage_.friction && !friction_was_on)
          start.contact[k] = pair.start_friction(start.contact[k], start.u);
      }
    // Friction that is switched off lets go: its energy is lost.
    if (!stage_.friction)
      {
        start.energies.dissipation += start.energies.friction;
        start.energies.friction = 0;
      }
    return start;
  }



  void
  PlateTestStage::move_plates(State &start) const
  {
    const bool there_already =
      stage_before_ != nullptr &&
      stage_before_->type == LoadStage::Type::compression;
    double      &reaction = start.reactions[MacroUnknowns::n_macro];
    const double overlap =
      plate_overlap * parameters_.cell.bundle_thickness.smaller();
    if (plates_.are_used() && !there_already)
      {
        lower_layers(overlap, start);
        plates_.let_touch(overlap, start.u);
        reaction = -plates_.force(start.u);
      }
    if (plates_.are_used() || !there_already)
      return;
    // Plates that are taken away let go.
    PressPlates gone(cell_,
                     parameters_.contact.normal_penalty,
                     parameters_.contact.n_quadrature_points);
    gone.rest_springs(start.u);
    const double energy = gone.energy(start.u);
    start.energies.contact -= energy;
    start.energies.dissipation += energy;
    start.u[cell_.macro().plate_distance()] = 0.;
    start.u[cell_.macro().plate_center()]   = 0.;
    reaction                                = 0.;
  }



  /*
   * Without contact between them layers do no work when they move. No layer
   * gets nearer to the next one by more than it moves, so none can miss it.
   */
  void
  PlateTestStage::lower_layers(const double overlap, State &start) const
  {
    const FabricCell  &fabric   = cell_.fabric();
    const IGASpace<3> &space    = cell_.bodies().space();
    const unsigned int n_layers = fabric.n_layers();
    const double       near     = 0.1 * overlap;
    const unsigned int most     = 200; // of them a few are needed
    for (unsigned int iteration = 0; n_layers > 1 && iteration < most;
         ++iteration)
      {
        std::vector<double> gap = gaps_between_layers(start);
        const bool touch   = *std::max_element(gap.begin(), gap.end()) < near;
        double     lowered = 0;
        for (unsigned int k = 1; k < n_layers; ++k)
          {
            lowered += touch ? overlap : gap[k - 1];
            for (unsigned int b = fabric.first_bundle(k);
                 b < fabric.first_bundle(k + 1);
                 ++b)
              for (unsigned int l = 0; l < space.patch(b).n_control_points();
                   ++l)
                start.u[3 * space.control_point(b, l) + 2] -= lowered;
          }
        Vector<double> m;
        system_.restrict_to_independent(start.u, m);
        system_.expand(m, start.u);
        if (touch)
          return;
      }
    if (n_layers > 1)
      throw StageFailed("Stage " + stage_.name +
                        " could not bring the layers into contact: some never "
                        "meet the next one. Look at the Layer shift "
                        "(subsection Cell).");
  }



  std::vector<double>
  PlateTestStage::gaps_between_layers(const State &start) const
  {
    const FabricCell   &fabric = cell_.fabric();
    std::vector<double> gap(fabric.n_layers() - 1,
                            std::numeric_limits<double>::max());
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        const ContactCandidates &pair = fabric.contacts()[k];
        if (!pair.between_layers)
          continue;
        const ContactStep<3> step =
          contacts()[k]->begin_step(start.contact[k], start.u);
        ContactEvaluation<3> evaluation;
        contacts()[k]->evaluate(step, start.u, evaluation);
        double &smallest = gap[fabric.bundles()[pair.secondary_bundle].layer];
        for (const auto &closest : evaluation.closest)
          smallest = std::min(smallest, closest.gap);
      }
    return gap;
  }



  Increment
  PlateTestStage::increment(const State &accepted,
                            const double load_factor) const
  {
    Increment increment;
    increment.load_factor = load_factor;
    system_.restrict_to_independent(accepted.u, increment.target);
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      if (k == MacroUnknowns::n_modes || !resultant_controlled_[k])
        increment.target[system_.independent_index(cell_.macro().first + k)] =
          from_[k] + load_factor * (to_[k] - from_[k]);
    if (const auto H = frame_.gradients(load_factor))
      for (unsigned int n = 0; n < n_membrane_modes; ++n)
        increment.target[system_.independent_index(cell_.macro().mode(n))] =
          (*H)[n];
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      increment.applied.push_back(
        force_from_[n] + load_factor * (force_to_[n] - force_from_[n]));
    if (plates_.are_used())
      {
        increment
          .target[system_.independent_index(cell_.macro().plate_distance())] =
          plate_distance_from_ +
          load_factor * (plate_distance_to_ - plate_distance_from_);
        increment.applied.push_back(
          pressure_from_ + load_factor * (pressure_to_ - pressure_from_));
      }
    increment.natural = accepted.natural;
    if (stage_.type != LoadStage::Type::relax)
      {
        increment.contact = begin_contact(accepted);
        return increment;
      }
    const double before = relaxed_fraction(accepted.load_factor);
    const double now    = relaxed_fraction(load_factor);
    increment.natural   = cell_.bodies().relax(start_.u, start_.natural, now);
    State relaxed       = accepted;
    for (unsigned int k = 0; k < contacts().size(); ++k)
      relaxed.contact[k] = contacts()[k]->relax(accepted.contact[k],
                                                gaps_at_start_[k],
                                                before,
                                                now);
    increment.contact = begin_contact(relaxed);
    return increment;
  }



  void
  PlateTestStage::evaluate(const Increment &increment, Trial &trial) const
  {
    const MacroUnknowns  &macro = cell_.macro();
    const Vector<double> &u     = trial.u;
    Vector<double>       &R     = trial.residual;
    R.reinit(macro.n_unknowns());
    {
      const auto scope  = section(timer_, "Residual: bundles");
      trial.force_scale = cell_.bodies().add_residual(u, R, increment.natural);
    }
    {
      const auto     scope = section(timer_, "Residual: contact");
      Vector<double> force(macro.n_unknowns());
      add_contact_forces(increment, trial, force);
      R += force;
      // Convergence is measured against the forces before they cancel: those
      // of the cells on their control points, and of contact.
      trial.force_scale =
        std::sqrt(trial.force_scale * trial.force_scale + force.norm_sqr());
    }
    foundation_.add_residual(u, foundation_share(increment.load_factor), R);
    // Prescribed resultants act on the macro unknowns.
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      if (resultant_controlled_[n])
        R[macro.mode(n)] -= increment.applied[n] * cell_.fabric().area();
    mean_height_.add_residual(u, R);
    frame_.add_residual(increment.load_factor, u, R);
    plates_.add_residual(u, R);
    if (plates_.are_used() && pressure_controlled())
      R[macro.plate_distance()] +=
        increment.applied.back() * cell_.fabric().area();
  }



  void
  PlateTestStage::add_groups_of_jumps(ConstrainedSystem &system)
  {
    if (jumps_ == nullptr)
      return;
    mean_height_ = MeanHeight(cell_,
                              *stage_.bends_along,
                              force_unit() / length_unit(parameters_.cell));
    mean_height_.add_groups(cell_groups_, system);
    for (std::vector<unsigned int> group : jumps_->groups())
      {
        for (unsigned int &k : group)
          k = system.row_of_v(k);
        jump_groups_.push_back(system.add_group(group));
      }
  }



  void
  PlateTestStage::add_tangent_of_jumps(const Trial       &trial,
                                       ConstrainedSystem &system) const
  {
    Vector<double> v;
    jumps_->invert(trial.u, v);
    jumps_->second_derivatives(v,
                               trial.residual,
                               [&](const unsigned int         group,
                                   const std::vector<double> &matrix) {
                                 system.add(jump_groups_[group], matrix);
                               });
  }



  double
  PlateTestStage::lever_arm(const unsigned int unknown) const
  {
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      if (unknown == cell_.macro().mode(n))
        return displacement_unit(parameters_.cell, n);
    return 1.;
  }



  std::vector<std::vector<unsigned int>>
  PlateTestStage::couplings(const Increment &increment,
                            const Trial     &trial) const
  {
    return contact_couplings(increment,
                             trial,
                             pattern_margin *
                               parameters_.cell.bundle_thickness.smaller());
  }



  bool
  PlateTestStage::add_tangent(const Increment   &increment,
                              const Trial       &trial,
                              ConstrainedSystem &system) const
  {
    {
      const auto scope = section(timer_, "Tangent: contact");
      if (!add_contact_tangent(increment, trial, system))
        return false;
    }
    if (ranks().is_first())
      {
        foundation_.add_tangent(foundation_share(increment.load_factor),
                                system);
        if (jumps_ != nullptr)
          add_tangent_of_jumps(trial, system);
        frame_.add_tangent(increment.load_factor, trial.u, system);
        plates_.add_tangent(trial.u, system);
      }
    const auto scope = section(timer_, "Tangent: bundles");
    mean_height_.add_tangent(trial.u, trial.force_scale, system);
    cell_.bodies().add_tangent(trial.u,
                               cell_groups_,
                               system,
                               increment.natural);
    return true;
  }



  // Newton's method may land on a state that no path leads to, with elements
  // folded up; a shorter step then finds the other one. A loss that is on the
  // path is met by shorter steps, too.
  bool
  PlateTestStage::may_be_spurious(const State &before, const State &after) const
  {
    const double          step  = after.load_factor - before.load_factor;
    const StepParameters &steps = stage_.steps;
    // A fine mesh that goes on from a coarse one has its one step.
    return step > shortest_step_to_doubt * steps.maximum_step && step < 1. &&
           0.5 * step >= steps.minimum_step &&
           !cell_.bodies().loss_of_ellipticity(before.u, before.natural);
  }



  void
  PlateTestStage::check(const State &before, const State &after) const
  {
    // Prescribed gradients were checked when the file was read; resultants
    // may lead anywhere.
    KnownGradients H;
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      H[n] = after.u[cell_.macro().mode(n)];
    const std::string obstacle =
      obstacle_of_gradients(H, 0.5 * layer_thickness(parameters_.cell));
    if (!obstacle.empty())
      throw CellCollapsed(obstacle);
    const StabilityParameters &stability = parameters_.stability;
    {
      const auto scope = section(timer_, "Ellipticity");
      const auto loss =
        cell_.bodies().loss_of_ellipticity(after.u, after.natural);
      if (loss && (stability.stops_at_loss() || may_be_spurious(before, after)))
        throw EllipticityLost(cell_.bodies().describe(*loss));
      checked_is_elliptic_ = !loss;
    }
    const EnergyChange step(before.energies, after.energies);
    if (!step.is_jump(stability.energy_tolerance))
      return;
    std::ostringstream detail;
    detail.precision(3);
    detail << "its work " << step.work << " N mm, known up to "
           << step.uncertainty << " N mm, and the growth of the energies "
           << step.growth << " N mm plus the dissipation " << step.dissipation
           << " N mm differ by more than the tolerance of the energy "
           << step.content << " N mm";
    throw BranchLeft(detail.str());
  }
} // namespace NPT
