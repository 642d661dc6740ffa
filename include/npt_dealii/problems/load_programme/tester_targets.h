// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the stages that do as testers do are driven by.

#ifndef npt_dealii_problems_load_programme_tester_targets_h
#define npt_dealii_problems_load_programme_tester_targets_h

#include <npt_dealii/problems/load_programme/load_programme.h>

#include <optional>
#include <string>

namespace NPT
{
  /**
   * Targets of stages in the terms of fabric testers:
   *
   * | type | targets |
   * | --- | --- |
   * | trellis | shear_angle [degree]; yarns end with the length of the woven
   * cell |
   * | picture frame | shear_angle, and for both yarns either a stretch [-] or a
   * tension [N/mm]; without, they keep the stretch that they have |
   * | bias extension | shear_angle or bias_stretch [-] |
   * | compression | plate_distance [mm] or pressure [MPa], and any H and n |
   *
   * The columns of curves.csv have the same names.
   */
  namespace TesterTargets
  {
    /// H1, H2 and H3 are the membrane modes that yarns lead.
    constexpr unsigned int n_membrane = 3;

    /// "shear_angle|warp_stretch|...", for a pattern.
    std::string
    choices();

    /// One or two sentences for the entry Targets.
    std::string
    meaning();

    /**
     * Check that a stage of known type has the targets of its type, in their
     * ranges, and set H_targets where they follow. Throws InputError with
     * stage, name, value and range.
     */
    void
    settle(LoadStage &stage);

    /// The shear angle at the end of a stage that leads yarns [rad]; of a bias
    /// extension by its stretch that of a trellis. Nothing if that has no such
    /// angle.
    std::optional<double>
    expected_shear_angle(const LoadStage &stage);

    /// "shear_angle = 30 degree" and so on, as reached or as wanted, for
    /// titles.
    std::string
    with_unit(const std::string &name, const double value);
  } // namespace TesterTargets
} // namespace NPT

#endif
