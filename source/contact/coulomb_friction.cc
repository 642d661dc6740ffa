// SPDX-License-Identifier: LGPL-2.1-or-later
// Return mapping of Coulomb friction and its consistent derivatives.

#include <npt_dealii/contact/coulomb_friction.h>
#include <npt_dealii/contact/geometry/surface_metric.h>

#include <cmath>

namespace NPT
{
  template <int m>
  CoulombFriction<m>::CoulombFriction(const double coefficient,
                                      const double penalty)
    : coefficient_(coefficient)
    , penalty_(penalty)
  {
    Assert(coefficient >= 0. && penalty > 0.,
           dealii::ExcMessage("Friction needs mu >= 0 and a penalty > 0"));
  }



  template <int m>
  bool
  CoulombFriction<m>::exerts_traction() const
  {
    return coefficient_ > 0.;
  }



  template <int m>
  double
  CoulombFriction<m>::penalty() const
  {
    return penalty_;
  }



  template <int m>
  FrictionResponse<m>
  CoulombFriction<m>::response(const std::array<double, m>        &traction_n,
                               const std::array<double, m>        &slip,
                               const std::array<double, n_metric> &metric,
                               const double                        pressure,
                               const double penalty_scale) const
  {
    using Indices = SymmetricIndices<m>;
    Response answer;
    if (!(pressure > 0.) || coefficient_ == 0.)
      return answer;

    SurfaceMatrix<m> a;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        a[i][j] = metric[Indices::second(i, j)];
    const SurfaceMatrix<m> inverse = invert_symmetric<m>(a);

    // Stick predictor (25), and its derivatives.
    const double penalty = penalty_scale * penalty_;
    Trial        trial;
    for (int i = 0; i < m; ++i)
      {
        trial.covariant[i] = traction_n[i];
        for (int j = 0; j < m; ++j)
          trial.covariant[i] += penalty * a[i][j] * slip[j];
      }
    for (int i = 0; i < m; ++i)
      {
        trial.contravariant[i] = 0;
        for (int j = 0; j < m; ++j)
          trial.contravariant[i] += inverse[i][j] * trial.covariant[j];
        trial.norm_square += trial.contravariant[i] * trial.covariant[i];
      }
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        {
          answer.by_slip[i][j] = penalty * a[i][j];
          answer.by_metric[i][Indices::second(i, j)] += penalty * slip[j];
        }

    if (std::sqrt(trial.norm_square) <= coefficient_ * pressure)
      {
        answer.traction = trial.covariant;
        answer.energy   = 0.5 * trial.norm_square / penalty;
      }
    else
      slide(trial, pressure, penalty, answer);
    return answer;
  }



  template <int m>
  void
  CoulombFriction<m>::slide(const Trial &trial,
                            const double pressure,
                            const double penalty,
                            Response    &answer) const
  {
    using Indices = SymmetricIndices<m>;

    // (27): t = (limit/norm) t_trial.
    const double norm   = std::sqrt(trial.norm_square);
    const double limit  = coefficient_ * pressure;
    const double factor = limit / norm;
    answer.slipping     = true;
    answer.dissipation  = limit * (norm - limit) / penalty;
    answer.energy       = 0.5 * limit * limit / penalty;

    // d norm = ( t^a dt_a - 1/2 t^a t^b da_ab ) / norm.
    const auto                  &raised         = trial.contravariant;
    std::array<double, m>        norm_by_slip   = {};
    std::array<double, n_metric> norm_by_metric = {};
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i)
        norm_by_slip[j] += raised[i] * answer.by_slip[i][j] / norm;
    for (unsigned int k = 0; k < n_metric; ++k)
      for (int i = 0; i < m; ++i)
        norm_by_metric[k] += raised[i] * answer.by_metric[i][k] / norm;
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j)
        norm_by_metric[Indices::second(i, j)] -=
          0.5 * raised[i] * raised[j] / norm;

    for (int i = 0; i < m; ++i)
      {
        const double t        = trial.covariant[i];
        answer.traction[i]    = factor * t;
        answer.by_pressure[i] = coefficient_ * t / norm;
        for (int j = 0; j < m; ++j)
          answer.by_slip[i][j] =
            factor * (answer.by_slip[i][j] - t * norm_by_slip[j] / norm);
        for (unsigned int k = 0; k < n_metric; ++k)
          answer.by_metric[i][k] =
            factor * (answer.by_metric[i][k] - t * norm_by_metric[k] / norm);
      }
  }

  template class CoulombFriction<1>;
  template class CoulombFriction<2>;

  namespace
  {
    template <int m>
    NamedFrictionLaw<m>
    coulomb_friction()
    {
      return {"traction up to mu times the pressure, (12)-(14)",
              [](const FrictionParameters &parameters) {
                return std::make_unique<CoulombFriction<m>>(
                  parameters.coefficient, parameters.tangential_penalty);
              }};
    }
    const Registry<NamedFrictionLaw<1>>::Registration
      coulomb_friction_in_plane("Coulomb", coulomb_friction<1>());
    const Registry<NamedFrictionLaw<2>>::Registration
      coulomb_friction_in_space("Coulomb", coulomb_friction<2>());
  } // namespace
} // namespace NPT
