// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cross sections of fiber bundles as NURBS patches.

#ifndef npt_dealii_fabric_bundle_section_h
#define npt_dealii_fabric_bundle_section_h

#include <npt_dealii/iga/nurbs_patch.h>

#include <map>
#include <string>

namespace NPT
{
  /**
   * Cross section of a bundle, symmetric about both axes, |y| <= w/2. Its wide
   * faces, top and bottom, are the surfaces that touch other bundles; they end
   * at blunt edges of half height e > 0, so that no cell degenerates.
   *
   * The shape is one of those that register themselves; a new one is a pair of
   * files like arch_sections.cc. Lens, ellipse and power ellipse are one
   * family, the arch of semi-axis t/2 cut off where its half height has fallen
   * to e:
   *
   * @f[ h(y) = \frac{t}{2} \left( 1 - (1 - \epsilon^{2/n})
   *       \left(\frac{2y}{w}\right)^2 \right)^{n/2}, \qquad
   *       \epsilon = \frac{2e}{t} ; @f]
   *
   * n = 2 is the lens h = e + (t/2 - e)(1 - (2y/w)^2), n = 1 the ellipse. Lens
   * and ellipse are exact NURBS. The power ellipse of other n is no NURBS: it
   * is interpolated at the Greville points of the mesh, so its error is
   * of order p + 1 in the width of the cells.
   *
   * The rounded rectangle has flat faces that end in circular arcs of 60
   * degrees and radius r = t - 2e, and side faces of height 2e. It is an exact
   * NURBS, C1 in its parameter where arcs and flats meet (the curvature jumps
   * there, so it cannot be smoother).
   */
  struct BundleSection
  {
    std::string shape     = "lens"; ///< a name of Registry<SectionShape>
    double      width     = 4.0;    ///< w [mm]
    double      thickness = 1.2;    ///< t [mm], at the center
    double      tip       = 0.12;   ///< e [mm], half height of the blunt edge

    /// Further numbers of the shape by the names of their entries; those that
    /// are not here have their defaults.
    std::map<std::string, double> numbers = {};

    /// A further number of this shape, given or by default.
    double
    number(const std::string &entry) const;
    /// Half height h(y) [mm].
    double
    half_height(const double y) const;
    /// Area of the exact section [mm^2]; by quadrature for the power ellipse.
    double
    area() const;
    /// Angle at which the wide face meets the side face, against the width
    /// [degrees]; at 90 degrees the cells of the edge would degenerate.
    double
    edge_angle() const;

    /**
     * The section as a patch: direction 0 across, of the given degree and with
     * n_across spans that are equally wide, direction 1 through the thickness,
     * linear, one span; both on [0,1].
     *
     * The rounded rectangle has spans of its own for arcs and flat, equally
     * wide within each; it needs n_across >= 3 and throws InputError below.
     */
    NURBSPatch<2>
    patch(const unsigned int degree, const unsigned int n_across) const;

    /// What makes these sizes impossible for the shape, without full stop;
    /// empty if nothing does.
    std::string
    obstacle() const;
  };
} // namespace NPT

#endif
