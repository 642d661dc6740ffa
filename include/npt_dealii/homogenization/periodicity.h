// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the couplings of a fabric cell: which control points its symmetry
// operations relate, and how.

#ifndef npt_dealii_homogenization_periodicity_h
#define npt_dealii_homogenization_periodicity_h

#include <npt_dealii/cell/fabric_cell.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/orbit_constraints.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/lac/affine_constraints.h>

#include <string>
#include <vector>

namespace NPT
{
  /// Which couplings hold in a stage.
  struct CouplingOptions
  {
    /// Weaving: the middle of the end faces is moved to the mid-plane.
    bool hold_end_middles = false;
  };

  /**
   * All couplings of a fabric cell: symmetry operations, the weaving
   * condition, pins where rigid motions would remain.
   *
   * @param height Z3 of each control point used in the jumps of bending and
   *   torsion [mm]; empty: the reference one.
   * @return Closed constraints over macro.n_unknowns() unknowns.
   */
  dealii::AffineConstraints<double>
  make_couplings(const FabricCell          &cell,
                 const IGASpace<3>         &space,
                 const MacroUnknowns       &macro,
                 const CouplingOptions     &options,
                 const std::vector<double> &height = {});

  /// Displacement of straight bundles held apart by `offset` [mm].
  dealii::Vector<double>
  straight_bundles(const FabricCell    &cell,
                   const IGASpace<3>   &space,
                   const MacroUnknowns &macro,
                   const double         offset);
} // namespace NPT

#endif
