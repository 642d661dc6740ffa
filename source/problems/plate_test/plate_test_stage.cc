// SPDX-License-Identifier: LGPL-2.1-or-later
// The equations of a stage of a plate test.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/load_step/branch_left.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/macro_limits.h>
#include <npt_dealii/problems/plate_test/plate_test_stage.h>

#include <cmath>
#include <optional>
#include <sstream>

namespace NPT
{
  using dealii::TimerOutput;
  using dealii::Vector;

  namespace
  {
    // Of the foundation in weaving [N/mm per mm^3 of bundle]: four orders
    // below the stiffness of contact, so that it moves nothing by itself.
    const double foundation_stiffness = 0.01;

    // Nodes nearer than this fraction of the thickness are about to touch:
    // their couplings enter the pattern.
    const double pattern_margin = 0.02;

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
    system.reinit(make_couplings(cell.fabric(),
                                 cell.bodies().space(),
                                 cell.macro(),
                                 cell.images(),
                                 woven,
                                 pins),
                  cell.macro().n_unknowns());
    cell_groups_ = cell.bodies().add_groups(system);
    set_loads(stages, before);
    set_prescribed(system);
    make_foundation(stages);
    start_ = make_start(before, index > 0 && stages[index - 1].friction);
    friction_let_go_ = before.energies.friction - start_.energies.friction;
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



  /*
   * Before contact holds them, the bundles of a cell that is coupled by
   * translations can float apart vertically, and bundles that no 2-fold axis
   * goes through also in plane. A soft foundation keeps them during weaving and
   * fades out in the release.
   */
  void
  PlateTestStage::make_foundation(const std::vector<LoadStage> &stages)
  {
    bool weaving_began = false;
    for (unsigned int k = 0; k <= index_; ++k)
      weaving_began = weaving_began || stages[k].type == LoadStage::Type::weave;
    if (stage_.type == LoadStage::Type::load || !weaving_began ||
        !cell_.fabric().needs_vertical_pin())
      return;
    const auto         integrals = cell_.bodies().integrals_of_functions(true);
    const unsigned int first = cell_.fabric().has_floating_bundles() ? 0 : 2;
    foundation_.assign(3 * integrals.size(), 0.);
    for (unsigned int A = 0; A < integrals.size(); ++A)
      for (unsigned int i = first; i < 3; ++i)
        foundation_[3 * A + i] = foundation_stiffness * integrals[A];
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
    // condition never moves it, and its tiny round-off is removed here.
    State          start = before;
    Vector<double> m, expanded;
    system_.restrict_to_independent(before.u, m);
    system_.expand(m, expanded);
    expanded -= before.u;
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
    increment.contact = begin_contact(accepted);
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
      trial.force_scale = cell_.bodies().add_residual(u, R);
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
    const double share = foundation_share(increment.load_factor);
    for (unsigned int k = 0; k < foundation_.size(); ++k)
      R[k] += share * foundation_[k] * u[k];
    // Prescribed resultants act on the macro unknowns.
    for (unsigned int n = 0; n < MacroUnknowns::n_modes; ++n)
      if (resultant_controlled_[n])
        R[macro.mode(n)] -= increment.applied[n] * cell_.fabric().area();
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
    const double share = foundation_share(increment.load_factor);
    for (unsigned int k = 0; k < foundation_.size(); ++k)
      if (foundation_[k] > 0.)
        system.add(std::vector<unsigned int>(1, k),
                   std::vector<double>(1, share * foundation_[k]));
    const auto scope = section(timer_, "Tangent: bundles");
    cell_.bodies().add_tangent(trial.u, cell_groups_, system);
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
        if (const auto loss = cell_.bodies().loss_of_ellipticity(after.u))
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
    energies.stored              = cell_.bodies().stored_energy(state.u);
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        const ContactSummary summary = contacts()[k]->summary(trial.contact[k]);
        energies.contact += summary.energy;
        energies.friction += summary.friction_energy;
        energies.dissipation += summary.dissipation;
      }
    add_work(before, state);
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
    if (foundation_.empty())
      return;
    const double share        = foundation_share(state.load_factor);
    const double at_full      = foundation_energy(state.u);
    const double share_before = foundation_share(before.load_factor);
    energies.foundation       = share * at_full;
    if (share != share_before)
      {
        const double work_before = energies.work_uncertainty;
        add(foundation_energy(before.u), at_full, share - share_before);
        energies.release_uncertainty += energies.work_uncertainty - work_before;
      }
  }



  double
  PlateTestStage::foundation_energy(const Vector<double> &u) const
  {
    double energy = 0;
    for (unsigned int k = 0; k < foundation_.size(); ++k)
      energy += 0.5 * foundation_[k] * u[k] * u[k];
    return energy;
  }
} // namespace NPT
