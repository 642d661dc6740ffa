// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the cross sections of fiber bundles as NURBS patches.

#ifndef npt_dealii_cell_bundle_section_h
#define npt_dealii_cell_bundle_section_h

#include <npt_dealii/iga/nurbs_patch.h>

namespace NPT
{
  /**
   * Lens section with blunt tips, half thickness
   *
   * @f[ h(y) = e + (t/2 - e) (1 - (2y/w)^2), \qquad |y| \le w/2 . @f]
   *
   * Parametric directions: across (quadratic), through the thickness (linear),
   * both on [0,1]; no degenerate corners.
   *
   * @param width w [mm]. @param thickness t [mm]. @param tip e [mm].
   */
  NURBSPatch<2>
  lens_section(const double width, const double thickness, const double tip);
} // namespace NPT

#endif
