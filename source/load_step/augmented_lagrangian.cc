// SPDX-License-Identifier: LGPL-2.1-or-later
// Repetitions of the augmented Lagrangian and growth of its penalties.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/augmented_lagrangian.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace NPT
{
  namespace
  {
    // Repetitions before penalties may grow, and by how much they do.
    constexpr unsigned int n_patient     = 5;
    constexpr double       growth_factor = 4.;
  } // namespace



  AugmentedLagrangian::AugmentedLagrangian(const ContactParameters &parameters)
    : parameters_(parameters)
  {
    AssertThrow(!parameters.augmented() ||
                  (parameters.penetration_tolerance > 0. &&
                   parameters.stick_tolerance > 0.),
                dealii::ExcMessage("ContactParameters::set_thickness() must "
                                   "give the tolerances of the augmented "
                                   "Lagrangian."));
    previous_.gap = previous_.slip = std::numeric_limits<double>::max();
  }



  std::optional<double>
  AugmentedLagrangian::next_growth(const ContactViolation &violation)
  {
    if (!parameters_.augmented())
      return {};
    const double gap_tolerance  = parameters_.penetration_tolerance;
    const double slip_tolerance = parameters_.stick_tolerance;
    if (violation.gap <= gap_tolerance && violation.slip <= slip_tolerance)
      return {};
    if (n_repetitions_ == parameters_.max_augmentations)
      {
        std::ostringstream detail;
        detail << "gap " << violation.gap << " mm, stick drift "
               << violation.slip << " mm after " << n_repetitions_
               << " augmentations. A larger penalty takes fewer of them.";
        throw NewtonNotConverged("augmentation limit", detail.str());
      }
    const bool slow =
      violation.gap > std::max(gap_tolerance, 0.5 * previous_.gap) ||
      violation.slip > std::max(slip_tolerance, 0.5 * previous_.slip);
    const bool grow = n_repetitions_ >= n_patient && slow;
    previous_       = violation;
    ++n_repetitions_;
    return grow ? growth_factor : 1.;
  }
} // namespace NPT
