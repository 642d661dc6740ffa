// SPDX-License-Identifier: LGPL-2.1-or-later
// What the cases of Hertzian contact share.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/cases/hertz_bodies.h>
#include <npt_dealii/verification/contact/contact_bodies.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace NPT
{
  using dealii::Point;

  HertzMesh::HertzMesh(const ContactCaseParameters       &p,
                       const ContactCaseParameters::Body &body,
                       const double                       half_width)
    : width(p.body_size * p.half_width)
    , lateral(graded(1.25 * half_width,
                     half_width / body.n_elements,
                     width,
                     p.span_growth))
    , depth(graded(0.5 * half_width,
                   half_width / body.n_elements,
                   width,
                   p.span_growth))
  {}



  double
  contact_modulus(const ContactCaseParameters &p)
  {
    return contact_modulus(p.upper.young_modulus,
                           p.upper.poisson_ratio,
                           p.lower.young_modulus,
                           p.lower.poisson_ratio);
  }



  double
  contact_modulus_on_rigid(const ContactCaseParameters &p)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    return contact_modulus(p.upper.young_modulus,
                           p.upper.poisson_ratio,
                           infinity,
                           0.);
  }



  double
  aimed_load_line(const ContactCaseParameters &p)
  {
    return HertzLine::from_half_width(p.half_width,
                                      1. / (1. / p.upper.radius +
                                            1. / p.lower.radius),
                                      contact_modulus(p))
      .load;
  }



  double
  aimed_load_sphere(const ContactCaseParameters &p)
  {
    return HertzPoint::from_half_axis_x(p.half_width,
                                        p.upper.radius,
                                        p.upper.radius,
                                        contact_modulus_on_rigid(p))
      .load;
  }



  NURBSPatch<3>
  sphere_segment(const ContactCaseParameters &p)
  {
    const HertzMesh mesh(p, p.upper, p.half_width);
    const Profile   arc(p.upper.radius, 0., mesh.width);
    return segment(true,
                   arc,
                   arc,
                   mesh.width,
                   p.degree,
                   mesh.lateral,
                   mesh.lateral,
                   mesh.depth);
  }



  NURBSPatch<3>
  rigid_plane(const double half_size, const unsigned int degree)
  {
    return box(Point<3>(-half_size, -half_size, -half_size),
               Point<3>(half_size, half_size, 0.),
               degree,
               {{1, 1, 1}});
  }



  void
  check_body_size(const ContactCaseParameters       &p,
                  const ContactCaseParameters::Body &body,
                  const std::string                 &subsection)
  {
    if (p.half_width * p.body_size < 0.9 * body.radius)
      return;
    std::ostringstream text;
    text << "Half width times Body size is " << p.half_width * p.body_size
         << " mm; the body must end before 0.9 of its radius of " << body.radius
         << " mm (subsections Benchmark and " << subsection << ").";
    throw InputError(text.str());
  }



  std::vector<ComparedQuantity>
  point_contact_quantities()
  {
    return {{"peak pressure", "MPa"},
            {"half axis along x", "mm"},
            {"half axis along y", "mm"},
            {"pressure profile, L2", "-"},
            {"approach of the plates", "mm", false}};
  }



  void
  compare_point_contact(const HertzPoint     &hertz,
                        const ContactResults &results,
                        ContactComparisons   &comparisons)
  {
    double       largest = 0, load = 0, moment[2] = {0, 0};
    ProfileError error;
    std::vector<std::array<double, 3>> profile;
    for (const ContactSample &sample : results.samples())
      {
        const double x = sample.x[0], y = sample.x[1];
        const double pressure = sample.pressure;
        const double exact    = hertz.pressure(x, y);
        largest               = std::max(largest, pressure);
        load += pressure * sample.area;
        for (unsigned int c = 0; c < 2; ++c)
          moment[c] += pressure * sample.x[c] * sample.x[c] * sample.area;
        error.add(sample.area, pressure, exact);
        // All points over the radius of the ellipse through them.
        const double r =
          std::hypot(x, y * hertz.half_axis_x / hertz.half_axis_y);
        if (r < 1.4 * hertz.half_axis_x)
          profile.push_back({{r, pressure, exact}});
      }
    // <x^2> = a^2/5 of Hertz' distribution.
    comparisons.compare("peak pressure", largest, hertz.peak_pressure);
    comparisons.compare("half axis along x",
                        std::sqrt(5. * moment[0] / load),
                        hertz.half_axis_x);
    comparisons.compare("half axis along y",
                        std::sqrt(5. * moment[1] / load),
                        hertz.half_axis_y);
    comparisons.compare("pressure profile, L2", error.value(), 0.);
    comparisons.report("approach of the plates", -results.row().value.back());
    comparisons.set_profile("radius [mm]", "contact pressure [MPa]", profile);
  }



  double
  torque(const ContactRow &row)
  {
    const double angle = std::asin(row.value[1]);
    return row.force[1] * std::cos(angle) - row.force[0] * std::sin(angle);
  }
} // namespace NPT
