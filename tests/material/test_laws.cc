// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the hyperelastic laws: derivatives, invariance, small
// strain, closed forms, and the failure at det F <= 0.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/dry_bundle_law.h>
#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/material/neo_hookean.h>

#include <deal.II/base/tensor.h>

#include <Sacado.hpp>
#include <catch2/catch.hpp>

#include <chrono>
#include <cstdio>
#include <limits>
#include <memory>
#include <vector>

#include "material_test_tools.h"

using namespace NPT;
using namespace MaterialTests;

namespace
{
  template <int dim>
  std::vector<std::unique_ptr<HyperelasticLaw<dim>>>
  all_laws(std::mt19937 &generator)
  {
    std::vector<std::unique_ptr<HyperelasticLaw<dim>>> laws;
    laws.push_back(std::make_unique<NeoHookean<dim>>(
      NeoHookeanConstants::from_young_and_poisson(100., 0.3)));
    laws.push_back(std::make_unique<NeoHookean<dim>>(
      NeoHookeanConstants::from_young_and_poisson(100.,
                                                  0.3,
                                                  VolumetricEnergy::ciarlet)));
    laws.push_back(
      std::make_unique<FiberBundleLaw<dim>>(FiberBundleConstants(),
                                            random_direction<dim>(generator)));
    // Moduli like those of the others, which the tolerances below are for, and
    // so loose that 20 % strain stays away from the closest packing.
    DryBundleConstants dry;
    dry.E_L   = 100.;
    dry.c     = 0.2;
    dry.eps_b = 0.2;
    dry.V_0   = 0.1;
    laws.push_back(
      std::make_unique<DryBundleLaw<dim>>(dry,
                                          random_direction<dim>(generator)));
    return laws;
  }



  // Central differences with the step h; error h^2 (third derivative)/6 plus
  // rounding 1e-16 / h.
  template <int dim>
  void
  check_by_differences(const HyperelasticLaw<dim> &law, const Tensor<2, dim> &F)
  {
    const double h = 1e-5;

    Tensor<2, dim> P, P_differences;
    Tensor<4, dim> A, A_differences;
    law.stress_and_tangent(F, P, A);
    for (unsigned int k = 0; k < dim; ++k)
      for (unsigned int L = 0; L < dim; ++L)
        {
          Tensor<2, dim> F_plus = F, F_minus = F, P_plus, P_minus;
          F_plus[k][L] += h;
          F_minus[k][L] -= h;
          P_differences[k][L] =
            (law.energy(F_plus) - law.energy(F_minus)) / (2. * h);
          law.stress(F_plus, P_plus);
          law.stress(F_minus, P_minus);
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int J = 0; J < dim; ++J)
              A_differences[i][J][k][L] =
                (P_plus[i][J] - P_minus[i][J]) / (2. * h);
        }

