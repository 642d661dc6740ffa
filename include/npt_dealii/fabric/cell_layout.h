// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a cell consists of: its bundles, its symmetry operations, the
// surfaces that may touch.

#ifndef npt_dealii_fabric_cell_layout_h
#define npt_dealii_fabric_cell_layout_h

#include <npt_dealii/fabric/symmetry.h>
#include <npt_dealii/iga/nurbs_patch.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace NPT
{
  /// One straight bundle (or one ply of a laminate) in the reference
  /// configuration.
  struct FiberBundle
  {
    enum class Family
    {
      warp, ///< along Y1
      weft, ///< along Y2
      ply
    };
    Family               family;
    NURBSPatch<3>        patch;     ///< along, across, through the thickness
    dealii::Tensor<1, 3> direction; ///< fiber direction, unit vector
    unsigned int         body;      ///< patches of one body are joined

    unsigned int n_crossings = 1; ///< 1 for a ply
    /// Along which of Y1, Y2, Y3 the symmetry of the cell lets this bundle move
    /// rigidly, by itself or against its image under the 2-fold axis or a
    /// mirror plane.
    std::array<bool, 3> can_float = {{false, false, false}};
    /// Where along the bundle, in [0,1], a 2-fold axis goes through it.
    double axis_parameter = 0.5;

    /// Where the 2-fold axis or a mirror plane takes a piece of a bundle: the
    /// number of a bundle of the cell, perhaps its own.
    struct Counterpart
    {
      unsigned int      bundle;
      SymmetryOperation operation;
      double            begin, end; ///< of the piece, Y along the bundle [mm]
    };
    /// Empty if neither is a constraint.
    std::vector<Counterpart> counterparts = {};
    /// Y of the middle of the bundle along itself [mm].
    double middle = 0.;
    /// From bottom to top, of Cell / Layers.
    unsigned int layer = 0;
  };

  /**
   * A bundle face seen through a symmetry operation of the cell: the face of a
   * neighboring cell (49), or of the base cell itself if the operation is the
   * identity. During weaving it is held apart from its contact partner by
   * offset_sign times the weaving offset along Y3.
   */
  struct SurfaceImage
  {
    unsigned int      bundle;
    unsigned int      side; ///< 0 begin, 1 end of that direction
    SymmetryOperation operation;
    double            offset_sign;
    /// Pieces of the same strand continue each other; period counts them along
    /// the strand, 0 for the piece that crosses the contact partner.
    int strand;
    int period;
    /// Parametric direction normal to the face: 2 for bottom and top, 1 for
    /// the edges of a bundle (side contact of parallel neighbors).
    unsigned int direction = 2;
  };

  /// A secondary face and the primary faces that it may touch.
  struct ContactCandidates
  {
    unsigned int              secondary_bundle;
    unsigned int              secondary_side;
    std::vector<SurfaceImage> primaries;
    unsigned int              direction = 2; ///< as in SurfaceImage
    /// The top of a layer against the bottom of the next one.
    bool between_layers = false;
  };

  /// One crossing of a bundle of the cell, seen through a shift of the cell.
  struct CrossingPiece
  {
    unsigned int      bundle;
    unsigned int      crossing; ///< of the bundle, from 0
    SymmetryOperation operation;
    bool              first, last; ///< along its strand in the repeat
  };

  /// All parts of a cell; see the functions of FabricCell.
  struct CellLayout
  {
    std::vector<FiberBundle>       bundles;
    std::vector<SymmetryOperation> operations;
    std::vector<ContactCandidates> contacts;
    std::vector<CrossingPiece>     repeat;

    double area              = 0.; ///< [mm^2]
    bool   has_two_fold_axis = false;
    bool   has_mirror_planes = false;
    bool   integrates_pieces = false;
  };
} // namespace NPT

#endif
