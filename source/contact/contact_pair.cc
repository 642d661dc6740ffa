// SPDX-License-Identifier: LGPL-2.1-or-later
// Parts of a contact pair, its accepted states, the augmented Lagrangian and
// results. Gaps and laws are in contact_evaluation.cc, the virtual work in
// contact_virtual_work.cc.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_pair.h>

#include <algorithm>
#include <sstream>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    template <int dim>
    ContactGeometry<dim>
    make_geometry(const ContactSurface<dim>              &secondary,
                  const std::vector<ContactSurface<dim>> &primaries,
                  const ContactParameters                &contact,
                  const double                            thickness)
    {
      const auto points =
        secondary.surface().quadrature(contact.n_quadrature_points);
      return {secondary,
              primaries,
              points,
              contact.method == ContactParameters::Method::mortar ?
                Averaging::mortar<dim>(secondary.surface(), points) :
                Averaging::pointwise<dim>(points),
              contact.maximum_penetration * thickness,
              thickness};
    }
  } // namespace



  template <int dim>
  ContactPair<dim>::ContactPair(
    const ContactSurface<dim>              &secondary,
    const std::vector<ContactSurface<dim>> &primaries,
    const ContactParameters                &contact,
    const FrictionParameters               &friction,
    const double                            thickness,
    const SymmetryWeight                   &symmetry_weight)
    : geometry_(make_geometry(secondary, primaries, contact, thickness))
    , nodes_are_points_(contact.method != ContactParameters::Method::mortar)
    , augmented_(contact.augmented())
    , normal_law_(Registry<NamedNormalLaw>::instance()
                    .get(contact.normal_law)
                    .make(contact))
    , friction_law_(Registry<NamedFrictionLaw<m>>::instance()
                      .get(friction.law)
                      .make(friction))
    , slip_measure_(Registry<NamedSlipMeasure<dim>>::instance()
                      .get(friction.slip_measure)
                      .make())
  {
    for (const auto &node : geometry_.averaging.nodes())
      symmetry_weight_.push_back(
        symmetry_weight ?
          symmetry_weight(nodes_are_points_ ?
                            geometry_.points[node.label].X :
                            secondary.reference_position(node.label)) :
          1);
  }



  template <int dim>
  void
  ContactPair<dim>::assert_sizes(const ContactState<dim> &state) const
  {
    (void)state;
    AssertDimension(state.traction.size(), n_nodes());
    AssertDimension(state.multiplier.size(), n_nodes());
    AssertDimension(state.closest.size(), geometry_.points.size());
  }



  template <int dim>
  void
  ContactPair<dim>::assert_belongs(
    const ContactStep<dim>       &step,
    const ContactEvaluation<dim> &evaluation) const
  {
    (void)step;
    (void)evaluation;
    AssertDimension(step.starts.size(), geometry_.points.size());
    Assert(step.serial != 0 && evaluation.serial == step.serial,
           dealii::ExcMessage(
             "This evaluation is not of this load step, or the step was "
             "augmented after it. Call ContactPair::evaluate()."));
    AssertDimension(evaluation.nodes.size(), n_nodes());
  }



  // -------------------------------------------------------- accepted states

  template <int dim>
  ContactState<dim>
  ContactPair<dim>::initial_state() const
  {
    ContactState<dim> state;
    state.traction.assign(n_nodes(), std::array<double, m>{});
    state.multiplier.assign(n_nodes(), 0.);
    state.closest.resize(geometry_.points.size());
    return state;
  }



  template <int dim>
  ContactState<dim>
  ContactPair<dim>::with_friction(const ContactState<dim> &state,
                                  const bool               on) const
  {
    // Without friction nothing of the friction machinery is ever touched. The
    // history begins where friction begins; a stage that finds friction on
    // already goes on with it.
    assert_sizes(state);
    ContactState<dim> result = state;
    result.friction_on       = on && friction_law_->exerts_traction();
    if (!result.friction_on || !state.friction_on)
      result.traction.assign(n_nodes(), std::array<double, m>{});
    return result;
  }



  template <int dim>
  ContactState<dim>
  ContactPair<dim>::start_friction(const ContactState<dim> &state,
                                   const Vector<double>    &displacement) const
  {
    const ContactStep<dim> step = begin_step(state, displacement);
    ContactEvaluation<dim> evaluation;
    evaluate(step, displacement, evaluation);
    ContactState<dim>       result   = state;
    const ContactState<dim> accepted = accept(step, evaluation);
    result.closest                   = accepted.closest;
    result.behind                    = accepted.behind;
    return result;
  }



  template <int dim>
  ContactState<dim>
  ContactPair<dim>::accept(const ContactStep<dim>       &step,
                           const ContactEvaluation<dim> &evaluation) const
  {
    assert_belongs(step, evaluation);
    ContactState<dim> state;
    state.friction_on = step.friction_on;
    state.multiplier  = step.multiplier;
    state.traction.resize(n_nodes());
    for (unsigned int I = 0; I < n_nodes(); ++I)
      {
        state.traction[I] = evaluation.nodes[I].friction.traction;
        if (augmented_)
          state.multiplier[I] = evaluation.nodes[I].pressure;
      }
    state.closest.resize(geometry_.points.size());
    for (unsigned int q = 0; q < state.closest.size(); ++q)
      {
        const ClosestPoint<dim> &c = evaluation.closest[q];
        state.closest[q].known     = !step.behind[q];
        state.closest[q].surface   = c.surface;
        state.closest[q].u         = c.u;
      }
    state.behind        = step.behind;
    state.penalty_scale = step.penalty_scale;
    return state;
  }



  // ---------------------------------------------------- augmented Lagrangian

  template <int dim>
  ContactViolation
  ContactPair<dim>::violation(const ContactStep<dim>       &step,
                              const ContactEvaluation<dim> &evaluation) const
  {
    assert_belongs(step, evaluation);
    const SlipMeasure<dim> *slip_measure = measure(step.friction_on);
    ContactViolation        result;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      {
        const NodeState<dim> &state = evaluation.nodes[I];
        if (symmetry_weight_[I] == 0 ||
            (!state.active && step.multiplier[I] == 0.))
          continue;
        result.gap = std::max(result.gap,
                              std::abs(state.pressure - step.multiplier[I]) /
                                (step.penalty_scale * normal_law_->penalty()));
        if (slip_measure == nullptr || !state.active)
          continue;
        // |t - lambda|^2 = (t - lambda)_a a^{ab} (t - lambda)_b.
        const auto metric =
          slip_measure->traction_metric({geometry_, step, evaluation}, I);
        const auto &t      = state.friction.traction;
        const auto &lambda = step.traction_multiplier[I];
        double      square = 0;
        for (int a = 0; a < m; ++a)
          for (int b = 0; b < m; ++b)
            square += (t[a] - lambda[a]) * metric[a][b] * (t[b] - lambda[b]);
        result.slip =
          std::max(result.slip,
                   std::sqrt(std::max(0., square)) /
                     (step.penalty_scale * friction_law_->penalty()));
      }
    return result;
  }



  template <int dim>
  void
  ContactPair<dim>::check_depth(const ContactEvaluation<dim> &evaluation) const
  {
    for (unsigned int q = 0; q < evaluation.closest.size(); ++q)
      if (evaluation.reach.has(q) && geometry_.is_deep(evaluation.closest[q]))
        {
          std::ostringstream detail;
          detail << "contact point " << q << " lies "
                 << -evaluation.closest[q].gap << " mm deep, more than the "
                 << geometry_.maximum_penetration
                 << " mm of Maximum penetration";
          throw PenetrationTooDeep(detail.str());
        }
  }



  // ---------------------------------------------------------------- results

  template <int dim>
  ContactSummary
  ContactPair<dim>::summary(const ContactEvaluation<dim> &evaluation) const
  {
    AssertDimension(evaluation.nodes.size(), n_nodes());
    ContactSummary result;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      {
        const NodeState<dim> &state = evaluation.nodes[I];
        const unsigned int    k     = symmetry_weight_[I];
        const double          W     = weight(evaluation.reach, I);
        result.energy += W * state.energy;
        if (!state.active)
          continue;
        result.n_active += k;
        if (evaluation.friction_on)
          {
            (state.slipping ? result.n_slip : result.n_stick) += k;
            result.friction_energy += W * state.friction.energy;
            result.dissipation += W * state.friction.dissipation;
          }
      }
    // Depth is that of points: a mean over a control point may be open where
    // a corner of the other body is deep inside.
    for (unsigned int q = 0; q < evaluation.closest.size(); ++q)
      if (evaluation.reach.has(q))
        result.largest_penetration =
          std::max(result.largest_penetration, -evaluation.closest[q].gap);
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  ContactPair<dim>::friction_traction(const ContactEvaluation<dim> &evaluation,
                                      const unsigned int            I) const
  {
    AssertIndexRange(I, evaluation.nodes.size());
    const SlipMeasure<dim> *slip_measure = measure(evaluation.friction_on);
    return slip_measure == nullptr || !evaluation.nodes[I].active ?
             Tensor<1, dim>() :
             slip_measure->traction_vector(geometry_, evaluation, I);
  }



  template <int dim>
  Tensor<1, dim>
  ContactPair<dim>::slip_increment(const ContactEvaluation<dim> &evaluation,
                                   const unsigned int            I) const
  {
    AssertIndexRange(I, evaluation.nodes.size());
    const SlipMeasure<dim> *slip_measure = measure(evaluation.friction_on);
    return slip_measure == nullptr || !evaluation.nodes[I].active ?
             Tensor<1, dim>() :
             slip_measure->slip_vector(geometry_, evaluation, I);
  }

  template class ContactPair<2>;
  template class ContactPair<3>;
} // namespace NPT