    // Moduli are some 100 MPa and vary over strains of some 0.1: h^2 gives
    // 1e-6 at most, rounding 1e-8.
    INFO(law.name());
    CHECK(max_difference(P, P_differences) < 2e-6);
    CHECK(max_difference(A, A_differences) < 2e-5);
  }



  // Second derivatives of the printed energy by nested forward automatic
  // differentiation.
  template <int dim>
  void
  check_by_automatic_differentiation(const HyperelasticLaw<dim> &law,
                                     const FiberBundleConstants &constants,
                                     const Tensor<1, dim>       &direction,
                                     const Tensor<2, dim>       &F)
  {
    constexpr int n = dim * dim;
    using First     = Sacado::Fad::SFad<double, n>;
    using Second    = Sacado::Fad::SFad<First, n>;

    std::array<Second, n> F_ad;
    for (int e = 0; e < n; ++e)
      {
        F_ad[e]       = Second(n, e, First(n, e, F[e / dim][e % dim]));
        F_ad[e].val() = First(n, e, F[e / dim][e % dim]);
      }
    const Second energy = printed_energy<dim>(constants, direction, F_ad);

    Tensor<2, dim> P, P_ad, P_only;
    Tensor<4, dim> A, A_ad;
    law.stress_and_tangent(F, P, A);
    law.stress(F, P_only);
    for (int r = 0; r < n; ++r)
      {
        P_ad[r / dim][r % dim] = energy.dx(r).val();
        for (int s = 0; s < n; ++s)
          A_ad[r / dim][r % dim][s / dim][s % dim] = energy.dx(r).dx(s);
      }

    // Moduli reach some 1000 MPa: 1e-11 is rounding.
    INFO(law.name());
    CHECK(law.energy(F) == Approx(energy.val().val()).epsilon(1e-12));
    CHECK(max_difference(P, P_ad) < 1e-11);
    CHECK(max_difference(P, P_only) < 1e-12);
    CHECK(max_difference(A, A_ad) < 1e-11);
  }



  template <int dim>
  void
  check_derivatives()
  {
    std::mt19937 generator(1);
    for (unsigned int sample = 0; sample < 5; ++sample)
      {
        const auto F = random_deformation<dim>(generator);
        for (const auto &law : all_laws<dim>(generator))
          check_by_differences(*law, F);

        const FiberBundleConstants constants;
        const auto                 direction = random_direction<dim>(generator);
        check_by_automatic_differentiation(
          FiberBundleLaw<dim>(constants, direction), constants, direction, F);

        // The isotropic law is the bundle's energy without (52).
        const auto m = NeoHookeanConstants::from_young_and_poisson(100., 0.3);
        const FiberBundleConstants isotropic{m.mu, m.lambda, 0., 0., 0., 0.};
        check_by_automatic_differentiation(NeoHookean<dim>(m),
                                           isotropic,
                                           direction,
                                           F);
      }
  }



  template <int dim>
  void
  check_invariance()
  {
    std::mt19937 generator(2);
    for (unsigned int sample = 0; sample < 5; ++sample)
      for (const auto &law : all_laws<dim>(generator))
        {
          const auto F = random_deformation<dim>(generator);
          const auto Q = random_rotation<dim>(generator);

          Tensor<2, dim> P, P_rotated;
          Tensor<4, dim> A;
          law->stress_and_tangent(F, P, A);
          law->stress(Q * F, P_rotated);

          INFO(law->name());
          CHECK(law->energy(Q * F) == Approx(law->energy(F)).epsilon(1e-11));
          CHECK(max_difference(P_rotated, Q * P) < 1e-11);

          // Balance of moment of momentum
          const Tensor<2, dim> tau = P * transpose(F);
          CHECK(max_difference(tau, transpose(tau)) < 1e-11);

          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int J = 0; J < dim; ++J)
              for (unsigned int k = 0; k < dim; ++k)
                for (unsigned int L = 0; L < dim; ++L)
                  CHECK(std::abs(A[i][J][k][L] - A[k][L][i][J]) < 1e-11);
        }
  }



  template <int dim>
  void
  check_inversion()
  {
    std::mt19937 generator(3);
    for (const auto &law : all_laws<dim>(generator))
      for (const double stretch : {0.,
                                   -0.1,
                                   std::numeric_limits<double>::quiet_NaN(),
                                   std::numeric_limits<double>::infinity()})
        {
          Tensor<2, dim> F = identity<dim>(), P;
          Tensor<4, dim> A;
          F[1][1] = stretch;

          INFO(law->name() << ", F_22 = " << stretch);
          CHECK_THROWS_AS(law->energy(F), InvertedCell);
          CHECK_THROWS_AS(law->stress(F, P), InvertedCell);
          CHECK_THROWS_AS(law->stress_and_tangent(F, P, A), InvertedCell);
        }
  }
} // namespace



TEST_CASE("Stress and tangent of every law are the derivatives of its energy",
          "[material]")
{
  check_derivatives<2>();
  check_derivatives<3>();
}



