// SPDX-License-Identifier: LGPL-2.1-or-later
// Slip by the parameters of the closest point, (20), (24).

#include <npt_dealii/contact/closest_point_slip.h>

namespace NPT
{
  using dealii::Tensor;
  using dealii::Vector;

  // ------------------------------------------------------------- references

  template <int dim>
  void
  ClosestPointSlip<dim>::set_references(const ContactGeometry<dim> &geometry,
                                        const ContactState<dim>    &accepted,
                                        const ContactPositions<dim> &,
                                        ContactStep<dim> &step) const
  {
    step.references.resize(geometry.points.size());
    for (unsigned int q = 0; q < step.references.size(); ++q)
      {
        step.references[q].known   = accepted.closest[q].known;
        step.references[q].surface = accepted.closest[q].surface;
        step.references[q].u       = accepted.closest[q].u;
      }
  }



  template <int dim>
  const SlipReference<dim> *
  ClosestPointSlip<dim>::acting_reference(const ContactStep<dim> &,
                                          const unsigned int) const
  {
    return nullptr;
  }



  // ------------------------------------------------------------------- slip

  template <int dim>
  void
  ClosestPointSlip<dim>::evaluate_point(const ContactView<dim> &,
                                        const unsigned int,
                                        SlipPoint<dim> &) const
  {}



  template <int dim>
  void
  ClosestPointSlip<dim>::evaluate_node(const ContactView<dim> &view,
                                       const unsigned int      I,
                                       std::array<double, m>  &slip,
                                       Metric                 &metric) const
  {
    slip   = {};
    metric = {};
    for (const auto &entry :
         view.geometry.friction_averaging.nodes()[I].entries)
      {
        const ClosestPoint<dim> &c = view.evaluation.closest[entry.point];
        if (!view.step.reach.has(entry.point))
          continue;
        const double A = view.step.reach.friction_weight(I, entry);
        for (int a = 0; a < m; ++a)
          for (int b = a; b < m; ++b)
            metric[SymmetricIndices<m>::second(a, b)] += A * (c.a[a] * c.a[b]);

        if (!has_slip(view, entry.point))
          continue;
        const SlipReference<dim> &reference = view.step.references[entry.point];
        const auto &from = view.geometry.primaries[reference.surface];
        const auto &to   = view.geometry.primaries[c.surface];
        for (int a = 0; a < m; ++a)
          slip[a] += A * (c.u[a] - reference.u[a]);
        slip[to.along()] += A * (to.shift() - from.shift());
      }
  }



  template <int dim>
  bool
  ClosestPointSlip<dim>::has_slip(const ContactView<dim> &view,
                                  const unsigned int      q) const
  {
    // Parameters of different bodies cannot be subtracted, and those of a point
    // that was behind the body before tell nothing.
    const ClosestPoint<dim>  &c         = view.evaluation.closest[q];
    const SlipReference<dim> &reference = view.step.references[q];
    if (!view.step.reach.has(q) || !reference.known)
      return false;
    const int from = view.geometry.primaries[reference.surface].strand();
    const int to   = view.geometry.primaries[c.surface].strand();
    return reference.surface == c.surface || (from >= 0 && from == to);
  }



  template <int dim>
  const std::array<Tensor<1, dim>, ClosestPointSlip<dim>::m> &
  ClosestPointSlip<dim>::tangents(const ContactEvaluation<dim> &evaluation,
                                  const unsigned int            q) const
  {
    return evaluation.closest[q].a;
  }



  template <int dim>
  bool
  ClosestPointSlip<dim>::traction_is_covariant() const
  {
    return true;
  }



  template <int dim>
  bool
  ClosestPointSlip<dim>::follows_closest_point() const
  {
    return true;
  }



  // ----------------------------------------------------------- virtual work

  template <int dim>
  void
  ClosestPointSlip<dim>::add_virtual_work(
    const ContactView<dim>       &view,
    const unsigned int            q,
    const ContactKinematics<dim> &kinematics,
    const PointFunctions<dim> &,
    typename ContactKinematics<dim>::Row &jets,
    Vector<double> &) const
  {
    for (int a = 0; a < m; ++a)
      for (unsigned int k = 0; k < jets.size(); ++k)
        jets[k] += view.evaluation.point_traction[q][a] *
                   kinematics.parameter_variation(a)[k];
  }



  template <int dim>
  void
  ClosestPointSlip<dim>::first_variations(
    const ContactView<dim>         &view,
    const unsigned int              q,
    const ContactKinematics<dim>   &kinematics,
    const PointFunctions<dim>      &functions,
    typename Variations<dim>::Rows &rows) const
  {
    for (int a = 0; a < m; ++a)
      if (has_slip(view, q))
        jets_to_functions<dim>(kinematics.parameter_variation(a),
                               functions,
                               rows[1 + a]);
      else
        rows[1 + a].assign(dim * functions.dofs.size(), 0.);
    for (unsigned int c = 0; c < ContactKinematics<dim>::n_metric; ++c)
      jets_to_functions<dim>(kinematics.metric_variation(c),
                             functions,
                             rows[1 + m + c]);
  }



  template <int dim>
  void
  ClosestPointSlip<dim>::add_second_variation(const ContactView<dim> &,
                                              const unsigned int,
                                              const PointFunctions<dim> &,
                                              std::vector<double> &) const
  {}



  template class ClosestPointSlip<2>;
  template class ClosestPointSlip<3>;

  namespace
  {
    template <int dim>
    NamedSlipMeasure<dim>
    closest_point_slip()
    {
      return {"increments of the closest point's parameters, Eqs. (20), (24) "
              "of the paper; agrees with relative displacement as the load "
              "steps become small",
              []() { return std::make_unique<ClosestPointSlip<dim>>(); }};
    }
    const Registry<NamedSlipMeasure<2>>::Registration
      closest_point_slip_in_plane("closest point", closest_point_slip<2>());
    const Registry<NamedSlipMeasure<3>>::Registration
      closest_point_slip_in_space("closest point", closest_point_slip<3>());
  } // namespace
} // namespace NPT
