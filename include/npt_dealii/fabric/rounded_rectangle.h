// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the section with flat faces, arcs and side faces.

#ifndef npt_dealii_fabric_rounded_rectangle_h
#define npt_dealii_fabric_rounded_rectangle_h

#include <npt_dealii/fabric/bundle_section.h>

#include <deal.II/base/numbers.h>

namespace NPT
{
  /**
   * Flat faces that end in circular arcs of 60 degrees and radius r = t - 2e,
   * and side faces of height 2e; an exact NURBS. Registered as "rounded
   * rectangle"; it needs three spans across.
   */
  namespace RoundedRectangle
  {
    /// Opening of the arcs.
    constexpr double arc_angle = dealii::numbers::PI / 3;

    double
    half_height(const BundleSection &section, const double y);
  } // namespace RoundedRectangle
} // namespace NPT

#endif
