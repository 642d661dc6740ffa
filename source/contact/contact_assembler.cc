// SPDX-License-Identifier: LGPL-2.1-or-later
// Virtual work of frictional contact and its consistent linearization.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/contact/contact_assembler.h>
#include <npt_dealii/contact/contact_search.h>

#include <algorithm>
#include <map>
#include <memory>

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
    const Multiplicity                     &multiplicity)
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
      multiplicity_.push_back(
        multiplicity ? multiplicity(contact.method == "mortar" ?
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
  ContactAssembler<dim>::usable(const unsigned int q) const
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
  ContactAssembler<dim>::slip_row(const unsigned int    q,
                                  const int             a,
                                  const PointFunctions &functions,
                                  std::vector<double>  &row) const
  {
    const SlipPoint &slip  = slip_points_[q];
    const auto      &shape = points_[q].shape;
    row.assign(dim * functions.dofs.size(), 0.);
    for (unsigned int l = 0; l < shape.lattice.size(); ++l)
      for (unsigned int i = 0; i < dim; ++i)
        row[dim * l + i] += slip.weight * (shape.value[l] * slip.tau[a][i] +
                                           shape.first[a][l] * slip.d[i]);
    for (unsigned int l = 0; l < slip.shape.lattice.size(); ++l)
      for (unsigned int i = 0; i < dim; ++i)
        row[dim * functions.reference[l] + i] -=
          slip.weight * slip.shape.value[l] * slip.tau[a][i];
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
    const NormalLaw      normal_law{penalty_scale_ * contact_.normal_penalty};
    const FrictionLaw<m> friction_law{friction_law_.coefficient,
                                      penalty_scale_ * friction_law_.penalty};
    point_pressure_.assign(points_.size(), 0.);
    point_traction_.assign(points_.size(), std::array<double, m>{});
    point_loaded_.assign(points_.size(), false);
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        const auto &node  = averaging_.nodes()[I];
        NodeState  &state = nodes_[I];
        state             = NodeState();
        for (const auto &entry : node.entries)
          state.gap +=
            entry.weight * (usable(entry.point) ? closest_[entry.point].gap :
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
                if (!usable(entry.point))
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

        const double W = multiplicity_[I] * node.area;
        if (W > 0.)
          for (const auto &entry : node.entries)
            if (usable(entry.point))
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
  void
  ContactAssembler<dim>::point_functions(const unsigned int q,
                                         PointFunctions    &functions) const
  {
    const auto              &s       = points_[q].shape;
    const ClosestPoint<dim> &c       = closest_[q];
    const auto              &primary = primaries_[c.surface];
    const unsigned int n_s = s.lattice.size(), n_m = c.shape.lattice.size();

    functions.dofs.resize(n_s + n_m);
    functions.reference.clear();
    for (auto &values : functions.jet)
      values.assign(n_s + n_m, 0.);
    for (unsigned int l = 0; l < n_s; ++l)
      {
        functions.dofs[l]   = secondary_.first_dof(s.lattice[l]);
        functions.jet[0][l] = s.value[l];
      }
    for (unsigned int l = 0; l < n_m; ++l)
      {
        functions.dofs[n_s + l]   = primary.first_dof(c.shape.lattice[l]);
        functions.jet[0][n_s + l] = -c.shape.value[l];
        unsigned int f            = 1;
        for (const auto &first : c.shape.first)
          functions.jet[f++][n_s + l] = first[l];
        for (const auto &second : c.shape.second)
          functions.jet[f++][n_s + l] = second[l];
      }

    if (!friction_on_ || by_closest_point_)
      return;
    const SlipPoint &slip = slip_points_[q];
    if (slip.surface == c.surface && slip.shape.lattice == c.shape.lattice)
      for (unsigned int l = 0; l < n_m; ++l)
        functions.reference.push_back(n_s + l);
    else
      for (const unsigned int l : slip.shape.lattice)
        {
          functions.reference.push_back(functions.dofs.size());
          functions.dofs.push_back(primaries_[slip.surface].first_dof(l));
          for (auto &values : functions.jet)
            values.push_back(0.);
        }
  }



  template <int dim>
  void
  ContactAssembler<dim>::add_residual(Vector<double> &residual) const
  {
    constexpr unsigned int n_jets = ContactKinematics<dim>::n_jets;
    PointFunctions         functions;
    std::vector<double>    slip;
    for (unsigned int q = 0; q < points_.size(); ++q)
      {
        if (!point_loaded_[q])
          continue;
        const ContactKinematics<dim> kinematics(closest_[q]);
        auto                         row = kinematics.gap_variation();
        for (double &value : row)
          value *= point_pressure_[q];
        if (friction_on_ && by_closest_point_)
          for (int a = 0; a < m; ++a)
            for (unsigned int k = 0; k < row.size(); ++k)
              row[k] +=
                point_traction_[q][a] * kinematics.parameter_variation(a)[k];

        point_functions(q, functions);
        if (friction_on_ && !by_closest_point_)
          for (int a = 0; a < m; ++a)
            {
              slip_row(q, a, functions, slip);
              for (unsigned int A = 0; A < functions.dofs.size(); ++A)
                for (unsigned int i = 0; i < dim; ++i)
                  residual[functions.dofs[A] + i] +=
                    point_traction_[q][a] * slip[dim * A + i];
            }
        for (unsigned int A = 0; A < functions.dofs.size(); ++A)
          for (unsigned int f = 0; f < n_jets; ++f)
            if (functions.jet[f][A] != 0.)
              for (unsigned int i = 0; i < dim; ++i)
                residual[functions.dofs[A] + i] +=
                  functions.jet[f][A] * row[f * dim + i];
      }
  }



  template <int dim>
  void
  ContactAssembler<dim>::add_tangent(const AddMatrix &add) const
  {
    using Kinematics                  = ContactKinematics<dim>;
    constexpr unsigned int n_jets     = Kinematics::n_jets;
    constexpr unsigned int n_rows     = 1 + m + Kinematics::n_metric;
    const bool             parameters = friction_on_ && by_closest_point_;
    const bool             relative   = friction_on_ && !by_closest_point_;
    const unsigned int     n_used = parameters ? n_rows : relative ? 1 + m : 1;
    const bool             mortar = contact_.method == "mortar";

    // Variations at the loaded points, carried to the control points. Row 0
    // is the gap, then the parameters, then the metric.
    struct PointRows
    {
      std::vector<unsigned int>               dofs;
      std::array<std::vector<double>, n_rows> rows;
    };
    std::vector<PointRows> point_rows(mortar ? points_.size() : 0);

    // 1. Terms that belong to single points: pressure and traction times the
    // second variations. Points that share their functions share a block; the
    // first and the last one tell which these are.
    std::map<std::array<unsigned int, 7>, std::vector<unsigned int>> groups;
    for (unsigned int q = 0; q < points_.size(); ++q)
      if (point_loaded_[q])
        groups[{{points_[q].shape.lattice[0],
                 closest_[q].surface,
                 closest_[q].shape.lattice.front(),
                 closest_[q].shape.lattice.back(),
                 relative ? slip_points_[q].surface : 0,
                 relative ? slip_points_[q].shape.lattice.front() : 0,
                 relative ? slip_points_[q].shape.lattice.back() : 0}}]
          .push_back(q);

    PointFunctions                                    functions;
    std::array<double, Kinematics::n * Kinematics::n> M;
    std::vector<double>                               block, half;
    std::vector<unsigned int>                         dofs;
    for (const auto &group : groups)
      {
        block.clear();
        for (const unsigned int q : group.second)
          {
            const Kinematics kinematics(closest_[q]);
            point_functions(q, functions);
            const unsigned int n_functions = functions.dofs.size();
            const unsigned int n           = dim * n_functions;
            if (block.empty())
              {
                block.assign(n * n, 0.);
                dofs.resize(n);
                for (unsigned int A = 0; A < n_functions; ++A)
                  for (unsigned int i = 0; i < dim; ++i)
                    dofs[A * dim + i] = functions.dofs[A] + i;
              }

            M.fill(0.);
            kinematics.add_second_variation(point_pressure_[q],
                                            parameters ?
                                              point_traction_[q] :
                                              std::array<double, m>{},
                                            M);
            if (relative)
              {
                // t^a D(delta sigma_a), with the same factor for each
                // component: t^a (delta tau_a . D d + D tau_a . delta d).
                const SlipPoint    &slip  = slip_points_[q];
                const auto         &shape = points_[q].shape;
                const unsigned int  n_s   = shape.lattice.size();
                std::vector<double> turn(n_s, 0.), move(n_functions, 0.);
                for (unsigned int A = 0; A < n_s; ++A)
                  {
                    for (int a = 0; a < m; ++a)
                      turn[A] +=
                        slip.weight * point_traction_[q][a] * shape.first[a][A];
                    move[A] = shape.value[A];
                  }
                for (unsigned int l = 0; l < slip.shape.lattice.size(); ++l)
                  move[functions.reference[l]] -= slip.shape.value[l];
                for (unsigned int A = 0; A < n_s; ++A)
                  for (unsigned int B = 0; B < n_functions; ++B)
                    for (unsigned int i = 0; i < dim; ++i)
                      {
                        const double value = turn[A] * move[B];
                        block[(A * dim + i) * n + B * dim + i] += value;
                        block[(B * dim + i) * n + A * dim + i] += value;
                      }
              }
            const auto row_of = [&](const unsigned int r) -> const auto &
            {
              return r == 0 ? kinematics.gap_variation() :
                     r <= m ? kinematics.parameter_variation(r - 1) :
                              kinematics.metric_variation(r - 1 - m);
            };
            if (mortar)
              {
                PointRows &rows = point_rows[q];
                rows.dofs       = functions.dofs;
                for (unsigned int r = 0; r < n_used; ++r)
                  {
                    if (relative && r > 0)
                      {
                        slip_row(q, r - 1, functions, rows.rows[r]);
                        continue;
                      }
                    const auto &jets = row_of(r);
                    rows.rows[r].assign(n, 0.);
                    for (unsigned int f = 0; f < n_jets; ++f)
                      for (unsigned int A = 0; A < n_functions; ++A)
                        if (functions.jet[f][A] != 0.)
                          for (unsigned int i = 0; i < dim; ++i)
                            rows.rows[r][A * dim + i] +=
                              functions.jet[f][A] * jets[f * dim + i];
                  }
              }
            else
              {
                // A node that is a single point: everything stays on the jets.
                const NodeState &state = nodes_[q];
                const double W = multiplicity_[q] * averaging_.nodes()[q].area;
                const auto  &g = kinematics.gap_variation();
                for (unsigned int k = 0; k < g.size(); ++k)
                  for (unsigned int l = 0; l < g.size(); ++l)
                    M[k * g.size() + l] += W * state.slope * g[k] * g[l];
                if (relative)
                  {
                    std::vector<double> gap(n, 0.), right(n);
                    for (unsigned int f = 0; f < n_jets; ++f)
                      for (unsigned int A = 0; A < n_functions; ++A)
                        if (functions.jet[f][A] != 0.)
                          for (unsigned int i = 0; i < dim; ++i)
                            gap[A * dim + i] +=
                              functions.jet[f][A] * g[f * dim + i];
                    std::array<std::vector<double>, m> slip;
                    for (int a = 0; a < m; ++a)
                      slip_row(q, a, functions, slip[a]);
                    for (int a = 0; a < m; ++a)
                      {
                        for (unsigned int k = 0; k < n; ++k)
                          {
                            right[k] = -state.friction.by_pressure[a] *
                                       state.slope * gap[k];
                            for (int b = 0; b < m; ++b)
                              right[k] +=
                                state.friction.by_slip[a][b] * slip[b][k];
                          }
                        for (unsigned int k = 0; k < n; ++k)
                          for (unsigned int l = 0; l < n; ++l)
                            block[k * n + l] += W * slip[a][k] * right[l];
                      }
                  }
                if (parameters)
                  for (int a = 0; a < m; ++a)
                    {
                      typename Kinematics::Row right;
                      for (unsigned int k = 0; k < g.size(); ++k)
                        {
                          right[k] =
                            -state.friction.by_pressure[a] * state.slope * g[k];
                          for (int b = 0; b < m; ++b)
                            right[k] +=
                              state.friction.by_slip[a][b] * row_of(1 + b)[k];
                          for (unsigned int c = 0; c < Kinematics::n_metric;
                               ++c)
                            right[k] += state.friction.by_metric[a][c] *
                                        row_of(1 + m + c)[k];
                        }
                      const auto &left = row_of(1 + a);
                      for (unsigned int k = 0; k < g.size(); ++k)
                        for (unsigned int l = 0; l < g.size(); ++l)
                          M[k * g.size() + l] += W * left[k] * right[l];
                    }
              }

            // block += N^T M N with N the jet values of the functions. Second
            // variations meet J_ab only where a traction acts on xi, and
            // beside edges.
            const unsigned int n_used_jets =
              parameters || closest_[q].edge_radius > 0. ? n_jets : 1 + m;
            half.assign(Kinematics::n * n, 0.);
            for (unsigned int k = 0; k < dim * n_used_jets; ++k)
              for (unsigned int h = 0; h < n_used_jets; ++h)
                for (unsigned int B = 0; B < n_functions; ++B)
                  {
                    const double N = functions.jet[h][B];
                    if (N != 0.)
                      for (unsigned int j = 0; j < dim; ++j)
                        half[k * n + B * dim + j] +=
                          M[k * Kinematics::n + h * dim + j] * N;
                  }
            for (unsigned int f = 0; f < n_used_jets; ++f)
              for (unsigned int A = 0; A < n_functions; ++A)
                {
                  const double N = functions.jet[f][A];
                  if (N != 0.)
                    for (unsigned int i = 0; i < dim; ++i)
                      {
                        const double *source = &half[(f * dim + i) * n];
                        double       *target = &block[(A * dim + i) * n];
                        for (unsigned int l = 0; l < n; ++l)
                          target[l] += N * source[l];
                      }
                }
          }
        add(dofs, block);
      }
    if (!mortar)
      return;

    // 2. Terms that couple all points of a node: products of the averaged
    // first variations.
    // Position of each first unknown in the block of a node; a flat table,
    // since it is read for every function of every point.
    constexpr unsigned int no_slot = dealii::numbers::invalid_unsigned_int;
    unsigned int           n_table = 0;
    for (const PointRows &rows : point_rows)
      for (const unsigned int dof : rows.dofs)
        n_table = std::max(n_table, dof + 1);
    std::vector<unsigned int>               slot(n_table, no_slot);
    std::array<std::vector<double>, n_rows> average;
    std::array<std::vector<double>, 1 + m>  right;
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        const NodeState &state = nodes_[I];
        const auto      &node  = averaging_.nodes()[I];
        const double     W     = multiplicity_[I] * node.area;
        if (!state.active || W == 0.)
          continue;

        std::fill(slot.begin(), slot.end(), no_slot);
        dofs.clear();
        for (const auto &entry : node.entries)
          if (usable(entry.point))
            for (const unsigned int dof : point_rows[entry.point].dofs)
              if (slot[dof] == no_slot)
                {
                  slot[dof] = dofs.size();
                  for (unsigned int i = 0; i < dim; ++i)
                    dofs.push_back(dof + i);
                }
        const unsigned int n = dofs.size();

        for (unsigned int r = 0; r < n_used; ++r)
          average[r].assign(n, 0.);
        for (const auto &entry : node.entries)
          if (usable(entry.point))
            {
              const PointRows &rows = point_rows[entry.point];
              for (unsigned int A = 0; A < rows.dofs.size(); ++A)
                {
                  const unsigned int at = slot[rows.dofs[A]];
                  for (unsigned int r = 0; r < n_used; ++r)
                    for (unsigned int i = 0; i < dim; ++i)
                      average[r][at + i] +=
                        entry.weight * rows.rows[r][A * dim + i];
                }
            }

        right[0] = average[0];
        for (double &value : right[0])
          value *= W * state.slope;
        if (friction_on_)
          for (int a = 0; a < m; ++a)
            {
              right[1 + a].assign(n, 0.);
              for (unsigned int k = 0; k < n; ++k)
                {
                  double value = -state.friction.by_pressure[a] * state.slope *
                                 average[0][k];
                  for (int b = 0; b < m; ++b)
                    value += state.friction.by_slip[a][b] * average[1 + b][k];
                  if (parameters)
                    for (unsigned int c = 0; c < Kinematics::n_metric; ++c)
                      value +=
                        state.friction.by_metric[a][c] * average[1 + m + c][k];
                  right[1 + a][k] = W * value;
                }
            }

        block.resize(n * n);
        for (unsigned int k = 0; k < n; ++k)
          {
            double      *target = &block[k * n];
            const double left   = average[0][k];
            for (unsigned int l = 0; l < n; ++l)
              target[l] = left * right[0][l];
            if (friction_on_)
              for (int a = 0; a < m; ++a)
                {
                  const double left_a = average[1 + a][k];
                  for (unsigned int l = 0; l < n; ++l)
                    target[l] += left_a * right[1 + a][l];
                }
          }
        add(dofs, block);
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
        if (multiplicity_[I] == 0 ||
            (!nodes_[I].active && nodes_[I].gap > margin))
          continue;
        first.clear();
        for (const auto &entry : averaging_.nodes()[I].entries)
          if (usable(entry.point))
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
        history_.closest[q].known   = usable(q);
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
        if (multiplicity_[I] == 0 || (!state.active && multiplier_[I] == 0.))
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
        const unsigned int k     = multiplicity_[I];
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
