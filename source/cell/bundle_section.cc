// SPDX-License-Identifier: LGPL-2.1-or-later
// Cross sections of fiber bundles.

#include <npt_dealii/cell/bundle_section.h>

namespace NPT
{
  NURBSPatch<2>
  lens_section(const double width, const double thickness, const double tip)
  {
    // In Bernstein form 1 - (2y/w)^2 has the coefficients 0, 2, 0.
    const double h[3] = {tip, thickness - tip, tip};

    std::vector<dealii::Point<2>> points;
    for (const double zeta : {-1., 1.})
      for (unsigned int i = 0; i < 3; ++i)
        points.emplace_back(width * (0.5 * i - 0.5), zeta * h[i]);
    return NURBSPatch<2>(
      {{KnotVector::uniform(2, 1), KnotVector::uniform(1, 1)}}, points);
  }
} // namespace NPT
