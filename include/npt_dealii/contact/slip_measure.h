// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what contact asks of every measure of slip.

#ifndef npt_dealii_contact_slip_measure_h
#define npt_dealii_contact_slip_measure_h

#include <npt_dealii/base/registry.h>
#include <npt_dealii/contact/contact_evaluation.h>
#include <npt_dealii/contact/contact_state.h>
#include <npt_dealii/contact/contact_step.h>
#include <npt_dealii/contact/contact_variations.h>

#include <functional>
#include <memory>

namespace NPT
{
  /// A contact pair at one displacement of a load step, to look at.
  template <int dim>
  struct ContactView
  {
    const ContactGeometry<dim>   &geometry;
    const ContactStep<dim>       &step;
    const ContactEvaluation<dim> &evaluation;
  };

  /**
   * A measure s^a of the slip since the accepted state, with the tangents a_a
   * on which it and the friction traction have their components. Friction acts
   * by
   *
   * @f[ C_t = \sum_I W_I \, t_a^I \, \delta s^{a,I}, \qquad
   *     s^{a,I} = \sum_q A_{Iq} s^a_q , @f]
   *
   * so that a measure is its value, its first variation and the part
   * t_a D(delta s^a) of the tangent. All functions are functions of their
   * arguments only. Without friction there is no measure.
   */
  template <int dim>
  class SlipMeasure
  {
  public:
    static constexpr int m = dim - 1;
    using Metric           = std::array<double, SymmetricIndices<m>::n_second>;

    virtual ~SlipMeasure() = default;

    /// Fill references and metrics of a new step.
    ///
    /// @param positions Of the accepted displacement.
    /// @param step Its start values and reach are there already.
    virtual void
    set_references(const ContactGeometry<dim>  &geometry,
                   const ContactState<dim>     &accepted,
                   const ContactPositions<dim> &positions,
                   ContactStep<dim>            &step) const = 0;

    /// Slip of a Gauss point, once its closest point is known.
    virtual void
    evaluate_point(const ContactView<dim> &view,
                   const unsigned int      q,
                   SlipPoint<dim>         &slip) const = 0;

    /// Averaged slip of a node, and the metric with which the law sees it.
    virtual void
    evaluate_node(const ContactView<dim> &view,
                  const unsigned int      I,
                  std::array<double, m>  &slip,
                  Metric                 &metric) const = 0;

    /// False if a Gauss point has no part in the slip of its nodes; then their
    /// traction does not act on it either.
    virtual bool
    has_slip(const ContactView<dim> &view, const unsigned int q) const = 0;

    /// True if slip is a function of the closest point: its variations are
    /// linear forms of the jets then, the metric varies with them, the second
    /// variations are those of ContactKinematics, and these need third
    /// derivatives.
    virtual bool
    follows_closest_point() const = 0;

    /// The material point of a primary surface on which the traction of a Gauss
    /// point acts besides the closest point, or null.
    virtual const SlipReference<dim> *
    acting_reference(const ContactStep<dim> &step,
                     const unsigned int      q) const = 0;

    /// Add t_a delta s^a of a point, weighted by its area: as a linear form of
    /// the jets, or to the residual.
    virtual void
    add_virtual_work(const ContactView<dim>               &view,
                     const unsigned int                    q,
                     const ContactKinematics<dim>         &kinematics,
                     const PointFunctions<dim>            &functions,
                     typename ContactKinematics<dim>::Row &jets,
                     dealii::Vector<double>               &residual) const = 0;

    /// Rows 1 and on of the first variations of a point.
    virtual void
    first_variations(const ContactView<dim>         &view,
                     const unsigned int              q,
                     const ContactKinematics<dim>   &kinematics,
                     const PointFunctions<dim>      &functions,
                     typename Variations<dim>::Rows &rows) const = 0;

    /// Add t_a D(delta s^a) of a point to a matrix over its functions, as far
    /// as ContactKinematics does not know it.
    virtual void
    add_second_variation(const ContactView<dim>    &view,
                         const unsigned int         q,
                         const PointFunctions<dim> &functions,
                         std::vector<double>       &block) const = 0;

    /// Tangents of the components at a Gauss point.
    virtual const std::array<dealii::Tensor<1, dim>, m> &
    tangents(const ContactEvaluation<dim> &evaluation,
             const unsigned int            q) const = 0;

    /// True if the traction has covariant components t_a on these tangents and
    /// slip contravariant ones; false if it is the other way round (dual form).
    virtual bool
    traction_is_covariant() const = 0;

    /// How many components of the metric vary within a step.
    unsigned int
    n_varying_metrics() const
    {
      return follows_closest_point() ? ContactKinematics<dim>::n_metric : 0;
    }

    /// Matrix M for which t_a M^{ab} t_b is the square of a traction.
    SurfaceMatrix<m>
    traction_metric(const ContactView<dim> &view, const unsigned int I) const;

    /// Traction of an active node on the secondary side as a vector [MPa].
    dealii::Tensor<1, dim>
    traction_vector(const ContactGeometry<dim>   &geometry,
                    const ContactEvaluation<dim> &evaluation,
                    const unsigned int            I) const;

    /// Slip of an active node as a vector [mm].
    dealii::Tensor<1, dim>
    slip_vector(const ContactGeometry<dim>   &geometry,
                const ContactEvaluation<dim> &evaluation,
                const unsigned int            I) const;

  private:
    // Vector of co- or contravariant components at a node.
    dealii::Tensor<1, dim>
    tangent_vector(const ContactGeometry<dim>   &geometry,
                   const ContactEvaluation<dim> &evaluation,
                   const unsigned int            I,
                   const std::array<double, m>  &v,
                   const bool                    covariant) const;
  };

  /// A measure of slip by its name, for Registry.
  template <int dim>
  struct NamedSlipMeasure
  {
    std::string                                              text;
    std::function<std::unique_ptr<const SlipMeasure<dim>>()> make;
  };
} // namespace NPT

#endif
