// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the virtual work of frictional contact of one secondary surface with
// its primary surfaces: state, residual, consistent tangent, history.

#ifndef npt_dealii_contact_contact_assembler_h
#define npt_dealii_contact_contact_assembler_h

#include <npt_dealii/contact/averaging.h>
#include <npt_dealii/contact/contact_history.h>
#include <npt_dealii/contact/contact_kinematics.h>
#include <npt_dealii/contact/contact_parameters.h>
#include <npt_dealii/contact/coulomb_friction.h>
#include <npt_dealii/contact/normal_law.h>

#include <functional>

namespace NPT
{
  /**
   * Frictional contact of one secondary surface, (43),
   *
   * @f[ C_c = \sum_I W_I \left( p^I \, \delta g^I
   *           + t_a^I \, \delta\xi^{a,I} \right), @f]
   *
   * with the nodes I of Averaging. The three questions of contact are answered
   * one after the other: evaluate() finds where the surfaces are and how far
   * apart (projection, averages) and what the laws answer; add_residual()
   * and add_tangent() say where the traction acts. The assembled virtual work
   * is delta W_int + C_c = 0 ((15) misprints the sign).
   *
   * Slip is measured in one of two ways. "closest point": as in the paper by
   * the increments of xi-bar. There the slip across an edge, a kink or a seam
   * vanishes the moment the closest point is held there, and the residual
   * jumps. "relative displacement" (default), (A16) of doc/theory.md: with the
   * material point xi_n of the primary surface that was closest to the
   * accepted state, and the tangents tau_a = x^s_{,a} of the secondary surface,
   *
   * @f[ \sigma_a = \tau_a \cdot (x^s - x^m(\xi_n))
   *       - [\tau_a \cdot (x^s - x^m(\xi_n))]_n , \qquad
   *     C_t = \sum_I W_I \, t^{a,I} \, \delta\sigma_a^I . @f]
   *
   * It is a bilinear function of the displacement whatever the closest point
   * does, invariant under rigid motion (so that action equals reaction, also
   * in moment), and does not depend on the chart of the primary surface.
   *
   * Unknowns are numbered by the ContactSurface objects; vectors are full
   * (unconstrained) vectors.
   */
  template <int dim>
  class ContactAssembler
  {
  public:
    static constexpr int m = dim - 1;

    /// Integer weight of a node in the virtual work, by the reference position
    /// of its control point or Gauss point; see fabric symmetry (a 2-fold axis
    /// lets one half of the nodes stand for both).
    using SymmetryWeight =
      std::function<unsigned int(const dealii::Point<dim> &)>;

    /**
     * @param maximum_penetration Deeper closest points are rejected [mm].
     */
    ContactAssembler(const ContactSurface<dim>              &secondary,
                     const std::vector<ContactSurface<dim>> &primaries,
                     const ContactParameters                &contact,
                     const FrictionParameters               &friction,
                     const double          maximum_penetration,
                     const SymmetryWeight &symmetry_weight = {});

    /// Switch friction on (with zero slip history from now on) or off.
    void
    set_friction(const bool on);

    /**
     * Start a step from the accepted displacement: full search for the closest
     * points, so that nothing of a rejected attempt survives.
     */
    void
    start_step(const dealii::Vector<double> &accepted_displacement);

    /// Compute gaps, pressures and tractions at this displacement. Throws
    /// ProjectionLost if a point has no closest point.
    void
    evaluate(const dealii::Vector<double> &displacement);

    /// Add C_c of the evaluated state to a full residual vector.
    void
    add_residual(dealii::Vector<double> &residual) const;

    /// Receives unknowns and a dense matrix (row major) to be added.
    using AddMatrix = std::function<void(const std::vector<unsigned int> &dofs,
                                         const std::vector<double> &matrix)>;
    /// Hand the blocks of the consistent tangent of the evaluated state out.
    void
    add_tangent(const AddMatrix &add) const;

    /// Groups of unknowns that the tangent couples, for all nodes that are
    /// closed or nearer than `margin` [mm].
    std::vector<std::vector<unsigned int>>
    coupled_unknowns(const double margin) const;

    /// Make the evaluated state the accepted one.
    void
    commit();

    /// What the multipliers of the augmented Lagrangian still leave open [mm].
    struct Violation
    {
      double gap  = 0; ///< largest |p - lambda| / epsilon_N
      double slip = 0; ///< largest |t - lambda_t| / epsilon_T
      // Both with the penalties as they have grown.
    };
    /// How far the evaluated state is from its multipliers.
    Violation
    violation() const;
    /// Uzawa's update: the evaluated tractions become the multipliers of the
    /// present load step, and both penalties grow by a factor. Only commit()
    /// makes that growth part of the accepted state.
    void
    augment(const double growth = 1.);

    /// Figures of the evaluated state.
    struct Summary
    {
      unsigned int n_active            = 0;
      unsigned int n_stick             = 0;
      unsigned int n_slip              = 0;
      double       energy              = 0; ///< normal penalty energy [N mm]
      double       friction_energy     = 0; ///< tangential penalty [N mm]
      double       dissipation         = 0; ///< of this increment [N mm]
      double       largest_penetration = 0; ///< over nodes [mm]
    };
    Summary
    summary() const;

