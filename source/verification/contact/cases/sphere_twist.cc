// SPDX-License-Identifier: LGPL-2.1-or-later
// A sphere twisted on a plane after Lubkin.

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
     * A quarter of an elastic sphere, pressed on a rigid plane and twisted
     * about the normal. The quarter is closed by the four-fold axis, w(QX) = Q
     * w(X) with the rotation Q by a right angle.
     */
    class SphereTwist final : public ContactCase
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
        return true;
      }

      ContactModel
      make_model(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p  = parameters.benchmark;
        const double                 mu = parameters.friction.coefficient;
        ContactModel                 model;
        model.patches = {sphere_segment(p),
                         rigid_plane(1.2 * p.body_size * p.half_width,
                                     p.degree)};
        model.handles = {"cosine - 1", "sine", "z"};
        model.couple  = [](HandleCouplings &c) {
          const auto top = c.face(0, 2, 1);
          attach_rotation(c, top, 0, 1);
          attach(c, top, 2, 2);
          hold(c, c.all(1), {0, 1, 2});
          const NURBSPatch<3> &solid = c.space().patch(0);
          for (unsigned int k = 0; k < solid.n_control_points(2); ++k)
            for (unsigned int j = 0; j < solid.n_control_points(1); ++j)
              {
                // (0, s) is the image of (s, 0).
                const unsigned int A =
                  c.space().control_point(0, solid.index({{0, j, k}}));
                const unsigned int B =
                  c.space().control_point(0, solid.index({{j, 0, k}}));
                if (A == B)
                  {
                    hold(c, {A}, {0, 1});
                    continue;
                  }
                c.tie(c.displacement(A, 0), {{c.displacement(B, 1), -1.}});
                c.tie(c.displacement(A, 1), {{c.displacement(B, 0), 1.}});
                c.tie(c.displacement(A, 2), {{c.displacement(B, 2), 1.}});
              }
        };
        model.force_factor = 4.;
        model.body_height  = p.body_size * p.half_width;
        const double P     = aimed_load_sphere(p);
        const auto   hertz = HertzPoint::from_load(P,
                                                 p.upper.radius,
                                                 p.upper.radius,
                                                 contact_modulus_on_rigid(p));
        const double angle =
          TwistedSphere{hertz, mu, p.upper.constants().mu}.twist(
            p.stick_ratio * hertz.half_axis_x);
        model.stages = {
          {"approach", false, 1, {move(2, -0.25 * hertz.approach)}},
          {"press", false, 5, {load(2, -P)}},
          {"twist", true, p.load_steps, turn(0, 1, angle)}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"peak pressure", "MPa"},
                {"torque", "N mm"},
                {"stick radius", "mm"}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const auto         &p   = parameters.benchmark;
        const auto         &row = results.row();
        const double        E   = contact_modulus_on_rigid(p);
        const TwistedSphere exact{HertzPoint::from_load(-row.force[2],
                                                        p.upper.radius,
                                                        p.upper.radius,
                                                        E),
                                  parameters.friction.coefficient,
                                  p.upper.constants().mu};

        double largest = 0;
        for (const ContactSample &sample : results.samples())
          largest = std::max(largest, sample.pressure);
        comparisons.compare("peak pressure",
                            largest,
                            exact.normal.peak_pressure);

        std::vector<std::array<double, 3>> profile;
        for (const ContactRow &r : results.rows())
          if (r.stage == "twist")
            {
              const double angle = std::asin(r.value[1]);
              profile.push_back(
                {{angle, torque(r), exact.torque(exact.stick_radius(angle))}});
            }
        const double c = exact.stick_radius(profile.back()[0]);
        comparisons.compare("torque", profile.back()[1], exact.torque(c));
        comparisons.compare("stick radius", results.stick_radius(false), c);
        comparisons.set_profile("twist [rad]", "torque [N mm]", profile, true);
      }
    };

    const ContactCases::Registration
      registration("sphere twist", std::make_shared<SphereTwist>());
  } // namespace
} // namespace NPT
