// SPDX-License-Identifier: LGPL-2.1-or-later
// Partial slip of two cylinders after Cattaneo and Mindlin.

#include <npt_dealii/base/exceptions.h>
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
    PartialSlipLine
    exact_solution(const ContactBenchmarkParameters &parameters,
                   const ContactRow                 &row)
    {
      const auto &p = parameters.benchmark;
      return PartialSlipLine{HertzLine::from_load(-row.force[1],
                                                  0.5 * p.upper.radius,
                                                  contact_modulus(p)),
                             parameters.friction.coefficient,
                             std::abs(row.force[0])};
    }

    /**
     * Two equal cylinders in plane strain, whole width: pressed together
     * without friction, then sheared forth, back and forth again.
     */
    class PartialSlip final : public ContactCase
    {
    public:
      void
      check(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        check_body_size(p, p.upper, "Upper body");
        check_body_size(p, p.lower, "Lower body");
        if (p.upper.young_modulus != p.lower.young_modulus ||
            p.upper.poisson_ratio != p.lower.poisson_ratio ||
            p.upper.radius != p.lower.radius)
          throw InputError(
            "The bodies differ; the exact solution of partial slip needs equal "
            "materials and radii (subsections Upper body and Lower body).");
      }

      bool
      needs_friction() const override
      {
        return true;
      }

      ContactModel
      make_model(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p  = parameters.benchmark;
        const double                 mu = parameters.friction.coefficient;
        ContactModel                 model;
        const double                 b = p.half_width;
        for (const bool upper : {true, false})
          {
            const auto     &body = upper ? p.upper : p.lower;
            const HertzMesh mesh(p, body, p.half_width);
            model.patches.push_back(
              segment(upper,
                      Profile(body.radius, -mesh.width, mesh.width),
                      Profile(flat, 0., b),
                      mesh.width,
                      p.degree,
                      mirrored(mesh.lateral),
                      {},
                      mesh.depth));
          }
        model.handles = {"x", "z"};
        model.couple  = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 0, 0);
          attach(c, c.face(0, 2, 1), 2, 1);
          hold(c, c.face(1, 2, 0), {0, 2});
          plane_strain(c);
        };
        model.force_factor = 1. / b;
        model.body_height  = p.body_size * p.half_width;
        const double P     = aimed_load_line(p);
        const double Q     = (1. - p.stick_ratio * p.stick_ratio) * mu * P;
        const double d     = 0.5 * p.half_width * p.half_width / p.upper.radius;
        model.stages       = {{"approach", false, 1, {move(1, -d)}},
                              {"press", false, 5, {load(1, -P)}},
                              {"shear", true, p.load_steps, {load(0, Q)}},
                              {"reverse", true, p.load_steps, {load(0, -Q)}},
                              {"return", true, p.load_steps, {load(0, Q)}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"peak pressure", "MPa"},
                {"half width", "mm"},
                {"stick half width", "mm"},
                {"pressure profile, L2", "-"},
                {"traction profile, L2", "-"},
                {"loss per cycle", "N"}};
      }

      void
      compare_stage(const std::string                &stage,
                    const ContactBenchmarkParameters &parameters,
                    const ContactResults             &results,
                    ContactComparisons &comparisons) const override
      {
        if (stage != "shear")
          return;
        const PartialSlipLine exact = exact_solution(parameters, results.row());
        double                largest = 0, second_moment = 0;
        ProfileError          pressure, traction;
        std::vector<std::array<double, 3>> profile;
        // The contact moves with the surfaces; x counts from its center.
        double     load = 0, center = 0;
        const auto all = results.samples();
        for (const ContactSample &sample : all)
          {
            load += sample.pressure * sample.area;
            center += sample.pressure * sample.area * sample.x[0];
          }
        center /= load;
        for (const ContactSample &sample : all)
          {
            const double x = sample.x[0] - center;
            second_moment += sample.pressure * x * x * sample.area;
            largest = std::max(largest, sample.pressure);
            pressure.add(sample.area,
                         sample.pressure,
                         exact.normal.pressure(x));
            traction.add(sample.area, sample.traction[0], exact.traction(x));
            if (std::abs(x) < 1.4 * exact.normal.half_width)
              profile.push_back({{x, sample.traction[0], exact.traction(x)}});
          }
        comparisons.compare("peak pressure",
                            largest,
                            exact.normal.peak_pressure);
        comparisons.compare("half width",
                            2. * std::sqrt(second_moment / load),
                            exact.normal.half_width);
        comparisons.compare("stick half width",
                            results.stick_radius(true),
                            exact.stick_half_width());
        comparisons.compare("pressure profile, L2", pressure.value(), 0.);
        comparisons.compare("traction profile, L2", traction.value(), 0.);
        comparisons.set_profile("x [mm]", "friction traction [MPa]", profile);
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const PartialSlipLine exact = exact_solution(parameters, results.row());
        double                before = 0;
        for (const ContactRow &r : results.rows())
          if (r.stage == "shear")
            before = r.dissipation;
        comparisons.compare("loss per cycle",
                            results.row().dissipation - before,
                            exact.loss_per_cycle(
                              contact_modulus(parameters.benchmark)));
      }
    };

    const ContactCases::Registration
      registration("partial slip", std::make_shared<PartialSlip>());
  } // namespace
} // namespace NPT
