// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines slip by relative displacement.

#ifndef npt_dealii_contact_relative_displacement_h
#define npt_dealii_contact_relative_displacement_h

#include <npt_dealii/contact/slip_measure.h>

namespace NPT
{
  /**
   * Slip against the material point xi_n of the primary surface that was
   * closest to the accepted state, on the tangents tau_a = x^s_{,a} of the
   * secondary surface, (A16),
   *
   * @f[ \sigma_a = \tau_a \cdot (x^s - x^m(\xi_n))
   *       - [\tau_a \cdot (x^s - x^m(\xi_n))]_n , \qquad
   *     C_t = \sum_I W_I \, t^{a,I} \, \delta\sigma_a^I . @f]
   *
   * It is a bilinear function of the displacement whatever the closest point
   * does, invariant under rigid motion (so that action equals reaction, also
   * in moment), and does not depend on the chart of the primary surface.
   *
   * The law is used in its dual form: sigma_a and t^a instead of xi^a and t_a,
   * with the inverse metric of the accepted state in the place of the metric.
   */
  template <int dim>
  class RelativeDisplacement : public SlipMeasure<dim>
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

  private:
    // d, tau and sigma of a point against its reference.
    static void
    measure(const ContactGeometry<dim>  &geometry,
            const ContactPositions<dim> &positions,
            const SlipReference<dim>    &reference,
            const unsigned int           q,
            SlipPoint<dim>              &slip);
    // delta sigma_a on the functions of a point.
    static void
    slip_row(const ContactView<dim>    &view,
             const unsigned int         q,
             const int                  a,
             const PointFunctions<dim> &functions,
             std::vector<double>       &row);
  };
} // namespace NPT

#endif
