// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of the material subsection of a parameter file.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/make_material.h>

#include <deal.II/base/parameter_handler.h>

#include <catch2/catch.hpp>

#include "material_test_tools.h"

using namespace NPT;
using namespace MaterialTests;

namespace
{
  MaterialParameters
  parse(const std::string &entries,
        const std::string &subsection = "Fiber bundle material")
  {
    MaterialParameters       parameters;
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm, subsection);
    prm.parse_input_from_string("subsection " + subsection + "\n" + entries +
                                "\nend\n");
    parameters.check(subsection);
    return parameters;
  }

  /// A law of which no other file knows: neo-Hookean with lambda = 0.
  struct CorkParameters final : public LawParameters
  {
    double shear_modulus = 7.;

    std::unique_ptr<LawParameters>
    clone() const override
    {
      return std::make_unique<CorkParameters>(*this);
    }

    void
    add_parameters(dealii::ParameterHandler &prm) override
    {
      add_parameter(prm,
                    "Cork modulus",
                    shear_modulus,
                    "Cork: shear modulus [MPa].",
                    positive_number());
    }

    void
    check(const std::string &subsection) const override
    {
      if (shear_modulus > 1e3)
        throw InputError("Cork modulus is too large (subsection " + subsection +
                         ").");
    }

    std::unique_ptr<HyperelasticLaw<2>>
    make_law(const dealii::Tensor<1, 2> &) const override
    {
      return std::make_unique<NeoHookean<2>>(
        NeoHookeanConstants{shear_modulus, 0.});
    }

    std::unique_ptr<HyperelasticLaw<3>>
    make_law(const dealii::Tensor<1, 3> &) const override
    {
      return std::make_unique<NeoHookean<3>>(
        NeoHookeanConstants{shear_modulus, 0.});
    }
  };

  const Registry<RegisteredLaw>::Registration
    cork("cork", {"the law of cork", []() {
                    return std::make_unique<CorkParameters>();
                  }});
} // namespace



TEST_CASE("An empty material subsection gives the fiber bundle of Table 1 with "
          "d > 0",
          "[material]")
{
  const auto law = make_material<3>(parse(""), first_axis<3>());
  CHECK(law->name() == "fiber bundle");

  const auto &bundle = dynamic_cast<const FiberBundleLaw<3> &>(*law);
  CHECK(bundle.fiber_direction() == first_axis<3>());
  CHECK(bundle.constants().mu == 3.2675);
  CHECK(bundle.constants().lambda == 3.9042);
  CHECK(bundle.constants().a == -2.3451);
  CHECK(bundle.constants().b == 16.167);
  CHECK(bundle.constants().c == 4.7881);
  CHECK(bundle.constants().d == 6.4613);
}



TEST_CASE("Entries of a parameter file reach the law they belong to",
          "[material]")
{
  const auto  bundle = make_material<2>(parse("set mu_iso = 1\n"
                                              "set lambda_iso = 2\n"
                                              "set a_trn = -3\n"
                                              "set b_trn = 4\n"
                                              "set c_trn = 5\n"
                                              "set d_trn = 1.5\n"),
                                       first_axis<2>());
  const auto &c = dynamic_cast<const FiberBundleLaw<2> &>(*bundle).constants();
  CHECK(c.mu == 1.);
  CHECK(c.lambda == 2.);
  CHECK(c.a == -3.);
  CHECK(c.b == 4.);
  CHECK(c.c == 5.);
  CHECK(c.d == 1.5);

  const auto isotropic = make_material<3>(parse("set Law = neo-Hookean\n"
                                                "set Young modulus = 26\n"
                                                "set Poisson ratio = 0.3\n",
                                                "Matrix material"),
                                          first_axis<3>());
  CHECK(isotropic->name() == "neo-Hookean");
  const auto &m = dynamic_cast<const NeoHookean<3> &>(*isotropic).constants();
  CHECK(m.mu == Approx(10.));
  CHECK(m.lambda == Approx(15.));
  CHECK(m.volumetric_energy == VolumetricEnergy::logarithm);

  const auto ciarlet = make_material<3>(parse("set Law = neo-Hookean\n"
                                              "set Volumetric energy = "
                                              "Ciarlet\n"),
                                        first_axis<3>());
  CHECK(ciarlet->name() == "neo-Hookean, Ciarlet");
}



