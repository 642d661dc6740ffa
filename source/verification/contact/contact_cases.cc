// SPDX-License-Identifier: LGPL-2.1-or-later
// Set-up of the contact benchmarks, one function per case.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/verification/contact/contact_bodies.h>
#include <npt_dealii/verification/contact/contact_cases.h>
#include <npt_dealii/verification/contact/exact_contact.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  using dealii::Point;
  using dealii::numbers::PI;

  namespace
  {
    // -------------------------------------------------------------- stages

    std::function<double(double, double)>
    linear_to(const double end)
    {
      return [end](const double start, const double t) {
        return start + t * (end - start);
      };
    }

    HandleDrive
    move(const unsigned int handle, const double end)
    {
      return {handle, false, linear_to(end)};
    }

    HandleDrive
    load(const unsigned int handle, const double end)
    {
      return {handle, true, linear_to(end)};
    }

    /// The handles of attach_rotation(), from rest to a finite angle.
    std::vector<HandleDrive>
    turn(const unsigned int cosine, const unsigned int sine, const double angle)
    {
      return {{cosine,
               false,
               [angle](double, const double t) {
                 return -2. * std::pow(std::sin(0.5 * angle * t), 2);
               }},
              {sine, false, [angle](double, const double t) {
                 return std::sin(angle * t);
               }}};
    }

    // --------------------------------------------------------------- cases

    using Parameters = ContactCaseParameters;

    /**
     * Two blocks in uniaxial strain under uniform pressure. Sides on rollers;
     * the mesh of the upper block has n_upper x n_upper spans, that of the
     * lower one n_lower x n_lower: equal numbers match.
     */
    ContactModel
    patch_test(const Parameters &p)
    {
      ContactModel       model;
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
      model.stages = {{"approach", false, 1, {move(0, -0.1 * p.pressure / E)}},
                      {"press", false, 4, {load(0, -p.pressure)}}};
      return model;
    }



    double
    aimed_load_line(const Parameters &p)
    {
      return HertzLine::from_half_width(p.half_width,
                                        1. / (1. / p.upper.radius +
                                              1. / p.lower.radius),
                                        contact_modulus(p.upper.young_modulus,
                                                        p.upper.poisson_ratio,
                                                        p.lower.young_modulus,
                                                        p.lower.poisson_ratio))
        .load;
    }

    /// Knots of a body in x, from its symmetry plane outward, and in depth.
    struct HertzMesh
    {
      double              width;
      std::vector<double> lateral, depth;

      HertzMesh(const Parameters       &p,
                const Parameters::Body &body,
                const double            half_width)
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
    };

    /**
     * Two elastic cylinders with parallel axes in plane strain, half of them
     * (x >= 0); the plane tops and bottoms are rigid plates.
     */
    ContactModel
    cylinders(const Parameters &p)
    {
      ContactModel model;
      const double b = p.half_width;
      for (const bool upper : {true, false})
        {
          const auto     &body = upper ? p.upper : p.lower;
          const HertzMesh mesh(p, body, p.half_width);
          model.patches.push_back(segment(upper,
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



    /// Cells around the origin that a quarter or the whole of a rigid plane
    /// consists of do not matter: one span is enough.
    NURBSPatch<3>
    rigid_plane(const double half_size, const unsigned int degree)
    {
      return box(Point<3>(-half_size, -half_size, -half_size),
                 Point<3>(half_size, half_size, 0.),
                 degree,
                 {{1, 1, 1}});
    }

    double
    aimed_load_sphere(const Parameters &p)
    {
      return HertzPoint::from_half_axis_x(p.half_width,
                                          p.upper.radius,
                                          p.upper.radius,
                                          contact_modulus(p.upper.young_modulus,
                                                          p.upper.poisson_ratio,
                                                          flat,
                                                          0.))
        .load;
    }

    NURBSPatch<3>
    sphere_segment(const Parameters &p)
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

    /// A quarter of an elastic sphere on a rigid plane.
    ContactModel
    sphere(const Parameters &p)
    {
      ContactModel model;
      model.patches = {sphere_segment(p),
                       rigid_plane(1.2 * p.body_size * p.half_width, p.degree)};
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



    HertzPoint
    crossed_cylinders_hertz(const Parameters &p)
    {
      return HertzPoint::from_half_axis_x(
        p.half_width,
        p.upper.radius,
        p.lower.radius,
        contact_modulus(p.upper.young_modulus,
                        p.upper.poisson_ratio,
                        p.lower.young_modulus,
                        p.lower.poisson_ratio));
    }

    /// A quarter of two elastic cylinders; the upper one curves along x, the
    /// lower one along y. Unequal radii give an ellipse.
    ContactModel
    crossed_cylinders(const Parameters &p)
    {
      const HertzPoint hertz = crossed_cylinders_hertz(p);
      ContactModel     model;
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
      model.stages = {{"approach", false, 1, {move(0, -0.25 * hertz.approach)}},
                      {"press", false, 5, {load(0, -hertz.load)}}};
      return model;
    }



    /// Two equal cylinders in plane strain, whole width: pressed together
    /// without friction, then sheared forth, back and forth again.
    ContactModel
    partial_slip(const Parameters &p, const double mu)
    {
      ContactModel model;
      const double b = p.half_width;
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



    /**
     * A block on another one, so constrained that every layer of control
     * points moves as one: uniaxial compression and simple shear, both
     * homogeneous, so that every number is known by hand.
     */
    ContactModel
    block(const Parameters &p)
    {
      ContactModel model;
      const double d = p.distance;
      model.patches  = {box(Point<3>(-0.5, -0.5, 0),
                           Point<3>(0.5, 0.5, 0.6),
                           p.degree,
                           {{2, 2, p.upper.n_elements}}),
                        box(Point<3>(-0.6 - d, -0.6, -1.),
                           Point<3>(0.6 + d, 0.6, 0),
                           p.degree,
                           {{3, 3, p.lower.n_elements}})};
      model.handles  = {"x", "z"};
      model.couple   = [](HandleCouplings &c) {
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
      model.stages = {{"approach", false, 1, {move(1, -0.1 * p.pressure / E)}},
                      {"press", false, 2, {load(1, -p.pressure)}},
                      {"push", true, p.load_steps, {move(0, d)}},
                      {"pull", true, p.load_steps, {move(0, -d)}},
                      {"push again", true, p.load_steps, {move(0, d)}}};
      return model;
    }



    /**
     * A thin elastic belt on a rigid drum. The slack end carries a dead load
     * along its tangent; the tight end is first held and then pulled along its
     * tangent until the belt slips everywhere.
     */
    ContactModel
    capstan(const Parameters &p, const double normal_penalty)
    {
      ContactModel model;
      const double R = p.lower.radius, half = p.wrap_angle * PI / 360.;
      const double b = p.thickness;
      // The belt begins with a thousandth of its pressure, so that the drum
      // holds it from the first iteration on.
      const double inner = R - 1e-3 * p.pressure / normal_penalty;
      model.patches      = {
             ring(
          inner, inner + p.thickness, half, b, p.degree, p.upper.n_elements, 1),
             ring(0.5 * R,
             R,
             half + 10. * PI / 180.,
             b,
             p.degree,
             p.lower.n_elements,
             1)};
      model.handles = {"slack end", "tight end"};
      model.couple  = [half](HandleCouplings &c) {
        // Displacement along the outward tangent of an end face is the handle.
        for (const unsigned int side : {0, 1})
          {
            const double       t[2]  = {(side == 0 ? -1. : 1.) * std::cos(half),
                                        -std::sin(half)};
            const unsigned int pivot = std::abs(t[0]) > std::abs(t[1]) ? 0 : 1;
            for (const unsigned int A : c.face(0, 0, side))
              {
                const unsigned int u[2] = {c.displacement(A, 0),
                                           c.displacement(A, 2)};
                // Of the layers across the belt the first one leads.
                const double Y = c.space().control_points()[A][1];
                if (Y < 1e-12)
                  c.tie(u[pivot],
                        {{c.handle(side), 1. / t[pivot]},
                         {u[1 - pivot], -t[1 - pivot] / t[pivot]}});
              }
          }
        hold(c, c.all(1), {0, 1, 2});
        plane_strain(c);
      };
      model.force_factor = 1. / b;
      model.body_height  = R;
      const double T     = p.pressure * R;
      model.stages       = {{"tighten", false, 5, {load(0, T)}},
                            {"pull", true, p.load_steps, {move(1, p.distance)}}};
      return model;
    }



    /// A rigid disc pressed on a rigid plane and turned by one degree.
    ContactModel
    disc_twist(const Parameters &p)
    {
      ContactModel model;
      const double R = p.upper.radius;
      model.patches  = {disc(R, 0., 0.5 * R, p.degree, p.upper.n_elements),
                        rigid_plane(1.5 * R, p.degree)};
      model.handles  = {"cosine - 1", "sine", "z"};
      model.couple   = [](HandleCouplings &c) {
        attach_rotation(c, c.all(0), 0, 1);
        attach(c, c.all(0), 2, 2);
        hold(c, c.all(1), {0, 1, 2});
      };
      model.body_height = R;
      model.stages      = {{"approach", false, 1, {move(2, -1e-6 * R)}},
                           {"press", false, 1, {load(2, -p.pressure * PI * R * R)}},
                           {"twist", true, p.load_steps, turn(0, 1, PI / 180.)}};
      return model;
    }



    /**
     * A quarter of an elastic sphere, pressed on a rigid plane and twisted
     * about the normal. The quarter is closed by the four-fold axis,
     * w(QX) = Q w(X) with the rotation Q by a right angle.
     */
    ContactModel
    sphere_twist(const Parameters &p, const double mu)
    {
      ContactModel model;
      model.patches = {sphere_segment(p),
                       rigid_plane(1.2 * p.body_size * p.half_width, p.degree)};
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
      const auto   hertz =
        HertzPoint::from_load(P,
                              p.upper.radius,
                              p.upper.radius,
                              contact_modulus(p.upper.young_modulus,
                                              p.upper.poisson_ratio,
                                              flat,
                                              0.));
      const double angle =
        TwistedSphere{hertz, mu, p.upper.constants().mu}.twist(
          p.stick_ratio * hertz.half_axis_x);
      model.stages = {{"approach", false, 1, {move(2, -0.25 * hertz.approach)}},
                      {"press", false, 5, {load(2, -P)}},
                      {"twist", true, p.load_steps, turn(0, 1, angle)}};
      return model;
    }



    /// An elastic cylinder pressed into an elastic slab (plane strain) and
    /// dragged along it over many elements at constant depth.
    ContactModel
    ironing(const Parameters &p)
    {
      ContactModel    model;
      const double    a = p.half_width, b = a;
      const HertzMesh mesh(p, p.upper, a);
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
      const unsigned int n    = std::round((p.distance + 2. * ends) / h);
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
        HertzLine::from_half_width(a,
                                   p.upper.radius,
                                   contact_modulus(p.upper.young_modulus,
                                                   p.upper.poisson_ratio,
                                                   p.lower.young_modulus,
                                                   p.lower.poisson_ratio))
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
  } // namespace



  ContactModel
  make_contact_model(const ContactBenchmarkParameters &parameters)
  {
    const ContactCaseParameters &p  = parameters.benchmark;
    const double                 mu = parameters.friction.coefficient;
    switch (p.type)
      {
        case ContactCase::patch_test:
          return patch_test(p);
        case ContactCase::cylinders:
          return cylinders(p);
        case ContactCase::sphere:
          return sphere(p);
        case ContactCase::crossed_cylinders:
          return crossed_cylinders(p);
        case ContactCase::partial_slip:
          return partial_slip(p, mu);
        case ContactCase::block:
          return block(p);
        case ContactCase::capstan:
          return capstan(p, parameters.contact.normal_penalty);
        case ContactCase::disc_twist:
          return disc_twist(p);
        case ContactCase::sphere_twist:
          return sphere_twist(p, mu);
        case ContactCase::ironing:
          return ironing(p);
      }
    AssertThrow(false, dealii::ExcInternalError());
    return {};
  }
} // namespace NPT
