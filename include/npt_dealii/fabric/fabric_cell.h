// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the periodic cell of a woven fabric: its bundles, its symmetry
// operations and the surfaces that may touch.

#ifndef npt_dealii_fabric_fabric_cell_h
#define npt_dealii_fabric_fabric_cell_h

#include <npt_dealii/fabric/cell_layout.h>
#include <npt_dealii/fabric/cell_parameters.h>

#include <array>
#include <vector>

namespace NPT
{
  /**
   * The cell in its reference configuration: every bundle straight with its
   * own mid-plane at Z3 = 0, so that cell coordinates are those of the woven
   * state. Bundles interpenetrate there; weaving starts with contact partners
   * held apart by the weaving offset t, the mean thickness of warp and weft
   * (straight bundles that just touch), and lets the offset go to
   * (1 - depth) t.
   *
   * Which bundles there are follows from the shifts of the weave's table that
   * the type admits: translations by the repeat (unit cell), all translations
   * (primitive cell, two-crossing cell), or these and glide planes (sub-unit
   * cell). Bundles that a shift maps onto each other are one; a bundle extends
   * over as many crossings as the smallest shift along itself. So plain weave
   * needs 4, 2 or 1 crossings, 2/2 twill 16, 4 or 2, 5-harness satin 25 or 5
   * (it has no glide plane). The origin is on a 2-fold axis if the weave has
   * one.
   */
  class FabricCell
  {
  public:
    /// Throws InputError if the weave has no such cell.
    FabricCell(const CellParameters &cell, const MeshParameters &mesh);

    const std::vector<FiberBundle> &
    bundles() const
    {
      return layout_.bundles;
    }
    /// All operations that relate control points of the base cell:
    /// translations or glides that take a bundle of the base cell to another
    /// one or to its end, and the same after the 2-fold axis and the mirror
    /// planes if they are used.
    const std::vector<SymmetryOperation> &
    operations() const
    {
      return layout_.operations;
    }
    const std::vector<ContactCandidates> &
    contacts() const
    {
      return layout_.contacts;
    }
    /// Area L1 L2 of the mid-plane that the cell stands for [mm^2].
    double
    area() const
    {
      return layout_.area;
    }
    const CellParameters &
    parameters() const
    {
      return parameters_;
    }
    /// Whether the 2-fold axis of the weave is used as a constraint.
    bool
    has_two_fold_axis() const
    {
      return layout_.has_two_fold_axis;
    }
    /// Whether pieces of bundles stand for others; see CellParameters.
    bool
    integrates_pieces() const
    {
      return layout_.integrates_pieces;
    }
    /// Along which of Y1, Y2, Y3 the operations let the whole cell move
    /// rigidly, so that it must be pinned: a 2-fold axis excludes it in plane,
    /// a glide plane along Y3.
    std::array<bool, 3>
    free_translations() const;
    /// Along which of Y1, Y2, Y3 a bundle can float before contact holds it.
    const std::array<bool, 3> &
    can_float(const unsigned int bundle) const
    {
      return layout_.bundles[bundle].can_float;
    }
    /**
     * Where along a bundle, in [0,1], a 2-fold axis of the weave goes through
     * it, used as a constraint or not: the place nearest to the middle of the
     * bundle, or the middle itself if there is none.
     */
    double
    axis_parameter(const unsigned int bundle) const
    {
      return layout_.bundles[bundle].axis_parameter;
    }
    /**
     * How often a point of a bundle counts in an integral over the cell: of a
     * point and its images under the 2-fold axis and the mirror planes one
     * stands for all of them, and the others have weight 0.
     *
     * With the axis alone the weight is 2, on the axis 1; with mirror planes 4,
     * on one plane 2, on two 1. The one that counts is that nearest to the
     * middle of its bundle, so that it is none at a seam, of which a bundle has
     * two halves; of equally near ones that in the bundle with the smallest
     * number, then that with the largest Y1, then Y2.
     */
    unsigned int
    symmetry_weight(const unsigned int bundle, const dealii::Point<3> &Y) const;

    /**
     * The pieces of which one repeat of the weave is put together, at least two
     * crossings by two, whatever the type of the cell: one piece of warp and
     * one of weft at each crossing, by translations and glide planes but never
     * by the 2-fold axis. The plies of a laminate are one piece each.
     */
    const std::vector<CrossingPiece> &
    repeat() const
    {
      return layout_.repeat;
    }

    /// Crossings of a bundle; 1 for a ply.
    unsigned int
    n_crossings(const unsigned int bundle) const
    {
      return layout_.bundles[bundle].n_crossings;
    }

    /// Layers of fabric on each other, from bottom to top.
    unsigned int
    n_layers() const
    {
      return layout_.bundles.back().layer + 1;
    }
    /// The number of the first bundle of a layer.
    unsigned int
    first_bundle(const unsigned int layer) const
    {
      return layer * (layout_.bundles.size() / n_layers());
    }

    /// The weaving offset t of straight bundles that just touch [mm].
    double
    weaving_offset() const
    {
      return parameters_.bundle_thickness.mean();
    }

  private:
    CellParameters parameters_;
    CellLayout     layout_;
  };
} // namespace NPT

#endif
