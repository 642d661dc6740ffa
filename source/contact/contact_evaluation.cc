// SPDX-License-Identifier: LGPL-2.1-or-later
// Load steps of a contact pair: search, gaps, slip, laws at the nodes.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/contact/geometry/surface_metric.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // Of the thickness. Surfaces that just touch, as many do where weaving
    // begins, are closed in all units and on all machines.
    constexpr double round_off_of_gap = 1e-14;

    // Numbers from 1; assertions compare them, results never depend on them.
    unsigned long
    new_serial()
    {
      static std::atomic<unsigned long> last{0};
      return ++last;
    }



    [[noreturn]] void
    throw_lost(const unsigned int q)
    {
      throw ProjectionLost("contact point " + std::to_string(q) +
                           " finds no closest point on any surface");
    }
  } // namespace



  // ---------------------------------------------------------- begin of a step

  template <int dim>
  ContactStep<dim>
  ContactPair<dim>::begin_step(const ContactState<dim> &state,
                               const Vector<double>    &accepted,
                               const Ranks             &ranks) const
  {
    assert_sizes(state);
    ContactStep<dim> step;
    step.friction_on         = state.friction_on;
    step.multiplier          = state.multiplier;
    step.traction_multiplier = state.traction;
    step.penalty_scale       = state.penalty_scale;
    step.gap_shift           = state.gap_shift;
    step.slip_path           = state.slip_path;
    step.law_pressure        = state.law_pressure;
    step.serial              = new_serial();

    ContactPositions<dim> positions;
    geometry_.update_positions(accepted, positions);
    const ContactSearch<dim> search(geometry_.primaries, positions.primaries);
    const unsigned int       n_points = geometry_.points.size();
    const bool               by_angle =
      step.friction_on && friction_coefficient_.depends_on_angle();
    // What is needed of the starts; each process finds some of them.
    struct Start
    {
      ProjectionStart<dim> closest;
      bool                 is_behind;
      double               reach, cosine;
    };
    std::vector<Start> starts(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        if (!ranks.has(q))
          continue;
        const ClosestPoint<dim> c =
          find_start(search, positions, state.closest[q], q);
        Start &start  = starts[q];
        start.closest = {c.found, c.surface, c.u};
        if (!c.found)
          continue;
        start.is_behind = state.behind.empty() ? geometry_.is_deep(c) :
                                                 state.behind[q] && c.gap < 0.;
        start.reach     = reach_of_point(positions, c, start.is_behind);
        start.cosine    = by_angle ? cosine_of_fibers(positions, c, q) : 0.;
      }
    ranks.exchange(starts);

    std::vector<double> cosines;
    for (unsigned int q = 0; q < n_points; ++q)
      {
        if (!starts[q].closest.known)
          throw_lost(q);
        step.starts.push_back(starts[q].closest);
        step.behind.push_back(starts[q].is_behind);
        step.reach.of_point.push_back(starts[q].reach);
        cosines.push_back(starts[q].cosine);
      }
    set_reach_of_nodes(step.reach);
    if (step.friction_on && friction_coefficient_.varies())
      set_friction_factors(cosines, step);

    if (const SlipMeasure<dim> *slip_measure = measure(step.friction_on))
      slip_measure->set_references(geometry_, state, positions, step);
    return step;
  }



  template <int dim>
  double
  ContactPair<dim>::cosine_of_fibers(const ContactPositions<dim> &positions,
                                     const ClosestPoint<dim>     &closest,
                                     const unsigned int           q) const
  {
    const Tensor<1, dim> secondary =
      geometry_.secondary.fiber_direction(geometry_.points[q].shape,
                                          positions.secondary);
    const Tensor<1, dim> primary =
      geometry_.primaries[closest.surface].fiber_direction(
        closest.shape, positions.primaries[closest.surface]);
    return std::abs(secondary * primary);
  }



  template <int dim>
  void
  ContactPair<dim>::set_friction_factors(const std::vector<double> &cosines,
                                         ContactStep<dim>          &step) const
  {
    const auto &nodes = geometry_.friction_averaging.nodes();
    step.friction_factor.assign(nodes.size(), 1.);
    if (friction_coefficient_.depends_on_angle())
      for (unsigned int J = 0; J < nodes.size(); ++J)
        if (step.reach.of_friction_node[J] > 0.)
          {
            // The share of the first point is what the others leave, so that
            // equal factors keep their bits.
            const double first = friction_coefficient_.static_factor(
              cosines[nodes[J].entries[0].point]);
            step.friction_factor[J] = first;
            for (const auto &entry : nodes[J].entries)
              step.friction_factor[J] +=
                step.reach.friction_weight(J, entry) *
                (friction_coefficient_.static_factor(cosines[entry.point]) -
                 first);
          }
    if (!friction_coefficient_.depends_on_slip())
      return;
    step.slip_path.resize(nodes.size(), 0.);
    for (unsigned int J = 0; J < nodes.size(); ++J)
      step.friction_factor[J] *= friction_coefficient_.decay(step.slip_path[J]);
  }



  template <int dim>
  std::vector<double>
  ContactPair<dim>::slip_path_after(
    const ContactStep<dim>       &step,
    const ContactEvaluation<dim> &evaluation) const
  {
    std::vector<double> path = step.slip_path;
    for (unsigned int J = 0; J < path.size(); ++J)
      {
        const FrictionState<dim> &state = evaluation.friction[J];
        // Surfaces that have parted stick again as before.
        path[J] = !state.active() ?
                    0. :
                    path[J] + friction_coefficient_.slip_of_step(
                                state.response.dissipation,
                                step.friction_factor[J] * state.pressure);
      }
    return path;
  }



  template <int dim>
  double
  ContactPair<dim>::distance_beside(const ContactPositions<dim> &positions,
                                    const ClosestPoint<dim>     &c) const
  {
    const ContactSurface<dim> &primary = geometry_.primaries[c.surface];
    const IGASurface<dim>     &surface = primary.surface();
    constexpr int              k       = m - 1; // the parameter with round ends
    const auto                &breaks  = surface.segment_breaks(k);
    const double               low  = breaks.front() + surface.end_rounding();
    const double               high = breaks.back() - surface.end_rounding();
    if (surface.end_rounding() > 0. && (c.u[k] < low || c.u[k] > high))
      {
        // A round edge ends at the side of the body, across which the tangent
        // plane there runs; the face ends where the round edge begins.
        const auto &x      = positions.primaries[c.surface];
        const auto  u      = c.u;
        const bool  is_low = u[k] < low;
        const auto  place  = [&](const double u_k) {
          auto v = u;
          v[k]   = u_k;
          return v;
        };
        const Tensor<1, dim> outward =
          (is_low ? -1. : 1.) *
          primary.direction(place(is_low ? low : high), k, x);
        const Tensor<1, dim> beyond =
          primary.position(u, x) + c.r -
          primary.position(place(is_low ? breaks.front() : breaks.back()), x);
        return std::max(0., beyond * outward);
      }
    if (!c.on_boundary)
      return 0.;
    const double height = c.r * c.surface_normal;
    return std::sqrt(std::max(0., c.r.norm_square() - height * height));
  }



  template <int dim>
  double
  ContactPair<dim>::reach_of_point(const ContactPositions<dim> &positions,
                                   const ClosestPoint<dim>     &c,
                                   const bool                   behind) const
  {
    if (behind)
      return 0.;
    const double beside = distance_beside(positions, c);
    // A thickness is farther than pressed bundles bulge; beyond, the mean over
    // a control point's support must not be ruled by points that touch nothing.
    return std::min(1., std::max(0., 2. - beside / geometry_.thickness));
  }



  template <int dim>
  void
  ContactPair<dim>::set_reach_of_nodes(ContactReach &reach) const
  {
    const auto set = [&](const Averaging &averaging, std::vector<double> &of) {
      of.assign(averaging.nodes().size(), 1.);
      for (unsigned int I = 0; I < of.size(); ++I)
        {
          bool   all = true;
          double sum = 0;
          for (const auto &entry : averaging.nodes()[I].entries)
            {
              all = all && reach.of_point[entry.point] == 1.;
              sum += entry.weight * reach.of_point[entry.point];
            }
          if (!all) // otherwise one, without round-off
            of[I] = sum;
        }
    };
    set(geometry_.averaging, reach.of_node);
    set(geometry_.friction_averaging, reach.of_friction_node);
  }



  template <int dim>
  ClosestPoint<dim>
  ContactPair<dim>::find_start(const ContactSearch<dim>    &search,
                               const ContactPositions<dim> &positions,
                               const ProjectionStart<dim>  &accepted,
                               const unsigned int           q) const
  {
    const Point<dim> x          = geometry_.position(positions, q);
    auto             candidates = search.nearest(x, 3);
    if (accepted.known)
      candidates.push_back(accepted);

    // Of the candidates on the near side the closest one wins; a point
    // behind the body may look closer but belongs to the far side.
    ClosestPoint<dim> start, c;
    double            best = std::numeric_limits<double>::max();
    for (const auto &candidate : candidates)
      {
        project(geometry_.primaries[candidate.surface],
                positions.primaries[candidate.surface],
                x,
                candidate.u,
                false,
                c);
        if (!c.found)
          continue;
        const double distance = geometry_.is_deep(c) ?
                                  1e6 * (c.r.norm() + geometry_.thickness) :
                                  c.r.norm();
        // A later candidate must be better by more than round-off.
        if (distance < best * (1 - 1e-9))
          {
            best          = distance;
            start         = c;
            start.surface = candidate.surface;
          }
      }
    return start;
  }



  // ------------------------------------- where are the surfaces, and how far?

  template <int dim>
  ClosestPlace<dim>
  ContactPair<dim>::find_closest(const ContactView<dim> &view,
                                 const unsigned int      q) const
  {
    // Always from the start of the step: the answer must not depend on
    // the states tried before.
    const ProjectionStart<dim> &start = view.step.starts[q];
    ClosestPlace<dim>           closest =
      find_closest_place(geometry_.primaries[start.surface],
                         view.evaluation.positions.primaries[start.surface],
                         geometry_.position(view.evaluation.positions, q),
                         start.u);
    if (!closest.found)
      return search_anew(view, q);
    closest.surface = start.surface;
    try_neighbor(view, q, closest);
    return closest;
  }



  template <int dim>
  ClosestPlace<dim>
  ContactPair<dim>::search_anew(const ContactView<dim> &view,
                                const unsigned int      q) const
  {
    // The warm start failed: search anew among the positions of now.
    const auto      &primaries = view.evaluation.positions.primaries;
    const Point<dim> x = geometry_.position(view.evaluation.positions, q);
    const ContactSearch<dim> search(geometry_.primaries, primaries);
    for (const auto &candidate : search.nearest(x, 4))
      {
        ClosestPlace<dim> closest =
          find_closest_place(geometry_.primaries[candidate.surface],
                             primaries[candidate.surface],
                             x,
                             candidate.u);
        if (closest.found)
          {
            closest.surface = candidate.surface;
            return closest;
          }
      }
    return {};
  }



  template <int dim>
  void
  ContactPair<dim>::try_neighbor(const ContactView<dim> &view,
                                 const unsigned int      q,
                                 ClosestPlace<dim>      &closest) const
  {
    // At the end of a piece its neighbor on the strand may be closer.
    const ContactSurface<dim> &piece = geometry_.primaries[closest.surface];
    const int                  along = piece.along();
    if (closest.free[along])
      return;
    const auto        &breaks = piece.surface().knot_vector(along).breaks();
    const unsigned int side   = closest.u[along] >= breaks.back() ? 1 : 0;
    const int          next   = piece.neighbor(side);
    if (next < 0 || (side == 0 && closest.u[along] > breaks.front()))
      return;

    const auto &next_breaks =
      geometry_.primaries[next].surface().knot_vector(along).breaks();
    std::array<double, m> u = closest.u;
    u[along] = side == 1 ? next_breaks.front() : next_breaks.back();
    ClosestPlace<dim> other =
      find_closest_place(geometry_.primaries[next],
                         view.evaluation.positions.primaries[next],
                         geometry_.position(view.evaluation.positions, q),
                         u);
    if (other.found && other.distance < closest.distance * (1 - 1e-12))
      {
        closest         = other;
        closest.surface = next;
      }
  }



  template <int dim>
  void
  ContactPair<dim>::find_all_closest(const ContactView<dim>         &view,
                                     std::vector<ClosestPoint<dim>> &closest,
                                     const Ranks &ranks) const
  {
    const unsigned int             n_points = geometry_.points.size();
    std::vector<ClosestPlace<dim>> places(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      if (ranks.has(q))
        places[q] = find_closest(view, q);
    ranks.exchange(places);

    const SlipMeasure<dim> *slip = measure(view.step.friction_on);
    closest.resize(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        if (!places[q].found)
          throw_lost(q);
        const unsigned int surface = places[q].surface;
        compute_closest_point(geometry_.primaries[surface],
                              view.evaluation.positions.primaries[surface],
                              geometry_.position(view.evaluation.positions, q),
                              places[q],
                              slip != nullptr && slip->follows_closest_point(),
                              closest[q]);
      }
  }



  // ------------------------------------------------- what do the laws answer?

  template <int dim>
  void
  ContactPair<dim>::evaluate_node(const ContactView<dim> &view,
                                  const unsigned int      I,
                                  NodeState<dim>         &state) const
  {
    const ContactStep<dim> &step = view.step;
    state                        = NodeState<dim>();
    if (!(step.reach.of_node[I] > 0.)) // no partner: as open as can be told
      {
        state.gap = geometry_.thickness;
        return;
      }
    for (const auto &entry : geometry_.averaging.nodes()[I].entries)
      if (step.reach.has(entry.point))
        state.gap += step.reach.weight(I, entry) *
                     view.evaluation.closest[entry.point].gap;
    if (!step.gap_shift.empty())
      state.gap += step.gap_shift[I];
    auto normal =
      (*normal_law_)(state.gap, step.multiplier[I], step.penalty_scale);
    if (!normal.active)
      normal =
        (*normal_law_)(state.gap - round_off_of_gap * geometry_.thickness,
                       step.multiplier[I],
                       step.penalty_scale);
    state.active   = normal.active;
    state.pressure = normal.pressure;
    state.slope    = normal.slope;
    state.energy   = normal.energy;
  }



  template <int dim>
  void
  ContactPair<dim>::set_friction_pressures(
    ContactEvaluation<dim> &evaluation) const
  {
    evaluation.friction.assign(n_friction_nodes(), FrictionState<dim>());
    if (!evaluation.friction_on)
      return;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      if (evaluation.nodes[I].active)
        {
          const double pressure = -evaluation.nodes[I].pressure;
          if (!friction_at_points_)
            evaluation.friction[I].pressure = pressure;
          else // (A27): |p|_q = sum_I R^I_q |p|^I, with R = A_Iq W_I / w_q
            for (const auto &entry : geometry_.averaging.nodes()[I].entries)
              if (evaluation.reach.has(entry.point))
                evaluation.friction[entry.point].pressure +=
                  entry.weight * geometry_.averaging.nodes()[I].area /
                  geometry_.points[entry.point].area * pressure;
        }
  }



  template <int dim>
  void
  ContactPair<dim>::evaluate_friction(const ContactView<dim> &view,
                                      const unsigned int      J,
                                      FrictionState<dim>     &state) const
  {
    const ContactStep<dim>           &step = view.step;
    typename SlipMeasure<dim>::Metric metric;
    slip_measure_->evaluate_node(view, J, state.slip, metric);
    const double factor =
      step.friction_factor.empty() ? 1. : step.friction_factor[J];
    state.response = (*friction_law_)(step.traction_multiplier[J],
                                      state.slip,
                                      metric,
                                      factor * state.pressure,
                                      step.penalty_scale);
    for (double &derivative : state.response.by_pressure)
      derivative *= factor;
    state.law_pressure = factor * state.pressure;
    state.dissipation  = dissipation_of_step(step, J, metric, state);
  }



  template <int dim>
  double
  ContactPair<dim>::dissipation_of_step(
    const ContactStep<dim>                  &step,
    const unsigned int                       J,
    const typename SlipMeasure<dim>::Metric &metric,
    const FrictionState<dim>                &state) const
  {
    const double by_end = state.response.dissipation;
    if (!(by_end > 0.) || step.law_pressure.empty())
      return by_end;
    SurfaceMatrix<m> a;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        a[i][j] = metric[SymmetricIndices<m>::second(i, j)];
    const SurfaceMatrix<m> inverse = invert_symmetric<m>(a);
    const auto &t = state.response.traction, &t_n = step.traction_multiplier[J];
    double      t_square = 0, along = 0;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        {
          t_square += t[i] * inverse[i][j] * t[j];
          along += t_n[i] * inverse[i][j] * t[j];
        }
    // In stresses along the traction: limits before and now, what is left to
    // the limit before, and by what the stick predictor exceeds that of now.
    const double limit    = std::sqrt(t_square);
    const double limit_n  = limit * step.law_pressure[J] / state.law_pressure;
    const double to_limit = std::max(0., limit_n - along / limit);
    const double excess =
      step.penalty_scale * friction_law_->penalty() * by_end / limit;
    const double share = excess / (excess + to_limit);
    return by_end * (1. - 0.5 * share * (1. - limit_n / limit));
  }



  template <int dim>
  void
  ContactPair<dim>::load_points_by_pressure(
    const ContactStep<dim> &step,
    const unsigned int      I,
    ContactEvaluation<dim> &evaluation) const
  {
    const NodeState<dim> &state = evaluation.nodes[I];
    const double          W     = weight(step.reach, I);
    if (!state.active || !(W > 0.))
      return;
    for (const auto &entry : geometry_.averaging.nodes()[I].entries)
      if (step.reach.has(entry.point))
        {
          const double A                       = step.reach.weight(I, entry);
          evaluation.point_loaded[entry.point] = true;
          evaluation.point_pressure[entry.point] += W * A * state.pressure;
        }
  }



  template <int dim>
  void
  ContactPair<dim>::load_points_by_friction(
    const ContactStep<dim> &step,
    const unsigned int      J,
    ContactEvaluation<dim> &evaluation) const
  {
    const ContactView<dim>    view{geometry_, step, evaluation};
    const FrictionState<dim> &state = evaluation.friction[J];
    const double              W     = friction_weight(step.reach, J);
    if (!state.active() || !(W > 0.))
      return;
    // What acts must be what was averaged.
    for (const auto &entry : geometry_.friction_averaging.nodes()[J].entries)
      if (slip_measure_->has_slip(view, entry.point))
        {
          const double A = step.reach.friction_weight(J, entry);
          evaluation.point_loaded[entry.point] = true;
          for (int a = 0; a < m; ++a)
            evaluation.point_traction[entry.point][a] +=
              W * A * state.response.traction[a];
        }
  }



  template <int dim>
  void
  ContactPair<dim>::evaluate(const ContactStep<dim> &step,
                             const Vector<double>   &displacement,
                             ContactEvaluation<dim> &evaluation,
                             const Ranks            &ranks) const
  {
    const unsigned int n_points = geometry_.points.size();
    AssertDimension(step.starts.size(), n_points);
    AssertDimension(step.multiplier.size(), n_nodes());
    const SlipMeasure<dim> *slip_measure = measure(step.friction_on);
    const ContactView<dim>  view{geometry_, step, evaluation};
    evaluation.serial      = 0; // half a state if the projection throws
    evaluation.friction_on = step.friction_on;
    evaluation.reach       = step.reach;

    geometry_.update_positions(displacement, evaluation.positions);
    find_all_closest(view, evaluation.closest, ranks);
    evaluation.slip.resize(n_points);
    if (slip_measure != nullptr)
      for (unsigned int q = 0; q < n_points; ++q)
        slip_measure->evaluate_point(view, q, evaluation.slip[q]);

    evaluation.point_pressure.assign(n_points, 0.);
    evaluation.point_traction.assign(n_points, std::array<double, m>{});
    evaluation.point_loaded.assign(n_points, false);
    evaluation.nodes.resize(n_nodes());
    for (unsigned int I = 0; I < n_nodes(); ++I)
      {
        evaluate_node(view, I, evaluation.nodes[I]);
        load_points_by_pressure(step, I, evaluation);
      }
    set_friction_pressures(evaluation);
    if (slip_measure != nullptr)
      for (unsigned int J = 0; J < n_friction_nodes(); ++J)
        if (evaluation.friction[J].active())
          {
            evaluate_friction(view, J, evaluation.friction[J]);
            load_points_by_friction(step, J, evaluation);
          }
    evaluation.serial = step.serial;
  }



  // ---------------------------------------------------- augmented Lagrangian

  template <int dim>
  void
  ContactPair<dim>::augment(ContactStep<dim>             &step,
                            const ContactEvaluation<dim> &evaluation,
                            const double                  growth) const
  {
    assert_belongs(step, evaluation);
    step.penalty_scale *= growth;
    const Missing missing = missing_multipliers(step, evaluation);
    for (unsigned int I = 0; I < n_nodes(); ++I)
      step.multiplier[I] =
        std::min(0., step.multiplier[I] + missing.pressure[I]);
    for (unsigned int J = 0; J < n_friction_nodes(); ++J)
      for (unsigned int a = 0; a < m; ++a)
        step.traction_multiplier[J][a] += missing.traction[J][a];
    step.serial = new_serial();
  }



#define NPT_INSTANTIATE(dim)                                                 \
  template ContactStep<dim> ContactPair<dim>::begin_step(                    \
    const ContactState<dim> &, const Vector<double> &, const Ranks &) const; \
  template void ContactPair<dim>::evaluate(const ContactStep<dim> &,         \
                                           const Vector<double> &,           \
                                           ContactEvaluation<dim> &,         \
                                           const Ranks &) const;             \
  template void ContactPair<dim>::augment(ContactStep<dim> &,                \
                                          const ContactEvaluation<dim> &,    \
                                          const double) const;               \
  template std::vector<double> ContactPair<dim>::slip_path_after(            \
    const ContactStep<dim> &, const ContactEvaluation<dim> &) const;
  NPT_INSTANTIATE(2)
  NPT_INSTANTIATE(3)
#undef NPT_INSTANTIATE
} // namespace NPT
