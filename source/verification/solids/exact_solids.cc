// SPDX-License-Identifier: LGPL-2.1-or-later
// Formulas of the exact solutions.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/neo_hookean.h>
#include <npt_dealii/verification/solids/exact_solids.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  HoleUnderTension::HoleUnderTension(const double tension,
                                     const double radius,
                                     const double young_modulus,
                                     const double poisson_ratio)
    : T_(tension)
    , R_(radius)
    , mu_(young_modulus / (2. * (1. + poisson_ratio)))
    , nu_(poisson_ratio)
  {}



  Tensor<1, 3>
  HoleUnderTension::displacement(const Point<3> &X) const
  {
    const double kappa = 3. - 4. * nu_;
    const double rho   = std::hypot(X[0], X[1]) / R_;
    const double theta = std::atan2(X[1], X[0]);
    Tensor<1, 3> u;
    u[0] = rho * (kappa + 1.) * std::cos(theta) +
           2. / rho * ((1. + kappa) * std::cos(theta) + std::cos(3. * theta)) -
           2. / std::pow(rho, 3) * std::cos(3. * theta);
    u[1] = rho * (kappa - 3.) * std::sin(theta) +
           2. / rho * ((1. - kappa) * std::sin(theta) + std::sin(3. * theta)) -
           2. / std::pow(rho, 3) * std::sin(3. * theta);
    return T_ * R_ / (8. * mu_) * u;
  }



  Tensor<2, 3>
  HoleUnderTension::stress(const Point<3> &X) const
  {
    const double s     = R_ * R_ / (X[0] * X[0] + X[1] * X[1]);
    const double theta = std::atan2(X[1], X[0]);
    const double c2 = std::cos(2. * theta), c4 = std::cos(4. * theta);
    const double s2 = std::sin(2. * theta), s4 = std::sin(4. * theta);
    Tensor<2, 3> sigma;
    sigma[0][0] = 1. - s * (1.5 * c2 + c4) + 1.5 * s * s * c4;
    sigma[1][1] = -s * (0.5 * c2 - c4) - 1.5 * s * s * c4;
    sigma[0][1] = sigma[1][0] = -s * (0.5 * s2 + s4) + 1.5 * s * s * s4;
    sigma[2][2]               = nu_ * (sigma[0][0] + sigma[1][1]);
    return T_ * sigma;
  }



  PressurizedCylinder::PressurizedCylinder(const double pressure,
                                           const double inner_radius,
                                           const double outer_radius,
                                           const double young_modulus,
                                           const double poisson_ratio)
    : c_(pressure * inner_radius * inner_radius /
         (outer_radius * outer_radius - inner_radius * inner_radius))
    , b_(outer_radius)
    , E_(young_modulus)
    , nu_(poisson_ratio)
  {}



  Tensor<1, 3>
  PressurizedCylinder::displacement(const Point<3> &X) const
  {
    const double r2 = X[0] * X[0] + X[1] * X[1];
    const double u_over_r =
      (1. + nu_) / E_ * c_ * (1. - 2. * nu_ + b_ * b_ / r2);
    Tensor<1, 3> u;
    u[0] = u_over_r * X[0];
    u[1] = u_over_r * X[1];
    return u;
  }



  Tensor<2, 3>
  PressurizedCylinder::stress(const Point<3> &X) const
  {
    // sigma = c [ (1 + b^2/r^2) 1 - 2 b^2/r^2 e_r (x) e_r ] in the plane
    const double r2 = X[0] * X[0] + X[1] * X[1];
    const double s  = b_ * b_ / r2;
    Tensor<2, 3> sigma;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        sigma[i][j] = c_ * ((i == j ? 1. + s : 0.) - 2. * s * X[i] * X[j] / r2);
    sigma[2][2] = 2. * nu_ * c_;
    return sigma;
  }



  PressurizedSphere::PressurizedSphere(const double pressure,
                                       const double inner_radius,
                                       const double outer_radius,
                                       const double young_modulus,
                                       const double poisson_ratio)
    : c_(pressure * std::pow(inner_radius, 3) /
         (std::pow(outer_radius, 3) - std::pow(inner_radius, 3)))
    , b_(outer_radius)
    , E_(young_modulus)
    , nu_(poisson_ratio)
  {}



  Tensor<1, 3>
  PressurizedSphere::displacement(const Point<3> &X) const
  {
    const double s = std::pow(b_ / X.norm(), 3);
    return c_ / E_ * (1. - 2. * nu_ + 0.5 * (1. + nu_) * s) * Tensor<1, 3>(X);
  }



  Tensor<2, 3>
  PressurizedSphere::stress(const Point<3> &X) const
  {
    // sigma = c [ (1 + s/2) 1 - 3/2 s e_r (x) e_r ],  s = (b/r)^3
    const double s = std::pow(b_ / X.norm(), 3);
    Tensor<2, 3> sigma;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        sigma[i][j] = c_ * ((i == j ? 1. + 0.5 * s : 0.) -
                            1.5 * s * X[i] * X[j] / X.norm_square());
    return sigma;
  }



  template <>
  const EnumNames<HomogeneousMode> &
  enum_names<HomogeneousMode>()
  {
    static const EnumNames<HomogeneousMode> names = {
      {HomogeneousMode::uniaxial, "uniaxial"},
      {HomogeneousMode::equibiaxial, "equibiaxial"},
      {HomogeneousMode::dilation, "dilation"},
      {HomogeneousMode::simple_shear, "simple shear"}};
    return names;
  }



  namespace
  {
    // The isotropic law is the other one without its fiber terms.
    FiberBundleConstants
    constants_of(const MaterialParameters &material)
    {
      if (const auto *bundle = material.selected<FiberBundleParameters>())
        return bundle->constants;
      const auto *isotropic = material.selected<NeoHookeanParameters>();
      AssertThrow(isotropic,
                  dealii::ExcMessage("No closed form for the law " +
                                     material.law + "."));
      const NeoHookeanConstants neo_hookean = isotropic->constants();
      FiberBundleConstants      constants;
      constants.mu     = neo_hookean.mu;
      constants.lambda = neo_hookean.lambda;
      constants.a = constants.b = constants.c = constants.d = 0.;
      return constants;
    }

    // J U' of the volumetric energies.
    double
    volumetric_stress(const MaterialParameters &material,
                      const double              lambda,
                      const double              J)
    {
      const auto *isotropic = material.selected<NeoHookeanParameters>();
      return isotropic &&
                 isotropic->volumetric_energy == VolumetricEnergy::ciarlet ?
               0.5 * lambda * (J * J - 1.) :
               lambda * std::log(J);
    }

    std::array<double, 3>
    principal_stresses(const MaterialParameters    &material,
                       const unsigned int           f,
                       const std::array<double, 3> &l)
    {
      const FiberBundleConstants m = constants_of(material);

      const double J     = l[0] * l[1] * l[2];
      const double log_J = std::log(J);
      const double I4    = l[f] * l[f];
      const double I5    = I4 * I4;

      std::array<double, 3> P;
      for (unsigned int i = 0; i < 3; ++i)
        P[i] = m.mu * l[i] +
               (volumetric_stress(material, m.lambda, J) - m.mu) / l[i] +
               (m.b * (I4 - 1.) - m.d * (I5 - 1.)) / l[i];
      P[f] += 2. * l[f] * (m.a + m.b * log_J + 2. * m.c * (I4 - 1.)) -
              4. * l[f] * I4 * (0.5 * m.a + m.d * log_J);
      return P;
    }

    // Newton's method for the free stretches. The Jacobian is a difference
    // quotient: it decides the number of iterations, not the root.
    void
    relax(const MaterialParameters        &material,
          const unsigned int               f,
          const std::vector<unsigned int> &free,
          std::array<double, 3>           &l)
    {
      const FiberBundleConstants m = constants_of(material);
      const double   round_off     = 1e-14 * (m.mu + m.lambda + std::abs(m.b));
      constexpr auto step          = 1e-6;
      for (unsigned int iteration = 0; iteration < 50; ++iteration)
        {
          const auto P       = principal_stresses(material, f, l);
          double     largest = 0;
          for (const unsigned int i : free)
            largest = std::max(largest, std::abs(P[i]));
          if (largest < round_off)
            return;

          // One or two unknowns.
          double K[2][2] = {{1., 0.}, {0., 1.}}, r[2] = {0., 0.};
          for (unsigned int b = 0; b < free.size(); ++b)
            {
              r[b]         = -P[free[b]];
              auto forward = l, backward = l;
              forward[free[b]] += step;
              backward[free[b]] -= step;
              const auto P_forward  = principal_stresses(material, f, forward);
              const auto P_backward = principal_stresses(material, f, backward);
              for (unsigned int a = 0; a < free.size(); ++a)
                K[a][b] =
                  (P_forward[free[a]] - P_backward[free[a]]) / (2. * step);
            }
          const double det   = K[0][0] * K[1][1] - K[0][1] * K[1][0];
          const double dl[2] = {(K[1][1] * r[0] - K[0][1] * r[1]) / det,
                                (K[0][0] * r[1] - K[1][0] * r[0]) / det};
          for (unsigned int b = 0; b < free.size(); ++b)
            l[free[b]] += dl[b];
          if (!(std::min({l[0], l[1], l[2]}) > 0.))
            break;
        }
      throw InputError("No stretch of the free directions makes them free of "
                       "stress; choose a smaller stretch.");
    }

    // With J = 1, f = F A, h = F^T f:  P = mu (F - F^{-T})
    //   + 2 [a + 2 c (I4-1)] f (x) A + [b (I4-1) - d (I5-1)] F^{-T}
    //   - a (f (x) h + F h (x) A),  F = 1 + g e1 (x) e2 inserted by hand.
    Tensor<2, 3>
    simple_shear_stress(const FiberBundleConstants &m,
                        const unsigned int          fiber_axis,
                        const double                g)
    {
      const double g2 = g * g;
      Tensor<2, 3> P;
      P[0][1] = P[1][0] = m.mu * g;
      if (fiber_axis == 0)
        {
          // I4 = 1, I5 = 1 + g^2
          P[0][0] += -(m.a + m.d) * g2;
          P[0][1] += -m.a * g;
          P[1][0] += -m.a * g + m.d * g * g2;
          P[1][1] += -m.d * g2;
          P[2][2] += -m.d * g2;
        }
      else if (fiber_axis == 1)
        {
          // I4 = 1 + g^2, I5 = g^2 + (1 + g^2)^2
          const double axial    = m.a + 2. * m.c * g2;
          const double pressure = m.b * g2 - m.d * (3. * g2 + g2 * g2);
          P[0][0] += pressure - m.a * g2;
          P[0][1] += 2. * axial * g - m.a * (3. * g + 2. * g * g2);
          P[1][0] += -pressure * g - m.a * g;
          P[1][1] += 2. * axial + pressure - 2. * m.a * (1. + g2);
          P[2][2] += pressure;
        }
      // A fiber across the plane of shear feels nothing: I4 = I5 = 1.
      return P;
    }
  } // namespace



  HomogeneousState
  homogeneous_state(const MaterialParameters &material,
                    const unsigned int        fiber_axis,
                    const HomogeneousMode     mode,
                    const double              amount)
  {
    AssertIndexRange(fiber_axis, 3u);

    HomogeneousState state;
    if (mode == HomogeneousMode::simple_shear)
      {
        state.F       = dealii::unit_symmetric_tensor<3>();
        state.F[0][1] = amount;
        state.P =
          simple_shear_stress(constants_of(material), fiber_axis, amount);
        return state;
      }
    std::array<double, 3>     l = {{amount, amount, amount}};
    std::vector<unsigned int> free;
    for (unsigned int i = mode == HomogeneousMode::uniaxial    ? 1 :
                          mode == HomogeneousMode::equibiaxial ? 2 :
                                                                 3;
         i < 3;
         ++i)
      {
        l[i] = 1.;
        free.push_back(i);
      }
    relax(material, fiber_axis, free, l);
    const auto P = principal_stresses(material, fiber_axis, l);
    for (unsigned int i = 0; i < 3; ++i)
      {
        state.F[i][i] = l[i];
        state.P[i][i] = P[i];
      }
    return state;
  }
} // namespace NPT
