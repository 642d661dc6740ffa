// SPDX-License-Identifier: LGPL-2.1-or-later
// Virtual work of frictional contact and its consistent linearization.

#include <npt_dealii/contact/contact_assembler.h>

#include <deal.II/base/utilities.h>

#include <array>
#include <map>
#include <vector>

namespace NPT
{
  using dealii::Vector;

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
  unsigned int
  ContactAssembler<dim>::n_variations() const
  {
    return !friction_on_     ? 1 :
           by_closest_point_ ? 1 + m + ContactKinematics<dim>::n_metric :
                               1 + m;
  }



  template <int dim>
  void
  ContactAssembler<dim>::point_variations(
    const unsigned int            q,
    const ContactKinematics<dim> &kinematics,
    const PointFunctions         &functions,
    Variations                   &variations) const
  {
    const unsigned int n_functions = functions.dofs.size();
    variations.dofs                = functions.dofs;
    for (unsigned int r = 0; r < n_variations(); ++r)
      {
        std::vector<double> &row = variations.rows[r];
        if (r > 0 && !by_closest_point_)
          {
            slip_row(q, r - 1, functions, row);
            continue;
          }
        const auto &jets = r == 0 ? kinematics.gap_variation() :
                           r <= m ? kinematics.parameter_variation(r - 1) :
                                    kinematics.metric_variation(r - 1 - m);
        row.assign(dim * n_functions, 0.);
        for (unsigned int f = 0; f < ContactKinematics<dim>::n_jets; ++f)
          for (unsigned int A = 0; A < n_functions; ++A)
            if (functions.jet[f][A] != 0.)
              for (unsigned int i = 0; i < dim; ++i)
                row[A * dim + i] += functions.jet[f][A] * jets[f * dim + i];
      }
  }



