// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the sections whose wide face is one arch: lens, ellipse and power
// ellipse.

#ifndef npt_dealii_fabric_arch_sections_h
#define npt_dealii_fabric_arch_sections_h

#include <npt_dealii/fabric/bundle_section.h>

namespace NPT
{
  /**
   * The arch of BundleSection,
   *
   * @f[ h(y) = \frac{t}{2} \left( 1 - (1 - \epsilon^{2/n})
   *       \left(\frac{2y}{w}\right)^2 \right)^{n/2}, \qquad
   *       \epsilon = \frac{2e}{t} . @f]
   *
   * Registered as "lens" (n = 2), "ellipse" (n = 1) and "power ellipse" (n by
   * the entry "Section power").
   */
  namespace ArchSection
  {
    double
    half_height(const BundleSection &section, const double n, const double y);

    /// Angle at which the arch meets the side face [degrees].
    double
    edge_angle(const BundleSection &section, const double n);
  } // namespace ArchSection
} // namespace NPT

#endif
