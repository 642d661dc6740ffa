// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the law of dry bundles (A30)-(A32), of the formulas for
// the bending of bundles (A33), (A34), and of their entries.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/bundle_bending.h>
#include <npt_dealii/material/dry_bundle_law.h>
#include <npt_dealii/material/ellipticity.h>
#include <npt_dealii/material/make_material.h>

#include <deal.II/base/numbers.h>
#include <deal.II/base/parameter_handler.h>

#include <Sacado.hpp>
#include <catch2/catch.hpp>

#include "material_test_tools.h"

using namespace NPT;
using namespace MaterialTests;

namespace
{
  DryBundleConstants
  buckling_glass()
  {
    DryBundleConstants m;
    m.c     = 1e-3;
    m.eps_b = 1e-4;
    return m;
  }



  // (A31), (A32) written independently of the library, for any number type.
  template <typename Number>
  Number
  printed_fibers(const DryBundleConstants &m, const Number &e)
  {
    using std::sqrt;
    const Number straight = 0.5 * m.E_L * e * e;
    if (e >= 0.)
      return straight;
    return m.c * straight + (1. - m.c) * m.E_L * m.eps_b * m.eps_b *
                              (sqrt(1. + e * e / (m.eps_b * m.eps_b)) - 1.);
  }

  template <typename Number>
  Number
  printed_compaction(const DryBundleConstants &m, const Number &j)
  {
    using std::sqrt;
    if (j >= 1.)
      return 0.5 * m.K_T() * (j - 1.) * (j - 1.);
    // The integral of (A32) by partial fractions in y = sqrt(V_a/V) - 1.
    const double y0 = std::sqrt(m.V_a / m.V_0) - 1.;
    const Number y  = sqrt(j * m.V_a / m.V_0) - 1.;
    return 4. * m.K_T() * std::pow(y0, 4) * (m.V_0 / m.V_a) *
           (1. / (6. * y0 * y0) + y0 / (3. * y * y * y) - 1. / (2. * y * y));
  }



  // (A30) by C alone: stretch of the fiber, and the part of C that is left for
  // lines normal to it. Independent of the invariants of the library.
  template <typename Number>
  Number
  printed_dry_energy(const DryBundleConstants    &m,
                     const Tensor<1, 3>          &A,
                     const std::array<Number, 9> &F)
  {
    using std::sqrt;
    // Two unit vectors across the fiber.
    Tensor<1, 3> axis;
    axis[std::abs(A[0]) < 0.6 ? 0 : 1] = 1.;
    const Tensor<1, 3> b =
      cross_product_3d(A, axis) / cross_product_3d(A, axis).norm();
    const Tensor<1, 3> c = cross_product_3d(A, b);

    const auto product = [&](const Tensor<1, 3> &a, const Tensor<1, 3> &d) {
      Number sum = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        {
          Number Fa = 0., Fd = 0.;
          for (unsigned int J = 0; J < 3; ++J)
            {
              Fa += F[3 * i + J] * a[J];
              Fd += F[3 * i + J] * d[J];
            }
          sum += Fa * Fd;
        }
      return sum;
    };
    const Number AA = product(A, A), Ab = product(A, b), Ac = product(A, c);
    const Number S_bb = product(b, b) - Ab * Ab / AA;
    const Number S_cc = product(c, c) - Ac * Ac / AA;
    const Number S_bc = product(b, c) - Ab * Ac / AA;
    const Number j    = sqrt(S_bb * S_cc - S_bc * S_bc);
    return printed_fibers<Number>(m, sqrt(AA) - 1.) +
           printed_compaction<Number>(m, j) +
           0.5 * m.G_T() * ((S_bb + S_cc) / j - 2.) +
           0.5 * m.G_L * (Ab * Ab + Ac * Ac) / (AA * AA);
  }



  Tensor<2, 3>
  diagonal(const double a, const double b, const double c)
  {
    Tensor<2, 3> F;
    F[0][0] = a;
    F[1][1] = b;
    F[2][2] = c;
    return F;
  }