    /// State at a contact node.
    struct NodeState
    {
      double                                gap      = 0;
      bool                                  active   = false;
      bool                                  slipping = false;
      double                                pressure = 0; ///< p <= 0
      double                                slope    = 0;
      double                                energy   = 0;
      std::array<double, m>                 slip     = {};
      typename CoulombFriction<m>::Response friction;
    };
    const std::vector<NodeState> &
    nodes() const
    {
      return nodes_;
    }
    /// Friction traction of node I on the secondary side, as a vector [MPa].
    dealii::Tensor<1, dim>
    friction_traction(const unsigned int I) const;
    /// Slip increment of node I as a vector [mm].
    dealii::Tensor<1, dim>
    slip_increment(const unsigned int I) const;
    const Averaging &
    averaging() const
    {
      return averaging_;
    }
    const ContactSurface<dim> &
    secondary() const
    {
      return secondary_;
    }
    const std::vector<typename IGASurface<dim>::QuadraturePoint> &
    quadrature_points() const
    {
      return points_;
    }
    const std::vector<ClosestPoint<dim>> &
    closest_points() const
    {
      return closest_;
    }
    /// Committed state, for checkpoints and for undoing.
    const ContactHistory<dim> &
    history() const
    {
      return history_;
    }
    void
    set_history(const ContactHistory<dim> &history)
    {
      history_ = history;
    }
    /// Multipliers of the augmented Lagrangian are part of the history.
    ContactHistory<dim> &
    history()
    {
      return history_;
    }

  private:
    // Unknowns and jet values at one Gauss point: functions of the secondary
    // surface, of the primary one at the closest point, and, where these are
    // others, at the reference point of slip.
    struct PointFunctions
    {
      std::vector<unsigned int> dofs;      // first unknown of each function
      std::vector<unsigned int> reference; // functions of the reference point
      // jet[f] holds the value of functional f for each function.
      std::array<std::vector<double>, ContactKinematics<dim>::n_jets> jet;
    };
    // Slip of a Gauss point by relative displacement (A16).
    struct SlipPoint
    {
      double          weight  = 0; // 1 near the primary surface, 0 far from it
      unsigned int    surface = 0;
      SurfaceShape<m> shape;          // at xi_n
      std::array<double, m>  start{}; // tau_a . (x^s - x^m(xi_n)) accepted
      dealii::Tensor<1, dim> d;       // x^s - x^m(xi_n)
      std::array<dealii::Tensor<1, dim>, m> tau; // x^s_,a
      std::array<double, m>                 sigma{};
    };
    void
    point_functions(const unsigned int q, PointFunctions &functions) const;
    void
    set_slip_references(const std::vector<dealii::Point<dim>> &positions);
    void
    update_slip_point(const std::vector<dealii::Point<dim>> &positions,
                      const unsigned int                     q,
                      SlipPoint                             &slip) const;
    // Vector of co- or contravariant components at a node.
    dealii::Tensor<1, dim>
    tangent_vector(const unsigned int           I,
                   const std::array<double, m> &v,
                   const bool                   covariant) const;
    // delta sigma_a on the functions of a point.
    void
    slip_row(const unsigned int    q,
             const int             a,
             const PointFunctions &functions,
             std::vector<double>  &row) const;

    // First variations of a point, or their averages at a node, on the control
    // points: row 0 of the gap, then of the components of the slip, then, with
    // slip by the closest point, of the metric.
    struct Variations
    {
      std::vector<unsigned int> dofs; // first unknown of each function
      std::array<std::vector<double>, 1 + m + ContactKinematics<dim>::n_metric>
        rows;
    };
    unsigned int
    n_variations() const;
    void
    point_variations(const unsigned int            q,
                     const ContactKinematics<dim> &kinematics,
                     const PointFunctions         &functions,
                     Variations                   &variations) const;
    // slot is scratch: position of an unknown in the average, else invalid.
    void
    average_variations(const unsigned int             I,
                       const std::vector<Variations> &of_points,
                       std::vector<unsigned int>     &slot,
                       Variations                    &average) const;
    // Terms of the tangent: t^a D(delta sigma_a), all second variations, and
    // products of first variations with the derivatives of the laws.
    void
    add_slip_second_variation(const unsigned int    q,
                              const PointFunctions &functions,
                              std::vector<double>  &block) const;
    void
    add_second_variations(const unsigned int            q,
                          const ContactKinematics<dim> &kinematics,
                          const PointFunctions         &functions,
                          std::vector<double>          &block) const;
    void
    add_first_variations(const unsigned int   I,
                         const Variations    &variations,
                         std::vector<double> &block) const;
    bool
    is_admissible(const unsigned int q) const;
    void
    find_closest(const dealii::Point<dim> &x,
                 const unsigned int        q,
                 ClosestPoint<dim>        &closest) const;

    ContactSurface<dim>                                    secondary_;
    std::vector<ContactSurface<dim>>                       primaries_;
    ContactParameters                                      contact_;
    CoulombFriction<m>                                     friction_law_;
    const bool                                             by_closest_point_;
    bool                                                   friction_on_ = false;
    double                                                 maximum_penetration_;
    std::vector<typename IGASurface<dim>::QuadraturePoint> points_;
    Averaging                                              averaging_;
    std::vector<unsigned int>                              symmetry_weight_;

    ContactHistory<dim>               history_;
    std::vector<ProjectionStart<dim>> starts_;
    std::vector<SlipPoint>            slip_points_;
    // Metric of the secondary surface at the nodes, accepted state, inverted.
    std::vector<std::array<double, SymmetricIndices<m>::n_second>>
      inverse_metric_;
    // Multipliers of the present load step.
    std::vector<double>                          multiplier_;
    std::vector<std::array<double, m>>           traction_multiplier_;
    double                                       penalty_scale_ = 1.;
    std::vector<std::vector<dealii::Point<dim>>> primary_positions_;
    std::vector<ClosestPoint<dim>>               closest_;
    std::vector<NodeState>                       nodes_;
    // Sums over the nodes of W_I A_Iq p^I and W_I A_Iq t_a^I at the points.
    std::vector<double>                point_pressure_;
    std::vector<std::array<double, m>> point_traction_;
    std::vector<bool>                  point_loaded_;
  };
} // namespace NPT

#endif
