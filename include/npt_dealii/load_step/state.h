// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the accepted state of a problem, and the increment that a load step
// adds to it.

#ifndef npt_dealii_load_step_state_h
#define npt_dealii_load_step_state_h

#include <npt_dealii/contact/contact_evaluation.h>
#include <npt_dealii/contact/contact_state.h>
#include <npt_dealii/contact/contact_step.h>
#include <npt_dealii/load_step/energy_balance.h>

#include <deal.II/lac/vector.h>

#include <vector>

namespace NPT
{
  /**
   * Everything that decides what a load step does next; a value. A problem
   * changes it only by accepting a step, which returns a new one: a rejected
   * step leaves nothing because there is nothing to leave.
   */
  struct State
  {
    /// All unknowns of the problem: displacements [mm], then its own, such as
    /// H1..H6, the weaving offset and the unknowns of periodic images.
    dealii::Vector<double> u;
    double                 load_factor = 0; ///< of the present stage, 0 to 1
    /// Generalized forces that the problem applies, in its own order: the
    /// resultants n1..n6 [N/mm], [N], or the forces on handles [N].
    std::vector<double> applied;
    /// Reactions conjugate to the same unknowns, in the units of `applied`.
    std::vector<double> reactions;
    /// Of every contact pair: friction tractions, closest points, multipliers,
    /// grown penalties.
    std::vector<ContactState<3>> contact;
    /// Where the bodies bear no stress, see NaturalState of room solid; empty:
    /// the reference configuration.
    std::vector<double> natural;
    /// What the balance of energy compares.
    Energies energies;
  };

  /**
   * What one load step adds: the load at its end, and what contact refers to.
   * All but the multipliers of the augmented Lagrangian is a function of the
   * accepted state and the load factor alone.
   */
  struct Increment
  {
    double load_factor = 0; ///< at the end of the step
    /// By independent unknown; only the prescribed entries mean something.
    dealii::Vector<double>      target;
    std::vector<double>         applied; ///< as State::applied, at the end
    std::vector<double>         natural; ///< as State::natural, at the end
    std::vector<ContactStep<3>> contact;
  };

  /// A state that is tried within a load step, and the problem's answer to it.
  struct Trial
  {
    dealii::Vector<double>            u;
    dealii::Vector<double>            residual;  ///< of all unknowns [N]
    dealii::Vector<double>            condensed; ///< C^T residual
    double                            force_scale = 0;
    std::vector<ContactEvaluation<3>> contact;
  };
} // namespace NPT

#endif
