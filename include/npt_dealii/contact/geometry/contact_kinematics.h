// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the first and second variations of gap and closest point at one
// contact point, expressed by the jets of the two surfaces.

#ifndef npt_dealii_contact_geometry_contact_kinematics_h
#define npt_dealii_contact_geometry_contact_kinematics_h

#include <npt_dealii/contact/geometry/closest_point_projection.h>
#include <npt_dealii/contact/geometry/surface_metric.h>

namespace NPT
{
  /**
   * Gap and closest point are functions of the control points through a few
   * linear functionals only, the "jets" at the contact point,
   *
   * @f[ J_0 = \delta w^s - \delta w^m, \quad J_a = \delta w^m_{,a}, \quad
   *     J_{ab} = \delta w^m_{,ab} . @f]
   *
   * All variations are computed on these (18 numbers for dim = 3) and carried
   * to the control points at the very end, where functional f has the value
   * jet_value(f) for a control point. Formulas: theory, section 5,
   *
   * @f[ \delta g = n \cdot J_0, \qquad
   *     H_{ab}\, \delta\xi^b = a_a \cdot J_0 + r \cdot J_a, \qquad
   *     H_{ab} = a_{ab} - r \cdot x_{,ab}, \quad r = g n, @f]
   *
   * in the free directions; held directions (edges, corners) have no
   * variation.
   */
  template <int dim>
  class ContactKinematics
  {
  public:
    static constexpr int          m = dim - 1;
    static constexpr unsigned int n_jets =
      1 + SymmetricIndices<m>::n_first + SymmetricIndices<m>::n_second;
    static constexpr unsigned int n        = dim * n_jets;
    static constexpr unsigned int n_metric = SymmetricIndices<m>::n_second;
    using Row                              = std::array<double, n>;

    explicit ContactKinematics(const ClosestPoint<dim> &closest_point);

    /// delta g as a linear form of the jets.
    const Row &
    gap_variation() const
    {
      return gap_;
    }
    /// delta xi^b as a linear form of the jets.
    const Row &
    parameter_variation(const unsigned int b) const
    {
      return parameter_[b];
    }
    /// Variation of the metric a_11, a_12, a_22 at the moving closest point.
    const Row &
    metric_variation(const unsigned int ab) const
    {
      return metric_[ab];
    }

    /**
     * Add pressure * D(delta g) + traction_b * D(delta xi^b), a symmetric
     * matrix of size n on the jets, to M (row major).
     *
     * Needs third derivatives in the closest point if a traction is given.
     */
    void
    add_second_variation(const double                 pressure,
                         const std::array<double, m> &traction,
                         std::array<double, n * n>   &M) const;

  private:
    using Matrix = std::array<double, n * n>;

    // First variations: delta xi (A8), delta-hat a_a and delta r, delta g (A7),
    // the same beside a rounded edge (A15), the metric.
    void
    set_parameter_variation();
    void
    set_total_variations();
    void
    set_gap_variation();
    void
    round_gap();
    void
    set_metric_variation();

    // Second variations: what the moving closest point adds to those of (A7)
    // and (A8); the turning normal of (A7), where the point moves freely and
    // where it is held; products and turning normal of (A15).
    void
    add_moving_point(const double                 pressure,
                     const std::array<double, m> &tau,
                     Matrix                      &M) const;
    void
    add_turning_normal(const double pressure, Matrix &M) const;
    void
    add_held_directions(const double pressure, Matrix &M) const;
    void
    add_edge_products(const double pressure, Matrix &M) const;
    void
    add_edge_turning(const double pressure, Matrix &M) const;
    void
    add_edge_bending(const int a, const double pressure, Matrix &M) const;
    // Distance |r| from an edge, or gap.
    double
    distance() const;

    const ClosestPoint<dim>            &c_;
    SurfaceMatrix<m>                    H_inverse_;
    Row                                 gap_;
    std::array<Row, m>                  parameter_;
    std::array<Row, n_metric>           metric_;
    std::array<std::array<Row, dim>, m> tangent_;  // delta-hat a_a
    std::array<Row, dim>                distance_; // delta r, total

    // Rounded edges: derivatives by distance |r| and height n . r, variations
    // of both, of the normal, and the inverse metric.
    double                distance_slope_, depth_slope_;
    Row                   rho_, depth_;
    std::array<Row, m>    turn_;
    std::array<double, m> rho_raised_, edge_traction_;
    SurfaceMatrix<m>      inverse_metric_;
  };
} // namespace NPT

#endif
