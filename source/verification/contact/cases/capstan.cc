// SPDX-License-Identifier: LGPL-2.1-or-later
// A belt on a drum after Euler and Eytelwein.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>
#include <npt_dealii/verification/contact/exact_contact.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <sstream>

namespace NPT
{
  using dealii::numbers::PI;

  namespace
  {
    /**
     * A thin elastic belt on a rigid drum. The slack end carries a dead load
     * along its tangent; the tight end is first held and then pulled along its
     * tangent until the belt slips everywhere.
     */
    class Capstan final : public ContactCase
    {
    public:
      void
      check(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        if (p.thickness <= 0.2 * p.lower.radius)
          return;
        std::ostringstream text;
        text << "Thickness is " << p.thickness
             << " mm; a belt must be thinner than a fifth of the radius of the "
                "drum, "
             << p.lower.radius << " mm (subsections Benchmark and Lower body).";
        throw InputError(text.str());
      }

      bool
      needs_friction() const override
      {
        return true;
      }

      ContactModel
      make_model(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        ContactModel                 model;
        const double R = p.lower.radius, half = p.wrap_angle * PI / 360.;
        const double b = p.thickness;
        // The belt begins with a thousandth of its pressure, so that the drum
        // holds it from the first iteration on.
        const double inner =
          R - 1e-3 * p.pressure / parameters.contact.normal_penalty;
        model.patches = {ring(inner,
                              inner + p.thickness,
                              half,
                              b,
                              p.degree,
                              p.upper.n_elements,
                              1),
                         ring(0.5 * R,
                              R,
                              half + 10. * PI / 180.,
                              b,
                              p.degree,
                              p.lower.n_elements,
                              1)};
        model.handles = {"slack end", "tight end"};
        model.couple  = [half](HandleCouplings &c) {
          // Displacement along the outward tangent of an end face is the
          // handle.
          for (const unsigned int side : {0, 1})
            {
              const double t[2] = {(side == 0 ? -1. : 1.) * std::cos(half),
                                   -std::sin(half)};
              const unsigned int pivot =
                std::abs(t[0]) > std::abs(t[1]) ? 0 : 1;
              for (const unsigned int A : c.face(0, 0, side))
                {
                  const unsigned int u[2] = {c.displacement(A, 0),
                                             c.displacement(A, 2)};
                  // Of the layers across the belt the first one leads.
                  const double Y = c.space().control_points()[A][1];
                  if (Y < 1e-12)
                    c.tie(u[pivot],
                          {{c.handle(side), 1. / t[pivot]},
                           {u[1 - pivot], -t[1 - pivot] / t[pivot]}});
                }
            }
          hold(c, c.all(1), {0, 1, 2});
          plane_strain(c);
        };
        model.force_factor = 1. / b;
        model.body_height  = R;
        const double T     = p.pressure * R;
        model.stages       = {{"tighten", false, 5, {load(0, T)}},
                              {"pull", true, p.load_steps, {move(1, p.distance)}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"tension ratio T2/T1", "-"},
                {"T2/T1 of a belt of this thickness", "-"},
                {"sticking nodes", "-"}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const auto  &p     = parameters.benchmark;
        const double mu    = parameters.friction.coefficient;
        const double angle = p.wrap_angle * PI / 180., R = p.lower.radius;
        const auto  &row = results.row();
        comparisons.compare("tension ratio T2/T1",
                            row.force[1] / row.force[0],
                            capstan_ratio(mu, angle));
        // Friction acts half the thickness below the middle of the belt:
        // moments about the axis give dT (R + h/2) = mu p R R d(angle), p R =
        // T.
        comparisons.compare("T2/T1 of a belt of this thickness",
                            row.force[1] / row.force[0],
                            capstan_ratio(mu,
                                          angle * R / (R + 0.5 * p.thickness)));
        comparisons.compare("sticking nodes", row.n_stick, 0.);
        std::vector<std::array<double, 3>> profile;
        for (const ContactSample &sample : results.samples())
          {
            const double phi = std::atan2(sample.x[0], sample.x[2]);
            profile.push_back(
              {{phi * 180. / PI,
                sample.pressure,
                row.force[0] / R * std::exp(mu * (phi + 0.5 * angle))}});
          }
        comparisons.set_profile("angle [degrees]",
                                "contact pressure [MPa]",
                                profile);
      }
    };

    const ContactCases::Registration registration("capstan",
                                                  std::make_shared<Capstan>());
  } // namespace
} // namespace NPT
