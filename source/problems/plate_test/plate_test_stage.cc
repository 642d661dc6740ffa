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
#include <optional>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::TimerOutput;
  using dealii::Vector;

  namespace
  {
    // Nodes nearer than this fraction of the thickness are about to touch:
    // their couplings enter the pattern.
    const double pattern_margin = 0.05;

    // A soft foundation keeps bundles that float before contact holds them
    // during weaving, and fades out in the release.
    bool
    has_foundation(const std::vector<LoadStage> &stages,
                   const unsigned int            index)
    {
      bool weaving_began = false;
      for (unsigned int k = 0; k <= index; ++k)
        weaving_began =
          weaving_began || stages[k].type == LoadStage::Type::weave;
      return weaving_began && (stages[index].type == LoadStage::Type::weave ||
                               stages[index].type == LoadStage::Type::release);
    }

    // The residual leaves out what the pins bear, so that it does work in a
    // rigid motion of the cell, in which images take part.
    double
    largest_pin_force(const PlateCell &cell, const Vector<double> &residual)
    {
      const auto is_free = cell.fabric().free_translations();
      double     largest = 0;
      for (unsigned int i = 0; i < 3; ++i)
        {
          double sum = 0;
          for (unsigned int k = i; k < cell.macro().first; k += 3)
            sum += residual[k];
          for (const PeriodicImage &image : cell.images())
            for (unsigned int l = 0; l < image.control_points.size(); ++l)
              sum += residual[image.first_unknown + 3 * l + i];
          if (is_free[i])
            largest = std::max(largest, std::abs(sum));
        }
      return largest;
    }

    // Of |force| on the control points [N].
    double
    sum_on_bundle(const IGASpace<3>    &space,
                  const unsigned int    bundle,
                  const Vector<double> &force)
    {
      double sum = 0;
      for (unsigned int l = 0; l < space.patch(bundle).n_control_points(); ++l)
        {
          const unsigned int A = space.control_point(bundle, l);
          sum +=
            Tensor<1, 3>({force[3 * A], force[3 * A + 1], force[3 * A + 2]})
              .norm();
        }
      return sum;
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
    , system_(system)
    , timer_(timer)
  {
    const auto &stages = parameters.load_programme.stages;
    if (stage_.bends_along)
      jumps_ = cell.objective_jumps(*stage_.bends_along);
    system.reinit(make_couplings(cell.fabric(),
                                 cell.bodies().space(),
                                 cell.macro(),
                                 cell.images(),
                                 woven,
                                 pins,
                                 jumps_.get()),
                  cell.macro().n_unknowns(),
                  jumps_);
    if (has_foundation(stages, index))
      foundation_ = WeavingFoundation(cell);
    cell_groups_ = cell.bodies().add_groups(system);
    set_loads(stages, before);
    set_prescribed(system);
    add_groups_of_jumps(system);
    foundation_.add_groups(system);
    start_ = make_start(before, index > 0 && stages[index - 1].friction);
    friction_let_go_ = before.energies.friction - start_.energies.friction;
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
    for (unsigned int k = 0; k < index_; ++k)
      {
        for (const auto &target : stages[k].H_targets)
          resultant_controlled_[target.first] = false;
        for (const auto &target : stages[k].n_targets)
          resultant_controlled_[target.first] = true;
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
        (index_ == 0 ||
         !parameters_.load_programme.stages[index_ - 1].bends_along))
      jumps_->raise(-mean_height_.value(start.u), start.u);
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
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      increment.applied.push_back(
        force_from_[n] + load_factor * (force_to_[n] - force_from_[n]));
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
      }
    const auto scope = section(timer_, "Tangent: bundles");
    mean_height_.add_tangent(trial.u, system);
    cell_.bodies().add_tangent(trial.u,
                               cell_groups_,
                               system,
                               increment.natural);
    return true;
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
    if (stability.stops_at_loss())
      {
        const auto scope = section(timer_, "Ellipticity");
        if (const auto loss =
              cell_.bodies().loss_of_ellipticity(after.u, after.natural))
          throw EllipticityLost(cell_.bodies().describe(*loss));
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



  SupportForces
  PlateTestStage::support_forces(const Increment &increment,
                                 const Trial     &trial) const
  {
    SupportForces forces;
    forces.foundation =
      foundation_.largest_force(trial.u,
                                foundation_share(increment.load_factor));
    if (jumps_ == nullptr)
      forces.pins = largest_pin_force(cell_, trial.residual);
    else
      {
        const Tensor<1, 3> sum = jumps_->sum_in_frames(trial.u, trial.residual);
        const auto         is_free = cell_.fabric().free_translations();
        for (unsigned int i = 0; i < 2; ++i)
          if (is_free[i])
            forces.pins = std::max(forces.pins, std::abs(sum[i]));
        forces.normal = mean_height_.force(trial.u);
      }
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        Vector<double> force(cell_.macro().n_unknowns());
        contacts()[k]->add_residual(increment.contact[k],
                                    trial.contact[k],
                                    force);
        forces.contact =
          std::max(forces.contact,
                   sum_on_bundle(cell_.bodies().space(),
                                 cell_.fabric().contacts()[k].secondary_bundle,
                                 force));
      }
    return forces;
  }



  State
  PlateTestStage::accept(const State     &before,
                         const Increment &increment,
                         const Trial     &trial) const
  {
    State state = EquilibriumProblem::accept(before, increment, trial);
    // Conjugates are the reactions of the macro unknowns over the area. The
    // residual excludes the applied load, so that they are the same for
    // prescribed H and prescribed n.
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      state.reactions.push_back(
        trial.condensed[system_.independent_index(cell_.macro().mode(n))] /
          cell_.fabric().area() +
        (resultant_controlled_[n] ? increment.applied[n] : 0.));
    state.reactions.push_back(
      trial
        .condensed[system_.independent_index(cell_.macro().weaving_offset())]);
    add_energies(before, trial, state);
    return state;
  }



  void
  PlateTestStage::add_energies(const State &before,
                               const Trial &trial,
                               State       &state) const
  {
    Energies &energies           = state.energies;
    energies.work                = before.energies.work;
    energies.work_uncertainty    = before.energies.work_uncertainty;
    energies.release_uncertainty = before.energies.release_uncertainty;
    energies.dissipation         = before.energies.dissipation;
    energies.stored = cell_.bodies().stored_energy(state.u, state.natural);
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        const ContactSummary summary = contacts()[k]->summary(trial.contact[k]);
        energies.contact += summary.energy;
        energies.friction += summary.friction_energy;
        energies.dissipation += summary.dissipation;
      }
    if (stage_.type == LoadStage::Type::relax)
      add_relaxation(before, trial, state);
    add_work(before, state);
  }



  // What bodies lose at the displacement before the step and at that behind it,
  // in the mean: exact where it does not change, as over all of a full
  // relaxation. Contact by the trapezoidal rule, which is exact then as well.
  void
  PlateTestStage::add_relaxation(const State &before,
                                 const Trial &trial,
                                 State       &state) const
  {
    const DeformableBodies &bodies   = cell_.bodies();
    Energies               &energies = state.energies;
    const double            loss_before =
      before.energies.stored - bodies.stored_energy(before.u, state.natural);
    const double loss =
      bodies.stored_energy(state.u, before.natural) - energies.stored;
    const double fraction = relaxed_fraction(state.load_factor) -
                            relaxed_fraction(before.load_factor);
    energies.relaxation_rate = relaxation_rate(trial.contact);
    const double rate_before = before.energies.relaxation_rate;
    energies.dissipation +=
      0.5 * (loss_before + loss +
             fraction * (rate_before + energies.relaxation_rate));
    energies.work_uncertainty +=
      0.5 * (std::abs(loss_before - loss) +
             fraction * std::abs(rate_before - energies.relaxation_rate));
  }



  // Of the forces on the macro unknowns, and of the release on the foundation,
  // whose springs it weakens.
  void
  PlateTestStage::add_work(const State &before, State &state) const
  {
    Energies  &energies = state.energies;
    const auto add      = [&](const double force_before,
                         const double force_after,
                         const double path) {
      energies.work += 0.5 * (force_before + force_after) * path;
      energies.work_uncertainty +=
        0.5 * std::abs((force_after - force_before) * path);
    };
    for (unsigned int k = 0; k < MacroUnknowns::n_macro; ++k)
      {
        const unsigned int unknown = cell_.macro().first + k;
        const double       area =
          k < MacroUnknowns::n_modes ? cell_.fabric().area() : 1.;
        add(area * before.reactions[k],
            area * state.reactions[k],
            state.u[unknown] - before.u[unknown]);
      }
    // What bodies lose while they relax after that is not known better.
    if (before.load_factor == 0.)
      energies.work_uncertainty += 2. * friction_let_go_;
    if (foundation_.is_empty())
      return;
    const double share        = foundation_share(state.load_factor);
    const double at_full      = foundation_.energy(state.u);
    const double share_before = foundation_share(before.load_factor);
    energies.foundation       = share * at_full;
    if (share != share_before)
      {
        const double work_before = energies.work_uncertainty;
        add(foundation_.energy(before.u), at_full, share - share_before);
        energies.release_uncertainty += energies.work_uncertainty - work_before;
      }
  }
} // namespace NPT
