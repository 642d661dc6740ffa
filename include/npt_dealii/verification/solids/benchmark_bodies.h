// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the bodies of solid benchmarks as NURBS patches, coarse and exact,
// and their refinement.

#ifndef npt_dealii_verification_solids_benchmark_bodies_h
#define npt_dealii_verification_solids_benchmark_bodies_h

#include <npt_dealii/iga/nurbs_patch.h>

#include <array>
#include <vector>

namespace NPT
{
  /**
   * First quadrant of a square plate with a circular hole around the origin:
   * two patches joined along the diagonal, so that no corner is degenerate.
   * Directions: from the hole to the edge, around, through the thickness.
   *
   * @param radius Of the hole. @param half_width Of the plate; larger.
   */
  std::vector<NURBSPatch<3>>
  quarter_plate_with_hole(const double radius,
                          const double half_width,
                          const double thickness);

  /// First quadrant of a tube around axis 3. Directions: radius, around, axis.
  NURBSPatch<3>
  quarter_tube(const double inner_radius,
               const double outer_radius,
               const double height);

  /**
   * First octant of a hollow sphere around the origin. Directions: radius,
   * from the pole on axis 3 to the equator, around axis 3.
   *
   * A biquadratic sphere has a degenerate edge at the pole (patches without
   * one need degree four): the face "begin" of direction 1 is a segment of
   * axis 3, on which all control points of direction 2 coincide. They must be
   * given the same displacement; then the functions are single-valued there,
   * and as those of the second row are proportional to the distance from the
   * axis, no rate of convergence is lost (measured in doc/verification.md).
   */
  NURBSPatch<3>
  sphere_octant(const double inner_radius, const double outer_radius);

  /// The unit cube.
  NURBSPatch<3>
  unit_block();

  /**
   * k-refinement: raise all directions to one degree, then split them, so that
   * the functions are C^{p-1} between the new spans.
   *
   * @param n_spans Per direction.
   */
  void
  refine(NURBSPatch<3>                     &patch,
         const unsigned int                 degree,
         const std::array<unsigned int, 3> &n_spans);

  /**
   * Distort the parametrization of a block: move each control point at random,
   * but the same at every call, in each direction by at most a fraction of the
   * distance to its neighbors. Control points on a face move within it, so the
   * body stays the block.
   *
   * @param fraction 0 to less than 0.5 [-].
   */
  void
  distort(NURBSPatch<3> &block, const double fraction);
} // namespace NPT

#endif
