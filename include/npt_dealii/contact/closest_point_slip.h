// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines slip by the parameters of the closest point.

#ifndef npt_dealii_contact_closest_point_slip_h
#define npt_dealii_contact_closest_point_slip_h

#include <npt_dealii/contact/slip_measure.h>

namespace NPT
{
  /**
   * Slip as in the paper, (20), (24): the increments of the parameters of the
   * closest point since the accepted state, on the tangents a_a of the primary
   * surface there,
   *
   * @f[ \Delta\xi^a = \xi^a - \xi^a_n , \qquad
   *     C_t = \sum_I W_I \, t_a^I \, \delta\xi^{a,I} . @f]
   *
   * A strand made of several images has one parameter along it, see
   * ContactSurface::set_strand(); a point that moves to another surface has no
   * increment. Across an edge, a kink or a seam slip vanishes the moment the
   * closest point is held there, and the residual jumps.
   */
  template <int dim>
  class ClosestPointSlip : public SlipMeasure<dim>
  {
  public:
    static constexpr int m = dim - 1;
    using typename SlipMeasure<dim>::Metric;

    void
    set_references(const ContactGeometry<dim>  &geometry,
                   const ContactState<dim>     &accepted,
                   const ContactPositions<dim> &positions,
                   ContactStep<dim>            &step) const override;
    void
    evaluate_point(const ContactView<dim> &view,
                   const unsigned int      q,
                   SlipPoint<dim>         &slip) const override;
    void
    evaluate_node(const ContactView<dim> &view,
                  const unsigned int      I,
                  std::array<double, m>  &slip,
                  Metric                 &metric) const override;
    bool
    has_slip(const ContactView<dim> &view, const unsigned int q) const override;
    bool
    follows_closest_point() const override;
    const SlipReference<dim> *
    acting_reference(const ContactStep<dim> &step,
                     const unsigned int      q) const override;
    void
    add_virtual_work(const ContactView<dim>               &view,
                     const unsigned int                    q,
                     const ContactKinematics<dim>         &kinematics,
                     const PointFunctions<dim>            &functions,
                     typename ContactKinematics<dim>::Row &jets,
                     dealii::Vector<double> &residual) const override;
    void
    first_variations(const ContactView<dim>         &view,
                     const unsigned int              q,
                     const ContactKinematics<dim>   &kinematics,
                     const PointFunctions<dim>      &functions,
                     typename Variations<dim>::Rows &rows) const override;
    void
    add_second_variation(const ContactView<dim>    &view,
                         const unsigned int         q,
                         const PointFunctions<dim> &functions,
                         std::vector<double>       &block) const override;
    const std::array<dealii::Tensor<1, dim>, m> &
    tangents(const ContactEvaluation<dim> &evaluation,
             const unsigned int            q) const override;
    bool
    traction_is_covariant() const override;
  };
} // namespace NPT

#endif
