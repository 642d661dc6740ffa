// SPDX-License-Identifier: LGPL-2.1-or-later
// Hertz' contact of two cylinders with parallel axes.

#include <npt_dealii/verification/contact/cases/hertz_bodies.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  namespace
  {
    /**
     * Two elastic cylinders with parallel axes in plane strain, half of them
     * (x >= 0); the plane tops and bottoms are rigid plates.
     */
    class Cylinders final : public ContactCase
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
        const ContactCaseParameters &p = parameters.benchmark;
        ContactModel                 model;
        const double                 b = p.half_width;
        for (const bool upper : {true, false})
          {
            const auto     &body = upper ? p.upper : p.lower;
            const HertzMesh mesh(p, body, p.half_width);
            model.patches.push_back(
              segment(upper,
                      Profile(body.radius, 0., mesh.width),
                      Profile(flat, 0., b),
                      mesh.width,
                      p.degree,
                      mesh.lateral,
                      {},
                      mesh.depth));
          }
        model.handles = {"z"};
        model.couple  = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 2, 0);
          hold(c, c.face(0, 2, 1), {0});
          hold(c, c.face(1, 2, 0), {0, 2});
          for (const unsigned int patch : {0, 1})
            hold(c, c.face(patch, 0, 0), {0});
          plane_strain(c);
        };
        model.force_factor = 2. / b;
        model.body_height  = p.body_size * p.half_width;
        const double R     = 1. / (1. / p.upper.radius + 1. / p.lower.radius);
        model.stages       = {{"approach",
                               false,
                               1,
                               {move(0, -0.25 * p.half_width * p.half_width / R)}},
                              {"press", false, 5, {load(0, -aimed_load_line(p))}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"peak pressure", "MPa"},
                {"half width", "mm"},
                {"pressure profile, L2", "-"},
                {"approach of the plates", "mm", false}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const auto  &p   = parameters.benchmark;
        const double R   = 1. / (1. / p.upper.radius + 1. / p.lower.radius);
        const double E   = contact_modulus(p);
        const auto hertz = HertzLine::from_load(-results.row().force[0], R, E);

        double       largest = 0, load = 0, second_moment = 0;
        ProfileError error;
        std::vector<std::array<double, 3>> profile;
        for (const ContactSample &sample : results.samples())
          {
            const double x = sample.x[0], pressure = sample.pressure;
            largest = std::max(largest, pressure);
            load += pressure * sample.area;
            second_moment += pressure * x * x * sample.area;
            error.add(sample.area, pressure, hertz.pressure(x));
            if (x < 1.4 * hertz.half_width)
              profile.push_back({{x, pressure, hertz.pressure(x)}});
          }
        comparisons.compare("peak pressure", largest, hertz.peak_pressure);
        // <x^2> = a^2/4 of Hertz' distribution.
        comparisons.compare("half width",
                            2. * std::sqrt(second_moment / load),
                            hertz.half_width);
        comparisons.compare("pressure profile, L2", error.value(), 0.);
        comparisons.report("approach of the plates", -results.row().value[0]);
        comparisons.set_profile("x [mm]", "contact pressure [MPa]", profile);
      }
    };

    const ContactCases::Registration
      registration("cylinders", std::make_shared<Cylinders>());
  } // namespace
} // namespace NPT
