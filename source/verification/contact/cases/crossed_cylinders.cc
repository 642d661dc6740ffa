// SPDX-License-Identifier: LGPL-2.1-or-later
// Hertz' contact of two cylinders with crossed axes.

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
    HertzPoint
    aimed_contact(const ContactCaseParameters &p)
    {
      return HertzPoint::from_half_axis_x(p.half_width,
                                          p.upper.radius,
                                          p.lower.radius,
                                          contact_modulus(p));
    }

    /**
     * A quarter of two elastic cylinders; the upper one curves along x, the
     * lower one along y. Unequal radii give an ellipse.
     */
    class CrossedCylinders final : public ContactCase
    {
    public:
      void
      check(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        check_body_size(p, p.upper, "Upper body");
        check_body_size(p, p.lower, "Lower body");
      }

      bool
      needs_friction() const override
      {
        return false;
      }

      ContactModel
      make_model(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p     = parameters.benchmark;
        const HertzPoint             hertz = aimed_contact(p);
        ContactModel                 model;
        for (const bool upper : {true, false})
          {
            const auto     &body = upper ? p.upper : p.lower;
            const HertzMesh along_x(p, body, hertz.half_axis_x);
            const HertzMesh along_y(p, body, hertz.half_axis_y);
            model.patches.push_back(
              segment(upper,
                      Profile(upper ? body.radius : flat, 0., along_x.width),
                      Profile(upper ? flat : body.radius, 0., along_y.width),
                      along_x.width,
                      p.degree,
                      along_x.lateral,
                      along_y.lateral,
                      hertz.half_axis_x < hertz.half_axis_y ? along_x.depth :
                                                              along_y.depth));
          }
        model.handles = {"z"};
        model.couple  = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 2, 0);
          hold(c, c.face(0, 2, 1), {0, 1});
          hold(c, c.face(1, 2, 0), {0, 1, 2});
          for (const unsigned int patch : {0, 1})
            {
              hold(c, c.face(patch, 0, 0), {0});
              hold(c, c.face(patch, 1, 0), {1});
            }
        };
        model.force_factor = 4.;
        model.body_height  = p.body_size * p.half_width;
        model.stages       = {
                {"approach", false, 1, {move(0, -0.25 * hertz.approach)}},
                {"press", false, 5, {load(0, -hertz.load)}}};
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
                                                    p.lower.radius,
                                                    contact_modulus(p)),
                              results,
                              comparisons);
      }
    };

    const ContactCases::Registration
      registration("crossed cylinders", std::make_shared<CrossedCylinders>());
  } // namespace
} // namespace NPT
