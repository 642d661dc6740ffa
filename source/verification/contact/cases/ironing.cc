// SPDX-License-Identifier: LGPL-2.1-or-later
// A cylinder dragged along a slab.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/cases/hertz_bodies.h>
#include <npt_dealii/verification/contact/contact_benchmark_parameters.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_case.h>
#include <npt_dealii/verification/contact/contact_comparisons.h>
#include <npt_dealii/verification/contact/contact_results.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NPT
{
  namespace
  {
    /// Largest deviation of the force on a handle from a parabola over the
    /// steps, over its mean.
    double
    ripple(const std::vector<const ContactRow *> &steps,
           const unsigned int                     handle)
    {
      // Least squares with Legendre polynomials up to the second degree, summed
      // as if they were orthogonal and repeated until they are.
      std::vector<double> rest;
      double              mean = 0;
      for (const ContactRow *row : steps)
        {
          rest.push_back(row->force[handle]);
          mean += std::abs(row->force[handle]) / steps.size();
        }
      const auto legendre = [&](const unsigned int n, const unsigned int i) {
        const double s = 2. * (i + 0.5) / rest.size() - 1.;
        return n == 0 ? 1. : n == 1 ? s : 1.5 * s * s - 0.5;
      };
      for (unsigned int repetition = 0; repetition < 20; ++repetition)
        for (unsigned int n = 0; n < 3; ++n)
          {
            double product = 0, square = 0;
            for (unsigned int i = 0; i < rest.size(); ++i)
              {
                product += rest[i] * legendre(n, i);
                square += legendre(n, i) * legendre(n, i);
              }
            for (unsigned int i = 0; i < rest.size(); ++i)
              rest[i] -= product / square * legendre(n, i);
          }
      double largest = 0;
      for (const double value : rest)
        largest = std::max(largest, std::abs(value));
      return largest / mean;
    }

    // Of the slab; more fit into no memory, and at 4e9 the count would begin
    // anew.
    constexpr double most_elements_along = 1e5;

    double
    n_elements_along(const ContactCaseParameters &p)
    {
      const double ends = 2. * p.body_size * p.half_width;
      return std::round((p.distance + 2. * ends) /
                        (p.half_width / p.lower.n_elements));
    }

    /**
     * An elastic cylinder pressed into an elastic slab (plane strain) and
     * dragged along it over many elements at constant depth.
     */
    class Ironing final : public ContactCase
    {
    public:
      void
      check(const ContactBenchmarkParameters &parameters) const override
      {
        const ContactCaseParameters &p = parameters.benchmark;
        check_body_size(p, p.upper, "Upper body");
        const double n = n_elements_along(p);
        if (n <= most_elements_along)
          return;
        std::ostringstream text;
        text << "Distance is " << p.distance << " mm, for which the slab would "
             << "have " << n << " elements along it; it may have at most "
             << most_elements_along << ", which suffice for "
             << most_elements_along * p.half_width / p.lower.n_elements -
                  4. * p.body_size * p.half_width
             << " mm (subsections Benchmark and Lower body).";
        throw InputError(text.str());
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
        const double                 a = p.half_width, b = a;
        const HertzMesh              mesh(p, p.upper, a);
        model.patches.push_back(
          segment(true,
                  Profile(p.upper.radius, -mesh.width, mesh.width),
                  Profile(flat, 0., b),
                  mesh.width,
                  p.degree,
                  mirrored(mesh.lateral),
                  {},
                  mesh.depth));
        const double       ends = 2. * mesh.width;
        const double       h    = a / p.lower.n_elements;
        const unsigned int n    = n_elements_along(p);
        model.patches.push_back(
          segment(false,
                  Profile(flat, -ends, p.distance + ends),
                  Profile(flat, 0., b),
                  mesh.width,
                  p.degree,
                  equal_spans(-ends, p.distance + ends, n),
                  {},
                  graded(0.5 * a, h, mesh.width, p.span_growth)));
        model.handles = {"x", "z"};
        model.couple  = [](HandleCouplings &c) {
          attach(c, c.face(0, 2, 1), 0, 0);
          attach(c, c.face(0, 2, 1), 2, 1);
          hold(c, c.face(1, 2, 0), {0, 2});
          plane_strain(c);
        };
        model.force_factor = 1. / b;
        model.body_height  = p.body_size * a;
        const double P =
          HertzLine::from_half_width(a, p.upper.radius, contact_modulus(p))
            .load;
        model.stages = {
          {"approach", false, 1, {move(1, -0.25 * a * a / p.upper.radius)}},
          {"press", false, 5, {load(1, -P)}},
          {"drag",
           true,
           p.load_steps,
           {move(0, p.distance),
            {1, false, [](const double start, double) { return start; }}}}};
        return model;
      }

      std::vector<ComparedQuantity>
      quantities() const override
      {
        return {{"ripple of the tangential force", "-"},
                {"ripple of the normal force", "-"},
                {"force ratio Q/P", "-"}};
      }

      void
      compare(const ContactBenchmarkParameters &parameters,
              const ContactResults             &results,
              ContactComparisons               &comparisons) const override
      {
        // Where the cylinder is far from both ends of its path the forces
        // change slowly with the distance; what is left beside a parabola comes
        // from the mesh.
        std::vector<std::array<double, 3>> profile;
        std::vector<const ContactRow *>    steady;
        for (const ContactRow &row : results.rows())
          if (row.stage == "drag")
            {
              profile.push_back(
                {{row.value[0],
                  row.force[0],
                  -parameters.friction.coefficient * row.force[1]}});
              if (row.n_stick == 0 && row.load_factor > 0.25)
                steady.push_back(&row);
            }
        comparisons.compare("ripple of the tangential force",
                            ripple(steady, 0),
                            0.);
        comparisons.compare("ripple of the normal force",
                            ripple(steady, 1),
                            0.);
        comparisons.compare("force ratio Q/P",
                            -results.row().force[0] / results.row().force[1],
                            parameters.friction.coefficient);
        comparisons.set_profile("displacement [mm]",
                                "tangential force [N/mm]",
                                profile,
                                true);
      }
    };

    const ContactCases::Registration registration("ironing",
                                                  std::make_shared<Ironing>());
  } // namespace
} // namespace NPT
