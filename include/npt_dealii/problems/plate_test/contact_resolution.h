// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how finely the mesh of a bundle sees the bundles that cross it.

#ifndef npt_dealii_problems_plate_test_contact_resolution_h
#define npt_dealii_problems_plate_test_contact_resolution_h

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/iga/iga_space.h>

namespace NPT
{
  /**
   * Knot spans of a secondary bundle that a bundle crossing it covers: its
   * width over the length of a span.
   */
  double
  n_spans_across_partner(const FabricCell  &cell,
                         const IGASpace<3> &space,
                         const unsigned int secondary_bundle);

  /**
   * Below this many spans a mean over the support of a control point (three
   * spans for degree 2) is no local quantity any more: contact is posed at the
   * Gauss points then, whatever Contact / Method says.
   */
  constexpr double fewest_spans_for_mortar = 3.;
} // namespace NPT

#endif
