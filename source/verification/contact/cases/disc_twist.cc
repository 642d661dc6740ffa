// SPDX-License-Identifier: LGPL-2.1-or-later
// The torque of a disc that slips as a whole.

#include <npt_dealii/verification/contact/cases/hertz_bodies.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace NPT
{
  using dealii::numbers::PI;

  namespace
  {
    /**
     * A rigid disc pressed on a rigid plane and turned by one degree.
     */
    class DiscTwist final : public ContactCase
    {
    public:
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
        const double                 R = p.upper.radius;
        model.patches = {disc(R, 0., 0.5 * R, p.degree, p.upper.n_elements),
                         rigid_plane(1.5 * R, p.degree)};
        model.handles = {"cosine - 1", "sine", "z"};
        model.couple  = [](HandleCouplings &c) {
          attach_rotation(c, c.all(0), 0, 1);
          attach(c, c.all(0), 2, 2);
          hold(c, c.all(1), {0, 1, 2});
        };
        model.body_height = R;
        model.stages      = {
               {"approach", false, 1, {move(2, -1e-6 * R)}},
               {"press", false, 1, {load(2, -p.pressure * PI * R * R)}},
               {"twist", true, p.load_steps, turn(0, 1, PI / 180.)}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"torque", "N mm"}, {"sticking nodes", "-"}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const auto  &row = results.row();
        const double exact =
          torque_of_slipping_disc(parameters.friction.coefficient,
                                  -row.force[2],
                                  parameters.benchmark.upper.radius);
        comparisons.compare("torque", torque(row), exact);
        comparisons.compare("sticking nodes", row.n_stick, 0.);
        std::vector<std::array<double, 3>> profile;
        for (const ContactRow &r : results.rows())
          if (r.stage == "twist")
            profile.push_back(
              {{std::asin(r.value[1]) * 180. / PI, torque(r), exact}});
        comparisons.set_profile("angle [degrees]",
                                "torque [N mm]",
                                profile,
                                true);
      }
    };

    const ContactCases::Registration
      registration("disc twist", std::make_shared<DiscTwist>());
  } // namespace
} // namespace NPT