  double
  fiber_stress(const DryBundleConstants &m, const double lambda)
  {
    Tensor<2, 3> P;
    DryBundleLaw<3>(m, first_axis<3>()).stress(diagonal(lambda, 1., 1.), P);
    return P[0][0];
  }

  // True pressure on the sides of a bundle with the fiber fraction V.
  double
  pressure(const DryBundleConstants &m, const double V)
  {
    const double s = std::sqrt(m.V_0 / V);
    Tensor<2, 3> P;
    DryBundleLaw<3>(m, first_axis<3>()).stress(diagonal(1., s, s), P);
    return -P[1][1] / s;
  }

  double
  lowest_eigenvalue(const DryBundleConstants &m, const Tensor<2, 3> &F)
  {
    return lowest_acoustic_eigenvalue(DryBundleLaw<3>(m, first_axis<3>()), F)
      .value;
  }

  MaterialParameters
  parse_dry(const std::string &entries)
  {
    MaterialParameters       parameters;
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    prm.parse_input_from_string(
      "subsection Fiber bundle material\nset Law = dry bundle\n" + entries +
      "\nend\n");
    parameters.check();
    return parameters;
  }

  DryBundleConstants
  dry_constants(const std::string &entries)
  {
    return parse_dry(entries).constants<DryBundleParameters>().constants();
  }
} // namespace



TEST_CASE("Energy, stress and tangent of the dry bundle are those of the "
          "printed energy by automatic differentiation, with fibers of glass",
          "[material]")
{
  using First  = Sacado::Fad::SFad<double, 9>;
  using Second = Sacado::Fad::SFad<First, 9>;

  const DryBundleConstants m = buckling_glass();
  std::mt19937             generator(11);
  unsigned int             n_buckled = 0, n_compacted = 0;
  for (unsigned int sample = 0; sample < 20; ++sample)
    {
      const auto            A = random_direction<3>(generator);
      const DryBundleLaw<3> law(m, A);
      // The closest packing goes on with its tangent from j = .773.
      const auto F = identity<3>() + random_tensor<3>(generator, 0.06);

      std::array<Second, 9> F_ad;
      for (int e = 0; e < 9; ++e)
        {
          F_ad[e]       = Second(9, e, First(9, e, F[e / 3][e % 3]));
          F_ad[e].val() = First(9, e, F[e / 3][e % 3]);
        }
      const Second Psi = printed_dry_energy<Second>(m, A, F_ad);

      Tensor<2, 3> P, P_only;
      Tensor<4, 3> tangent;
      law.stress_and_tangent(F, P, tangent);
      law.stress(F, P_only);
      CHECK(law.energy(F) == Approx(Psi.val().val()).epsilon(1e-10));
      CHECK(max_difference(P, P_only) == 0.);
      // Moduli are 43200 MPa.
      for (int r = 0; r < 9; ++r)
        {
          CHECK(P[r / 3][r % 3] == Approx(Psi.dx(r).val()).margin(1e-8));
          for (int s = 0; s < 9; ++s)
            CHECK(tangent[r / 3][r % 3][s / 3][s % 3] ==
                  Approx(Psi.dx(r).dx(s)).margin(1e-7));
        }
      const double lambda = (F * A).norm();
      n_buckled += lambda < 1.;
      n_compacted += determinant(F) / lambda < 1.;
    }
  CHECK((n_buckled > 2 && n_buckled < 18));
  CHECK((n_compacted > 2 && n_compacted < 18));
}



