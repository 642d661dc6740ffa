// SPDX-License-Identifier: LGPL-2.1-or-later
// Width of a crossing bundle in spans of the other one.

#include <npt_dealii/problems/plate_test/contact_resolution.h>

namespace NPT
{
  double
  n_spans_across_partner(const FabricCell  &cell,
                         const IGASpace<3> &space,
                         const unsigned int secondary_bundle)
  {
    const CellParameters &parameters = cell.parameters();
    const FiberBundle    &bundle     = cell.bundles()[secondary_bundle];
    const bool            warp   = bundle.family == FiberBundle::Family::warp;
    const double          length = warp ? parameters.crossing_spacing.weft :
                                          parameters.crossing_spacing.warp;
    const double          width =
      warp ? parameters.bundle_width.weft : parameters.bundle_width.warp;
    const double n_along =
      static_cast<double>(
        space.patch(secondary_bundle).knot_vector(0).n_spans()) /
      bundle.n_crossings;
    return n_along * width / length;
  }
} // namespace NPT
