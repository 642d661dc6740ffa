// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines one stage of a contact benchmark as an equilibrium problem: bodies
// that are moved or pushed by handles.

#ifndef npt_dealii_verification_contact_handle_problem_h
#define npt_dealii_verification_contact_handle_problem_h

#include <npt_dealii/load_step/equilibrium_problem.h>
#include <npt_dealii/solid/deformable_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>

#include <functional>
#include <vector>

namespace NPT
{
  /**
   * Unknowns are u = (w of all control points, handles); the couplings of the
   * case leave independent ones m, u = C m. Handles have prescribed values or
   * forces,
   *
   * @f[ C^T ( f_{int}(u) + f_{contact}(u) ) = f_{handles} . @f]
   *
   * State::applied and State::reactions are the forces on the handles, of the
   * whole body [N].
   */
  class HandleProblem : public EquilibriumProblem
  {
  public:
    /// What stays the same during a benchmark.
    struct Model
    {
      const DeformableBodies          &bodies;
      const std::vector<unsigned int> &groups; ///< of the cells in the system
      const ContactPairs              &contacts;
      unsigned int                     n_handles;
      /// Forces on the whole body over those on the part that is modeled.
      double force_factor;
      /// Nodes nearer than this are about to touch [mm].
      double pattern_margin;
    };

    /**
     * @param stages, index All stages and the present one; those before tell
     *   how handles are driven that it does not name.
     * @param before The accepted state at the end of the stage before.
     * @param system Its prescribed unknowns are set.
     */
    HandleProblem(const Model                     &model,
                  const std::vector<ContactStage> &stages,
                  const unsigned int               index,
                  const State                     &before,
                  ConstrainedSystem               &system);

    /// Bodies at rest, no forces.
    static State
    initial_state(const Model &model);

    /// The state from which the stage begins: load factor 0, friction on or
    /// off.
    const State &
    start() const
    {
      return start_;
    }

    Increment
    increment(const State &accepted, const double load_factor) const override;
    void
    evaluate(const Increment &increment, Trial &trial) const override;
    bool
    add_tangent(const Increment   &increment,
                const Trial       &trial,
                ConstrainedSystem &system) const override;
    std::vector<std::vector<unsigned int>>
    couplings(const Increment &increment, const Trial &trial) const override;
    State
    accept(const State     &before,
           const Increment &increment,
           const Trial     &trial) const override;
    const ContactPairs &
    contacts() const override
    {
      return model_.contacts;
    }

  private:
    // How a handle is driven in this stage.
    struct Handle
    {
      bool   by_force = false;
      double start    = 0; // value or force
      /// From the start and the load factor.
      std::function<double(double, double)> value = [](const double from,
                                                       double) { return from; };
    };

    unsigned int
    unknown(const unsigned int handle) const
    {
      return model_.bodies.n_displacements() + handle;
    }

    const Model              model_;
    const ConstrainedSystem &system_;
    std::vector<Handle>      handles_;
    State                    start_;
  };
} // namespace NPT

#endif