  template <int dim>
  void
  ContactAssembler<dim>::add_slip_second_variation(
    const unsigned int    q,
    const PointFunctions &functions,
    std::vector<double>  &block) const
  {
    // The same factor for each component i: t^a (delta tau_a . D d +
    // D tau_a . delta d).
    const SlipPoint    &slip        = slip_points_[q];
    const auto         &shape       = points_[q].shape;
    const unsigned int  n_functions = functions.dofs.size();
    const unsigned int  n           = dim * n_functions;
    const unsigned int  n_s         = shape.lattice.size();
    std::vector<double> turn(n_s, 0.), move(n_functions, 0.);
    for (unsigned int A = 0; A < n_s; ++A)
      {
        for (int a = 0; a < m; ++a)
          turn[A] += slip.weight * point_traction_[q][a] * shape.first[a][A];
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



  template <int dim>
  void
  ContactAssembler<dim>::add_second_variations(
    const unsigned int            q,
    const ContactKinematics<dim> &kinematics,
    const PointFunctions         &functions,
    std::vector<double>          &block) const
  {
    using Kinematics           = ContactKinematics<dim>;
    const bool         by_jets = friction_on_ && by_closest_point_;
    const unsigned int n_f     = functions.dofs.size();
    const unsigned int n       = dim * n_f;

    std::array<double, Kinematics::n * Kinematics::n> M;
    M.fill(0.);
    kinematics.add_second_variation(point_pressure_[q],
                                    by_jets ? point_traction_[q] :
                                              std::array<double, m>{},
                                    M);
    if (friction_on_ && !by_closest_point_)
      add_slip_second_variation(q, functions, block);

    // block += N^T M N with N the jet values of the functions. Second
    // variations meet J_ab only where a traction acts on xi, and beside edges.
    const unsigned int n_used_jets =
      by_jets || closest_[q].edge_radius > 0. ? Kinematics::n_jets : 1 + m;
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



  template <int dim>
  void
  ContactAssembler<dim>::add_first_variations(const unsigned int   I,
                                              const Variations    &variations,
                                              std::vector<double> &block) const
  {
    const NodeState    &state = nodes_[I];
    const double        W    = symmetry_weight_[I] * averaging_.nodes()[I].area;
    const auto         &rows = variations.rows;
    const unsigned int  n    = rows[0].size();
    std::vector<double> right(n);
    const auto          add_product = [&](const std::vector<double> &left) {
      for (unsigned int k = 0; k < n; ++k)
        {
          double      *target = &block[k * n];
          const double factor = W * left[k];
          for (unsigned int l = 0; l < n; ++l)
            target[l] += factor * right[l];
        }
    };

    for (unsigned int k = 0; k < n; ++k)
      right[k] = state.slope * rows[0][k];
    add_product(rows[0]);
    if (!friction_on_)
      return;
    for (int a = 0; a < m; ++a)
      {
        // |p| = -p falls where p rises.
        const double by_gap = -state.friction.by_pressure[a] * state.slope;
        for (unsigned int k = 0; k < n; ++k)
          {
            right[k] = by_gap * rows[0][k];
            for (int b = 0; b < m; ++b)
              right[k] += state.friction.by_slip[a][b] * rows[1 + b][k];
            if (by_closest_point_)
              for (unsigned int c = 0; c < ContactKinematics<dim>::n_metric;
                   ++c)
                right[k] += state.friction.by_metric[a][c] * rows[1 + m + c][k];
          }
        add_product(rows[1 + a]);
      }
  }



  template <int dim>
  void
  ContactAssembler<dim>::average_variations(
    const unsigned int             I,
    const std::vector<Variations> &of_points,
    std::vector<unsigned int>     &slot,
    Variations                    &average) const
  {
    const auto &entries = averaging_.nodes()[I].entries;
    average.dofs.clear();
    for (const auto &entry : entries)
      if (is_admissible(entry.point))
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

    for (unsigned int r = 0; r < n_variations(); ++r)
      average.rows[r].assign(dim * average.dofs.size(), 0.);
    for (const auto &entry : entries)
      if (is_admissible(entry.point))
        {
          const Variations &point = of_points[entry.point];
          for (unsigned int A = 0; A < point.dofs.size(); ++A)
            for (unsigned int r = 0; r < n_variations(); ++r)
              for (unsigned int i = 0; i < dim; ++i)
                average.rows[r][slot[point.dofs[A]] + i] +=
                  entry.weight * point.rows[r][A * dim + i];
        }
    for (const unsigned int dof : average.dofs)
      slot[dof] = dealii::numbers::invalid_unsigned_int;
  }



  template <int dim>
  void
  ContactAssembler<dim>::add_tangent(const AddMatrix &add) const
  {
    const bool nodes_are_points = contact_.method != "mortar";
    const bool relative         = friction_on_ && !by_closest_point_;
    const auto unknowns = [](const std::vector<unsigned int> &first_dofs) {
      std::vector<unsigned int> dofs;
      for (const unsigned int dof : first_dofs)
        for (unsigned int i = 0; i < dim; ++i)
          dofs.push_back(dof + i);
      return dofs;
    };

    // Points that share their functions share a block; the first and the last
    // function tell which these are.
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

    // 1. What belongs to single points: pressure and traction times the second
    // variations, and all of it where a node is a single point.
    std::vector<Variations> of_points(points_.size());
    PointFunctions          functions;
    std::vector<double>     block;
    for (const auto &group : groups)
      {
        block.clear();
        for (const unsigned int q : group.second)
          {
            const ContactKinematics<dim> kinematics(closest_[q]);
            point_functions(q, functions);
            block.resize(dealii::Utilities::fixed_power<2>(
                           dim * functions.dofs.size()),
                         0.);
            add_second_variations(q, kinematics, functions, block);
            point_variations(q, kinematics, functions, of_points[q]);
            if (nodes_are_points)
              add_first_variations(q, of_points[q], block);
          }
        add(unknowns(functions.dofs), block);
      }
    if (nodes_are_points)
      return;

    // 2. What couples all points of a node: products of the averaged first
    // variations.
    Variations                average;
    std::vector<unsigned int> slot;
    for (unsigned int I = 0; I < nodes_.size(); ++I)
      {
        if (!nodes_[I].active || symmetry_weight_[I] == 0 ||
            averaging_.nodes()[I].area == 0.)
          continue;
        average_variations(I, of_points, slot, average);
        block.assign(dealii::Utilities::fixed_power<2>(dim *
                                                       average.dofs.size()),
                     0.);
        add_first_variations(I, average, block);
        add(unknowns(average.dofs), block);
      }
  }



  template void
  ContactAssembler<2>::add_residual(Vector<double> &) const;
  template void
  ContactAssembler<3>::add_residual(Vector<double> &) const;
  template void
  ContactAssembler<2>::add_tangent(const AddMatrix &) const;
  template void
  ContactAssembler<3>::add_tangent(const AddMatrix &) const;
} // namespace NPT
