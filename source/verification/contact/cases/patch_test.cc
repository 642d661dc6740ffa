// SPDX-License-Identifier: LGPL-2.1-or-later
// The contact patch test.

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
    /// Stretch in uniaxial strain under the nominal stress -p, by Newton.
    double
    confined_stretch(const NeoHookeanConstants &c, const double p)
    {
      double stretch = 1;
      for (unsigned int i = 0; i < 50; ++i)
        {
          const double log = std::log(stretch);
          const double P =
            c.mu * (stretch - 1 / stretch) + c.lambda * log / stretch;
          const double dP = c.mu * (1 + 1 / (stretch * stretch)) +
                            c.lambda * (1 - log) / (stretch * stretch);
          stretch -= (P + p) / dP;
        }
      return stretch;
    }

    /**
     * Two blocks in uniaxial strain under uniform pressure. Sides on rollers;
     * the mesh of the upper block has n_upper x n_upper spans, that of the
     * lower one n_lower x n_lower: equal numbers match.
     */
    class PatchTest final : public ContactCase
    {
    public:
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
        const unsigned int nu = p.upper.n_elements, nl = p.lower.n_elements;
        model.patches = {
          box(Point<3>(0, 0, 0), Point<3>(1, 1, 0.6), p.degree, {{nu, nu, 2}}),
          box(Point<3>(0, 0, -1), Point<3>(1, 1, 0), p.degree, {{nl, nl, 2}})};
        model.handles = {"z"};
        model.couple  = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 2, 0);
          hold(c, c.face(1, 2, 0), {2});
          for (const unsigned int patch : {0, 1})
            for (const unsigned int side : {0, 1})
              {
                hold(c, c.face(patch, 0, side), {0});
                hold(c, c.face(patch, 1, side), {1});
              }
        };
        const double E = std::min(p.upper.young_modulus, p.lower.young_modulus);
        model.stages   = {
            {"approach", false, 1, {move(0, -0.1 * p.pressure / E)}},
            {"press", false, 4, {load(0, -p.pressure)}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"displacement of the plate", "mm"},
                {"stress error, maximum", "-"},
                {"stress error, mean square", "-"},
                {"contact pressure error", "-"}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        const auto  &p     = parameters.benchmark;
        const double upper = confined_stretch(p.upper.constants(), p.pressure);
        const double lower = confined_stretch(p.lower.constants(), p.pressure);
        comparisons.compare("displacement of the plate",
                            results.row().value[0],
                            0.6 * (upper - 1.) + 1. * (lower - 1.) -
                              (parameters.contact.augmented() ?
                                 0. :
                                 p.pressure /
                                   parameters.contact.normal_penalty));
        double largest = 0, square = 0, volume = 0;
        results.for_each_point(
          [&](const DeformableBodies::MaterialPoint &point) {
            const double error =
              std::abs(point.P[2][2] + p.pressure) / p.pressure;
            largest = std::max(largest, error);
            square += error * error * point.dV;
            volume += point.dV;
          });
        comparisons.compare("stress error, maximum", largest, 0.);
        comparisons.compare("stress error, mean square",
                            std::sqrt(square / volume),
                            0.);
        double pressure = 0;
        for (const ContactSample &sample : results.samples())
          pressure =
            std::max(pressure,
                     std::abs(sample.pressure - p.pressure) / p.pressure);
        comparisons.compare("contact pressure error", pressure, 0.);
      }
    };

    const ContactCases::Registration
      registration("patch test", std::make_shared<PatchTest>());
  } // namespace
} // namespace NPT
