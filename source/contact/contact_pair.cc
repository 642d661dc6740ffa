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
                  const FrictionParameters               &friction,
                  const double                            thickness)
    {
      const auto points =
        secondary.surface().quadrature(contact.n_quadrature_points);
      const auto averaging = [&](const bool at_points) {
        return at_points ||
                   contact.method != ContactParameters::Method::mortar ?
                 Averaging::pointwise<dim>(points) :
                 Averaging::mortar<dim>(secondary.surface(), points);
      };
      return {secondary,
              primaries,
              points,
              averaging(false),
              averaging(friction.nodes ==
                        FrictionParameters::Nodes::Gauss_points),
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
    : geometry_(
        make_geometry(secondary, primaries, contact, friction, thickness))
    , nodes_are_points_(contact.method != ContactParameters::Method::mortar)
    , friction_at_points_(!nodes_are_points_ &&
                          friction.nodes ==
                            FrictionParameters::Nodes::Gauss_points)
    , augmented_(contact.augmented())
    , normal_law_(Registry<NamedNormalLaw>::instance()
                    .get(contact.normal_law)
                    .make(contact))
    , friction_law_(Registry<NamedFrictionLaw<m>>::instance()
                      .get(friction.law)
                      .make(friction))
    , friction_coefficient_(friction)
    , slip_measure_(Registry<NamedSlipMeasure<dim>>::instance()
                      .get(friction.slip_measure)
                      .make())
  {
    const auto weights_of = [&](const Averaging &averaging,
                                const bool       nodes_are_points) {
      std::vector<unsigned int> weights;
      for (const auto &node : averaging.nodes())
        weights.push_back(
          symmetry_weight ?
            symmetry_weight(nodes_are_points ?
                              geometry_.points[node.label].X :
                              secondary.reference_position(node.label)) :
            1);
      return weights;
    };
    symmetry_weight_ = weights_of(geometry_.averaging, nodes_are_points_);
    friction_symmetry_weight_ =
      weights_of(geometry_.friction_averaging,
                 nodes_are_points_ || friction_at_points_);
    if (friction_at_points_)
      for (const auto &node : geometry_.averaging.nodes())
        bears_friction_.push_back(
          std::any_of(node.entries.begin(),
                      node.entries.end(),
                      [&](const Averaging::Entry &entry) {
                        return friction_symmetry_weight_[entry.point] > 0;
                      }));
  }



  template <int dim>
  void
  ContactPair<dim>::assert_sizes(const ContactState<dim> &state) const
  {
    (void)state;
    AssertDimension(state.traction.size(), n_friction_nodes());
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
    AssertDimension(evaluation.friction.size(), n_friction_nodes());
  }



  // -------------------------------------------------------- accepted states

  template <int dim>
  ContactState<dim>
  ContactPair<dim>::initial_state() const
  {
    ContactState<dim> state;
    state.traction.assign(n_friction_nodes(), std::array<double, m>{});
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
      {
        result.traction.assign(n_friction_nodes(), std::array<double, m>{});
        result.slip_path.clear();
        result.law_pressure.clear();
      }
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
    result.law_pressure              = accepted.law_pressure;
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
    if (augmented_ && !nodes_are_points_)
      for (unsigned int I = 0; I < n_nodes(); ++I)
        state.multiplier[I] = evaluation.nodes[I].pressure;
    for (const FrictionState<dim> &friction : evaluation.friction)
      {
        state.traction.push_back(friction.response.traction);
        if (step.friction_on)
          state.law_pressure.push_back(friction.law_pressure);
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
    state.gap_shift     = step.gap_shift;
    state.slip_path     = slip_path_after(step, evaluation);
    return state;
  }



  template <int dim>
  ContactState<dim>
  ContactPair<dim>::relax(const ContactState<dim>   &state,
                          const std::vector<double> &gaps,
                          const double               before,
                          const double               now) const
  {
    assert_sizes(state);
    AssertDimension(gaps.size(), n_nodes());
    // A trace of pressure stays, so that what touches goes on touching: without
    // it nothing would hold bundles that touch.
    const double      all_but_a_trace = 1. - 1e-9;
    const double      left   = before < 1. ? (1. - all_but_a_trace * now) /
                                        (1. - all_but_a_trace * before) :
                                             1.;
    ContactState<dim> result = state;
    result.gap_shift.resize(n_nodes(), 0.);
    for (unsigned int I = 0; I < n_nodes(); ++I)
      {
        result.gap_shift[I] +=
          all_but_a_trace * (now - before) * std::max(0., -gaps[I]);
        result.multiplier[I] *= left;
      }
    for (auto &traction : result.traction)
      for (double &component : traction)
        component *= left;
    for (double &pressure : result.law_pressure)
      pressure *= left;
    return result;
  }



  template <int dim>
  double
  ContactPair<dim>::relaxation_rate(const ContactEvaluation<dim> &evaluation,
                                    const std::vector<double>    &gaps) const
  {
    double rate = 0;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      rate -= weight(evaluation.reach, I) * evaluation.nodes[I].pressure *
              std::max(0., -gaps[I]);
    return rate;
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
          (slips(evaluation, I) ? result.n_slip : result.n_stick) += k;
      }
    if (evaluation.friction_on)
      for (unsigned int J = 0; J < n_friction_nodes(); ++J)
        {
          const FrictionState<dim> &friction = evaluation.friction[J];
          const double              W = friction_weight(evaluation.reach, J);
          result.friction_energy += W * friction.response.energy;
          result.dissipation += W * friction.dissipation;
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
  bool
  ContactPair<dim>::slips(const ContactEvaluation<dim> &evaluation,
                          const unsigned int            I) const
  {
    if (!friction_at_points_)
      return evaluation.friction[I].response.slipping;
    double slipping = 0, all = 0;
    for (const auto &entry : geometry_.averaging.nodes()[I].entries)
      {
        const FrictionState<dim> &state = evaluation.friction[entry.point];
        all += entry.weight * state.pressure;
        if (state.response.slipping)
          slipping += entry.weight * state.pressure;
      }
    return slipping > 0.5 * all;
  }



  template <int dim>
  template <typename Vectors>
  Tensor<1, dim>
  ContactPair<dim>::mean_at_node(const ContactEvaluation<dim> &evaluation,
                                 const unsigned int            I,
                                 const Vectors                &vector_at) const
  {
    AssertIndexRange(I, evaluation.nodes.size());
    if (measure(evaluation.friction_on) == nullptr ||
        !evaluation.nodes[I].active)
      return Tensor<1, dim>();
    if (!friction_at_points_)
      return vector_at(I);
    Tensor<1, dim> mean;
    for (const auto &entry : geometry_.averaging.nodes()[I].entries)
      if (evaluation.reach.has(entry.point))
        mean += evaluation.reach.weight(I, entry) * vector_at(entry.point);
    return mean;
  }



  template <int dim>
  Tensor<1, dim>
  ContactPair<dim>::traction_of_friction_node(
    const ContactEvaluation<dim> &evaluation,
    const unsigned int            J) const
  {
    AssertIndexRange(J, evaluation.friction.size());
    return evaluation.friction[J].active() ?
             slip_measure_->traction_vector(geometry_, evaluation, J) :
             Tensor<1, dim>();
  }



  template <int dim>
  Tensor<1, dim>
  ContactPair<dim>::friction_traction(const ContactEvaluation<dim> &evaluation,
                                      const unsigned int            I) const
  {
    return mean_at_node(evaluation, I, [&](const unsigned int J) {
      return slip_measure_->traction_vector(geometry_, evaluation, J);
    });
  }



  template <int dim>
  Tensor<1, dim>
  ContactPair<dim>::slip_increment(const ContactEvaluation<dim> &evaluation,
                                   const unsigned int            I) const
  {
    return mean_at_node(evaluation, I, [&](const unsigned int J) {
      return slip_measure_->slip_vector(geometry_, evaluation, J);
    });
  }

  template class ContactPair<2>;
  template class ContactPair<3>;
} // namespace NPT
