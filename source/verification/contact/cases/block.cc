// SPDX-License-Identifier: LGPL-2.1-or-later
// A block that sticks, slips and reverses on another one.

#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;

  namespace
  {
    /**
     * A block on another one, so constrained that every layer of control points
     * moves as one: uniaxial compression and simple shear, both homogeneous, so
     * that every number is known by hand.
     */
    class Block final : public ContactCase
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
        const double                 d = p.distance;
        model.patches                  = {box(Point<3>(-0.5, -0.5, 0),
                             Point<3>(0.5, 0.5, 0.6),
                             p.degree,
                             {{2, 2, p.upper.n_elements}}),
                                          box(Point<3>(-0.6 - d, -0.6, -1.),
                             Point<3>(0.6 + d, 0.6, 0),
                             p.degree,
                             {{3, 3, p.lower.n_elements}})};
        model.handles                  = {"x", "z"};
        model.couple                   = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 0, 0);
          attach(c, c.face(0, 2, 1), 2, 1);
          hold(c, c.face(1, 2, 0), {0, 1, 2});
          for (const unsigned int patch : {0, 1})
            {
              const NURBSPatch<3> &solid = c.space().patch(patch);
              for (unsigned int a = 0; a < solid.n_control_points(); ++a)
                {
                  const unsigned int A = c.space().control_point(patch, a);
                  const unsigned int B = c.space().control_point(
                    patch, solid.index({{0, 0, solid.multi_index(a)[2]}}));
                  c.tie(c.displacement(A, 1));
                  if (A != B)
                    for (const unsigned int k : {0, 2})
                      c.tie(c.displacement(A, k), {{c.displacement(B, k), 1.}});
                }
            }
        };
        const double E = std::min(p.upper.young_modulus, p.lower.young_modulus);
        model.stages   = {
            {"approach", false, 1, {move(1, -0.1 * p.pressure / E)}},
            {"press", false, 2, {load(1, -p.pressure)}},
            {"push", true, p.load_steps, {move(0, d)}},
            {"pull", true, p.load_steps, {move(0, -d)}},
            {"push again", true, p.load_steps, {move(0, d)}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"tangential force, maximum error", "-"},
                {"dissipation", "N mm"},
                {"force while slipping", "N"}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        // Three springs in series, blocks and tangential penalty, and a slider:
        // exact at finite strain, since simple shear of the neo-Hookean law has
        // P_13 = G times the shear, whatever the stretch.
        const auto  &p       = parameters.benchmark;
        const double lower_A = (1.2 + 2. * p.distance) * 1.2, lower_H = 1.;
        const double upper_A = 1., upper_H = 0.6;
        const double k =
          1. / (upper_H / (p.upper.constants().mu * upper_A) +
                lower_H / (p.lower.constants().mu * lower_A) +
                (parameters.contact.augmented() ?
                   0. :
                   1. / (parameters.friction.tangential_penalty * upper_A)));
        const double limit =
          parameters.friction.coefficient * p.pressure * upper_A;

        double Q = 0, path = 0, loss = 0, largest = 0;
        std::vector<std::array<double, 3>> profile;
        for (const ContactRow &row : results.rows())
          {
            if (row.stage == "approach" || row.stage == "press")
              continue;
            const double trial = Q + k * (row.value[0] - path);
            Q                  = std::min(std::max(trial, -limit), limit);
            loss += limit * std::abs(trial - Q) / k;
            path    = row.value[0];
            largest = std::max(largest, std::abs(row.force[0] - Q) / limit);
            profile.push_back({{row.value[0], row.force[0], Q}});
          }
        comparisons.compare("tangential force, maximum error", largest, 0.);
        comparisons.compare("dissipation", results.row().dissipation, loss);
        comparisons.compare("force while slipping",
                            results.row().force[0],
                            limit);
        comparisons.set_profile("displacement [mm]",
                                "tangential force [N]",
                                profile,
                                true);
      }
    };

    const ContactCases::Registration registration("block",
                                                  std::make_shared<Block>());
  } // namespace
} // namespace NPT
