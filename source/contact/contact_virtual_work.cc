// SPDX-License-Identifier: LGPL-2.1-or-later
// Virtual work of a contact pair and its consistent linearization.

#include <npt_dealii/contact/contact_pair.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    // All components of the unknowns that begin here.
    template <int dim>
    std::vector<unsigned int>
    all_components(const std::vector<unsigned int> &first_dofs)
    {
      std::vector<unsigned int> dofs;
      for (const unsigned int dof : first_dofs)
        for (unsigned int i = 0; i < dim; ++i)
          dofs.push_back(dof + i);
      return dofs;
    }
  } // namespace



  template <int dim>
  void
  ContactPair<dim>::point_functions(const ContactView<dim> &view,
                                    const unsigned int      q,
                                    PointFunctions<dim>    &functions) const
  {
    const auto              &s       = geometry_.points[q].shape;
    const ClosestPoint<dim> &c       = view.evaluation.closest[q];
    const auto              &primary = geometry_.primaries[c.surface];
    const unsigned int n_s = s.lattice.size(), n_m = c.shape.lattice.size();

    functions.dofs.resize(n_s + n_m);
    functions.reference.clear();
    for (auto &values : functions.jet)
      values.assign(n_s + n_m, 0.);
    for (unsigned int l = 0; l < n_s; ++l)
      {
        functions.dofs[l]   = geometry_.secondary.first_dof(s.lattice[l]);
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

    const SlipMeasure<dim>   *slip_measure = measure(view.step.friction_on);
    const SlipReference<dim> *reference =
      slip_measure == nullptr ? nullptr :
                                slip_measure->acting_reference(view.step, q);
    if (reference == nullptr)
      return;
    if (reference->surface == c.surface &&
        reference->shape.lattice == c.shape.lattice)
      for (unsigned int l = 0; l < n_m; ++l)
        functions.reference.push_back(n_s + l);
    else
      for (const unsigned int l : reference->shape.lattice)
        {
          functions.reference.push_back(functions.dofs.size());
          functions.dofs.push_back(
            geometry_.primaries[reference->surface].first_dof(l));
          for (auto &values : functions.jet)
            values.push_back(0.);
        }
  }



  template <int dim>
  void
  ContactPair<dim>::add_residual(const ContactStep<dim>       &step,
                                 const ContactEvaluation<dim> &evaluation,
                                 Vector<double>               &residual) const
  {
    assert_belongs(step, evaluation);
    constexpr unsigned int  n_jets = ContactKinematics<dim>::n_jets;
    const ContactView<dim>  view{geometry_, step, evaluation};
    const SlipMeasure<dim> *slip_measure = measure(step.friction_on);
    PointFunctions<dim>     functions;
    for (unsigned int q = 0; q < geometry_.points.size(); ++q)
      {
        if (!evaluation.point_loaded[q])
          continue;
        const ContactKinematics<dim> kinematics(evaluation.closest[q]);
        auto                         row = kinematics.gap_variation();
        for (double &value : row)
          value *= evaluation.point_pressure[q];

        point_functions(view, q, functions);
        if (slip_measure != nullptr)
          slip_measure->add_virtual_work(
            view, q, kinematics, functions, row, residual);
        for (unsigned int A = 0; A < functions.dofs.size(); ++A)
          for (unsigned int f = 0; f < n_jets; ++f)
            if (functions.jet[f][A] != 0.)
              for (unsigned int i = 0; i < dim; ++i)
                residual[functions.dofs[A] + i] +=
                  functions.jet[f][A] * row[f * dim + i];
      }
  }



  template <int dim>
  unsigned int
  ContactPair<dim>::n_variations(const ContactView<dim> &view) const
  {
    const SlipMeasure<dim> *slip_measure = measure(view.step.friction_on);
    return slip_measure == nullptr ? 1 :
                                     1 + m + slip_measure->n_varying_metrics();
  }



  template <int dim>
  void
  ContactPair<dim>::point_variations(const ContactView<dim>       &view,
                                     const unsigned int            q,
                                     const ContactKinematics<dim> &kinematics,
                                     const PointFunctions<dim>    &functions,
                                     Variations<dim> &variations) const
  {
    variations.dofs = functions.dofs;
    jets_to_functions<dim>(kinematics.gap_variation(),
                           functions,
                           variations.rows[0]);
    if (const SlipMeasure<dim> *slip_measure = measure(view.step.friction_on))
      slip_measure->first_variations(
        view, q, kinematics, functions, variations.rows);
  }



  template <int dim>
  void
  ContactPair<dim>::add_second_variations(
    const ContactView<dim>       &view,
    const unsigned int            q,
    const ContactKinematics<dim> &kinematics,
    const PointFunctions<dim>    &functions,
    std::vector<double>          &block) const
  {
    using Kinematics                           = ContactKinematics<dim>;
    const ContactEvaluation<dim> &state        = view.evaluation;
    const SlipMeasure<dim>       *slip_measure = measure(view.step.friction_on);
    const bool                    traction_in_jets =
      slip_measure != nullptr && slip_measure->follows_closest_point();
    const unsigned int n_f = functions.dofs.size();
    const unsigned int n   = dim * n_f;

    std::array<double, Kinematics::n * Kinematics::n> M;
    M.fill(0.);
    kinematics.add_second_variation(state.point_pressure[q],
                                    traction_in_jets ? state.point_traction[q] :
                                                       std::array<double, m>{},
                                    M);
    if (slip_measure != nullptr)
      slip_measure->add_second_variation(view, q, functions, block);

    // block += N^T M N with N the jet values of the functions. Second
    // variations meet J_ab only where a traction acts on xi, and beside edges.
    const unsigned int n_used_jets =
      traction_in_jets || state.closest[q].edge_radius > 0. ?
        Kinematics::n_jets :
        1 + m;
    std::vector<double> half(Kinematics::n * n, 0.);
    for (unsigned int k = 0; k < dim * n_used_jets; ++k)
      for (unsigned int h = 0; h < n_used_jets; ++h)
        for (unsigned int B = 0; B < n_f; ++B)
          {
            const double N = functions.jet[h][B];
            if (N != 0.)
              for (unsigned int j = 0; j < dim; ++j)
                half[k * n + B * dim + j] +=
                  M[k * Kinematics::n + h * dim + j] * N;
          }
    for (unsigned int f = 0; f < n_used_jets; ++f)
      for (unsigned int A = 0; A < n_f; ++A)
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



  namespace
  {
    // block += factor left (x) right
    void
    add_product(const double               factor,
                const std::vector<double> &left,
                const std::vector<double> &right,
                std::vector<double>       &block)
    {
      const unsigned int n = right.size();
      for (unsigned int k = 0; k < n; ++k)
        {
          double      *target = &block[k * n];
          const double scale  = factor * left[k];
          for (unsigned int l = 0; l < n; ++l)
            target[l] += scale * right[l];
        }
    }
  } // namespace



  template <int dim>
  void
  ContactPair<dim>::add_normal_product(const ContactView<dim>    &view,
                                       const unsigned int         I,
                                       const std::vector<double> &gap_row,
                                       std::vector<double>       &block) const
  {
    add_product(weight(view.step.reach, I) * view.evaluation.nodes[I].slope,
                gap_row,
                gap_row,
                block);
  }



  template <int dim>
  void
  ContactPair<dim>::add_friction_products(const ContactView<dim> &view,
                                          const unsigned int      J,
                                          const Variations<dim>  &variations,
                                          std::vector<double>    &block) const
  {
    const SlipMeasure<dim>    *slip_measure = measure(view.step.friction_on);
    const FrictionState<dim>  &state        = view.evaluation.friction[J];
    const FrictionResponse<m> &friction     = state.response;
    const auto                &rows         = variations.rows;
    const unsigned int         n            = rows[0].size();
    const unsigned int         n_metrics    = slip_measure->n_varying_metrics();
    std::vector<double>        right(n);
    for (int a = 0; a < m; ++a)
      {
        // |p| = -p falls where p rises. Pressure of a Gauss point comes from
        // several contact nodes: see average_friction_by_pressure().
        const double by_gap =
          friction_at_points_ ?
            0. :
            -friction.by_pressure[a] * view.evaluation.nodes[J].slope;
        for (unsigned int k = 0; k < n; ++k)
          {
            right[k] = by_gap * rows[0][k];
            for (int b = 0; b < m; ++b)
              right[k] += friction.by_slip[a][b] * rows[1 + b][k];
            for (unsigned int c = 0; c < n_metrics; ++c)
              right[k] += friction.by_metric[a][c] * rows[1 + m + c][k];
          }
        add_product(friction_weight(view.step.reach, J),
                    rows[1 + a],
                    right,
                    block);
      }
  }



  template <int dim>
  void
  ContactPair<dim>::average_friction_by_pressure(
    const ContactView<dim>             &view,
    const unsigned int                  I,
    const std::vector<Variations<dim>> &of_points,
    const std::vector<unsigned int>    &slot,
    std::vector<double>                &row) const
  {
    // sum_q W_q R^I_q (dt_a/d|p|)_q delta s^a_q
    const auto &node = geometry_.averaging.nodes()[I];
    for (const auto &entry : node.entries)
      {
        const unsigned int        q     = entry.point;
        const FrictionState<dim> &state = view.evaluation.friction[q];
        const double              share = friction_weight(view.step.reach, q) /
                             geometry_.points[q].area * entry.weight *
                             node.area;
        if (!state.active() || share == 0.)
          continue;
        const Variations<dim> &point = of_points[q];
        for (int a = 0; a < m; ++a)
          {
            const double factor = share * state.response.by_pressure[a];
            for (unsigned int A = 0; A < point.dofs.size(); ++A)
              for (unsigned int i = 0; i < dim; ++i)
                row[slot[point.dofs[A]] + i] +=
                  factor * point.rows[1 + a][A * dim + i];
          }
      }
  }



  template <int dim>
  void
  ContactPair<dim>::average_variations(
    const ContactView<dim>             &view,
    const unsigned int                  I,
    const std::vector<Variations<dim>> &of_points,
    std::vector<unsigned int>          &slot,
    Variations<dim>                    &average) const
  {
    const auto         &entries = geometry_.averaging.nodes()[I].entries;
    const ContactReach &reach   = view.step.reach;
    average.dofs.clear();
    for (const auto &entry : entries)
      if (reach.has(entry.point))
        for (const unsigned int dof : of_points[entry.point].dofs)
          {
            if (dof >= slot.size())
              slot.resize(dof + 1, dealii::numbers::invalid_unsigned_int);
            if (slot[dof] == dealii::numbers::invalid_unsigned_int)
              {
                slot[dof] = dim * average.dofs.size();
                average.dofs.push_back(dof);
              }
          }

    // Row 1 and on: the slip, or what pressure does to the friction of points.
    const bool         friction_at_points = at_points(view);
    const unsigned int n_rows = friction_at_points ? 1 : n_variations(view);
    for (unsigned int r = 0; r < n_rows; ++r)
      average.rows[r].assign(dim * average.dofs.size(), 0.);
    for (const auto &entry : entries)
      if (reach.has(entry.point))
        {
          const Variations<dim> &point  = of_points[entry.point];
          const double           weight = reach.weight(I, entry);
          for (unsigned int A = 0; A < point.dofs.size(); ++A)
            for (unsigned int r = 0; r < n_rows; ++r)
              for (unsigned int i = 0; i < dim; ++i)
                average.rows[r][slot[point.dofs[A]] + i] +=
                  weight * point.rows[r][A * dim + i];
        }
    if (friction_at_points)
      {
        average.rows[1].assign(dim * average.dofs.size(), 0.);
        average_friction_by_pressure(view, I, of_points, slot, average.rows[1]);
      }
    for (const unsigned int dof : average.dofs)
      slot[dof] = dealii::numbers::invalid_unsigned_int;
  }



  template <int dim>
  std::vector<std::vector<unsigned int>>
  ContactPair<dim>::groups_of_points(const ContactView<dim> &view) const
  {
    // The first and the last function tell which functions a point has.
    const SlipMeasure<dim> *slip_measure = measure(view.step.friction_on);
    std::map<std::array<unsigned int, 7>, std::vector<unsigned int>> groups;
    for (unsigned int q = 0; q < geometry_.points.size(); ++q)
      if (view.evaluation.point_loaded[q])
        {
          const ClosestPoint<dim>  &c = view.evaluation.closest[q];
          const SlipReference<dim> *reference =
            slip_measure == nullptr ?
              nullptr :
              slip_measure->acting_reference(view.step, q);
          groups[{{geometry_.points[q].shape.lattice[0],
                   c.surface,
                   c.shape.lattice.front(),
                   c.shape.lattice.back(),
                   reference ? reference->surface : 0,
                   reference ? reference->shape.lattice.front() : 0,
                   reference ? reference->shape.lattice.back() : 0}}]
            .push_back(q);
        }
    std::vector<std::vector<unsigned int>> result;
    for (auto &group : groups)
      result.push_back(std::move(group.second));
    return result;
  }



  template <int dim>
  std::vector<unsigned int>
  ContactPair<dim>::own_averages(const ContactView<dim> &view,
                                 const Ranks            &ranks) const
  {
    std::vector<unsigned int> nodes;
    if (!nodes_are_points_)
      for (unsigned int I = 0; I < n_nodes(); ++I)
        if (view.evaluation.nodes[I].active &&
            view.step.reach.of_node[I] > 0. && acts(I, view.step.friction_on))
          nodes.push_back(I);
    const auto [begin, end] = ranks.share_of(nodes.size());
    return {nodes.begin() + begin, nodes.begin() + end};
  }



  template <int dim>
  void
  ContactPair<dim>::add_tangent_of_points(
    const ContactView<dim>       &view,
    const std::vector<bool>      &averaged,
    std::vector<Variations<dim>> &of_points,
    const AddMatrix              &add,
    const Ranks                  &ranks) const
  {
    PointFunctions<dim> functions;
    std::vector<double> block;
    const auto          groups   = groups_of_points(view);
    const auto [first, last]     = ranks.share_of(groups.size());
    const bool has_friction_here = nodes_are_points_ || at_points(view);
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        const bool is_mine = g >= first && g < last;
        block.clear();
        for (const unsigned int q : groups[g])
          {
            if (!is_mine && !averaged[q])
              continue;
            const ContactKinematics<dim> kinematics(view.evaluation.closest[q]);
            point_functions(view, q, functions);
            point_variations(view, q, kinematics, functions, of_points[q]);
            if (!is_mine)
              continue;
            block.resize(dealii::Utilities::fixed_power<2>(
                           dim * functions.dofs.size()),
                         0.);
            add_second_variations(view, q, kinematics, functions, block);
            if (nodes_are_points_)
              add_normal_product(view, q, of_points[q].rows[0], block);
            if (has_friction_here && view.step.friction_on &&
                view.evaluation.friction[q].active())
              add_friction_products(view, q, of_points[q], block);
          }
        if (is_mine)
          add(all_components<dim>(functions.dofs), block);
      }
  }



  template <int dim>
  void
  ContactPair<dim>::add_tangent_of_nodes(
    const ContactView<dim>             &view,
    const std::vector<unsigned int>    &nodes,
    const std::vector<Variations<dim>> &of_points,
    const AddMatrix                    &add) const
  {
    Variations<dim>           average;
    std::vector<unsigned int> slot;
    std::vector<double>       block;
    for (const unsigned int I : nodes)
      {
        average_variations(view, I, of_points, slot, average);
        block.assign(dealii::Utilities::fixed_power<2>(dim *
                                                       average.dofs.size()),
                     0.);
        add_normal_product(view, I, average.rows[0], block);
        if (at_points(view)) // |p| = -p falls where p rises
          add_product(-view.evaluation.nodes[I].slope,
                      average.rows[1],
                      average.rows[0],
                      block);
        else if (view.step.friction_on)
          add_friction_products(view, I, average, block);
        add(all_components<dim>(average.dofs), block);
      }
  }



  template <int dim>
  void
  ContactPair<dim>::add_tangent(const ContactStep<dim>       &step,
                                const ContactEvaluation<dim> &evaluation,
                                const AddMatrix              &add,
                                const Ranks                  &ranks) const
  {
    assert_belongs(step, evaluation);
    const ContactView<dim> view{geometry_, step, evaluation};
    // Neighbors go to one process, so that it needs few points of others.
    const std::vector<unsigned int> nodes = own_averages(view, ranks);
    std::vector<bool>               averaged(geometry_.points.size(), false);
    for (const unsigned int I : nodes)
      for (const auto &entry : geometry_.averaging.nodes()[I].entries)
        averaged[entry.point] = true;

    // 1. What belongs to single points: pressure and traction times the second
    // variations, and all of it where a node is a single point.
    std::vector<Variations<dim>> of_points(geometry_.points.size());
    add_tangent_of_points(view, averaged, of_points, add, ranks);
    // 2. What couples all points of a node: products of the averaged first
    // variations.
    add_tangent_of_nodes(view, nodes, of_points, add);
  }



  namespace
  {
    // Points that are nearer to the next segment than this part of their own
    // are about to get there. On shear.prm: 8 patterns instead of 23.
    const double near_next_segment = 0.3;

    // Hand out the control points of the segment where a point is and of those
    // that it is about to get to.
    template <int dim>
    void
    for_each_lattice_point_near(
      const IGASurface<dim>                           &surface,
      const ClosestPoint<dim>                         &point,
      const std::function<void(const unsigned int l)> &use)
    {
      constexpr unsigned int                   m = dim - 1;
      std::array<std::vector<unsigned int>, m> segments;
      for (unsigned int a = 0; a < m; ++a)
        {
          const auto        &breaks = surface.segment_breaks(a);
          const unsigned int s      = point.segment[a];
          const double margin = near_next_segment * (breaks[s + 1] - breaks[s]);
          segments[a]         = {s};
          if (s > 0 && point.u[a] < breaks[s] + margin)
            segments[a].push_back(s - 1);
          if (s + 1 < surface.n_segments(a) &&
              point.u[a] > breaks[s + 1] - margin)
            segments[a].push_back(s + 1);
        }
      SurfaceShape<m>             shape;
      std::array<unsigned int, m> segment;
      for (const unsigned int s : segments[0])
        for (const unsigned int t : segments[m - 1])
          {
            if (m == 1 && s != t)
              continue;
            segment[0]     = s;
            segment[m - 1] = t;
            surface.evaluate(point.u, 0, shape, &segment);
            for (const unsigned int l : shape.lattice)
              use(l);
          }
    }
  } // namespace



  template <int dim>
  std::vector<std::vector<unsigned int>>
  ContactPair<dim>::coupled_unknowns(const ContactStep<dim>       &step,
                                     const ContactEvaluation<dim> &evaluation,
                                     const double                  margin) const
  {
    assert_belongs(step, evaluation);
    const SlipMeasure<dim> *slip_measure = measure(step.friction_on);
    std::vector<std::vector<unsigned int>> groups;
    std::vector<unsigned int>              first;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      {
        const NodeState<dim> &state = evaluation.nodes[I];
        if (!acts(I, step.friction_on) || (!state.active && state.gap > margin))
          continue;
        first.clear();
        for (const auto &entry : geometry_.averaging.nodes()[I].entries)
          {
            const ClosestPoint<dim> &c = evaluation.closest[entry.point];
            if (!step.reach.has(entry.point))
              continue;
            const auto &s = geometry_.points[entry.point].shape;
            for (const unsigned int l : s.lattice)
              first.push_back(geometry_.secondary.first_dof(l));
            const ContactSurface<dim> &primary = geometry_.primaries[c.surface];
            for_each_lattice_point_near(primary.surface(),
                                        c,
                                        [&](const unsigned int l) {
                                          first.push_back(primary.first_dof(l));
                                        });
            const SlipReference<dim> *reference =
              slip_measure == nullptr ?
                nullptr :
                slip_measure->acting_reference(step, entry.point);
            if (reference == nullptr)
              continue;
            for (const unsigned int l : reference->shape.lattice)
              first.push_back(
                geometry_.primaries[reference->surface].first_dof(l));
          }
        std::sort(first.begin(), first.end());
        first.erase(std::unique(first.begin(), first.end()), first.end());
        groups.push_back(all_components<dim>(first));
      }
    return groups;
  }



#define NPT_INSTANTIATE(dim)                                                   \
  template void ContactPair<dim>::add_residual(const ContactStep<dim> &,       \
                                               const ContactEvaluation<dim> &, \
                                               Vector<double> &) const;        \
  template void ContactPair<dim>::add_tangent(const ContactStep<dim> &,        \
                                              const ContactEvaluation<dim> &,  \
                                              const AddMatrix &,               \
                                              const Ranks &) const;            \
  template std::vector<std::vector<unsigned int>>                              \
  ContactPair<dim>::coupled_unknowns(const ContactStep<dim> &,                 \
                                     const ContactEvaluation<dim> &,           \
                                     const double) const;
  NPT_INSTANTIATE(2)
  NPT_INSTANTIATE(3)
#undef NPT_INSTANTIATE
} // namespace NPT
