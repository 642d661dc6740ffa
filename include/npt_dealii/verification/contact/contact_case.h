// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what a contact benchmark is made of: bodies as exact NURBS patches,
// what holds and moves them, the stages of loading, and the comparison with the
// exact solution, all behind one interface.

#ifndef npt_dealii_verification_contact_contact_case_h
#define npt_dealii_verification_contact_contact_case_h

#include <npt_dealii/base/registry.h>
#include <npt_dealii/iga/nurbs_patch.h>
#include <npt_dealii/verification/comparison.h>
#include <npt_dealii/verification/contact/handle_couplings.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  class ContactComparisons;
  class ContactResults;
  struct ContactBenchmarkParameters;

  /// What a handle does in a stage: its value, or the force on it (on the whole
  /// body, see ContactModel::force_factor), from t = 0, where it is what it was
  /// before, to the end of the stage at t = 1.
  struct HandleDrive
  {
    unsigned int handle;
    bool         force; ///< else value
    std::function<double(const double start, const double t)> value;
  };

  /// A value that goes linearly to its end.
  HandleDrive
  move(const unsigned int handle, const double end);

  /// A force that goes linearly to its end.
  HandleDrive
  load(const unsigned int handle, const double end);

  /// The handles of attach_rotation(), from rest to a finite angle.
  std::vector<HandleDrive>
  turn(const unsigned int cosine, const unsigned int sine, const double angle);

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



  /**
   * A value of the entry "Case". A new case is one file in
   * source/verification/contact, which registers an object of a derived class:
   *
   * @code
   *   const ContactCases::Registration
   *     registration("block", std::make_shared<Block>());
   * @endcode
   */
  class ContactCase
  {
  public:
    virtual ~ContactCase() = default;

    /// Throws InputError if the case cannot be built from the parameters.
    virtual void
    check(const ContactBenchmarkParameters &) const
    {}

    /// Whether the exact solution is one of friction, which then must not be
    /// zero.
    virtual bool
    needs_friction() const = 0;

    virtual ContactModel
    make_model(const ContactBenchmarkParameters &parameters) const = 0;

    /// All that compare() and compare_stage() name.
    virtual std::vector<ComparedQuantity>
    quantities() const = 0;

    /// Compare the state at the end of a stage that is not the last one.
    virtual void
    compare_stage(const std::string &,
                  const ContactBenchmarkParameters &,
                  const ContactResults &,
                  ContactComparisons &) const
    {}

    /// Compare the state at the end of the last stage.
    virtual void
    compare(const ContactBenchmarkParameters &parameters,
            const ContactResults             &results,
            ContactComparisons               &comparisons) const = 0;
  };

  /// All cases by their names. They have no state.
  using ContactCases = Registry<std::shared_ptr<const ContactCase>>;

  /// The quantities of a case and those of every contact benchmark: balance of
  /// forces and moments, largest penetration.
  std::vector<ComparedQuantity>
  all_quantities(const ContactCase &contact_case);
} // namespace NPT

#endif
