// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the lens with flat faces, an example of a further section.

#ifndef npt_dealii_doc_extending_flattened_lens_h
#define npt_dealii_doc_extending_flattened_lens_h

#include <npt_dealii/fabric/bundle_section.h>

namespace NPT
{
  /**
   * Flat faces over the share f of the width, and parabolic flanks down to the
   * blunt edge,
   *
   * @f[ h(y) = \frac{t}{2} - \left(\frac{t}{2} - e\right)
   *       \left( \frac{\max(0, |2y/w| - f)}{1 - f} \right)^2 . @f]
   *
   * f = 0 would be the lens. A quadratic spline with single knots at the ends
   * of the flat, thus exact and C1. Registered as "flattened lens"; it needs
   * three spans across.
   */
  namespace FlattenedLens
  {
    double
    half_height(const BundleSection &section, const double y);
  } // namespace FlattenedLens
} // namespace NPT

#endif
