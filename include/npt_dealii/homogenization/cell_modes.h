// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines which macroscopic modes the symmetry of a cell allows, and what they
// add to the displacement of an image of the cell.

#ifndef npt_dealii_homogenization_cell_modes_h
#define npt_dealii_homogenization_cell_modes_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/macro_modes.h>

#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  /// Macroscopic displacement of one unit of H_n (n from 0) at a point.
  dealii::Tensor<1, 3>
  macroscopic_displacement(const unsigned int n, const dealii::Point<3> &Y);

  /**
   * What one unit of H_n (n from 0) adds to the displacement of an image of the
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

  /// Whether a mode is invariant under an operation; it turns into its opposite
  /// otherwise.
  bool
  keeps_mode(const SymmetryOperation &g, const unsigned int n);

  /// Whether the operations of the cell allow mode n.
  bool
  represents_mode(const FabricCell &cell, const unsigned int n);

  /// All modes that the cell allows.
  std::vector<unsigned int>
  represented_modes(const FabricCell &cell);

  /// Name of the operation that forbids mode n, or an empty string.
  std::string
  obstacle(const FabricCell &cell, const unsigned int n);

  /// A length of the order of the thickness [mm]: 1 mm in the default cell.
  double
  length_unit(const CellParameters &cell);

  /// What the displacements of one unit of H_n are measured by in tolerances
  /// and norms: the length unit [mm] for a gradient, its square [mm^2] for a
  /// curvature.
  double
  displacement_unit(const CellParameters &cell, const unsigned int n);

  /// The smallest cell type that represents the given modes, and a clause that
  /// says why: "because ...".
  std::pair<std::string, std::string>
  smallest_cell_type(const CellParameters            &cell,
                     const std::vector<unsigned int> &modes);
} // namespace NPT

#endif
