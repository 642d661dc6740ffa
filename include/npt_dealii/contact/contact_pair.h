// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines frictional contact of one secondary surface with its primary
// surfaces: what a load step refers to, state, residual, consistent tangent.

#ifndef npt_dealii_contact_contact_pair_h
#define npt_dealii_contact_contact_pair_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/contact/friction_coefficient.h>
#include <npt_dealii/contact/geometry/contact_search.h>
#include <npt_dealii/contact/normal_law.h>
#include <npt_dealii/contact/slip_measure.h>

#include <functional>
#include <memory>

namespace NPT
{
  /**
   * Frictional contact of one secondary surface, (43),
   *
   * @f[ C_c = \sum_I W_I \left( p^I \, \delta g^I
   *           + t_a^I \, \delta\xi^{a,I} \right), @f]
   *
   * with the nodes I of Averaging. Friction may have nodes of its own, the
   * Gauss points, (A27); FrictionParameters::nodes. The three questions of
   * contact are answered one after the other: evaluate() finds where the
   * surfaces are and how far apart (projection, averages) and what the laws
   * answer; add_residual() and add_tangent() say where the traction acts. The
   * assembled virtual work is delta W_int + C_c = 0 ((15) misprints the sign).
   *
   * A pair never changes; what does are values, made in this order:
   *
   * @code
   *   ContactState<dim>      state = pair.initial_state();
   *   ContactEvaluation<dim> evaluation;
   *   ContactStep<dim>       step = pair.begin_step(state, u_accepted);
   *   pair.evaluate(step, u, evaluation); // in every iteration
   *   pair.add_residual(step, evaluation, residual);
   *   pair.add_tangent(step, evaluation, add);
   *   state = pair.accept(step, evaluation);
   * @endcode
   *
   * So a load step is a pure function of (accepted state, increment), and a
   * rejected one leaves nothing. Slip is measured as Friction/Slip measure
   * says, see SlipMeasure; what the surfaces answer is up to NormalLaw and
   * FrictionLaw.
   *
   * Unknowns are numbered by the ContactSurface objects; vectors are full
   * (unconstrained) vectors.
   */
  template <int dim>
  class ContactPair
  {
  public:
    static constexpr int m = dim - 1;

    /// Integer weight of a node in the virtual work, by the reference position
    /// of its control point or Gauss point; see fabric symmetry (a 2-fold axis
    /// lets one half of the nodes stand for both).
    using SymmetryWeight =
      std::function<unsigned int(const dealii::Point<dim> &)>;

    /**
     * @param thickness Of the thinner body [mm]. Maximum penetration is a
     *   fraction of it, and it is the reach beside an edge.
     */
    ContactPair(const ContactSurface<dim>              &secondary,
                const std::vector<ContactSurface<dim>> &primaries,
                const ContactParameters                &contact,
                const FrictionParameters               &friction,
                const double                            thickness,
                const SymmetryWeight                   &symmetry_weight = {});

    // ----------------------------------------------------- accepted states

    /// No traction, no history, friction off.
    ContactState<dim>
    initial_state() const;

    /// The state with friction on, with zero history from now on, or off; a
    /// state that has it on already goes on with it. Without a friction
    /// coefficient friction stays off.
    ContactState<dim>
    with_friction(const ContactState<dim> &state, const bool on) const;

    /// The state with the closest points of this displacement as reference of
    /// the slip; nothing else changes. Throws ProjectionLost.
    ContactState<dim>
    start_friction(const ContactState<dim>      &state,
                   const dealii::Vector<double> &displacement) const;

    // ----------------------------------------------------------- load step

    /// Start values and references of a load step: a full search for the
    /// closest points of the accepted displacement, of which each process
    /// searches some. Throws ProjectionLost, on all processes, if a point has
    /// none.
    ContactStep<dim>
    begin_step(const ContactState<dim>      &state,
               const dealii::Vector<double> &accepted_displacement,
               const Ranks                  &ranks = {}) const;

    /// Compute gaps, pressures and tractions at this displacement. The answer
    /// depends on step and displacement only; the storage of the evaluation is
    /// used again. Each process looks for some of the closest points. Throws
    /// ProjectionLost, on all processes, if a point has none.
    void
    evaluate(const ContactStep<dim>       &step,
             const dealii::Vector<double> &displacement,
             ContactEvaluation<dim>       &evaluation,
             const Ranks                  &ranks = {}) const;

