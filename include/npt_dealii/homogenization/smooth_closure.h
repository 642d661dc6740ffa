// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the conditions that make the displacement C1 over the periodic faces
// of a fabric cell and between its crossings.

#ifndef npt_dealii_homogenization_smooth_closure_h
#define npt_dealii_homogenization_smooth_closure_h

#include <npt_dealii/homogenization/orbit_constraints.h>
#include <npt_dealii/homogenization/point_finder.h>

#include <functional>

namespace NPT
{
  /// Directions of a bundle in which it goes on in neighboring cells.
  unsigned int
  n_closed_directions(const FiberBundle &bundle);

  /// Control point of a patch at the seam, an end or a C0 knot, that a smooth
  /// closure relates to control point l; l itself if there is none. In both
  /// directions if both are closed.
  unsigned int
  nearest_seam(const NURBSPatch<3> &patch,
               const unsigned int   n_closed,
               const unsigned int   l);

  /// What the macro unknowns add to component i of the displacement of the
  /// image of a control point.
  using JumpOfImage =
    std::function<OrbitConstraints::Affine(const unsigned int       A,
                                           const SymmetryOperation &g,
                                           const unsigned int       i)>;

  /**
   * Add (A18), see make_couplings(), at periodic faces through the operations
   * of the cell and between crossings inside the patch.
   *
   * Throws std::logic_error if no operation continues some end of a bundle.
   */
  void
  close_smoothly(const FabricCell        &cell,
                 const IGASpace<3>       &space,
                 const BundlePointFinder &finder,
                 const JumpOfImage       &jump,
                 OrbitConstraints        &orbits);
} // namespace NPT

#endif