TEST_CASE("The sign of d as printed in Table 1 is refused with the eigenvalue "
          "and the remedy",
          "[material]")
{
  CHECK_THROWS_AS(parse("set d_trn = -6.4613"), InputError);
  CHECK_THROWS_WITH(parse("set d_trn = -6.4613", "Warp material"),
                    Catch::Contains("lowest eigenvalue") &&
                      Catch::Contains("MPa") && Catch::Contains("d_trn") &&
                      Catch::Contains("subsection Warp material") &&
                      Catch::Contains("with d_trn = 6.4613") &&
                      Catch::Contains("misprint"));

  // No false advice: here it is G_L = mu - a that is negative.
  CHECK_THROWS_WITH(parse("set a_trn = 4"),
                    Catch::Contains("shear along the fiber") &&
                      Catch::Contains("-1.465 MPa") &&
                      !Catch::Contains("misprint"));
}



TEST_CASE("The lowest eigenvalue of the small-strain stiffness agrees with an "
          "eigenvalue test of the matrix",
          "[material]")
{
  std::mt19937                           generator(7);
  std::uniform_real_distribution<double> constant(-10., 10.);
  unsigned int                           n_stable = 0;
  for (unsigned int sample = 0; sample < 200; ++sample)
    {
      const FiberBundleConstants constants{std::abs(constant(generator)),
                                           constant(generator),
                                           constant(generator),
                                           constant(generator),
                                           constant(generator),
                                           constant(generator)};
      const double lowest = constants.lowest_stiffness_eigenvalue().value;

      // Cholesky of C - shift 1 in the orthonormal (Mandel) basis exists if
      // and only if shift is below the lowest eigenvalue.
      dealii::FullMatrix<double> C =
        FiberBundleLaw<3>(constants, random_direction<3>(generator))
          .small_strain_stiffness();
      for (unsigned int p = 0; p < 6; ++p)
        for (unsigned int q = 0; q < 6; ++q)
          C(p, q) *=
            (p < 3 ? 1. : std::sqrt(2.)) * (q < 3 ? 1. : std::sqrt(2.));
      const auto is_positive_definite_above = [&](const double shift) {
        dealii::FullMatrix<double> L = C;
        for (unsigned int p = 0; p < 6; ++p)
          for (unsigned int q = 0; q <= p; ++q)
            {
              double sum = C(p, q) - (p == q ? shift : 0.);
              for (unsigned int r = 0; r < q; ++r)
                sum -= L(p, r) * L(q, r);
              if (p == q && sum <= 0.)
                return false;
              L(p, q) = (p == q ? std::sqrt(sum) : sum / L(q, q));
            }
        return true;
      };
      CHECK(is_positive_definite_above(lowest - 1e-6));
      CHECK_FALSE(is_positive_definite_above(lowest + 1e-6));
      n_stable += (lowest > 0.);
    }
  CHECK(n_stable > 0);
  CHECK(n_stable < 200);
}



TEST_CASE("Young's modulus and Poisson's ratio out of range are refused by "
          "name",
          "[material]")
{
  const std::string isotropic = "set Law = neo-Hookean\n";
  for (const std::string nu : {"0.5", "-1", "0.7"})
    {
      CHECK_THROWS_AS(parse(isotropic + "set Poisson ratio = " + nu),
                      InputError);
      CHECK_THROWS_WITH(parse(isotropic + "set Poisson ratio = " + nu),
                        Catch::Contains("Poisson ratio is " + nu) &&
                          Catch::Contains("< 0.5") &&
                          Catch::Contains("subsection Fiber bundle material"));
    }
  CHECK_NOTHROW(parse(isotropic + "set Poisson ratio = 0.49"));
  CHECK_NOTHROW(parse(isotropic + "set Poisson ratio = -0.9"));
  CHECK_THROWS_WITH(parse(isotropic + "set Young modulus = 0"),
                    Catch::Contains("Young modulus is 0 MPa"));
  CHECK_THROWS_AS(parse(isotropic + "set Young modulus = -1"), InputError);

  // Constants of the law that is not selected are not looked at.
  CHECK_NOTHROW(parse("set Poisson ratio = 0.5"));
  CHECK_NOTHROW(parse(isotropic + "set d_trn = -6.4613"));
}



TEST_CASE("A law that registers itself is read, checked and made like the "
          "others",
          "[material]")
{
  const auto law =
    make_material<3>(parse("set Law = cork\nset Cork modulus = 3\n"),
                     first_axis<3>());
  // At rest the stiffness of shear is mu, and there is no contraction.
  const auto C = law->small_strain_stiffness();
  CHECK(C(3, 3) == Approx(3.));
  CHECK(C(0, 1) == Approx(0.).margin(1e-14));
  CHECK_THROWS_WITH(parse("set Law = cork\nset Cork modulus = 2000\n"),
                    Catch::Contains("Cork modulus is too large"));

  // It is offered where a law is chosen, and nothing stands in for a law that
  // is not there.
  MaterialParameters unknown("corck");
  CHECK_THROWS_WITH(make_material<3>(unknown, first_axis<3>()),
                    Catch::Contains("did you mean 'cork'"));
}