    /// Add C_c of the evaluated state to a full residual vector.
    void
    add_residual(const ContactStep<dim>       &step,
                 const ContactEvaluation<dim> &evaluation,
                 dealii::Vector<double>       &residual) const;

    /// Receives unknowns and a dense matrix (row major) to be added.
    using AddMatrix = std::function<void(const std::vector<unsigned int> &dofs,
                                         const std::vector<double> &matrix)>;
    /// Hand the blocks of the consistent tangent of the evaluated state out,
    /// each on one of the processes.
    void
    add_tangent(const ContactStep<dim>       &step,
                const ContactEvaluation<dim> &evaluation,
                const AddMatrix              &add,
                const Ranks                  &ranks = {}) const;

    /// Groups of unknowns that the tangent couples, for all nodes that are
    /// closed or nearer than `margin` [mm].
    std::vector<std::vector<unsigned int>>
    coupled_unknowns(const ContactStep<dim>       &step,
                     const ContactEvaluation<dim> &evaluation,
                     const double                  margin) const;

    /// Throws PenetrationTooDeep if a point in reach is deeper than
    /// Contact / Maximum penetration: such a state is no solution, since the
    /// point may be behind the body in truth.
    void
    check_depth(const ContactEvaluation<dim> &evaluation) const;

    /// The evaluated state as the accepted one.
    ContactState<dim>
    accept(const ContactStep<dim>       &step,
           const ContactEvaluation<dim> &evaluation) const;

    // ------------------------------------------------------------ relaxation

    /**
     * The state in which a fraction of the contact pressure at the start of the
     * relaxation has gone: what has been pressed in counts as the shape of the
     * surfaces,
     *
     * @f[ g \to g + \varphi \, \langle -g_0 \rangle, @f]
     *
     * so that at the same displacement the pressure falls linearly with the
     * fraction phi, as do multipliers and friction tractions.
     *
     * @param state With the fraction `before`.
     * @param gaps g_0 of the nodes at the start of the relaxation [mm].
     */
    ContactState<dim>
    relax(const ContactState<dim>   &state,
          const std::vector<double> &gaps,
          const double               before,
          const double               now) const;

    /// Energy of the normal penalty that relaxation takes away per fraction
    /// [N mm].
    double
    relaxation_rate(const ContactEvaluation<dim> &evaluation,
                    const std::vector<double>    &gaps) const;

    // -------------------------------------------------- augmented Lagrangian

    /// How far the evaluated state is from its multipliers, (A17).
    ContactViolation
    violation(const ContactStep<dim>       &step,
              const ContactEvaluation<dim> &evaluation) const;

    /// Uzawa's update: the multipliers of the step take what they lack, (A17),
    /// and both penalties grow by a factor >= 1. The step must be evaluated
    /// anew after that; only accept() makes it part of a state.
    void
    augment(ContactStep<dim>             &step,
            const ContactEvaluation<dim> &evaluation,
            const double                  growth = 1.) const;

    // -------------------------------------------------------------- results

    ContactSummary
    summary(const ContactEvaluation<dim> &evaluation) const;

    /// Does an active node slip? With friction at Gauss points: do those that
    /// bear more than half of its pressure?
    bool
    slips(const ContactEvaluation<dim> &evaluation, const unsigned int I) const;

    /// Friction traction of a friction node, as friction_traction().
    dealii::Tensor<1, dim>
    traction_of_friction_node(const ContactEvaluation<dim> &evaluation,
                              const unsigned int            J) const;

    /// Friction traction of node I on the secondary side, as a vector [MPa].
    dealii::Tensor<1, dim>
    friction_traction(const ContactEvaluation<dim> &evaluation,
                      const unsigned int            I) const;

    /// Slip increment of node I as a vector [mm].
    dealii::Tensor<1, dim>
    slip_increment(const ContactEvaluation<dim> &evaluation,
                   const unsigned int            I) const;

