// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines one test of a micro cell as an equilibrium problem.

#ifndef npt_dealii_problems_material_test_micro_cell_problem_h
#define npt_dealii_problems_material_test_micro_cell_problem_h

#include <npt_dealii/homogenization/solid_couplings.h>
#include <npt_dealii/load_step/equilibrium_problem.h>
#include <npt_dealii/problems/material_test/material_test_parameters.h>
#include <npt_dealii/solid/deformable_bodies.h>

namespace NPT
{
  /**
   * A periodic cell of fibers and matrix, deformed by its macroscopic
   * displacement gradient H or loaded by the first Piola-Kirchhoff stress P,
   * component by component, both in proportion to the load factor. Unknowns
   * are u = (w of all control points, H_11 ... H_33); the equations are
   *
   * @f[ C^T f_{int}(u) = |V| P_{prescribed} . @f]
   *
   * State::applied and State::reactions are the nine components of P [MPa].
   */
  class MicroCellProblem : public EquilibriumProblem
  {
  public:
    /**
     * @param groups Of the cells in the system, DeformableBodies::add_groups().
     * @param volume Of the cell [mm^3].
     * @param system Couplings and cells are known to it; the prescribed
     *   unknowns of this test are set.
     */
    MicroCellProblem(const DeformableBodies             &bodies,
                     const DeformableBodies::CellGroups &groups,
                     const SolidMacroUnknowns           &macro,
                     const double                        volume,
                     const MaterialTest                 &test,
                     ConstrainedSystem                  &system);

    /// All displacements and stresses zero.
    State
    natural_state() const;

    Increment
    increment(const State &accepted, const double load_factor) const override;
    void
    evaluate(const Increment &increment, Trial &trial) const override;
    bool
    add_tangent(const Increment   &increment,
                const Trial       &trial,
                ConstrainedSystem &system) const override;
    double
    force_unit() const override
    {
      return bodies_.force_unit();
    }
    /// Edge of a cube of the cell's volume for the macroscopic gradients.
    double
    lever_arm(const unsigned int unknown) const override;
    State
    accept(const State     &before,
           const Increment &increment,
           const Trial     &trial) const override;

  private:
    const DeformableBodies             &bodies_;
    const DeformableBodies::CellGroups &groups_;
    const SolidMacroUnknowns           &macro_;
    const double                        volume_;
    const MaterialTest                 &test_;
    const ConstrainedSystem            &system_;
  };
} // namespace NPT

#endif