TEST_CASE("At rest the dry bundle is the transversely isotropic solid of its "
          "data, free of stress",
          "[material]")
{
  const DryBundleConstants m = buckling_glass();
  const DryBundleLaw<3>    law(m, first_axis<3>());
  Tensor<2, 3>             P;
  law.stress(identity<3>(), P);
  CHECK(P.norm() < 1e-13);
  CHECK(law.energy(identity<3>()) == 0.);

  dealii::FullMatrix<double> S(6, 6);
  S.invert(law.small_strain_stiffness());
  CHECK(S(0, 0) == Approx(1. / m.E_L));
  CHECK(S(1, 1) == Approx(1. / m.E_T));
  CHECK(S(2, 2) == Approx(1. / m.E_T));
  CHECK(S(1, 2) == Approx(-m.nu_T / m.E_T));
  CHECK(std::abs(S(0, 1)) < 1e-12);
  CHECK(S(3, 3) == Approx(1. / m.G_T()));
  CHECK(S(4, 4) == Approx(1. / m.G_L));
  CHECK(S(5, 5) == Approx(1. / m.G_L));

  // No deformation has less energy than rest.
  std::mt19937 generator(12);
  for (unsigned int sample = 0; sample < 50; ++sample)
    CHECK(law.energy(random_deformation<3>(generator)) > 0.);
}



TEST_CASE("A pulled dry bundle has the force of its fibers and keeps its "
          "section; a pressed one bears the buckling stress of its fibers",
          "[material]")
{
  DryBundleConstants m = buckling_glass();
  CHECK(fiber_stress(m, 1.02) == Approx(m.E_L * 0.02));
  Tensor<2, 3> P;
  DryBundleLaw<3>(m, first_axis<3>()).stress(diagonal(1.02, 1., 1.), P);
  CHECK(std::abs(P[1][1]) < 1e-12);

  // Far below the buckling strain as in tension; far beyond it the stress is
  // the buckling stress and the modulus c E_L.
  CHECK(fiber_stress(m, 1. - 1e-6) == Approx(-m.E_L * 1e-6).epsilon(1e-4));
  const double buckling = (1. - m.c) * m.E_L * m.eps_b;
  CHECK(fiber_stress(m, 0.95) ==
        Approx(-buckling - m.c * m.E_L * 0.05).epsilon(1e-4));

  m.c = 1.;
  CHECK(fiber_stress(m, 0.95) == Approx(-m.E_L * 0.05));
}



TEST_CASE(
  "The pressure on a dry bundle is Gutowski's, and beyond all bounds at "
  "the closest packing",
  "[material]")
{
  DryBundleConstants m;
  const double       y0   = std::sqrt(m.V_a / m.V_0) - 1.;
  double             last = 0.;
  for (const double V : {0.61, 0.65, 0.7, 0.75, 0.77})
    {
      const double p = 2. * m.K_T() * std::pow(y0, 4) *
                       (std::sqrt(V / m.V_0) - 1.) /
                       std::pow(std::sqrt(m.V_a / V) - 1., 4);
      CHECK(pressure(m, V) == Approx(p));
      CHECK(p > last);
      last = p;
    }
  // From a tenth of sqrt(V_a/V) - 1 on, the pressure goes on linearly.
  CHECK(pressure(m, 0.78) > 1e3 * m.K_T());
  CHECK(pressure(m, 0.9) > 1e4 * m.K_T());
}



TEST_CASE("Sliding along the fibers takes G_L gamma and no other stress than "
          "that of the turned fibers",
          "[material]")
{
  const DryBundleConstants m;
  Tensor<2, 3>             F = identity<3>(), P;
  F[0][1]                    = 0.8;
  DryBundleLaw<3>(m, first_axis<3>()).stress(F, P);
  CHECK(P[0][1] == Approx(m.G_L * 0.8));
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int J = 0; J < 3; ++J)
      if (J != 0 && !(i == 0 && J == 1))
        CHECK(std::abs(P[i][J]) < 1e-12);
}



