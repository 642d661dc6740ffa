// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines when the augmented Lagrangian repeats a solution, and when it lets
// the penalties grow.

#ifndef npt_dealii_load_step_augmented_lagrangian_h
#define npt_dealii_load_step_augmented_lagrangian_h

#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/contact/contact_parameters.h>

#include <optional>

namespace NPT
{
  /**
   * The repetitions (Uzawa) of one load step: with the tractions of the last
   * solution as multipliers it is solved again until penetration and stick
   * drift are below their tolerances, (A17) of doc/theory.md.
   */
  class AugmentedLagrangian
  {
  public:
    /// With the penalty method there are no repetitions.
    explicit AugmentedLagrangian(const ContactParameters &parameters);

    /**
     * What to do after a solution: nothing more, or one more solution with
     * penalties that grow by the returned factor. A penalty that is small
     * against the stiffness of the bodies gains little per repetition: after
     * some of them it grows. The solution does not depend on it.
     *
     * Throws NewtonNotConverged, "augmentation limit", if
     * ContactParameters::max_augmentations are not enough.
     */
    std::optional<double>
    next_growth(const ContactViolation &violation);

  private:
    const ContactParameters parameters_;
    unsigned int            n_repetitions_ = 0;
    ContactViolation        previous_;
  };
} // namespace NPT

#endif
