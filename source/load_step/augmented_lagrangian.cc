// SPDX-License-Identifier: LGPL-2.1-or-later
// The loop of the augmented Lagrangian around Newton's method.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/augmented_lagrangian.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace NPT
{
  using dealii::Vector;

  ContactStepReport
  solve_contact_step(const NewtonParameters                    &newton,
                     const ContactParameters                   &parameters,
                     const NewtonProblem                       &problem,
                     const std::vector<const ContactPair<3> *> &contacts,
                     std::vector<ContactStep<3>>               &steps,
                     const std::vector<ContactEvaluation<3>>   &evaluations,
                     Vector<double>                            &x)
  {
    AssertDimension(steps.size(), contacts.size());
    AssertDimension(evaluations.size(), contacts.size());
    ContactStepReport report;
    report.newton         = solve_newton(newton, problem, x);
    report.final_residual = report.newton.residual_norms.back();
    if (!parameters.augmented())
      return report;

    constexpr unsigned int n_patient     = 5;
    double                 previous_gap  = std::numeric_limits<double>::max();
    double                 previous_slip = previous_gap;
    for (unsigned int k = 0;; ++k)
      {
        double gap = 0, slip = 0;
        for (unsigned int c = 0; c < contacts.size(); ++c)
          {
            const auto violation =
              contacts[c]->violation(steps[c], evaluations[c]);
            gap  = std::max(gap, violation.gap);
            slip = std::max(slip, violation.slip);
          }
        if (gap <= parameters.penetration_tolerance &&
            slip <= parameters.stick_tolerance)
          return report;
        if (k == parameters.max_augmentations)
          {
            std::ostringstream detail;
            detail << "gap " << gap << " mm, stick drift " << slip
                   << " mm after " << k
                   << " augmentations. A larger penalty takes fewer of them.";
            throw NewtonNotConverged("augmentation limit", detail.str());
          }
        // A penalty that is small against the stiffness of the bodies gains
        // little per repetition: after some of them let it grow, and keep it
        // for the next steps. The solution does not depend on it.
        const bool slow =
          gap >
            std::max(parameters.penetration_tolerance, 0.5 * previous_gap) ||
          slip > std::max(parameters.stick_tolerance, 0.5 * previous_slip);
        const double growth = k >= n_patient && slow ? 4. : 1.;
        previous_gap        = gap;
        previous_slip       = slip;
        for (unsigned int c = 0; c < contacts.size(); ++c)
          contacts[c]->augment(steps[c], evaluations[c], growth);
        const NewtonReport more = solve_newton(newton, problem, x);
        report.newton.iterations += more.iterations;
        report.final_residual = more.residual_norms.back();
      }
  }

} // namespace NPT