    unsigned int
    n_nodes() const
    {
      return geometry_.averaging.nodes().size();
    }
    unsigned int
    n_friction_nodes() const
    {
      return geometry_.friction_averaging.nodes().size();
    }
    const Averaging &
    averaging() const
    {
      return geometry_.averaging;
    }
    const Averaging &
    friction_averaging() const
    {
      return geometry_.friction_averaging;
    }
    const ContactSurface<dim> &
    secondary() const
    {
      return geometry_.secondary;
    }
    const std::vector<typename IGASurface<dim>::QuadraturePoint> &
    quadrature_points() const
    {
      return geometry_.points;
    }

  private:
    // The measure of slip where there is friction, otherwise null.
    const SlipMeasure<dim> *
    measure(const bool friction_on) const
    {
      return friction_on ? slip_measure_.get() : nullptr;
    }
    void
    assert_sizes(const ContactState<dim> &state) const;
    // Programmer's mistake: an evaluation of another step, or none.
    void
    assert_belongs(const ContactStep<dim>       &step,
                   const ContactEvaluation<dim> &evaluation) const;

    // Weight of a node in the virtual work, W_I s_I times that of symmetry.
    double
    weight(const ContactReach &reach, const unsigned int I) const
    {
      return symmetry_weight_[I] * geometry_.averaging.nodes()[I].area *
             reach.of_node[I];
    }
    double
    friction_weight(const ContactReach &reach, const unsigned int J) const
    {
      return friction_symmetry_weight_[J] *
             geometry_.friction_averaging.nodes()[J].area *
             reach.of_friction_node[J];
    }
    // Friction acts, and at Gauss points that are not the contact nodes.
    bool
    at_points(const ContactView<dim> &view) const
    {
      return friction_at_points_ && view.step.friction_on;
    }
    // Does the node take part in the virtual work: by itself, or by the
    // friction of one of its points?
    bool
    acts(const unsigned int I, const bool friction_on) const
    {
      return symmetry_weight_[I] > 0 ||
             (friction_on && friction_at_points_ && bears_friction_[I]);
    }
    // Mean over a contact node of vectors at the friction nodes.
    template <typename Vectors>
    dealii::Tensor<1, dim>
    mean_at_node(const ContactEvaluation<dim> &evaluation,
                 const unsigned int            I,
                 const Vectors                &vector_at) const;

    // S (p - lambda) and S (t - lambda_t) of (A17). (contact_multipliers.cc)
    struct Missing
    {
      std::vector<double>                pressure; // by contact node
      std::vector<std::array<double, m>> traction; // by friction node
    };
    Missing
    missing_multipliers(const ContactStep<dim>       &step,
                        const ContactEvaluation<dim> &evaluation) const;

    // Where are the surfaces, and how far? (contact_evaluation.cc)
    ClosestPoint<dim>
    find_start(const ContactSearch<dim>    &search,
               const ContactPositions<dim> &positions,
               const ProjectionStart<dim>  &accepted,
               const unsigned int           q) const;
    double
    reach_of_point(const ContactPositions<dim> &positions,
                   const ClosestPoint<dim>     &c,
                   const bool                   behind) const;
    // b_q of (A20) [mm].
    double
    distance_beside(const ContactPositions<dim> &positions,
                    const ClosestPoint<dim>     &c) const;
    void
    set_reach_of_nodes(ContactReach &reach) const;
    // (A38) of the accepted state. @param cosines Of the angle between the
    // fibers, by Gauss point, if the coefficient depends on it.
    void
    set_friction_factors(const std::vector<double> &cosines,
                         ContactStep<dim>          &step) const;
    double
    cosine_of_fibers(const ContactPositions<dim> &positions,
                     const ClosestPoint<dim>     &closest,
                     const unsigned int           q) const;
    std::vector<double>
    slip_path_after(const ContactStep<dim>       &step,
                    const ContactEvaluation<dim> &evaluation) const;
    ClosestPlace<dim>
    find_closest(const ContactView<dim> &view, const unsigned int q) const;
    ClosestPlace<dim>
    search_anew(const ContactView<dim> &view, const unsigned int q) const;
    void
    try_neighbor(const ContactView<dim> &view,
                 const unsigned int      q,
                 ClosestPlace<dim>      &closest) const;
    // Those of all points; each process finds some of them.
    void
    find_all_closest(const ContactView<dim>         &view,
                     std::vector<ClosestPoint<dim>> &closest,
                     const Ranks                    &ranks) const;

