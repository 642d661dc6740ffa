// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the bundles of one repeat of the deformed fabric from end to end,
// whatever part of them the cell computes.

#ifndef npt_dealii_problems_plate_exports_fabric_strand_h
#define npt_dealii_problems_plate_exports_fabric_strand_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/cylinder_motion.h>
#include <npt_dealii/iga/iga_space.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// A deformed cell; positions by control point of its space.
  struct DeformedCell
  {
    const FabricCell             &cell;
    const IGASpace<3>            &space;
    std::vector<dealii::Point<3>> positions; ///< x of the base cell [mm]
    /// Places to which bending and torsion refer [mm]; empty: the reference
    /// ones.
    std::vector<dealii::Point<3>> woven;
    Gradients                     H{};
    /// With objective jumps: the direction of curvature.
    std::optional<dealii::Tensor<1, 2>> bends_along = {};
  };

  /**
   * A bundle through one repeat of the fabric, FabricCell::repeat(): its pieces
   * one behind the other, as one grid of knot spans. Directions 0 along, 1
   * across, 2 through the thickness, right-handed; a piece that a glide plane
   * has turned over is counted from its other face.
   *
   * Points are those of the rational Bezier cells of the bundles, and of their
   * images in_fabric().
   */
  class FabricStrand
  {
  public:
    /// A place: knot span and local coordinates in [0,1] by direction.
    struct Place
    {
      std::array<unsigned int, 3> span;
      std::array<double, 3>       xi;
    };

    struct Sample
    {
      dealii::Point<3>                    x;       ///< [mm]
      std::array<dealii::Tensor<1, 3>, 3> tangent; ///< dx / d xi [mm]
      dealii::Tensor<1, 3>                fiber;   ///< unit vector F A / |F A|
    };

    /// All strands of the repeat, warp before weft, each family in its order
    /// across. The deformed cell must outlive them.
    static std::vector<FabricStrand>
    of_repeat(const DeformedCell &deformed);

    /// "warp_1", "weft_2", "ply_1".
    const std::string &
    name() const
    {
      return name_;
    }
    FiberBundle::Family
    family() const
    {
      return family_;
    }
    /// Bundle of the cell of the first piece.
    unsigned int
    bundle() const
    {
      return pieces_.front().piece.bundle;
    }
    unsigned int
    n_spans(const unsigned int direction) const
    {
      return direction == 0 ? n_along_ * pieces_.size() : n_spans_[direction];
    }

    Sample
    at(const Place &place) const;

  private:
    struct Piece
    {
      double        along; ///< of its middle in the reference fabric [mm]
      CrossingPiece piece;
    };

    // Coordinates of a cell of the mesh: x, Z, X by Bezier point, and weights.
    struct BezierCell
    {
      std::vector<std::vector<double>> points;
      std::vector<double>              weights;
    };

    FabricStrand(const DeformedCell       &deformed,
                 const FiberBundle::Family family,
                 const std::string        &name,
                 const std::vector<Piece> &pieces);

    const DeformedCell *deformed_;
    FiberBundle::Family family_;
    std::string         name_;
    std::vector<Piece>  pieces_;
    unsigned int        n_along_; // spans of a piece
    // Spans of a bundle.
    std::array<unsigned int, 3> n_spans_;
    // By piece and span.
    std::vector<std::vector<BezierCell>> cells_;
  };
} // namespace NPT

#endif
