// SPDX-License-Identifier: LGPL-2.1-or-later
// Components of traction and slip on averaged tangents.

#include <npt_dealii/contact/slip_measure.h>

namespace NPT
{
  using dealii::Tensor;

  template <int dim>
  SurfaceMatrix<SlipMeasure<dim>::m>
  SlipMeasure<dim>::traction_metric(const ContactView<dim> &view,
                                    const unsigned int      I) const
  {
    SurfaceMatrix<m> metric = {};
    for (const auto &entry :
         view.geometry.friction_averaging.nodes()[I].entries)
      {
        const auto  &tangent = tangents(view.evaluation, entry.point);
        const double A       = view.step.reach.friction_weight(I, entry);
        for (int a = 0; a < m; ++a)
          for (int b = 0; b < m; ++b)
            metric[a][b] += A * (tangent[a] * tangent[b]);
      }
    return traction_is_covariant() ? invert_symmetric<m>(metric) : metric;
  }



  template <int dim>
  Tensor<1, dim>
  SlipMeasure<dim>::tangent_vector(const ContactGeometry<dim>   &geometry,
                                   const ContactEvaluation<dim> &evaluation,
                                   const unsigned int            I,
                                   const std::array<double, m>  &v,
                                   const bool covariant) const
  {
    std::array<Tensor<1, dim>, m> tangent;
    for (const auto &entry : geometry.friction_averaging.nodes()[I].entries)
      for (int a = 0; a < m; ++a)
        tangent[a] += evaluation.reach.friction_weight(I, entry) *
                      tangents(evaluation, entry.point)[a];
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
  SlipMeasure<dim>::traction_vector(const ContactGeometry<dim>   &geometry,
                                    const ContactEvaluation<dim> &evaluation,
                                    const unsigned int            I) const
  {
    return tangent_vector(geometry,
                          evaluation,
                          I,
                          evaluation.friction[I].response.traction,
                          traction_is_covariant());
  }



  template <int dim>
  Tensor<1, dim>
  SlipMeasure<dim>::slip_vector(const ContactGeometry<dim>   &geometry,
                                const ContactEvaluation<dim> &evaluation,
                                const unsigned int            I) const
  {
    return tangent_vector(geometry,
                          evaluation,
                          I,
                          evaluation.friction[I].slip,
                          !traction_is_covariant());
  }

  template class SlipMeasure<2>;
  template class SlipMeasure<3>;
} // namespace NPT
