// SPDX-License-Identifier: LGPL-2.1-or-later
// State of frictional contact: search, gaps, slip, laws at the nodes, history.
// Its virtual work is in contact_virtual_work.cc.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_assembler.h>
#include <npt_dealii/contact/contact_search.h>

#include <algorithm>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  template <int dim>
  ContactAssembler<dim>::ContactAssembler(
    const ContactSurface<dim>              &secondary,
    const std::vector<ContactSurface<dim>> &primaries,
    const ContactParameters                &contact,
    const FrictionParameters               &friction,
    const double                            maximum_penetration,
    const SymmetryWeight                   &symmetry_weight)
    : secondary_(secondary)
    , primaries_(primaries)
    , contact_(contact)
    , friction_law_{friction.coefficient, friction.tangential_penalty}
    , by_closest_point_(friction.slip_measure == "closest point")
    , maximum_penetration_(maximum_penetration)
    , points_(secondary.surface().quadrature(contact.n_quadrature_points))
    , averaging_(contact.method == "mortar" ?
                   Averaging::mortar<dim>(secondary.surface(), points_) :
                   Averaging::pointwise<dim>(points_))
  {
    const unsigned int n_nodes = averaging_.nodes().size();
    for (const auto &node : averaging_.nodes())
      symmetry_weight_.push_back(
        symmetry_weight ?
          symmetry_weight(contact.method == "mortar" ?
                            secondary.reference_position(node.label) :
                            points_[node.label].X) :
          1);
    history_.traction.assign(n_nodes, std::array<double, m>{});
    history_.multiplier.assign(n_nodes, 0.);
    traction_multiplier_ = history_.traction;
    multiplier_          = history_.multiplier;
    slip_points_.resize(points_.size());
    inverse_metric_.resize(n_nodes);
    history_.closest.resize(points_.size());
    starts_.resize(points_.size());
    closest_.resize(points_.size());
    nodes_.resize(n_nodes);
  }



  template <int dim>
  void
  ContactAssembler<dim>::set_friction(const bool on)
  {
    // Without friction nothing of the friction machinery is ever touched. The
    // history begins where friction begins; a stage that finds friction on
    // already goes on with it.
    const bool was_on = friction_on_;
    friction_on_      = on && friction_law_.coefficient > 0.;
    if (!friction_on_ || !was_on)
      history_.traction.assign(nodes_.size(), std::array<double, m>{});
    traction_multiplier_ = history_.traction;
  }



  template <int dim>
  bool
  ContactAssembler<dim>::is_admissible(const unsigned int q) const
  {
    return closest_[q].gap > -maximum_penetration_;
  }



  template <int dim>
  void
  ContactAssembler<dim>::start_step(const Vector<double> &accepted)
  {
    std::vector<Point<dim>> positions;
    secondary_.update_positions(accepted, positions);
    primary_positions_.resize(primaries_.size());
    for (unsigned int s = 0; s < primaries_.size(); ++s)
      primaries_[s].update_positions(accepted, primary_positions_[s]);
    const ContactSearch<dim> search(primaries_, primary_positions_);

    ClosestPoint<dim> c;
    for (unsigned int q = 0; q < points_.size(); ++q)
      {
        Point<dim>  x;
        const auto &shape = points_[q].shape;
        for (unsigned int l = 0; l < shape.lattice.size(); ++l)
          x += shape.value[l] * positions[shape.lattice[l]];

        // Of the candidates on the near side the closest one wins; a point
        // behind the body may look closer but belongs to the far side.
        double best      = std::numeric_limits<double>::max();
        starts_[q].known = false;
        auto candidates  = search.nearest(x, 3);
        if (history_.closest[q].known)
          candidates.push_back(history_.closest[q]);
        for (const auto &candidate : candidates)
          {
            project(primaries_[candidate.surface],
                    primary_positions_[candidate.surface],
                    x,
                    candidate.u,
                    false,
                    c);
            if (!c.found)
              continue;
            const double distance =
              c.r.norm() + (c.gap <= -maximum_penetration_ ? 1e6 : 0.);
            // A later candidate must be better by more than round-off.
            if (distance < best * (1 - 1e-9))
              {
                best               = distance;
                starts_[q].known   = true;
                starts_[q].surface = candidate.surface;
                starts_[q].u       = c.u;
              }
          }
        if (!starts_[q].known)
          throw ProjectionLost("contact point " + std::to_string(q) +
                               " finds no closest point on any surface");
      }
    multiplier_          = history_.multiplier;
    traction_multiplier_ = history_.traction;
    penalty_scale_       = history_.penalty_scale;
    if (friction_on_ && !by_closest_point_)
      set_slip_references(positions);
  }



  template <int dim>
  void
  ContactAssembler<dim>::set_slip_references(
    const std::vector<Point<dim>> &positions)
  {
    using Indices = SymmetricIndices<m>;
    for (unsigned int q = 0; q < points_.size(); ++q)
      {
        SlipPoint         &slip = slip_points_[q];
        const unsigned int s    = starts_[q].surface;
        slip.surface            = s;
        slip.start              = {};
        primaries_[s].surface().evaluate(starts_[q].u, 0, slip.shape);
        update_slip_point(positions, q, slip);
        slip.start = slip.sigma;
        // Points out of reach do not slide on anything. Their part fades, so
        // that no point enters or leaves the average at once.
        slip.weight =
          std::min(1., std::max(0., 2. - slip.d.norm() / maximum_penetration_));
      }
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        SurfaceMatrix<m> metric = {};
        for (const auto &entry : averaging_.nodes()[I].entries)
          for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b)
              metric[a][b] += entry.weight * (slip_points_[entry.point].tau[a] *
                                              slip_points_[entry.point].tau[b]);
        const auto inverse = invert_symmetric<m>(metric);
        for (int a = 0; a < m; ++a)
          for (int b = a; b < m; ++b)
            inverse_metric_[I][Indices::second(a, b)] = inverse[a][b];
      }
  }



  template <int dim>
  void
  ContactAssembler<dim>::update_slip_point(
    const std::vector<Point<dim>> &positions,
    const unsigned int             q,
    SlipPoint                     &slip) const
  {
    const auto &shape   = points_[q].shape;
    const auto &primary = primary_positions_[slip.surface];
    slip.d              = 0;
    slip.tau            = {};
    for (unsigned int l = 0; l < shape.lattice.size(); ++l)
      {
        const Point<dim> &x = positions[shape.lattice[l]];
        slip.d += shape.value[l] * x;
        for (int a = 0; a < m; ++a)
          slip.tau[a] += shape.first[a][l] * x;
      }
    for (unsigned int l = 0; l < slip.shape.lattice.size(); ++l)
      slip.d -= slip.shape.value[l] * primary[slip.shape.lattice[l]];
    for (int a = 0; a < m; ++a)
      slip.sigma[a] = slip.tau[a] * slip.d - slip.start[a];
  }



  template <int dim>
  void
  ContactAssembler<dim>::find_closest(const Point<dim>  &x,
                                      const unsigned int q,
                                      ClosestPoint<dim> &closest) const
  {
    const unsigned int s                 = starts_[q].surface;
    const bool         third_derivatives = friction_on_ && by_closest_point_;
    project(primaries_[s],
            primary_positions_[s],
            x,
            starts_[q].u,
            third_derivatives,
            closest);
    if (!closest.found)
      {
        // The warm start failed: search anew among the positions of now.
        const ContactSearch<dim> search(primaries_, primary_positions_);
        for (const auto &candidate : search.nearest(x, 4))
          {
            project(primaries_[candidate.surface],
                    primary_positions_[candidate.surface],
                    x,
                    candidate.u,
                    third_derivatives,
                    closest);
            if (closest.found)
              {
                closest.surface = candidate.surface;
                return;
              }
          }
        throw ProjectionLost("contact point " + std::to_string(q) +
                             " finds no closest point on any surface");
      }
    closest.surface = s;

    // At the end of a piece its neighbor on the strand may be closer.
    const int along = primaries_[s].along();
    if (!closest.free[along])
      {
        const auto &breaks =
          primaries_[s].surface().knot_vector(along).breaks();
        const unsigned int side = closest.u[along] >= breaks.back() ? 1 : 0;
        const int          next = primaries_[s].neighbor(side);
        if (next >= 0 && (side == 1 || closest.u[along] <= breaks.front()))
          {
            const auto &next_breaks =
              primaries_[next].surface().knot_vector(along).breaks();
            std::array<double, m> u = closest.u;
            u[along] = side == 1 ? next_breaks.front() : next_breaks.back();
            ClosestPoint<dim> other;
            project(primaries_[next],
                    primary_positions_[next],
                    x,
                    u,
                    third_derivatives,
                    other);
            if (other.found && other.r.norm() < closest.r.norm() * (1 - 1e-12))
              {
                closest         = other;
                closest.surface = next;
              }
          }
      }
  }



  template <int dim>
  void
  ContactAssembler<dim>::evaluate(const Vector<double> &displacement)
  {
    std::vector<Point<dim>> positions;
    secondary_.update_positions(displacement, positions);
    primary_positions_.resize(primaries_.size());
    for (unsigned int s = 0; s < primaries_.size(); ++s)
      primaries_[s].update_positions(displacement, primary_positions_[s]);

    // Where are the surfaces, and how far?
    for (unsigned int q = 0; q < points_.size(); ++q)
      {
        Point<dim>  x;
        const auto &shape = points_[q].shape;
        for (unsigned int l = 0; l < shape.lattice.size(); ++l)
          x += shape.value[l] * positions[shape.lattice[l]];
        // Always from the start of the step: the answer must not depend on
        // the states tried before.
        find_closest(x, q, closest_[q]);
        if (friction_on_ && !by_closest_point_)
          update_slip_point(positions, q, slip_points_[q]);
      }

    // What do the laws answer?
    const NormalLaw normal_law{penalty_scale_ * contact_.normal_penalty};
    const CoulombFriction<m> friction_law{friction_law_.coefficient,
                                          penalty_scale_ *
                                            friction_law_.penalty};
    point_pressure_.assign(points_.size(), 0.);
    point_traction_.assign(points_.size(), std::array<double, m>{});
    point_loaded_.assign(points_.size(), false);
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        const auto &node  = averaging_.nodes()[I];
        NodeState  &state = nodes_[I];
        state             = NodeState();
        for (const auto &entry : node.entries)
          state.gap += entry.weight * (is_admissible(entry.point) ?
                                         closest_[entry.point].gap :
                                         maximum_penetration_);
        const auto answer = normal_law(state.gap, multiplier_[I]);
        state.active      = answer.active;
        state.pressure    = answer.pressure;
        state.slope       = answer.slope;
        state.energy      = answer.energy;
        if (!state.active)
          continue;

        if (friction_on_ && !by_closest_point_)
          {
            for (const auto &entry : node.entries)
              for (int a = 0; a < m; ++a)
                state.slip[a] += entry.weight *
                                 slip_points_[entry.point].weight *
                                 slip_points_[entry.point].sigma[a];
            // The law in its dual form: sigma_a and t^a instead of xi^a and
            // t_a, with the inverse metric in the place of the metric.
            state.friction = friction_law(traction_multiplier_[I],
                                          state.slip,
                                          inverse_metric_[I],
                                          -state.pressure);
            state.slipping = state.friction.slipping;
          }
        else if (friction_on_)
          {
            std::array<double, SymmetricIndices<m>::n_second> metric = {};
            for (const auto &entry : node.entries)
              {
                if (!is_admissible(entry.point))
                  continue;
                const ClosestPoint<dim> &c = closest_[entry.point];
                for (int a = 0; a < m; ++a)
                  for (int b = a; b < m; ++b)
                    metric[SymmetricIndices<m>::second(a, b)] +=
                      entry.weight * (c.a[a] * c.a[b]);
                const auto &reference = history_.closest[entry.point];
                if (!reference.known)
                  continue;
                const auto &from = primaries_[reference.surface];
                const auto &to   = primaries_[c.surface];
                if (reference.surface != c.surface &&
                    (from.strand() < 0 || from.strand() != to.strand()))
                  continue;
                for (int a = 0; a < m; ++a)
                  state.slip[a] += entry.weight * (c.u[a] - reference.u[a]);
                state.slip[to.along()] +=
                  entry.weight * (to.shift() - from.shift());
              }
            state.friction = friction_law(traction_multiplier_[I],
                                          state.slip,
                                          metric,
                                          -state.pressure);
            state.slipping = state.friction.slipping;
          }

        const double W = symmetry_weight_[I] * node.area;
        if (W > 0.)
          for (const auto &entry : node.entries)
            if (is_admissible(entry.point))
              {
                point_loaded_[entry.point] = true;
                point_pressure_[entry.point] +=
                  W * entry.weight * state.pressure;
                for (int a = 0; a < m; ++a)
                  point_traction_[entry.point][a] +=
                    W * entry.weight * state.friction.traction[a];
              }
      }
  }



  template <int dim>
  std::vector<std::vector<unsigned int>>
  ContactAssembler<dim>::coupled_unknowns(const double margin) const
  {
    std::vector<std::vector<unsigned int>> groups;
    std::vector<unsigned int>              first;
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        if (symmetry_weight_[I] == 0 ||
            (!nodes_[I].active && nodes_[I].gap > margin))
          continue;
        first.clear();
        for (const auto &entry : averaging_.nodes()[I].entries)
          if (is_admissible(entry.point))
            {
              for (const unsigned int l : points_[entry.point].shape.lattice)
                first.push_back(secondary_.first_dof(l));
              const auto &c = closest_[entry.point];
              for (const unsigned int l : c.shape.lattice)
                first.push_back(primaries_[c.surface].first_dof(l));
              if (!friction_on_ || by_closest_point_)
                continue;
              const SlipPoint &slip = slip_points_[entry.point];
              for (const unsigned int l : slip.shape.lattice)
                first.push_back(primaries_[slip.surface].first_dof(l));
            }
        std::sort(first.begin(), first.end());
        first.erase(std::unique(first.begin(), first.end()), first.end());
        std::vector<unsigned int> group;
        for (const unsigned int dof : first)
          for (unsigned int i = 0; i < dim; ++i)
            group.push_back(dof + i);
        groups.push_back(group);
      }
    return groups;
  }



  template <int dim>
  void
  ContactAssembler<dim>::commit()
  {
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        history_.traction[I] = nodes_[I].friction.traction;
        if (contact_.augmented())
          history_.multiplier[I] = nodes_[I].pressure;
      }
    for (unsigned int q = 0; q < points_.size(); ++q)
      {
        history_.closest[q].known   = is_admissible(q);
        history_.closest[q].surface = closest_[q].surface;
        history_.closest[q].u       = closest_[q].u;
      }
    history_.penalty_scale = penalty_scale_;
  }



  template <int dim>
  typename ContactAssembler<dim>::Violation
  ContactAssembler<dim>::violation() const
  {
    Violation result;
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        const NodeState &state = nodes_[I];
        if (symmetry_weight_[I] == 0 || (!state.active && multiplier_[I] == 0.))
          continue;
        result.gap = std::max(result.gap,
                              std::abs(state.pressure - multiplier_[I]) /
                                (penalty_scale_ * contact_.normal_penalty));
        if (!friction_on_ || !state.active)
          continue;
        // |t - lambda|^2 = (t - lambda)_a a^{ab} (t - lambda)_b, where the
        // dual form has the roles of both metrics exchanged.
        SurfaceMatrix<m> metric = {};
        for (const auto &entry : averaging_.nodes()[I].entries)
          for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b)
              {
                const auto &tangents = by_closest_point_ ?
                                         closest_[entry.point].a :
                                         slip_points_[entry.point].tau;
                metric[a][b] += entry.weight * (tangents[a] * tangents[b]);
              }
        if (by_closest_point_)
          metric = invert_symmetric<m>(metric);
        double square = 0;
        for (int a = 0; a < m; ++a)
          for (int b = 0; b < m; ++b)
            square +=
              (state.friction.traction[a] - traction_multiplier_[I][a]) *
              metric[a][b] *
              (state.friction.traction[b] - traction_multiplier_[I][b]);
        result.slip = std::max(result.slip,
                               std::sqrt(std::max(0., square)) /
                                 (penalty_scale_ * friction_law_.penalty));
      }
    return result;
  }



  template <int dim>
  void
  ContactAssembler<dim>::augment(const double growth)
  {
    penalty_scale_ *= growth;
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        multiplier_[I]          = nodes_[I].pressure;
        traction_multiplier_[I] = nodes_[I].friction.traction;
      }
  }



  template <int dim>
  Tensor<1, dim>
  ContactAssembler<dim>::tangent_vector(const unsigned int           I,
                                        const std::array<double, m> &v,
                                        const bool covariant) const
  {
    std::array<Tensor<1, dim>, m> tangent;
    for (const auto &entry : averaging_.nodes()[I].entries)
      for (int a = 0; a < m; ++a)
        tangent[a] +=
          entry.weight * (by_closest_point_ ? closest_[entry.point].a[a] :
                                              slip_points_[entry.point].tau[a]);
    SurfaceMatrix<m> metric;
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        metric[a][b] = tangent[a] * tangent[b];
    const auto     inverse = invert_symmetric<m>(metric);
    Tensor<1, dim> result;
    for (int a = 0; a < m; ++a)
      for (int b = 0; b < m; ++b)
        result += (covariant ? inverse[a][b] :
                   a == b    ? 1. :
                               0.) *
                  v[b] * tangent[a];
    return result;
  }



  template <int dim>
  Tensor<1, dim>
  ContactAssembler<dim>::friction_traction(const unsigned int I) const
  {
    return friction_on_ ?
             tangent_vector(I, nodes_[I].friction.traction, by_closest_point_) :
             Tensor<1, dim>();
  }



  template <int dim>
  Tensor<1, dim>
  ContactAssembler<dim>::slip_increment(const unsigned int I) const
  {
    return friction_on_ ?
             tangent_vector(I, nodes_[I].slip, !by_closest_point_) :
             Tensor<1, dim>();
  }



  template <int dim>
  typename ContactAssembler<dim>::Summary
  ContactAssembler<dim>::summary() const
  {
    Summary result;
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        const NodeState   &state = nodes_[I];
        const unsigned int k     = symmetry_weight_[I];
        const double       W     = k * averaging_.nodes()[I].area;
        result.energy += W * state.energy;
        if (!state.active)
          continue;
        result.n_active += k;
        result.largest_penetration =
          std::max(result.largest_penetration, -state.gap);
        if (friction_on_)
          {
            (state.slipping ? result.n_slip : result.n_stick) += k;
            result.friction_energy += W * state.friction.energy;
            result.dissipation += W * state.friction.dissipation;
          }
      }
    return result;
  }

  template class ContactAssembler<2>;
  template class ContactAssembler<3>;
} // namespace NPT
