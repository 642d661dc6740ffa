// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the periodic cell of a woven fabric: its bundles, its symmetry
// operations and the surfaces that may touch.

#ifndef npt_dealii_fabric_fabric_cell_h
#define npt_dealii_fabric_fabric_cell_h

#include <npt_dealii/fabric/bundle_section.h>
#include <npt_dealii/fabric/cell_parameters.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  class WeavePattern;

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
  };

  /**
   * An isometry Y -> Q Y + a that maps the woven structure onto itself, Q
   * diagonal with entries +1, -1. Displacements of the structure obey
   *
   * @f[ w(QY + a) = Q\,w(Y) + [ w_m(QY + a) - Q\,w_m(Y) ] @f]
   *
   * with the macroscopic field w_m of theory, section 2; see
   * macroscopic_displacement().
   */
  struct SymmetryOperation
  {
    std::string          name;
    dealii::Tensor<1, 3> Q; ///< diagonal
    dealii::Tensor<1, 3> a; ///< [mm]

    /// First this operation, then another.
    SymmetryOperation
    then(const SymmetryOperation &next) const;

    dealii::Point<3>
    operator()(const dealii::Point<3> &Y) const
    {
      dealii::Point<3> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = Q[i] * Y[i] + a[i];
      return result;
    }

    /**
     * Whether macroscopic mode n (0..5 for H1..H6) is invariant: strains turn
     * with Q, curvatures with Q and with the sign of the thickness direction.
     */
    bool
    keeps_mode(const unsigned int n) const;
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
  };

  /// One crossing of a bundle of the cell, seen through a shift of the cell.
  struct CrossingPiece
  {
    unsigned int      bundle;
    unsigned int      crossing; ///< of the bundle, from 0
    SymmetryOperation operation;
    bool              first, last; ///< along its strand in the repeat
  };

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
      return bundles_;
    }
    /// All operations that relate control points of the base cell:
    /// translations or glides that take a bundle of the base cell to another
    /// one or to its end, and the same after the 2-fold axis if there is one.
    const std::vector<SymmetryOperation> &
    operations() const
    {
      return operations_;
    }
    const std::vector<ContactCandidates> &
    contacts() const
    {
      return contacts_;
    }
    /// Area L1 L2 of the mid-plane that the cell stands for [mm^2].
    double
    area() const
    {
      return area_;
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
      return two_fold_axis_;
    }
    /// Whether a translation of the whole cell along Y3 must be pinned (a
    /// glide plane excludes it).
    bool
    needs_vertical_pin() const;
    /// Whether a bundle can float in plane before contact holds it: the 2-fold
    /// axes go past it. (Without 2-fold axis every bundle is pinned.)
    bool
    has_floating_bundles() const;
    /**
     * Where along a bundle, in [0,1], a 2-fold axis of the weave goes through
     * it, used as a constraint or not: the place nearest to the middle of the
     * bundle, or the middle itself if there is none.
     */
    double
    axis_parameter(const unsigned int bundle) const
    {
      return axis_parameter_[bundle];
    }
    /// Whether the operations allow mode n (0..5).
    bool
    represents_mode(const unsigned int n) const;
    /// Name of the operation that forbids mode n, or an empty string.
    std::string
    obstacle(const unsigned int n) const;

    /**
     * How often a point of a bundle stands for itself and its mirror image:
     * where the 2-fold axis maps bundles of the base cell onto each other, one
     * half is integrated with weight 2, points on the axis with weight 1, the
     * other half with weight 0.
     */
    unsigned int
    symmetry_weight(const unsigned int bundle, const dealii::Point<3> &Y) const;

    /**
     * The pieces of which one repeat of the weave is put together, at least two
     * crossings by two, whatever the type of the cell: one piece of warp and
     * one of weft at each crossing, by translations and glide planes but never
     * by the 2-fold axis. The plies of a laminate are one piece each.
     */
    std::vector<CrossingPiece>
    repeat() const;

    /// Crossings of a bundle; 1 for a ply.
    unsigned int
    n_crossings(const unsigned int bundle) const
    {
      return strands_[bundle].n_crossings;
    }

    /// The weaving offset t of straight bundles that just touch [mm].
    double
    weaving_offset() const
    {
      return parameters_.bundle_thickness.mean();
    }

    /// The smallest cell type that represents the given modes (0..5), and a
    /// clause that says why: "because ...".
    static std::pair<std::string, std::string>
    smallest_type(const CellParameters            &cell,
                  const std::vector<unsigned int> &modes);

  private:
    // A bundle in its cell: its number among the parallel bundles of the weave,
    // position of the axis, first crossing, number of crossings, begin.
    struct Strand
    {
      int          index;
      double       position; ///< across [mm]
      int          first;
      unsigned int n_crossings;
      double       begin;  ///< along [mm]
      double       length; ///< along [mm]
      bool         held;   ///< a 2-fold axis goes through it
    };

    NURBSPatch<3>
    straight_bundle(const BundleSection  &section,
                    const double          spacing,
                    const unsigned int    n_crossings,
                    const MeshParameters &mesh) const;
    void
    add_plies(const MeshParameters &mesh);
    void
    add_side_contacts();
    void
    add_strands(const WeavePattern &weave, const MeshParameters &mesh);
    void
    add_operations();
    void
    add_contacts(const WeavePattern &weave);
    // +1: shifting by this many warp and weft bundles is a translation of this
    // cell, -1: a glide plane, 0: neither.
    int
    shift_sign(const WeavePattern &weave, const int warp, const int weft) const;
    // The middle of a strand.
    dealii::Point<3>
    middle(const unsigned int bundle) const;

    CellParameters                 parameters_;
    double                         L1_, L2_; // spacing along Y1, Y2
    std::vector<FiberBundle>       bundles_;
    std::vector<Strand>            strands_; // by bundle
    std::vector<SymmetryOperation> lattice_; // identity first
    std::vector<SymmetryOperation> operations_;
    std::vector<ContactCandidates> contacts_;
    double                         area_;
    // Twice the position of the weave's 2-fold axis, in bundles.
    std::optional<std::array<int, 2>> axis_;
    bool                              two_fold_axis_ = false;
    std::vector<double>               axis_parameter_; // by bundle
    // Where the 2-fold axis takes each bundle, or -1.
    std::vector<int>               mirror_;
    std::vector<SymmetryOperation> mirror_operation_;
  };

  /**
   * Macroscopic displacement of one unit of H_n (n = 0..5) at a point,
   *
   * @f[ w_m = ( H_1 Y_1 + H_3 Y_2/2 + Z_3 (H_4 Y_1 + H_6 Y_2/2),\;
   *             H_2 Y_2 + H_3 Y_1/2 + Z_3 (H_5 Y_2 + H_6 Y_1/2),\;
   *           -(H_4 Y_1^2 + H_5 Y_2^2 + H_6 Y_1 Y_2)/2 ) . @f]
   */
  dealii::Tensor<1, 3>
  macroscopic_displacement(const unsigned int n, const dealii::Point<3> &Y);

  /**
   * What one unit of H_n (n = 0..5) adds to the displacement of an image of the
   * cell, w(gY) = Q w(Y) + jump, with g Y = Q Y + a:
   *
   * @f[ w_m(QY + a) - Q\,w_m(Y) . @f]
   *
   * Affine in Y for all modes that the operation allows.
   */
  dealii::Tensor<1, 3>
  macroscopic_jump(const unsigned int       n,
                   const SymmetryOperation &g,
                   const dealii::Point<3>  &Y);
} // namespace NPT

#endif