TEST_CASE("A rigid rotation turns the stress and leaves the energy, and the "
          "tangent has major symmetry",
          "[material]")
{
  check_invariance<2>();
  check_invariance<3>();
}



TEST_CASE("A deformation that is not invertible raises InvertedCell with its "
          "determinant",
          "[material]")
{
  check_inversion<2>();
  check_inversion<3>();

  const FiberBundleLaw<3> law(FiberBundleConstants(), first_axis<3>());
  Tensor<2, 3>            F = identity<3>(), P;
  F[2][2]                   = -0.25;
  CHECK_THROWS_WITH(law.stress(F, P), Catch::Contains("det F = -0.25"));
}



TEST_CASE("The fiber bundle is free of stress at rest for any constants",
          "[material]")
{
  std::mt19937                           generator(4);
  std::uniform_real_distribution<double> constant(-20., 20.);
  for (unsigned int sample = 0; sample < 10; ++sample)
    {
      const FiberBundleConstants constants{constant(generator),
                                           constant(generator),
                                           constant(generator),
                                           constant(generator),
                                           constant(generator),
                                           constant(generator)};
      const FiberBundleLaw<3>    law(constants, random_direction<3>(generator));

      Tensor<2, 3> P;
      law.stress(identity<3>(), P);
      CHECK(P.norm() < 1e-12);
      CHECK(std::abs(law.energy(identity<3>())) < 1e-12);

      // so is any rigidly rotated state
      law.stress(random_rotation<3>(generator), P);
      CHECK(P.norm() < 1e-11);
    }
}



TEST_CASE("Table 1 with d > 0 has E_L = 56.04, E_T = 8.28, G_L = 5.61, G_T = "
          "3.27 MPa and nu_LT = 0.725",
          "[material]")
{
  const EngineeringConstants m = FiberBundleConstants().engineering_constants();

  // half a unit of the last digit of the stated values
  CHECK(m.E_L == Approx(56.04).margin(0.005));
  CHECK(m.E_T == Approx(8.28).margin(0.005));
  CHECK(m.G_L == Approx(5.61).margin(0.005));
  CHECK(m.G_T == Approx(3.27).margin(0.005));
  CHECK(m.nu_LT == Approx(0.725).margin(0.0005));

  FiberBundleConstants printed;
  printed.d = -6.4613;
  CHECK(printed.engineering_constants().E_L == Approx(-363.).margin(0.5));
}



TEST_CASE("The engineering constants are those of the inverted tangent at rest",
          "[material]")
{
  const FiberBundleLaw<3>    law(FiberBundleConstants(), first_axis<3>());
  const EngineeringConstants m = law.engineering_constants();

  dealii::FullMatrix<double> S(6, 6);
  S.invert(law.small_strain_stiffness());
  CHECK(S(0, 0) == Approx(1. / m.E_L));
  CHECK(S(1, 1) == Approx(1. / m.E_T));
  CHECK(S(2, 2) == Approx(1. / m.E_T));
  CHECK(S(0, 1) == Approx(-m.nu_LT / m.E_L));
  CHECK(S(0, 2) == Approx(-m.nu_LT / m.E_L));
  CHECK(S(3, 3) == Approx(1. / m.G_T));
  CHECK(S(4, 4) == Approx(1. / m.G_L));
  CHECK(S(5, 5) == Approx(1. / m.G_L));
  CHECK(std::abs(S(0, 5)) < 1e-15);
  CHECK(std::abs(S(0, 3)) < 1e-15);
}



