// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the look for bundles that lie in each other, whatever contact knows
// of them.

#ifndef npt_dealii_homogenization_bundle_overlap_h
#define npt_dealii_homogenization_bundle_overlap_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// The deepest overlap of a bundle of the cell with another one or an image.
  struct BundleOverlap
  {
    double depth = 0; ///< [mm]; 0: there is none
    /// Part of the samples of all bundles that lie in another one: about the
    /// part of their volume [-].
    double           share  = 0;
    unsigned int     bundle = 0, other = 0;
    dealii::Point<3> place; ///< current position [mm]
  };

  /**
   * Where do bundles lie in each other? Sample points of every bundle, two per
   * knot span and direction, are looked for in all other bundles of the cell
   * and in the images of all bundles around it. The depth of a point on the
   * surface of its own bundle is its distance from the lateral faces of the
   * other one; that of a point inside is the diameter of the ball about it that
   * lies in both. So it is the thickness of the common part, also where two
   * bundles coincide.
   *
   * This is independent of the contact pairs: it sees neighbors without side
   * contact, points that contact has lost, and averages that are open where
   * points are not.
   *
   * @param u All unknowns, of MacroUnknowns.
   * @param woven As for make_couplings().
   * @param bends_along With objective jumps: the direction of curvature.
   * @param round_edges Whether bundles have round edges, (A47) of
   *   doc/theory.md: what lies beyond them does not count.
   * @param ranks Share the work.
   *
   * While a weaving offset holds the families apart only bundles of one family
   * are compared. A laminate has nothing to compare: its plies are one piece.
   */
  BundleOverlap
  find_overlap(const FabricCell                          &cell,
               const IGASpace<3>                         &space,
               const MacroUnknowns                       &macro,
               const dealii::Vector<double>              &u,
               const std::vector<dealii::Point<3>>       &woven,
               const std::optional<dealii::Tensor<1, 2>> &bends_along = {},
               const bool                                 round_edges = false,
               const Ranks                               &ranks       = {});

  /// "warp bundle 0 and weft bundle 1 at (0.1, 0.2, 0.3) mm".
  std::string
  describe(const BundleOverlap &overlap, const FabricCell &cell);
} // namespace NPT

#endif
