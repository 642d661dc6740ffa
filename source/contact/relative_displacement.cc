// SPDX-License-Identifier: LGPL-2.1-or-later
// Slip by relative displacement, (A16) of doc/theory.md.

#include <npt_dealii/contact/relative_displacement.h>

#include <algorithm>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;
  using dealii::Vector;

  // ------------------------------------------------------------- references

  template <int dim>
  void
  RelativeDisplacement<dim>::set_references(
    const ContactGeometry<dim> &geometry,
    const ContactState<dim> &,
    const ContactPositions<dim> &positions,
    ContactStep<dim>            &step) const
  {
    using Indices               = SymmetricIndices<m>;
    const unsigned int n_points = geometry.points.size();
    step.references.resize(n_points);
    std::vector<SlipPoint<dim>> slip(n_points);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        SlipReference<dim> &reference = step.references[q];
        reference.known               = true;
        reference.surface             = step.starts[q].surface;
        reference.u                   = step.starts[q].u;
        reference.start               = {};
        geometry.primaries[reference.surface].surface().evaluate(
          reference.u, 0, reference.shape);
        measure(geometry, positions, reference, q, slip[q]);
        reference.start = slip[q].sigma;
        // Points out of reach do not slide on anything. Their part fades, so
        // that no point enters or leaves the average at once.
        reference.weight = std::min(
          1., std::max(0., 2. - slip[q].d.norm() / (0.5 * geometry.thickness)));
      }

    const auto &nodes = geometry.friction_averaging.nodes();
    step.inverse_metric.resize(nodes.size());
    for (unsigned int I = 0; I < nodes.size(); ++I)
      {
        if (!(step.reach.of_friction_node[I] > 0.))
          continue;
        SurfaceMatrix<m> metric = {};
        for (const auto &entry : nodes[I].entries)
          {
            const auto  &tau = slip[entry.point].tau;
            const double A   = step.reach.friction_weight(I, entry);
            for (int a = 0; a < m; ++a)
              for (int b = 0; b < m; ++b)
                metric[a][b] += A * (tau[a] * tau[b]);
          }
        const auto inverse = invert_symmetric<m>(metric);
        for (int a = 0; a < m; ++a)
          for (int b = a; b < m; ++b)
            step.inverse_metric[I][Indices::second(a, b)] = inverse[a][b];
      }
  }



  template <int dim>
  const SlipReference<dim> *
  RelativeDisplacement<dim>::acting_reference(const ContactStep<dim> &step,
                                              const unsigned int      q) const
  {
    return &step.references[q];
  }



  // ------------------------------------------------------------------- slip

  template <int dim>
  void
  RelativeDisplacement<dim>::measure(const ContactGeometry<dim>  &geometry,
                                     const ContactPositions<dim> &positions,
                                     const SlipReference<dim>    &reference,
                                     const unsigned int           q,
                                     SlipPoint<dim>              &slip)
  {
    const auto &shape   = geometry.points[q].shape;
    const auto &primary = positions.primaries[reference.surface];
    slip.d              = 0;
    slip.tau            = {};
    for (unsigned int l = 0; l < shape.lattice.size(); ++l)
      {
        const Point<dim> &x = positions.secondary[shape.lattice[l]];
        slip.d += shape.value[l] * x;
        for (int a = 0; a < m; ++a)
          slip.tau[a] += shape.first[a][l] * x;
      }
    for (unsigned int l = 0; l < reference.shape.lattice.size(); ++l)
      slip.d -= reference.shape.value[l] * primary[reference.shape.lattice[l]];
    for (int a = 0; a < m; ++a)
      slip.sigma[a] = slip.tau[a] * slip.d - reference.start[a];
  }



  template <int dim>
  void
  RelativeDisplacement<dim>::evaluate_point(const ContactView<dim> &view,
                                            const unsigned int      q,
                                            SlipPoint<dim>         &slip) const
  {
    measure(view.geometry,
            view.evaluation.positions,
            view.step.references[q],
            q,
            slip);
  }



  template <int dim>
  void
  RelativeDisplacement<dim>::evaluate_node(const ContactView<dim> &view,
                                           const unsigned int      I,
                                           std::array<double, m>  &slip,
                                           Metric                 &metric) const
  {
    slip = {};
    for (const auto &entry :
         view.geometry.friction_averaging.nodes()[I].entries)
      if (has_slip(view, entry.point))
        for (int a = 0; a < m; ++a)
          slip[a] += view.step.reach.friction_weight(I, entry) *
                     view.step.references[entry.point].weight *
                     view.evaluation.slip[entry.point].sigma[a];
    metric = view.step.inverse_metric[I];
  }



  template <int dim>
  bool
  RelativeDisplacement<dim>::has_slip(const ContactView<dim> &view,
                                      const unsigned int      q) const
  {
    return view.step.reach.has(q);
  }



  template <int dim>
  const std::array<Tensor<1, dim>, RelativeDisplacement<dim>::m> &
  RelativeDisplacement<dim>::tangents(const ContactEvaluation<dim> &evaluation,
                                      const unsigned int            q) const
  {
    return evaluation.slip[q].tau;
  }



  template <int dim>
  bool
  RelativeDisplacement<dim>::traction_is_covariant() const
  {
    return false;
  }



  template <int dim>
  bool
  RelativeDisplacement<dim>::follows_closest_point() const
  {
    return false;
  }



  // ----------------------------------------------------------- virtual work

  template <int dim>
  void
  RelativeDisplacement<dim>::slip_row(const ContactView<dim>    &view,
                                      const unsigned int         q,
                                      const int                  a,
                                      const PointFunctions<dim> &functions,
                                      std::vector<double>       &row)
  {
    const SlipReference<dim> &reference = view.step.references[q];
    const SlipPoint<dim>     &slip      = view.evaluation.slip[q];
    const auto               &shape     = view.geometry.points[q].shape;
    row.assign(dim * functions.dofs.size(), 0.);
    for (unsigned int l = 0; l < shape.lattice.size(); ++l)
      for (unsigned int i = 0; i < dim; ++i)
        row[dim * l + i] +=
          reference.weight *
          (shape.value[l] * slip.tau[a][i] + shape.first[a][l] * slip.d[i]);
    for (unsigned int l = 0; l < reference.shape.lattice.size(); ++l)
      for (unsigned int i = 0; i < dim; ++i)
        row[dim * functions.reference[l] + i] -=
          reference.weight * reference.shape.value[l] * slip.tau[a][i];
  }



  template <int dim>
  void
  RelativeDisplacement<dim>::add_virtual_work(
    const ContactView<dim> &view,
    const unsigned int      q,
    const ContactKinematics<dim> &,
    const PointFunctions<dim> &functions,
    typename ContactKinematics<dim>::Row &,
    Vector<double> &residual) const
  {
    // Kept between calls: one allocation per point would be noticed.
    static thread_local std::vector<double> slip;
    for (int a = 0; a < m; ++a)
      {
        slip_row(view, q, a, functions, slip);
        for (unsigned int A = 0; A < functions.dofs.size(); ++A)
          for (unsigned int i = 0; i < dim; ++i)
            residual[functions.dofs[A] + i] +=
              view.evaluation.point_traction[q][a] * slip[dim * A + i];
      }
  }



  template <int dim>
  void
  RelativeDisplacement<dim>::first_variations(
    const ContactView<dim> &view,
    const unsigned int      q,
    const ContactKinematics<dim> &,
    const PointFunctions<dim>      &functions,
    typename Variations<dim>::Rows &rows) const
  {
    for (int a = 0; a < m; ++a)
      slip_row(view, q, a, functions, rows[1 + a]);
  }



  template <int dim>
  void
  RelativeDisplacement<dim>::add_second_variation(
    const ContactView<dim>    &view,
    const unsigned int         q,
    const PointFunctions<dim> &functions,
    std::vector<double>       &block) const
  {
    // The same factor for each component i: t^a (delta tau_a . D d +
    // D tau_a . delta d).
    const SlipReference<dim> &reference   = view.step.references[q];
    const auto               &traction    = view.evaluation.point_traction[q];
    const auto               &shape       = view.geometry.points[q].shape;
    const unsigned int        n_functions = functions.dofs.size();
    const unsigned int        n           = dim * n_functions;
    const unsigned int        n_s         = shape.lattice.size();
    std::vector<double>       turn(n_s, 0.), move(n_functions, 0.);
    for (unsigned int A = 0; A < n_s; ++A)
      {
        for (int a = 0; a < m; ++a)
          turn[A] += reference.weight * traction[a] * shape.first[a][A];
        move[A] = shape.value[A];
      }
    for (unsigned int l = 0; l < reference.shape.lattice.size(); ++l)
      move[functions.reference[l]] -= reference.shape.value[l];
    for (unsigned int A = 0; A < n_s; ++A)
      for (unsigned int B = 0; B < n_functions; ++B)
        for (unsigned int i = 0; i < dim; ++i)
          {
            const double value = turn[A] * move[B];
            block[(A * dim + i) * n + B * dim + i] += value;
            block[(B * dim + i) * n + A * dim + i] += value;
          }
  }



  template class RelativeDisplacement<2>;
  template class RelativeDisplacement<3>;

  namespace
  {
    template <int dim>
    NamedSlipMeasure<dim>
    relative_displacement()
    {
      return {"slip of a point against the material point of the other surface "
              "that it touched when the load step began, (A16); smooth at "
              "edges, kinks and seams",
              []() { return std::make_unique<RelativeDisplacement<dim>>(); }};
    }
    const Registry<NamedSlipMeasure<2>>::Registration
      relative_displacement_in_plane("relative displacement",
                                     relative_displacement<2>());
    const Registry<NamedSlipMeasure<3>>::Registration
      relative_displacement_in_space("relative displacement",
                                     relative_displacement<3>());
  } // namespace
} // namespace NPT
