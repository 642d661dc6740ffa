// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the solution of one load step with contact: Newton's method, repeated
// for the augmented Lagrangian.

#ifndef npt_dealii_load_step_augmented_lagrangian_h
#define npt_dealii_load_step_augmented_lagrangian_h

#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/load_step/newton.h>

#include <vector>

namespace NPT
{
  struct ContactStepReport
  {
    /// Of the first solution, whose order tells of the tangent; iterations:
    /// the sum over all solutions.
    NewtonReport newton;
    /// Norm of the residual of the last solution [N].
    double final_residual = 0;
  };

  /**
   * Solve a load step from the given x: once with the penalty method; with the
   * augmented Lagrangian repeat with the tractions of the last solution as
   * multipliers until penetration and stick drift are below their tolerances,
   * (A17) of doc/theory.md. Repetitions that gain little make the penalties
   * grow; see ContactPair::augment().
   *
   * @param contacts The contact pairs.
   * @param steps    The load step of each pair; the problem's residual refers
   *   to them. The augmented Lagrangian changes their multipliers.
   * @param evaluations Of each pair at the displacement that the problem's
   *   residual has seen last.
   *
   * Throws NewtonNotConverged, "augmentation limit" if
   * ContactParameters::max_augmentations are not enough, and whatever
   * solve_newton() throws.
   */
  ContactStepReport
  solve_contact_step(const NewtonParameters                    &newton,
                     const ContactParameters                   &parameters,
                     const NewtonProblem                       &problem,
                     const std::vector<const ContactPair<3> *> &contacts,
                     std::vector<ContactStep<3>>               &steps,
                     const std::vector<ContactEvaluation<3>>   &evaluations,
                     dealii::Vector<double>                    &x);
} // namespace NPT

#endif
