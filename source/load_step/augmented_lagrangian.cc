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
  solve_contact_step(const NewtonParameters                   &newton,
                     const ContactParameters                  &parameters,
                     const NewtonProblem                      &problem,
                     const std::vector<ContactAssembler<3> *> &contacts,
                     Vector<double>                           &x)
  {
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
        for (ContactAssembler<3> *contact : contacts)
          {
            const auto violation = contact->violation();
            gap                  = std::max(gap, violation.gap);
            slip                 = std::max(slip, violation.slip);
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
        for (ContactAssembler<3> *contact : contacts)
          contact->augment(growth);
        const NewtonReport more = solve_newton(newton, problem, x);
        report.newton.iterations += more.iterations;
        report.final_residual = more.residual_norms.back();
      }
  }



  void
  start_friction(ContactAssembler<3> &contact, const Vector<double> &u)
  {
    contact.start_step(u);
    contact.evaluate(u);
    auto history = contact.history();
    contact.commit();
    history.closest = contact.history().closest;
    contact.set_history(history);
  }
} // namespace NPT
