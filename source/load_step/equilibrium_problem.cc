// SPDX-License-Identifier: LGPL-2.1-or-later
// What most problems share: contact pairs, and accepting a step.

#include <npt_dealii/load_step/equilibrium_problem.h>

namespace NPT
{
  std::vector<std::vector<unsigned int>>
  EquilibriumProblem::couplings(const Increment &, const Trial &) const
  {
    return {};
  }



  double
  EquilibriumProblem::force_unit() const
  {
    return 0.;
  }



  double
  EquilibriumProblem::lever_arm(const unsigned int) const
  {
    return 1.;
  }



  void
  EquilibriumProblem::check(const State &, const State &) const
  {}



  const Ranks &
  EquilibriumProblem::ranks() const
  {
    static const Ranks alone;
    return alone;
  }



  const ContactPairs &
  EquilibriumProblem::contacts() const
  {
    static const ContactPairs none;
    return none;
  }



  State
  EquilibriumProblem::accept(const State &,
                             const Increment &increment,
                             const Trial     &trial) const
  {
    State state;
    state.u           = trial.u;
    state.load_factor = increment.load_factor;
    state.applied     = increment.applied;
    state.natural     = increment.natural;
    for (unsigned int k = 0; k < contacts().size(); ++k)
      state.contact.push_back(
        contacts()[k]->accept(increment.contact[k], trial.contact[k]));
    return state;
  }



  std::vector<ContactStep<3>>
  EquilibriumProblem::begin_contact(const State &accepted) const
  {
    AssertDimension(accepted.contact.size(), contacts().size());
    std::vector<ContactStep<3>> steps;
    for (unsigned int k = 0; k < contacts().size(); ++k)
      steps.push_back(
        contacts()[k]->begin_step(accepted.contact[k], accepted.u, ranks()));
    return steps;
  }



  void
  EquilibriumProblem::add_contact_forces(const Increment        &increment,
                                         Trial                  &trial,
                                         dealii::Vector<double> &force) const
  {
    AssertDimension(increment.contact.size(), contacts().size());
    trial.contact.resize(contacts().size());
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        const ContactPair<3> &pair = *contacts()[k];
        pair.evaluate(increment.contact[k], trial.u, trial.contact[k], ranks());
        pair.add_residual(increment.contact[k], trial.contact[k], force);
      }
  }



  bool
  EquilibriumProblem::add_contact_tangent(const Increment   &increment,
                                          const Trial       &trial,
                                          ConstrainedSystem &system) const
  {
    AssertDimension(trial.contact.size(), contacts().size());
    bool has_all_couplings = true;
    for (unsigned int k = 0; k < contacts().size(); ++k)
      contacts()[k]->add_tangent(
        increment.contact[k],
        trial.contact[k],
        [&](const std::vector<unsigned int> &unknowns,
            const std::vector<double>       &K) {
          if (!system.add(unknowns, K))
            has_all_couplings = false;
        },
        ranks());
    return ranks().all(has_all_couplings);
  }



  std::vector<std::vector<unsigned int>>
  EquilibriumProblem::contact_couplings(const Increment &increment,
                                        const Trial     &trial,
                                        const double     margin) const
  {
    AssertDimension(trial.contact.size(), contacts().size());
    std::vector<std::vector<unsigned int>> groups;
    for (unsigned int k = 0; k < contacts().size(); ++k)
      {
        const auto more = contacts()[k]->coupled_unknowns(increment.contact[k],
                                                          trial.contact[k],
                                                          margin);
        groups.insert(groups.end(), more.begin(), more.end());
      }
    return groups;
  }
} // namespace NPT