TEST_CASE("The small-strain stiffness of the fiber bundle follows from its "
          "constants in closed form",
          "[material]")
{
  const FiberBundleConstants       c;
  const FiberBundleLaw<3>          law(c, first_axis<3>());
  const dealii::FullMatrix<double> C = law.small_strain_stiffness();

  const double k = 2. * c.b - 4. * c.d;
  CHECK(C(0, 0) == Approx(c.lambda + 2. * c.mu + 8. * c.c + 2. * k - 4. * c.a));
  CHECK(C(0, 1) == Approx(c.lambda + k));
  CHECK(C(1, 1) == Approx(c.lambda + 2. * c.mu));
  CHECK(C(1, 2) == Approx(c.lambda));
  CHECK(C(3, 3) == Approx(c.mu));
  CHECK(C(4, 4) == Approx(c.mu - c.a));
  CHECK(C(5, 5) == Approx(c.mu - c.a));

  // Plane strain is the in-plane part of the same matrix.
  const FiberBundleLaw<2>          plane(c, first_axis<2>());
  const dealii::FullMatrix<double> C_plane = plane.small_strain_stiffness();
  CHECK(C_plane(0, 0) == Approx(C(0, 0)));
  CHECK(C_plane(0, 1) == Approx(C(0, 1)));
  CHECK(C_plane(1, 1) == Approx(C(1, 1)));
  CHECK(C_plane(2, 2) == Approx(C(5, 5)));
}



TEST_CASE("A fiber bundle stretched by 20 % with its sides held carries P11 = "
          "13.46 MPa",
          "[material]")
{
  const FiberBundleConstants c;
  const FiberBundleLaw<3>    law(c, first_axis<3>());

  const double s = 1.2;
  Tensor<2, 3> F = identity<3>(), P;
  F[0][0]        = s;
  law.stress(F, P);
  CHECK(P[0][0] == Approx(13.46).margin(0.005));

  // Closed form with I4 = s^2, I5 = s^4, J = s
  const double log_s = std::log(s), x = s * s - 1., y = s * s * s * s - 1.;
  CHECK(P[0][0] ==
        Approx(c.mu * (s - 1. / s) + c.lambda * log_s / s + c.b * x / s +
               (c.a + c.b * log_s + 2. * c.c * x) * 2. * s - c.d * y / s -
               (0.5 * c.a + c.d * log_s) * 4. * s * s * s));
  CHECK(P[1][1] == Approx(-c.mu + c.mu + c.lambda * log_s + c.b * x - c.d * y));
  CHECK(P[2][2] == Approx(P[1][1]));
  CHECK(std::abs(P[0][1]) < 1e-14);
}



TEST_CASE("The neo-Hookean law has the closed form of uniaxial stretch and the "
          "given Young's modulus and Poisson's ratio",
          "[material]")
{
  const double E = 10., nu = 0.3;
  const auto   m = NeoHookeanConstants::from_young_and_poisson(E, nu);
  CHECK(m.mu == Approx(E / 2.6));
  CHECK(m.lambda == Approx(E * nu / (1.3 * 0.4)));
  const NeoHookean<3> law(m);

  Tensor<2, 3> F = identity<3>(), P;
  for (const double s : {0.6, 1.5})
    {
      F[0][0] = s;
      law.stress(F, P);
      CHECK(P[0][0] ==
            Approx(m.mu * (s - 1. / s) + m.lambda * std::log(s) / s));
      CHECK(P[1][1] == Approx(m.lambda * std::log(s)));
    }

  dealii::FullMatrix<double> S(6, 6);
  S.invert(law.small_strain_stiffness());
  CHECK(S(0, 0) == Approx(1. / E));
  CHECK(S(0, 1) == Approx(-nu / E));
  CHECK(S(3, 3) == Approx(1. / m.mu));
}



