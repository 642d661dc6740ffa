// SPDX-License-Identifier: LGPL-2.1-or-later
// Return mapping of Coulomb friction and its consistent derivatives.

#include <npt_dealii/contact/coulomb_friction.h>
#include <npt_dealii/contact/surface_metric.h>

#include <cmath>

namespace NPT
{
  template <int m>
  typename CoulombFriction<m>::Response
  CoulombFriction<m>::operator()(const std::array<double, m>        &traction_n,
                                 const std::array<double, m>        &slip,
                                 const std::array<double, n_metric> &metric,
                                 const double pressure) const
  {
    using Indices = SymmetricIndices<m>;
    Assert(pressure >= 0., dealii::ExcMessage("Pressure must not be negative"));
    Response answer;
    if (!(pressure > 0.) || coefficient == 0.)
      return answer;

    SurfaceMatrix<m> a;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        a[i][j] = metric[Indices::second(i, j)];
    const SurfaceMatrix<m> inverse = invert_symmetric<m>(a);

    std::array<double, m> trial, raised;
    for (int i = 0; i < m; ++i)
      {
        trial[i] = traction_n[i];
        for (int j = 0; j < m; ++j)
          trial[i] += penalty * a[i][j] * slip[j];
      }
    double norm2 = 0;
    for (int i = 0; i < m; ++i)
      {
        raised[i] = 0;
        for (int j = 0; j < m; ++j)
          raised[i] += inverse[i][j] * trial[j];
        norm2 += raised[i] * trial[i];
      }
    const double norm  = std::sqrt(norm2);
    const double limit = coefficient * pressure;

    // Derivatives of the trial traction.
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        {
          answer.by_slip[i][j] = penalty * a[i][j];
          answer.by_metric[i][Indices::second(i, j)] += penalty * slip[j];
        }

    if (norm <= limit)
      {
        answer.traction = trial;
        answer.energy   = 0.5 * norm2 / penalty;
        return answer;
      }

    // Slip: t = (limit/norm) t_trial.
    answer.slipping     = true;
    const double factor = limit / norm;
    answer.dissipation  = limit * (norm - limit) / penalty;
    answer.energy       = 0.5 * limit * limit / penalty;

    // d norm = ( t^a dt_a - 1/2 t^a t^b da_ab ) / norm.
    std::array<double, m>        norm_by_slip;
    std::array<double, n_metric> norm_by_metric = {};
    for (int j = 0; j < m; ++j)
      {
        norm_by_slip[j] = 0;
        for (int i = 0; i < m; ++i)
          norm_by_slip[j] += raised[i] * answer.by_slip[i][j] / norm;
      }
    for (unsigned int k = 0; k < n_metric; ++k)
      for (int i = 0; i < m; ++i)
        norm_by_metric[k] += raised[i] * answer.by_metric[i][k] / norm;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        norm_by_metric[Indices::second(i, j)] -=
          0.5 * raised[i] * raised[j] / norm;

    for (int i = 0; i < m; ++i)
      {
        answer.traction[i]    = factor * trial[i];
        answer.by_pressure[i] = coefficient * trial[i] / norm;
        for (int j = 0; j < m; ++j)
          answer.by_slip[i][j] =
            factor * (answer.by_slip[i][j] - trial[i] * norm_by_slip[j] / norm);
        for (unsigned int k = 0; k < n_metric; ++k)
          answer.by_metric[i][k] =
            factor *
            (answer.by_metric[i][k] - trial[i] * norm_by_metric[k] / norm);
      }
    return answer;
  }

  template struct CoulombFriction<1>;
  template struct CoulombFriction<2>;
} // namespace NPT
