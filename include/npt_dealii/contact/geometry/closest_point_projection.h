// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the closest point of a surface to a point in space, edges and corners
// included, and the surface geometry there.

#ifndef npt_dealii_contact_geometry_closest_point_projection_h
#define npt_dealii_contact_geometry_closest_point_projection_h

#include <npt_dealii/contact/geometry/contact_surface.h>

namespace NPT
{
  /**
   * Where the closest point xi-bar of a primary surface (10) is.
   *
   * A direction that is not `free` is held at a boundary of the surface, or at
   * a knot where the surface is only C0: there the closest point lies on an
   * edge or corner.
   */
  template <int dim>
  struct ClosestPlace
  {
    static constexpr int m = dim - 1;

    bool                        found       = false;
    unsigned int                surface     = 0;     ///< which primary surface
    std::array<double, m>       u           = {};    ///< parameters xi-bar
    std::array<unsigned int, m> segment     = {};    ///< polynomial used
    std::array<bool, m>         free        = {};    ///< orthogonal direction
    bool                        on_boundary = false; ///< of the surface
    double                      distance    = 0;     ///< |x^s - x^m| [mm]
  };

  /**
   * Closest point xi-bar of a primary surface (10) and the geometry there.
   *
   * Where a direction is not `free`, r = x^s - x^m is not orthogonal to the
   * surface, and the unit vector r/|r| takes the place of the normal (normal
   * cone). So the gap depends continuously on the state also on C0 surfaces.
   */
  template <int dim>
  struct ClosestPoint : ClosestPlace<dim>
  {
    using ClosestPlace<dim>::m;

    double                 gap = 0; ///< (9) [mm], > 0 open
    dealii::Tensor<1, dim> normal;  ///< unit; gap = normal . r
    dealii::Tensor<1, dim> r;       ///< x^s - x^m
    /// If positive, the closest point is on a rounded boundary of this radius
    /// [mm]: the gap is that of Eq. (A15), and `normal` is r/|r|.
    double                 edge_radius = 0.;
    dealii::Tensor<1, dim> surface_normal;   ///< of the face, where held
    std::array<dealii::Tensor<1, dim>, m> a; ///< tangents a_alpha
    std::array<dealii::Tensor<1, dim>, SymmetricIndices<m>::n_second> x_second;
    std::array<dealii::Tensor<1, dim>, SymmetricIndices<m>::n_third>  x_third;
    SurfaceShape<m> shape; ///< functions, up to third order
  };

  /// Start value of a projection.
  template <int dim>
  struct ProjectionStart
  {
    bool                        known   = false;
    unsigned int                surface = 0;
    std::array<double, dim - 1> u;
  };

  /**
   * Gap beside the rounded boundary of a surface, (A15) of doc/theory.md, as a
   * function of the distance rho = |r| from the boundary and the height
   * c = n . r over the tangent plane there,
   *
   * @f[ g = q - R, \qquad q = \sqrt{\rho^2 + 2 R c + R^2} = |r + R n| . @f]
   */
  struct RoundedEdge
  {
    double gap;
    double by_distance, by_height; ///< first derivatives
    double by_distance_distance, by_distance_height, by_height_height;

    RoundedEdge(const double radius,
                const double distance,
                const double height);
  };

  /**
   * Minimize |x - x^m(u)| over one surface by Newton's method with bounds:
   * the parameter domain is cut into the pieces between C0 knots (one piece
   * for a smooth surface); inside a piece a damped Newton method with the
   * Hessian a_ab - r . x_,ab (Gauss-Newton where that is indefinite), at the
   * border of a piece a change to the neighboring one as long as the distance
   * falls. The distance decreases monotonically, so the method cannot cycle.
   *
   * @param positions Current control points of the surface.
   * @param point x^s.
   * @param start Start parameters.
   *
   * Return found = false if the iteration failed (then the caller tries
   * another start or gives up). Member `surface` is left to the caller.
   */
  template <int dim>
  ClosestPlace<dim>
  find_closest_place(const ContactSurface<dim>             &surface,
                     const std::vector<dealii::Point<dim>> &positions,
                     const dealii::Point<dim>              &point,
                     const std::array<double, dim - 1>     &start);

  /**
   * Compute the geometry at a place that was found with the same positions and
   * point.
   *
   * @param third_derivatives Compute x_third as well (needed by the tangent of
   *   friction only).
   * @param result Its storage is used again.
   */
  template <int dim>
  void
  compute_closest_point(const ContactSurface<dim>             &surface,
                        const std::vector<dealii::Point<dim>> &positions,
                        const dealii::Point<dim>              &point,
                        const ClosestPlace<dim>               &place,
                        const bool         third_derivatives,
                        ClosestPoint<dim> &result);

  /// Both: find the place and, if it was found, compute the geometry there.
  template <int dim>
  void
  project(const ContactSurface<dim>             &surface,
          const std::vector<dealii::Point<dim>> &positions,
          const dealii::Point<dim>              &point,
          const std::array<double, dim - 1>     &start,
          const bool                             third_derivatives,
          ClosestPoint<dim>                     &result);
} // namespace NPT

#endif
