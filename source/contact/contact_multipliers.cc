// SPDX-License-Identifier: LGPL-2.1-or-later
// The multipliers of the augmented Lagrangian: what they lack.

#include <npt_dealii/contact/contact_pair.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  namespace
  {
    // Conditions at Gauss points are more than the control points can meet;
    // multipliers of each would grow without end against each other. S takes of
    // a field at the points what the functions of the control points resolve:
    // their means over the support of each, interpolated.
    template <int dim>
    class Smoothing
    {
    public:
      explicit Smoothing(
        const std::vector<typename IGASurface<dim>::QuadraturePoint> &points)
        : points_(points)
      {
        unsigned int n = 0;
        for (const auto &point : points)
          for (const unsigned int A : point.averaging.lattice)
            n = std::max(n, A + 1);
        area_.resize(n, 0.);
        for (const auto &point : points)
          for (unsigned int l = 0; l < point.averaging.lattice.size(); ++l)
            area_[point.averaging.lattice[l]] +=
              point.averaging.value[l] * point.area;
      }

      // value(q) is a reference to the field at point q.
      template <typename Value>
      void
      smooth(const Value &value) const
      {
        std::vector<double> mean(area_.size(), 0.);
        for (unsigned int q = 0; q < points_.size(); ++q)
          for (unsigned int l = 0; l < points_[q].averaging.lattice.size(); ++l)
            {
              const unsigned int A = points_[q].averaging.lattice[l];
              mean[A] += points_[q].averaging.value[l] * points_[q].area /
                         area_[A] * value(q);
            }
        for (unsigned int q = 0; q < points_.size(); ++q)
          {
            double &result = value(q);
            result         = 0;
            for (unsigned int l = 0; l < points_[q].averaging.lattice.size();
                 ++l)
              result += points_[q].averaging.value[l] *
                        mean[points_[q].averaging.lattice[l]];
          }
      }

    private:
      const std::vector<typename IGASurface<dim>::QuadraturePoint> &points_;
      std::vector<double>                                           area_;
    };
  } // namespace



  template <int dim>
  typename ContactPair<dim>::Missing
  ContactPair<dim>::missing_multipliers(
    const ContactStep<dim>       &step,
    const ContactEvaluation<dim> &evaluation) const
  {
    Missing result;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      result.pressure.push_back(evaluation.nodes[I].pressure -
                                step.multiplier[I]);
    result.traction.resize(n_friction_nodes());
    for (unsigned int J = 0; J < n_friction_nodes(); ++J)
      for (int a = 0; a < m; ++a)
        result.traction[J][a] = evaluation.friction[J].response.traction[a] -
                                step.traction_multiplier[J][a];
    if (!nodes_are_points_ && !friction_at_points_)
      return result;

    const Smoothing<dim> smoothing(geometry_.points);
    if (nodes_are_points_)
      smoothing.smooth(
        [&](const unsigned int q) -> double & { return result.pressure[q]; });
    if (evaluation.friction_on)
      for (int a = 0; a < m; ++a)
        smoothing.smooth([&](const unsigned int q) -> double & {
          return result.traction[q][a];
        });
    return result;
  }



  template <int dim>
  ContactViolation
  ContactPair<dim>::violation(const ContactStep<dim>       &step,
                              const ContactEvaluation<dim> &evaluation) const
  {
    assert_belongs(step, evaluation);
    const Missing    missing = missing_multipliers(step, evaluation);
    ContactViolation result;
    for (unsigned int I = 0; I < n_nodes(); ++I)
      if (symmetry_weight_[I] > 0 &&
          (evaluation.nodes[I].active || step.multiplier[I] != 0.))
        result.gap = std::max(result.gap,
                              std::abs(missing.pressure[I]) /
                                (step.penalty_scale * normal_law_->penalty()));
    const SlipMeasure<dim> *slip_measure = measure(step.friction_on);
    if (slip_measure == nullptr)
      return result;
    for (unsigned int J = 0; J < n_friction_nodes(); ++J)
      {
        if (friction_symmetry_weight_[J] == 0 ||
            !evaluation.friction[J].active())
          continue;
        // |t - lambda|^2 = (t - lambda)_a a^{ab} (t - lambda)_b.
        const auto metric =
          slip_measure->traction_metric({geometry_, step, evaluation}, J);
        const auto &t      = missing.traction[J];
        double      square = 0;
        for (int a = 0; a < m; ++a)
          for (int b = 0; b < m; ++b)
            square += t[a] * metric[a][b] * t[b];
        result.slip =
          std::max(result.slip,
                   std::sqrt(std::max(0., square)) /
                     (step.penalty_scale * friction_law_->penalty()));
      }
    return result;
  }



#define NPT_INSTANTIATE(dim)                                                   \
  template typename ContactPair<dim>::Missing                                  \
  ContactPair<dim>::missing_multipliers(const ContactStep<dim> &,              \
                                        const ContactEvaluation<dim> &) const; \
  template ContactViolation ContactPair<dim>::violation(                       \
    const ContactStep<dim> &, const ContactEvaluation<dim> &) const;
  NPT_INSTANTIATE(2)
  NPT_INSTANTIATE(3)
#undef NPT_INSTANTIATE
} // namespace NPT
