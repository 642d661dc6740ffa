// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines bodies of which some unknowns are driven in proportion to the load
// factor, as an equilibrium problem.

#ifndef npt_dealii_verification_solids_driven_solid_h
#define npt_dealii_verification_solids_driven_solid_h

#include <npt_dealii/load_step/equilibrium_problem.h>
#include <npt_dealii/solid/deformable_bodies.h>

namespace NPT
{
  /// Deformable bodies, C^T f_int(C m) = 0 for the free m, with the prescribed
  /// m at load factor times their targets.
  class DrivenSolid : public EquilibriumProblem
  {
  public:
    /**
     * @param groups Of the cells in the system.
     * @param target By independent unknown, at load factor 1.
     */
    DrivenSolid(const DeformableBodies             &body,
                const DeformableBodies::CellGroups &groups,
                const dealii::Vector<double>       &target)
      : body_(body)
      , groups_(groups)
      , target_(target)
    {}

    Increment
    increment(const State &, const double load_factor) const override
    {
      Increment increment;
      increment.load_factor = load_factor;
      increment.target      = target_;
      increment.target *= load_factor;
      return increment;
    }

    void
    evaluate(const Increment &, Trial &trial) const override
    {
      trial.residual.reinit(trial.u.size());
      trial.force_scale = body_.add_residual(trial.u, trial.residual);
    }

    bool
    add_tangent(const Increment &,
                const Trial       &trial,
                ConstrainedSystem &system) const override
    {
      body_.add_tangent(trial.u, groups_, system);
      return true;
    }

    double
    force_unit() const override
    {
      return body_.force_unit();
    }

  private:
    const DeformableBodies             &body_;
    const DeformableBodies::CellGroups &groups_;
    const dealii::Vector<double>       &target_;
  };
} // namespace NPT

#endif