TEST_CASE("Stress and tangent of the dry bundle are continuous where fibers "
          "slacken, where the section begins to open, and near the closest "
          "packing",
          "[material]")
{
  const DryBundleConstants m = buckling_glass();
  const DryBundleLaw<3>    law(m, first_axis<3>());
  const double             y0     = std::sqrt(m.V_a / m.V_0) - 1.;
  const double             x_last = 1. - 0.9 * y0 / (1. + y0); // sqrt(j)
  const double             h      = 1e-10;
  const auto jump = [&](const Tensor<2, 3> &at, const Tensor<2, 3> &step) {
    Tensor<2, 3> P_before, P_after;
    Tensor<4, 3> A_before, A_after;
    law.stress_and_tangent(at - h * step, P_before, A_before);
    law.stress_and_tangent(at + h * step, P_after, A_after);
    return std::make_pair(max_difference(P_before, P_after) / P_after.norm(),
                          max_difference(A_before, A_after) / A_after.norm());
  };
  CHECK(jump(identity<3>(), diagonal(1., 0., 0.)).second < 1e-6);
  CHECK(jump(identity<3>(), diagonal(0., 1., 1.)).second < 1e-6);
  const auto packed = jump(diagonal(1., x_last, x_last), diagonal(0., 1., 1.));
  CHECK(packed.first < 1e-6);
  CHECK(packed.second < 1e-6);
}



TEST_CASE("Fibers that do not buckle lose ellipticity by a kink band at the "
          "strain G_L / E_L; those that buckle below G_L do not",
          "[material]")
{
  DryBundleConstants m;
  // W_f' / lambda + G_L / lambda^4 = 0
  double lambda = 1.;
  for (unsigned int iteration = 0; iteration < 20; ++iteration)
    lambda = 1. - m.G_L / (m.E_L * lambda * lambda * lambda);
  CHECK(lowest_eigenvalue(m, diagonal(lambda + 1e-6, 1., 1.)) > 0.);
  CHECK(lowest_eigenvalue(m, diagonal(lambda - 1e-6, 1., 1.)) < 0.);
  const auto lowest =
    lowest_acoustic_eigenvalue(DryBundleLaw<3>(m, first_axis<3>()),
                               diagonal(0.99, 1., 1.));
  CHECK(std::abs(lowest.normal[0]) == Approx(1.));
  CHECK(std::abs(lowest.polarization[0]) < 1e-5);

  m.c     = 1e-4;
  m.eps_b = 0.5 * m.G_L / m.E_L;
  for (const double s : {0.999, 0.98, 0.95})
    CHECK(lowest_eigenvalue(m, diagonal(s, 1., 1.)) > 0.);
}



TEST_CASE("The dry bundle stays elliptic in tension, compaction and sliding",
          "[material]")
{
  DryBundleConstants m = buckling_glass();
  for (const double s : {1.001, 1.05, 1.2})
    CHECK(lowest_eigenvalue(m, diagonal(s, 1., 1.)) > 0.);
  for (const double s : {0.99, 0.95, 0.9})
    {
      CHECK(lowest_eigenvalue(m, diagonal(1., s, s)) > 0.);
      CHECK(lowest_eigenvalue(m, diagonal(1., s, 1.)) > 0.);
    }
  for (const double gamma : {0.1, 0.3, 0.8})
    {
      Tensor<2, 3> F = identity<3>();
      F[0][1]        = gamma;
      CHECK(lowest_eigenvalue(m, F) > 0.);
    }
}



TEST_CASE(
  "A strip that slides bends as a solid for a large shear modulus, as a "
  "stack of layers for a small one, and the inverse finds the modulus",
  "[material]")
{
  const double E = 4e4, slenderness = 0.11;
  const double k2 = std::pow(dealii::numbers::PI * slenderness, 2); // (k t)^2
  CHECK(bending_ratio(E, 1e6 * E, slenderness) == Approx(1.));
  for (const double G : {1e-6, 1e-4})
    CHECK(bending_ratio(E, G, slenderness) ==
          Approx(12. * G / (E * k2)).epsilon(0.01));
  // Its first correction is that of Timoshenko's beam with the factor 5/6.
  const double G = 100. * E;
  CHECK(1. / bending_ratio(E, G, slenderness) - 1. ==
        Approx(k2 * E / (12. * 5. / 6. * G)).epsilon(1e-4));

  for (const double ratio : {1e-4, 0.01, 0.3, 0.9, 0.9999})
    CHECK(bending_ratio(E,
                        shear_modulus_for_bending(E, ratio, slenderness),
                        slenderness) == Approx(ratio).epsilon(1e-10));
}



