// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the bodies of contact benchmarks as exact NURBS patches, and the
// knots that grade them towards the contact.

#ifndef npt_dealii_verification_contact_contact_bodies_h
#define npt_dealii_verification_contact_contact_bodies_h

#include <npt_dealii/iga/nurbs_patch.h>

#include <array>
#include <limits>
#include <vector>

namespace NPT
{
  /// Radius of a straight profile.
  constexpr double flat = std::numeric_limits<double>::infinity();

  /// A circular arc (or straight line) through the apex (0,0), curving
  /// downward, between two abscissae s: one rational quadratic segment.
  struct Profile
  {
    double                               radius;
    std::array<std::array<double, 2>, 3> points; ///< s, height
    double                               middle_weight;

    Profile(const double R, const double begin, const double end);

    double
    abscissa(const double u) const;

    /// Parameters of abscissae strictly inside; s(u) is monotone.
    std::vector<double>
    parameters(const std::vector<double> &abscissae) const;
  };

  /// Knots between 0 and the end: equal spans of length h up to `fine`, then
  /// lengths that grow by a constant factor near the wanted one.
  std::vector<double>
  graded(const double fine,
         const double h,
         const double end,
         const double growth);

  /// -x for all, 0, and x for all.
  std::vector<double>
  mirrored(const std::vector<double> &positive);

  /// The knots between n equal spans.
  std::vector<double>
  equal_spans(const double begin, const double end, const unsigned int n);

  /**
   * A body with vertical sides between a plane and the surface that touches
   * z = 0 at the origin: for two arcs the surface of revolution of the first
   * about a line parallel to x in depth R_y (a sphere for equal radii), for
   * one arc a cylinder. Exact, since both are rational quadratic.
   *
   * @param depths Knots by depth below the apex.
   */
  NURBSPatch<3>
  segment(const bool                 upper,
          const Profile             &along_x,
          const Profile             &along_y,
          const double               height,
          const unsigned int         degree,
          const std::vector<double> &x_knots,
          const std::vector<double> &y_knots,
          const std::vector<double> &depths);

  /// A box with equal spans.
  NURBSPatch<3>
  box(const dealii::Point<3>            &low,
      const dealii::Point<3>            &high,
      const unsigned int                 degree,
      const std::array<unsigned int, 3> &n);

  /// Part of a ring about the y axis, |angle from z| <= half_angle; the
  /// third direction is radial.
  NURBSPatch<3>
  ring(const double       inner_radius,
       const double       outer_radius,
       const double       half_angle,
       const double       width,
       const unsigned int degree,
       const unsigned int n_arc,
       const unsigned int n_radial);

  /// A disc over the square of parameters (the four corners of the square
  /// are singular points on the circle), thickened downward or upward.
  NURBSPatch<3>
  disc(const double       radius,
       const double       low,
       const double       high,
       const unsigned int degree,
       const unsigned int n);
} // namespace NPT

#endif
