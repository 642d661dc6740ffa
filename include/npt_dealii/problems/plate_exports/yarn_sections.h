// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the sections along the bundles of the repeat, as TexGen wants them.

#ifndef npt_dealii_problems_plate_exports_yarn_sections_h
#define npt_dealii_problems_plate_exports_yarn_sections_h

#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/problems/plate_exports/fabric_strand.h>

#include <string>
#include <vector>

namespace NPT
{
  /**
   * Paths and sections of the strands of one repeat. A station stands at every
   * knot along a strand: its position is the middle line of the bundle there,
   * its tangent that of this line, and its section is where the plane normal to
   * the tangent cuts the bundle, a polygon through the cuts of lines along the
   * bundle. At the ends the bundle goes on periodically.
   *
   * Throws InputError for a laminate and for a bent or sheared repeat, which no
   * translations along x and y continue.
   */
  WovenTextile
  make_woven_textile(const std::vector<FabricStrand> &strands,
                     const std::string               &name);
} // namespace NPT

#endif
