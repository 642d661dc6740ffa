// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the set-up of the contact benchmarks: bodies as exact NURBS patches,
// what holds and moves them, and the stages of loading.

#ifndef npt_dealii_verification_contact_contact_cases_h
#define npt_dealii_verification_contact_contact_cases_h

#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/handle_couplings.h>

#include <functional>
#include <string>
#include <vector>

namespace NPT
{
  /// What a handle does in a stage: its value, or the force on it (on the whole
  /// body, see ContactModel::force_factor), from t = 0, where it is what it was
  /// before, to the end of the stage at t = 1.
  struct HandleDrive
  {
    unsigned int handle;
    bool         force; ///< else value
    std::function<double(const double start, const double t)> value;
  };

  struct ContactStage
  {
    std::string              name;
    bool                     friction = false;
    unsigned int             n_steps  = 1;
    std::vector<HandleDrive> drives; ///< handles not named stay as they are
  };

  /**
   * A contact problem: two bodies of one patch each, patch 0 the upper one with
   * the secondary surface, patch 1 the lower one with the primary surface.
   *
   * Bodies are patches over x, y (or angle and y) with the third direction
   * upward; they touch at z = 0, which is the lower side of the upper body and
   * the upper side of the lower one.
   */
  struct ContactModel
  {
    std::vector<NURBSPatch<3>>             patches;
    std::vector<std::string>               handles;
    std::function<void(HandleCouplings &)> couple;
    std::vector<ContactStage>              stages;
    /// Forces on the whole body over those on the part that is modeled: 2 or 4
    /// by symmetry, and 1/width for forces per length in plane strain.
    double force_factor = 1;
    /// Deeper closest points belong to the far side [mm].
    double body_height = 1;
  };

  /// Throws InputError if the case cannot be built from the parameters.
  ContactModel
  make_contact_model(const ContactBenchmarkParameters &parameters);
} // namespace NPT

#endif