TEST_CASE("The neo-Hookean law of Ciarlet has the closed form of dilation and "
          "differs from the logarithmic one in the third order of ln J",
          "[material]")
{
  const auto logarithm = NeoHookeanConstants::from_young_and_poisson(10., 0.3);
  const auto ciarlet =
    NeoHookeanConstants::from_young_and_poisson(10.,
                                                0.3,
                                                VolumetricEnergy::ciarlet);
  const NeoHookean<3> law_1(logarithm), law_2(ciarlet);

  Tensor<2, 3> P;
  for (const double s : {0.7, 1.4})
    {
      const Tensor<2, 3> F  = s * identity<3>();
      const double       J2 = std::pow(s, 6);
      law_2.stress(F, P);
      CHECK(P[0][0] == Approx(ciarlet.mu * (s - 1. / s) +
                              0.5 * ciarlet.lambda * (J2 - 1.) / s));
      CHECK(std::abs(P[0][1]) < 1e-14);
    }

  // U_2 - U_1 = lambda (ln J)^3 / 3 (1 + (ln J)/2 + ...)
  const double log_J      = 1e-3;
  const auto   F          = std::exp(log_J / 3.) * identity<3>();
  const double difference = law_2.energy(F) - law_1.energy(F);
  CHECK(difference ==
        Approx(ciarlet.lambda * std::pow(log_J, 3) / 3. * (1. + 0.5 * log_J))
          .epsilon(1e-5));
}



TEST_CASE("Plane strain is the three-dimensional law with F33 = 1",
          "[material]")
{
  std::mt19937       generator(5);
  const auto         F2 = random_deformation<2>(generator);
  const auto         A2 = random_direction<2>(generator);
  const Tensor<1, 3> A3({A2[0], A2[1], 0.});
  Tensor<2, 3>       F3 = identity<3>(), P3;
  Tensor<2, 2>       P2;
  for (unsigned int i = 0; i < 2; ++i)
    for (unsigned int J = 0; J < 2; ++J)
      F3[i][J] = F2[i][J];

  const auto compare = [&](const HyperelasticLaw<2> &plane,
                           const HyperelasticLaw<3> &law) {
    CHECK(plane.energy(F2) == Approx(law.energy(F3)));
    plane.stress(F2, P2);
    law.stress(F3, P3);
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int J = 0; J < 2; ++J)
        CHECK(P2[i][J] == Approx(P3[i][J]));
  };
  compare(FiberBundleLaw<2>(FiberBundleConstants(), A2),
          FiberBundleLaw<3>(FiberBundleConstants(), A3));
  compare(NeoHookean<2>({1., 2.}), NeoHookean<3>({1., 2.}));
  compare(DryBundleLaw<2>(DryBundleConstants(), A2),
          DryBundleLaw<3>(DryBundleConstants(), A3));
}



TEST_CASE("A fiber direction that is not a unit vector is refused",
          "[material]")
{
  CHECK_THROWS_WITH(FiberBundleLaw<3>(FiberBundleConstants(),
                                      2. * first_axis<3>()),
                    Catch::Contains("unit vector"));
}



TEST_CASE("Stress and tangent of the fiber bundle cost less than a microsecond "
          "per point",
          "[.benchmark][material]")
{
  std::mt19937       generator(6);
  const unsigned int n_points = 64, n_repetitions = 20000;

  std::vector<std::array<double, 9>> Fs(n_points);
  for (auto &F : Fs)
    {
      const auto T = random_deformation<3>(generator);
      for (unsigned int e = 0; e < 9; ++e)
        F[e] = T[e / 3][e % 3];
    }

  for (const auto &law : all_laws<3>(generator))
    {
      double     P[9], A[81], sum = 0.;
      const auto measure = [&](const auto &evaluate) {
        const auto start = std::chrono::steady_clock::now();
        for (unsigned int repetition = 0; repetition < n_repetitions;
             ++repetition)
          for (const auto &F : Fs)
            {
              evaluate(F.data());
              sum += P[0];
            }
        return std::chrono::duration<double, std::nano>(
                 std::chrono::steady_clock::now() - start)
                 .count() /
               n_points / n_repetitions;
      };
      const double both =
        measure([&](const double *F) { law->stress_and_tangent(F, P, A); });
      const double stress =
        measure([&](const double *F) { law->stress(F, P); });
      std::printf("%s: stress and tangent %.0f ns, stress %.0f ns per point\n",
                  law->name().c_str(),
                  both,
                  stress);
      CHECK(std::isfinite(sum));
      CHECK(both < 1000.);
      CHECK(stress < both);
    }
}
