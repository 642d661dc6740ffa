// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the global unknowns of a cell, macroscopic modes and the weaving
// offset, and their places among the unknowns.

#ifndef npt_dealii_homogenization_macro_unknowns_h
#define npt_dealii_homogenization_macro_unknowns_h

#include <npt_dealii/homogenization/macro_modes.h>

namespace NPT
{
  /**
   * Numbering of all unknowns of a cell: three displacement components per
   * control point, then the generalized displacement gradients in the order of
   * MacroModes::table, then the weaving offset [mm]: the distance by which the
   * bundles are still held apart, from t (straight) to 0 (woven). Behind them
   * are unknowns of which only some stages make use; elsewhere they are zero.
   */
  struct MacroUnknowns
  {
    static constexpr unsigned int n_modes = MacroModes::n;
    static constexpr unsigned int n_macro = n_modes + 1;
    /// With the distance of the plates: the unknowns whose reactions do work.
    static constexpr unsigned int n_driven = n_macro + 1;

    explicit MacroUnknowns(const unsigned int n_control_points)
      : first(3 * n_control_points)
    {}

    unsigned int
    mode(const unsigned int n) const
    {
      return first + n;
    }
    unsigned int
    weaving_offset() const
    {
      return first + n_modes;
    }
    /// What holds the mean height of a bent cell, see ObjectiveJumps, or what
    /// leads the yarns of a frame, see FrameDrive [mm]; the force is
    /// proportional to it.
    unsigned int
    support() const
    {
      return first + n_macro;
    }
    /// Distance of the plates that press the fabric [mm], see PressPlates.
    unsigned int
    plate_distance() const
    {
      return support() + 1;
    }
    /// Height of the plane half way between them [mm].
    unsigned int
    plate_center() const
    {
      return support() + 2;
    }
    /// Unknowns of images follow; see PeriodicImage.
    unsigned int
    first_image_unknown() const
    {
      return plate_center() + 1;
    }
    unsigned int
    n_unknowns() const
    {
      return first_image_unknown() + n_image_unknowns;
    }

    unsigned int first;
    unsigned int n_image_unknowns = 0;
  };
} // namespace NPT

#endif
