// SPDX-License-Identifier: LGPL-2.1-or-later
// The equations of a test of a micro cell.

#include <npt_dealii/problems/material_test/micro_cell_problem.h>

#include <cmath>

namespace NPT
{
  MicroCellProblem::MicroCellProblem(const DeformableBodies             &bodies,
                                     const DeformableBodies::CellGroups &groups,
                                     const SolidMacroUnknowns           &macro,
                                     const double                        volume,
                                     const MaterialTest                 &test,
                                     ConstrainedSystem                  &system)
    : bodies_(bodies)
    , groups_(groups)
    , macro_(macro)
    , volume_(volume)
    , test_(test)
    , system_(system)
  {
    std::vector<bool> prescribed(system.n_independent(), false);
    for (unsigned int e = 0; e < SolidMacroUnknowns::n_macro; ++e)
      prescribed[system.independent_index(macro.first + e)] =
        !test.stress_controlled[e];
    system.set_prescribed(prescribed);
  }



  State
  MicroCellProblem::natural_state() const
  {
    State state;
    state.u.reinit(macro_.n_unknowns());
    state.applied.assign(SolidMacroUnknowns::n_macro, 0.);
    state.reactions.assign(SolidMacroUnknowns::n_macro, 0.);
    return state;
  }



  Increment
  MicroCellProblem::increment(const State &accepted,
                              const double load_factor) const
  {
    Increment increment;
    increment.load_factor = load_factor;
    system_.restrict_to_independent(accepted.u, increment.target);
    increment.applied.assign(SolidMacroUnknowns::n_macro, 0.);
    for (unsigned int e = 0; e < SolidMacroUnknowns::n_macro; ++e)
      if (test_.stress_controlled[e])
        increment.applied[e] = load_factor * test_.target[e];
      else
        increment.target[system_.independent_index(macro_.first + e)] =
          load_factor * test_.target[e];
    return increment;
  }



  void
  MicroCellProblem::evaluate(const Increment &increment, Trial &trial) const
  {
    trial.residual.reinit(trial.u.size());
    trial.force_scale = bodies_.add_residual(trial.u, trial.residual);
    // Prescribed stresses act on the macro unknowns.
    for (unsigned int e = 0; e < SolidMacroUnknowns::n_macro; ++e)
      if (test_.stress_controlled[e])
        trial.residual[macro_.first + e] -= increment.applied[e] * volume_;
  }



  bool
  MicroCellProblem::add_tangent(const Increment &,
                                const Trial       &trial,
                                ConstrainedSystem &system) const
  {
    bodies_.add_tangent(trial.u, groups_, system);
    return true;
  }



  double
  MicroCellProblem::lever_arm(const unsigned int unknown) const
  {
    return unknown < macro_.first ? 1. : std::cbrt(volume_);
  }



  State
  MicroCellProblem::accept(const State     &before,
                           const Increment &increment,
                           const Trial     &trial) const
  {
    State state = EquilibriumProblem::accept(before, increment, trial);
    // Reactions of the macro unknowns. The residual has the prescribed stress
    // taken off already.
    for (unsigned int e = 0; e < SolidMacroUnknowns::n_macro; ++e)
      state.reactions.push_back(
        trial.condensed[system_.independent_index(macro_.first + e)] / volume_ +
        (test_.stress_controlled[e] ? increment.applied[e] : 0.));
    return state;
  }
} // namespace NPT