    // What do the laws answer?
    void
    evaluate_node(const ContactView<dim> &view,
                  const unsigned int      I,
                  NodeState<dim>         &state) const;
    void
    evaluate_friction(const ContactView<dim> &view,
                      const unsigned int      J,
                      FrictionState<dim>     &state) const;
    // (A46).
    double
    dissipation_of_step(const ContactStep<dim>                  &step,
                        const unsigned int                       J,
                        const typename SlipMeasure<dim>::Metric &metric,
                        const FrictionState<dim>                &state) const;
    void
    set_friction_pressures(ContactEvaluation<dim> &evaluation) const;
    void
    load_points_by_pressure(const ContactStep<dim> &step,
                            const unsigned int      I,
                            ContactEvaluation<dim> &evaluation) const;
    void
    load_points_by_friction(const ContactStep<dim> &step,
                            const unsigned int      J,
                            ContactEvaluation<dim> &evaluation) const;

    // Where does the traction act? (contact_virtual_work.cc)
    void
    point_functions(const ContactView<dim> &view,
                    const unsigned int      q,
                    PointFunctions<dim>    &functions) const;
    unsigned int
    n_variations(const ContactView<dim> &view) const;
    void
    point_variations(const ContactView<dim>       &view,
                     const unsigned int            q,
                     const ContactKinematics<dim> &kinematics,
                     const PointFunctions<dim>    &functions,
                     Variations<dim>              &variations) const;
    // slot is scratch: position of an unknown in the average, else invalid.
    void
    average_variations(const ContactView<dim>             &view,
                       const unsigned int                  I,
                       const std::vector<Variations<dim>> &of_points,
                       std::vector<unsigned int>          &slot,
                       Variations<dim>                    &average) const;
    // Terms of the tangent: all second variations, and products of first
    // variations with the derivatives of the laws.
    void
    add_second_variations(const ContactView<dim>       &view,
                          const unsigned int            q,
                          const ContactKinematics<dim> &kinematics,
                          const PointFunctions<dim>    &functions,
                          std::vector<double>          &block) const;
    void
    add_normal_product(const ContactView<dim>    &view,
                       const unsigned int         I,
                       const std::vector<double> &gap_row,
                       std::vector<double>       &block) const;
    void
    add_friction_products(const ContactView<dim> &view,
                          const unsigned int      J,
                          const Variations<dim>  &variations,
                          std::vector<double>    &block) const;
    // Friction at points: what the pressure of a contact node does to the
    // friction of its points.
    void
    average_friction_by_pressure(const ContactView<dim>             &view,
                                 const unsigned int                  I,
                                 const std::vector<Variations<dim>> &of_points,
                                 const std::vector<unsigned int>    &slot,
                                 std::vector<double>                &row) const;
    // Loaded points that share all their functions.
    std::vector<std::vector<unsigned int>>
    groups_of_points(const ContactView<dim> &view) const;
    // Nodes of several points that act, those of this process.
    std::vector<unsigned int>
    own_averages(const ContactView<dim> &view, const Ranks &ranks) const;
    // Blocks of single points, of which the first variations are kept where
    // they are averaged, and of nodes.
    void
    add_tangent_of_points(const ContactView<dim>       &view,
                          const std::vector<bool>      &averaged,
                          std::vector<Variations<dim>> &of_points,
                          const AddMatrix              &add,
                          const Ranks                  &ranks) const;
    void
    add_tangent_of_nodes(const ContactView<dim>             &view,
                         const std::vector<unsigned int>    &nodes,
                         const std::vector<Variations<dim>> &of_points,
                         const AddMatrix                    &add) const;

    const ContactGeometry<dim>                    geometry_;
    const bool                                    nodes_are_points_;
    const bool                                    friction_at_points_;
    const bool                                    augmented_;
    const std::unique_ptr<const NormalLaw>        normal_law_;
    const std::unique_ptr<const FrictionLaw<m>>   friction_law_;
    const FrictionCoefficient                     friction_coefficient_;
    const std::unique_ptr<const SlipMeasure<dim>> slip_measure_;
    std::vector<unsigned int>                     symmetry_weight_; // by node
    std::vector<unsigned int> friction_symmetry_weight_; // by friction node
    std::vector<bool>         bears_friction_; // by node, friction at points
  };
} // namespace NPT

#endif