TEST_CASE("The double modulus is that of equal moduli, and four times the "
          "smaller one if the other is much larger",
          "[material]")
{
  CHECK(double_modulus(3., 3.) == Approx(3.));
  CHECK(double_modulus(1e12, 3.) == Approx(12.).epsilon(1e-5));
  CHECK(loose_bending_ratio(0.02, 0.6) == Approx(0.75 / 900.));
}



TEST_CASE("Entries of a data sheet become the constants of the dry bundle",
          "[material]")
{
  const auto m = dry_constants("set Fiber modulus = 70000\n"
                               "set Fiber fraction = 0.5\n"
                               "set Transverse modulus = 8\n"
                               "set Transverse Poisson ratio = 0.6\n"
                               "set Longitudinal shear modulus = 2\n"
                               "set Compression ratio = 0.01\n"
                               "set Buckling strain = 0.0002\n");
  CHECK(m.E_L == Approx(35000.));
  CHECK(m.V_0 == 0.5);
  CHECK(m.V_a == 0.8);
  CHECK(m.G_L == 2.);
  CHECK(m.G_T() == Approx(2.5));
  CHECK(m.K_T() == Approx(10.));
  CHECK(m.c == 0.01);
  CHECK(m.eps_b == 0.0002);

  // 1200 tex of glass of 2.5 g/cm^3 have .48 mm^2.
  const auto by_tex = dry_constants("set Bundle tex = 1200\n"
                                    "set Fiber density = 2.5\n"
                                    "set Bundle area = 0.8\n");
  CHECK(by_tex.V_0 == Approx(0.6));
  CHECK(fiber_fraction(1200., 2.5, 0.8) == Approx(0.6));

  // Fibers buckle below G_L, unless the file says when.
  const auto buckling = dry_constants("set Compression ratio = 0.2\n");
  CHECK(0.8 * buckling.E_L * buckling.eps_b == Approx(0.5 * buckling.G_L));

  const auto bent = dry_constants("set Bending ratio = 0.01\n"
                                  "set Bending slenderness = 0.1\n");
  CHECK(bending_ratio(bent.E_L, bent.G_L, 0.1) == Approx(0.01));
}



TEST_CASE("Entries with which a dry bundle is no stable solid, or that its "
          "closest packing does not hold, are refused by name",
          "[material]")
{
  CHECK_THROWS_WITH(parse_dry("set Fiber fraction = 0.85"),
                    Catch::Contains("Fiber fraction is 0.85") &&
                      Catch::Contains("less than Fiber fraction limit, 0.8"));
  CHECK_THROWS_WITH(parse_dry("set Bundle tex = 2000\nset Bundle area = 0.8"),
                    Catch::Contains("Bundle tex, Fiber density and Bundle area "
                                    "is 0.98") &&
                      Catch::Contains("enlarge Bundle area"));
  CHECK_THROWS_WITH(parse_dry("set Bundle tex = 2000"),
                    Catch::Contains("Bundle area is 0; it must be > 0"));
  CHECK_THROWS_WITH(parse_dry("set Compression ratio = 0"),
                    Catch::Contains("Compression ratio is 0"));
  CHECK_THROWS_WITH(parse_dry("set Transverse Poisson ratio = 1"),
                    Catch::Contains("Transverse Poisson ratio is 1"));
  CHECK_THROWS_WITH(parse_dry("set Bending ratio = 0.1"),
                    Catch::Contains("Bending slenderness is 0"));
  CHECK_THROWS_WITH(parse_dry("set Bending ratio = 1"),
                    Catch::Contains("it must be >= 0 and < 1"));
  CHECK_THROWS_AS(parse_dry("set Longitudinal shear modulus = 0"), InputError);
}
