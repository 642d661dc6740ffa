// SPDX-License-Identifier: LGPL-2.1-or-later
// Hertz' contact of a sphere on a rigid plane.

#include <npt_dealii/verification/contact/cases/hertz_bodies.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>

namespace NPT
{
  namespace
  {
    /**
     * A quarter of an elastic sphere on a rigid plane.
     */
    class Sphere final : public ContactCase
    {
    public:
      void
      check(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        check_body_size(p, p.upper, "Upper body");
      }

      bool
      needs_friction() const override
      {
        return false;
      }

      ContactModel
      make_model(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        ContactModel                 model;
        model.patches = {sphere_segment(p),
                         rigid_plane(1.2 * p.body_size * p.half_width,
                                     p.degree)};
        model.handles = {"z"};
        model.couple  = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 2, 0);
          hold(c, c.face(0, 2, 1), {0, 1});
          hold(c, c.face(0, 0, 0), {0});
          hold(c, c.face(0, 1, 0), {1});
          hold(c, c.all(1), {0, 1, 2});
        };
        model.force_factor = 4.;
        model.body_height  = p.body_size * p.half_width;
        model.stages       = {
                {"approach",
                 false,
                 1,
                 {move(0, -0.25 * p.half_width * p.half_width / p.upper.radius)}},
                {"press", false, 5, {load(0, -aimed_load_sphere(p))}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return point_contact_quantities();
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const auto &p = parameters.benchmark;
        compare_point_contact(HertzPoint::from_load(-results.row().force.back(),
                                                    p.upper.radius,
                                                    p.upper.radius,
                                                    contact_modulus_on_rigid(
                                                      p)),
                              results,
                              comparisons);
      }
    };

    const ContactCases::Registration registration("sphere",
                                                  std::make_shared<Sphere>());
  } // namespace
} // namespace NPT
