// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the periodic cell of a woven fabric: its bundles, its symmetry
// operations and the surfaces that may touch.

#ifndef npt_dealii_cell_fabric_cell_h
#define npt_dealii_cell_fabric_cell_h

#include <npt_dealii/cell/bundle_section.h>
#include <npt_dealii/cell/cell_parameters.h>

#include <deal.II/base/tensor.h>

#include <string>
#include <vector>

namespace NPT
{
  /// One straight bundle in the reference configuration.
  struct FiberBundle
  {
    enum class Family
    {
      warp, ///< along Y1
      weft  ///< along Y2
    };
    Family               family;
    NURBSPatch<3>        patch;     ///< along, across, through the thickness
    dealii::Tensor<1, 3> direction; ///< fiber direction, unit vector
    /// +1: starts above the mid-plane in weaving, -1: below.
    double side;
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

  /// Two faces that may touch: bundle number and side (0 bottom, 1 top) of the
  /// thickness direction.
  struct ContactCandidates
  {
    unsigned int                                       secondary_bundle;
    unsigned int                                       secondary_side;
    std::vector<std::pair<unsigned int, unsigned int>> primaries;
  };

  /**
   * The cell in its reference configuration: every bundle straight with its
   * own mid-plane at Z3 = 0, so that cell coordinates are those of the woven
   * state. (Bundles interpenetrate there; the straight bundles at touch are
   * the displacement +/- t/2 along Y3, the start of weaving.)
   */
  class FabricCell
  {
  public:
    FabricCell(const CellParameters &cell, const MeshParameters &mesh);

    const std::vector<FiberBundle> &
    bundles() const
    {
      return bundles_;
    }
    /// Operations that couple control points: glides and, if asked for, the
    /// 2-fold axis.
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
    /// Whether the operations allow mode n (0..5).
    bool
    represents_mode(const unsigned int n) const;
    /// Name of the operation that forbids mode n, or an empty string.
    std::string
    obstacle(const unsigned int n) const;

    /**
     * How often a point stands for itself and its mirror images: with the
     * 2-fold axis one half of the cell is integrated with weight 2, points on
     * the axis with weight 1, the other half with weight 0.
     */
    unsigned int
    multiplicity(const dealii::Point<3> &Y) const;

    /// Diagonal of the operation by which averages over the integrated half
    /// must be symmetrized; all +1 without a 2-fold axis.
    bool
    integrates_half() const
    {
      return parameters_.two_fold_axis;
    }
    /// Whether cell averages must be completed by their glide image.
    bool
    has_glide() const
    {
      return true;
    }

  private:
    CellParameters                 parameters_;
    std::vector<FiberBundle>       bundles_;
    std::vector<SymmetryOperation> operations_;
    std::vector<ContactCandidates> contacts_;
    double                         area_;
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
} // namespace NPT

#endif
