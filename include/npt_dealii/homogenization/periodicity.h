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
  /**
   * Control points of a face seen through an operation of the cell. They have
   * unknowns of their own, which AffineConstraints tie to the base cell, the
   * macro unknowns and the weaving offset omega,
   *
   * @f[ w(QY+a) = Q\,w(Y) + w_m(QY+a) - Q\,w_m(Y) \pm \omega e_3 , @f]
   *
   * so that contact with an image needs nothing special anywhere else.
   */
  struct GhostSurface
  {
    std::vector<unsigned int>     control_points; ///< of the base cell
    SymmetryOperation             operation;
    double                        offset_sign;
    unsigned int                  first_unknown; ///< three per control point
    std::vector<dealii::Point<3>> reference;     ///< QX + a
  };

  /**
   * All couplings of a fabric cell: symmetry operations, pins where rigid
   * motions would remain, and ghost surfaces.
   *
   * @param woven Positions of the control points in the woven state [mm], to
   *   which the jumps of bending and torsion refer; empty: the reference ones.
   *   A jump taken at reference positions would shear the structure by H4 times
   *   the displacement of weaving along the bundle: the moments would then
   *   depend on where a strand is cut into periods (by 2 % of n1 t in a coarse
   *   twill), with woven positions they do not.
   * @return Closed constraints over macro.n_unknowns() unknowns.
   *
   * Throws std::logic_error if the mesh is not mapped onto itself by an
   * operation.
   */
  dealii::AffineConstraints<double>
  make_couplings(const FabricCell                    &cell,
                 const IGASpace<3>                   &space,
                 const MacroUnknowns                 &macro,
                 const std::vector<GhostSurface>     &ghosts,
                 const std::vector<dealii::Point<3>> &woven = {});
} // namespace NPT

#endif
