// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a problem must answer to be driven in load steps.

#ifndef npt_dealii_load_step_equilibrium_problem_h
#define npt_dealii_load_step_equilibrium_problem_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/load_step/state.h>

#include <memory>
#include <vector>

namespace NPT
{
  /// Contact pairs of a problem, in the order of State::contact.
  using ContactPairs = std::vector<std::unique_ptr<ContactPair<3>>>;

  /**
   * The equations of one stage, C^T R(u) = 0 for the free unknowns m of
   * u = C m, as functions of the state: no member remembers what was evaluated
   * last. LoadStepper tries, cuts and accepts steps of it.
   *
   * A new kind of test derives from this class; doc/extending shows one.
   */
  class EquilibriumProblem
  {
  public:
    virtual ~EquilibriumProblem() = default;

    /**
     * The step from an accepted state to a load factor: targets of the
     * prescribed unknowns, applied forces, and the references of contact
     * (begin_contact()).
     *
     * Throws ProjectionLost if a contact point has no closest point.
     */
    virtual Increment
    increment(const State &accepted, const double load_factor) const = 0;

    /**
     * Fill trial.residual with R(u), trial.force_scale with the norm of the
     * forces before they cancel [N], against which convergence is measured, and
     * trial.contact, all at trial.u.
     *
     * Throws a LoadStepFailure (inverted cell, lost projection) if this u
     * cannot be evaluated; a shorter step may then succeed.
     */
    virtual void
    evaluate(const Increment &increment, Trial &trial) const = 0;

    /**
     * Add dR/du at an evaluated trial to a system set to zero. Contact comes
     * first: if the pattern of the system lacks one of its couplings, the
     * return is false on all processes, the matrix is of no use, and the
     * caller widens the pattern by couplings().
     */
    virtual bool
    add_tangent(const Increment   &increment,
                const Trial       &trial,
                ConstrainedSystem &system) const = 0;

    /// Stiffness times size^2 of the bodies [N]: a residual that is round-off
    /// of this counts as converged. 0: there is no such floor.
    virtual double
    force_unit() const;

    /**
     * What the residual of an unknown of u is divided by in its norm, so that
     * all components have the unit N: 1 for displacements, a length for a
     * gradient [-], its square for a curvature [1/mm].
     */
    virtual double
    lever_arm(const unsigned int unknown) const;

    /// Groups of unknowns that contact couples or is about to couple.
    virtual std::vector<std::vector<unsigned int>>
    couplings(const Increment &increment, const Trial &trial) const;

    /**
     * Look at a converged step before it is accepted; throws a LoadStepFailure
     * to refuse it. A BranchLeft is only a doubt: if the step cannot be cut any
     * more, it is accepted with a warning.
     *
     * @param after What accept() made of the step.
     */
    virtual void
    check(const State &before, const State &after) const;

    /// The state after an accepted step.
    virtual State
    accept(const State     &before,
           const Increment &increment,
           const Trial     &trial) const;

    /// The processes that share the work; by default this one alone.
    virtual const Ranks &
    ranks() const;

    /// Pairs whose friction and multipliers are part of the state.
    virtual const ContactPairs &
    contacts() const;

    /// The references of all contact pairs for a step from this state.
    std::vector<ContactStep<3>>
    begin_contact(const State &accepted) const;

    /// Evaluate all contact pairs at trial.u and add their virtual work to a
    /// full vector of forces.
    void
    add_contact_forces(const Increment        &increment,
                       Trial                  &trial,
                       dealii::Vector<double> &force) const;

    /// Add the tangents of all contact pairs; false as in add_tangent().
    bool
    add_contact_tangent(const Increment   &increment,
                        const Trial       &trial,
                        ConstrainedSystem &system) const;

    /// Couplings of all nodes that are closed or nearer than margin [mm].
    std::vector<std::vector<unsigned int>>
    contact_couplings(const Increment &increment,
                      const Trial     &trial,
                      const double     margin) const;
  };
} // namespace NPT

#endif
