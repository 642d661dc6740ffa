// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the couplings of a fabric cell: which control points its symmetry
// operations relate, and how.

#ifndef npt_dealii_homogenization_fabric_couplings_h
#define npt_dealii_homogenization_fabric_couplings_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/objective_jumps.h>
#include <npt_dealii/homogenization/orbit_constraints.h>
#include <npt_dealii/homogenization/periodic_image.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/lac/affine_constraints.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// Where rigid motions of the whole cell are held that its symmetry leaves.
  /// Bundles that float against each other are no matter of pins.
  struct Pins
  {
    bool used = true; ///< false leaves them free, to look at reactions
    /// Parameters, in [0,1]^2, of the point of the first bundle (of every layer
    /// of fabric) that is held in
    /// plane, if the 2-fold axis is not a constraint. Empty: where an axis of
    /// the weave goes through the bundle, or its middle.
    std::optional<std::array<double, 2>> in_plane;
    /// Position, in the first patch, of the control point that is held along
    /// Y3, if there is no glide plane. With a smooth closure one at the end of
    /// the patch is replaced by its neighbor inside.
    std::array<unsigned int, 3> vertical = {{0, 0, 0}};
  };

  /// Which unknowns behind the modes and the offset a stage makes use of; the
  /// others are zero. See MacroUnknowns.
  struct UsedUnknowns
  {
    bool support = false;
    /// Between plates only the lowest layer of fabric is pinned along Y3.
    bool plates = false;
  };

  /**
   * All couplings of a fabric cell: symmetry operations, pins where rigid
   * motions would remain, and periodic images.
   *
   * With Cell / Smooth closure the displacement is C1 over the periodic faces
   * and between crossings as well: a control point 0 there lies between its
   * inner neighbor 1 and the image, by an operation of the cell, of the inner
   * neighbor n-2 of the other end,
   *
   * @f[ u_0 = \alpha u_1 + (1-\alpha) ( Q u_{n-2} + w_m(QY_{n-2}+a) -
   *         Q w_m(Y_{n-2}) ), \qquad
   *     X_0 = \alpha X_1 + (1-\alpha) (Q X_{n-2} + a) \qquad (A18) @f]
   *
   * with alpha = 1/2 where the spans on both sides are equal. Weights must not
   * change along the bundle.
   *
   * @param woven Positions of the control points in the woven state [mm], to
   *   which the jumps of bending and torsion refer; empty: the reference ones.
   *   A jump taken at reference positions would shear the structure by H4 times
   *   the displacement of weaving along the bundle: the moments would then
   *   depend on where a strand is cut into periods (by 2 % of n1 t in a coarse
   *   twill), with woven positions they do not.
   * @param jumps Given: the couplings are those of v of (A25), free of H, and
   *   the mean height of the cell has to be held instead of the vertical pin,
   *   for which the support is used.
   * @param used The plates are centered at the mid-plane if a glide plane
   *   exchanges them.
   * @return Closed constraints over macro.n_unknowns() unknowns.
   *
   * Throws std::logic_error if the mesh is not mapped onto itself by an
   * operation, or if the conditions of a smooth closure contradict the rest.
   */
  dealii::AffineConstraints<double>
  make_couplings(const FabricCell                    &cell,
                 const IGASpace<3>                   &space,
                 const MacroUnknowns                 &macro,
                 const std::vector<PeriodicImage>    &images,
                 const std::vector<dealii::Point<3>> &woven = {},
                 const Pins                          &pins  = {},
                 const ObjectiveJumps                *jumps = nullptr,
                 const UsedUnknowns                  &used  = {});
} // namespace NPT

#endif
