// SPDX-License-Identifier: LGPL-2.1-or-later
// The equations of a stage of a contact benchmark.

#include <npt_dealii/verification/contact/handle_problem.h>

#include <cmath>

namespace NPT
{
  using dealii::Vector;

  HandleProblem::HandleProblem(const Model                     &model,
                               const std::vector<ContactStage> &stages,
                               const unsigned int               index,
                               const State                     &before,
                               ConstrainedSystem               &system)
    : model_(model)
    , system_(system)
    , handles_(model.n_handles)
    , start_(before)
  {
    for (unsigned int s = 0; s <= index; ++s)
      for (const HandleDrive &drive : stages[s].drives)
        {
          handles_[drive.handle].by_force = drive.force;
          if (s == index)
            handles_[drive.handle].value = drive.value;
        }
    std::vector<bool> prescribed(system.n_independent(), false);
    for (unsigned int k = 0; k < handles_.size(); ++k)
      {
        Handle &handle = handles_[k];
        // A force that is switched on goes on from the present reaction.
        handle.start =
          handle.by_force ? before.reactions[k] : before.u[unknown(k)];
        prescribed[system.independent_index(unknown(k))] = !handle.by_force;
      }
    system.set_prescribed(prescribed);
    system.forget_pattern();

    const bool friction = stages[index].friction;
    const bool begins = friction && (index == 0 || !stages[index - 1].friction);
    start_.load_factor = 0;
    for (unsigned int k = 0; k < start_.contact.size(); ++k)
      {
        const ContactPair<3> &pair = *model.contacts[k];
        start_.contact[k] = pair.with_friction(start_.contact[k], friction);
        if (begins)
          start_.contact[k] = pair.start_friction(start_.contact[k], start_.u);
      }
  }



  State
  HandleProblem::initial_state(const Model &model)
  {
    State state;
    state.u.reinit(model.bodies.n_displacements() + model.n_handles);
    state.applied.assign(model.n_handles, 0.);
    state.reactions.assign(model.n_handles, 0.);
    for (const auto &pair : model.contacts)
      state.contact.push_back(pair->initial_state());
    return state;
  }



  Increment
  HandleProblem::increment(const State &accepted,
                           const double load_factor) const
  {
    Increment increment;
    increment.load_factor = load_factor;
    increment.applied.assign(handles_.size(), 0.);
    system_.restrict_to_independent(accepted.u, increment.target);
    for (unsigned int k = 0; k < handles_.size(); ++k)
      {
        const double value = handles_[k].value(handles_[k].start, load_factor);
        if (handles_[k].by_force)
          increment.applied[k] = value;
        else
          increment.target[system_.independent_index(unknown(k))] = value;
      }
    increment.contact = begin_contact(accepted);
    return increment;
  }



  void
  HandleProblem::evaluate(const Increment &increment, Trial &trial) const
  {
    trial.residual.reinit(trial.u.size());
    const double solids = model_.bodies.add_residual(trial.u, trial.residual);

    Vector<double> force(trial.u.size());
    add_contact_forces(increment, trial, force);
    trial.residual += force;
    for (unsigned int k = 0; k < handles_.size(); ++k)
      if (handles_[k].by_force)
        trial.residual[unknown(k)] -=
          increment.applied[k] / model_.force_factor;
    // Convergence is measured against the forces before they cancel.
    trial.force_scale = std::sqrt(solids * solids + force.norm_sqr());
  }



  bool
  HandleProblem::add_tangent(const Increment   &increment,
                             const Trial       &trial,
                             ConstrainedSystem &system) const
  {
    if (!add_contact_tangent(increment, trial, system))
      return false;
    model_.bodies.add_tangent(trial.u, model_.groups, system);
    return true;
  }



  std::vector<std::vector<unsigned int>>
  HandleProblem::couplings(const Increment &increment, const Trial &trial) const
  {
    return contact_couplings(increment, trial, model_.pattern_margin);
  }



  State
  HandleProblem::accept(const State     &before,
                        const Increment &increment,
                        const Trial     &trial) const
  {
    State state = EquilibriumProblem::accept(before, increment, trial);
    // The residual excludes applied forces only for handles driven by value.
    for (unsigned int k = 0; k < handles_.size(); ++k)
      state.reactions.push_back(
        model_.force_factor *
        (trial.condensed[system_.independent_index(unknown(k))] +
         (handles_[k].by_force ? increment.applied[k] / model_.force_factor :
                                 0.)));
    return state;
  }
} // namespace NPT
