// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of numerical material testing: identities, bounds, convergence, and
// the chain from fibers and matrix to the bundle law.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/material/dry_bundle_law.h>
#include <npt_dealii/problems/material_test/composite_bounds.h>
#include <npt_dealii/problems/material_test/numerical_material_testing.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <map>
#include <sstream>

namespace
{
  using namespace NPT;
  using dealii::FullMatrix;
  using dealii::Tensor;

  MaterialTestParameters
  parameters_with(const std::vector<std::string> &overrides)
  {
    // Small by default: tests of identities need no accuracy. An entry may be
    // given only once, so later ones replace earlier ones here.
    std::map<std::string, std::string> entries{
      {"Micro mesh/Elements around", "2"},
      {"Micro mesh/Elements in fiber", "1"},
      {"Micro mesh/Elements in matrix", "1"},
      {"Micro mesh/Additional Gauss points", "0"},
      {"Material tests/Identify", "false"},
      {"Material tests/Tests", "none"}};
    for (const std::string &entry : overrides)
      entries[entry.substr(0, entry.find('='))] =
        entry.substr(entry.find('=') + 1);
    std::vector<std::string> all;
    for (const auto &entry : entries)
      all.push_back(entry.first + "=" + entry.second);
    return MaterialTestParameters::read(ParameterText(), all);
  }

  std::unique_ptr<NumericalMaterialTesting>
  run(const std::vector<std::string> &overrides)
  {
    static std::ostringstream screen;
    auto                      test =
      std::make_unique<NumericalMaterialTesting>(parameters_with(overrides),
                                                 "",
                                                 screen);
    test->run();
    return test;
  }

  // One load step to the given targets.
  std::vector<std::string>
  one_step(const std::string              &targets,
           const std::vector<std::string> &more = {})
  {
    std::vector<std::string> result{"Material tests/Tests=t",
                                    "Material tests/Test t/Targets=" + targets,
                                    "Material tests/Test t/Initial step=0.5",
                                    "Material tests/Test t/Maximum step=0.5"};
    result.insert(result.end(), more.begin(), more.end());
    return result;
  }

  const std::string general = "H11: 0.06, H12: 0.05, H13: -0.04, H21: 0.03, "
                              "H22: 0.05, H23: 0.08, H31: 0.02, H32: -0.03, "
                              "H33: -0.04";

  double
  difference(const Tensor<2, 3> &a, const Tensor<2, 3> &b)
  {
    return (a - b).norm() / b.norm();
  }

  double
  difference(const FullMatrix<double> &a, const FullMatrix<double> &b)
  {
    FullMatrix<double> d(a);
    d.add(-1., b);
    return d.frobenius_norm() / b.frobenius_norm();
  }

  struct Moduli
  {
    explicit Moduli(const FullMatrix<double> &C)
    {
      FullMatrix<double> S(6, 6);
      S.invert(C);
      E_1  = 1. / S(0, 0);
      E_2  = 1. / S(1, 1);
      k_T  = 0.5 * (C(1, 1) + C(1, 2));
      G_12 = C(5, 5);
      G_23 = C(3, 3);
      G_45 = 0.5 * (C(1, 1) - C(1, 2)); // shear at 45 degrees
    }
    double E_1, E_2, k_T, G_12, G_23, G_45;
  };

  bool
  inside(const double value, const Interval &bounds)
  {
    return value >= bounds.lower * (1. - 1e-9) &&
           value <= bounds.upper * (1. + 1e-9);
  }

  Tensor<2, 3>
  identity()
  {
    Tensor<2, 3> one;
    for (unsigned int i = 0; i < 3; ++i)
      one[i][i] = 1.;
    return one;
  }
} // namespace



TEST_CASE("A cell that is dry bundle all over has the stress of the law, with "
          "buckled fibers, compaction and sliding",
          "[top]")
{
  std::vector<std::string> entries =
    one_step("H11: -0.001, H13: 0.1, H22: -0.03, H33: -0.05");
  for (const std::string material : {"Fiber", "Matrix"})
    for (const std::string entry : {"Law=dry bundle",
                                    "Compression ratio=0.01",
                                    "Longitudinal shear modulus=4"})
      entries.push_back(material + " material/" + entry);
  const auto test = run(entries);

  DryBundleParameters dry;
  dry.compression_ratio = 0.01;
  dry.shear_modulus     = 4.;
  Tensor<2, 3> F, P;
  F[0][0] = 0.999;
  F[0][2] = 0.1;
  F[1][1] = 0.97;
  F[2][2] = 0.95;
  dry.make_law(dealii::Point<3>::unit_vector(0))->stress(F, P);
  // Newton's method stops at 1e-10 of forces; the modulus along the fibers is
  // 10^4 times the stress.
  CHECK(difference(test->rows().back().P, P) < 1e-6);
}



TEST_CASE("A cell of one material has the stress of that material", "[top]")
{
  const NeoHookean<3> law(NeoHookeanConstants::from_young_and_poisson(7., 0.3));
  for (const std::string packing : {"square", "hexagonal"})
    for (const std::string basis : {"NURBS", "Lagrange"})
      {
        const auto test =
          run(one_step(general,
                       {"Micro cell/Packing=" + packing,
                        "Micro mesh/Basis=" + basis,
                        "Micro mesh/Additional Gauss points=5",
                        "Material tests/Uniform along fiber=false",
                        "Fiber material/Young modulus=7",
                        "Matrix material/Young modulus=7"}));
        const auto  &row = test->rows().back();
        Tensor<2, 3> P;
        law.stress(identity() + row.H, P);
        CHECK(difference(row.P, P) < 1e-11);
        CHECK(difference(row.P_average, P) < 1e-11);
        CHECK(row.energy == Approx(law.energy(identity() + row.H)));
      }
}



TEST_CASE("Macroscopic stress, power and moment close to solver accuracy",
          "[top]")
{
  for (const std::string packing : {"square", "hexagonal"})
    for (const std::string uniform : {"true", "false"})
      {
        const auto test =
          run(one_step(general,
                       {"Micro cell/Packing=" + packing,
                        "Newton/Relative tolerance=1e-12",
                        "Material tests/Uniform along fiber=" + uniform}));
        const auto        &row = test->rows().back();
        const Tensor<2, 3> F   = identity() + row.H;
        // Reactions against averages, and Hill-Mandel: <P : F> = <P> : <F>.
        CHECK(difference(row.P, row.P_average) < 1e-9);
        CHECK(row.P_times_F == Approx(scalar_product(row.P, F)).epsilon(1e-9));
        const Tensor<2, 3> tau = row.P * transpose(F);
        CHECK((tau - transpose(tau)).norm() < 1e-9 * tau.norm());

        FullMatrix<double> A = test->macroscopic_tangent(), At(A);
        At.copy_transposed(A);
        CHECK(difference(A, At) < 1e-9);
      }
}



TEST_CASE("The macroscopic tangent is the derivative of the stress", "[top]")
{
  const auto stress = [](const double H12) {
    return run(one_step("H11: 0.1, H22: 0.05, H12: " + std::to_string(H12),
                        {"Newton/Relative tolerance=1e-12"}));
  };
  const double h  = 1e-3;
  const auto   at = stress(0.1), up = stress(0.1 + h), down = stress(0.1 - h);
  const FullMatrix<double> A = at->macroscopic_tangent();
  const Tensor<2, 3>       dP =
    (up->rows().back().P - down->rows().back().P) / (2. * h);
  for (unsigned int e = 0; e < 9; ++e)
    CHECK(A(e, 1) == Approx(dP[e / 3][e % 3]).epsilon(1e-4).margin(1e-5));
}



TEST_CASE("Results do not depend on the choice of the cell", "[top]")
{
  for (const std::string packing : {"square", "hexagonal"})
    {
      const auto reference = run(one_step(general,
                                          {"Micro cell/Packing=" + packing,
                                           "Newton/Relative tolerance=1e-12"}));
      for (const std::string n : {"2", "4"})
        {
          const auto other = run(one_step(general,
                                          {"Micro cell/Packing=" + packing,
                                           "Micro cell/Fibers=" + n,
                                           "Newton/Relative tolerance=1e-12"}));
          CHECK(difference(other->small_strain_stiffness(),
                           reference->small_strain_stiffness()) < 1e-9);
          CHECK(difference(other->rows().back().P, reference->rows().back().P) <
                1e-9);
        }
      // Neither on its length along the fibers, nor on what is assumed there,
      // nor on the unit of length.
      for (const std::string entry :
           {"Material tests/Uniform along fiber=false",
            "Micro mesh/Elements along=2",
            "Micro cell/Fiber spacing=0.013"})
        {
          const auto other = run(one_step(general,
                                          {"Micro cell/Packing=" + packing,
                                           entry,
                                           "Newton/Relative tolerance=1e-12"}));
          CHECK(difference(other->rows().back().P, reference->rows().back().P) <
                1e-9);
        }
    }
}



TEST_CASE("The moduli respect symmetry and bounds", "[top]")
{
  const std::vector<std::string> mesh{"Micro mesh/Elements around=3",
                                      "Micro mesh/Elements in fiber=1",
                                      "Micro mesh/Elements in matrix=1",
                                      "Micro mesh/Additional Gauss points=4"};
  for (const std::string packing : {"square", "hexagonal"})
    for (const std::string fraction : {"0.3", "0.77"})
      for (const double nu_matrix : {0.3, 0.45})
        {
          auto entries = mesh;
          entries.push_back("Micro cell/Packing=" + packing);
          entries.push_back("Micro cell/Volume fraction=" + fraction);
          entries.push_back("Matrix material/Poisson ratio=" +
                            std::to_string(nu_matrix));
          const FullMatrix<double> C = run(entries)->small_strain_stiffness();
          const Moduli             m(C);
          const CompositeBounds    bounds = unidirectional_bounds(
            std::stod(fraction), 100., 0.3, 1., nu_matrix);
          INFO(packing << " " << fraction << " " << nu_matrix);

          // Equal Poisson's ratios: the rule of mixtures is exact. Else it is
          // a lower bound.
          if (nu_matrix == 0.3)
            CHECK(m.E_1 == Approx(bounds.rule_of_mixtures).epsilon(1e-9));
          CHECK(inside(m.E_1, bounds.E_L));
          CHECK(m.E_1 >= bounds.rule_of_mixtures * (1. - 1e-9));
          CHECK(inside(m.k_T, bounds.k_T));
          CHECK(inside(m.G_12, bounds.G_L));
          CHECK(C(1, 1) == Approx(C(2, 2)).epsilon(1e-9));
          CHECK(C(4, 4) == Approx(C(5, 5)).epsilon(1e-9));
          CHECK(inside(m.E_2, bounds.E_T));
          // Six-fold symmetry in the plane is isotropy; four-fold is not.
          if (packing == "hexagonal")
            {
              CHECK(m.G_23 == Approx(m.G_45).epsilon(1e-7));
              CHECK(inside(m.G_23, bounds.G_T));
            }
          else
            {
              // The bounds of Hashin and Shtrikman assume isotropy across the
              // fibers. With two different shear moduli they hold for the
              // harmonic mean of the distances to a constituent (the trace
              // bounds of Milton and Kohn, 1988); one modulus alone may lie
              // outside, and G_23 of the square array does.
              const double G_f = 50. / 1.3, G_m = 0.5 / (1. + nu_matrix);
              const auto   mean = [&](const double G) {
                return 2. / (1. / (m.G_23 - G) + 1. / (m.G_45 - G));
              };
              CHECK(m.G_23 < 0.95 * m.G_45);
              CHECK(G_m + mean(G_m) >= bounds.G_T.lower);
              CHECK(G_f + mean(G_f) <= bounds.G_T.upper);
            }
        }
}



TEST_CASE("Moduli at 77 % converge with mesh and degree, NURBS and FE_Q to the "
          "same numbers",
          "[top]")
{
  const auto stiffness = [](const std::string &packing,
                            const std::string &basis,
                            const unsigned int degree,
                            const unsigned int n) {
    return run({"Micro mesh/Additional Gauss points=1",
                "Micro cell/Packing=" + packing,
                "Micro mesh/Basis=" + basis,
                "Micro mesh/Degree=" + std::to_string(degree),
                "Micro mesh/Elements around=" + std::to_string(n),
                "Micro mesh/Elements in fiber=" + std::to_string(n / 2),
                "Micro mesh/Elements in matrix=" + std::to_string(n / 2)})
      ->small_strain_stiffness();
  };
  for (const std::string packing : {"square", "hexagonal"})
    {
      const auto reference = stiffness(packing, "NURBS", 3, 8);
      for (const std::string basis : {"NURBS", "Lagrange"})
        {
          double previous = 1.;
          for (const unsigned int n : {2, 4, 8})
            {
              const double error =
                difference(stiffness(packing, basis, 2, n), reference);
              INFO(packing << " " << basis << " " << n << " " << error);
              CHECK(error < 0.4 * previous);
              previous = error;
            }
          CHECK(previous < 6e-4);
        }
      // Elevating the degree on one mesh; with C0 patches the spaces are
      // nested (smooth splines of different degree are not).
      double previous = 1.;
      for (const unsigned int p : {2, 3, 4})
        {
          const double error =
            difference(stiffness(packing, "Bernstein", p, 2), reference);
          INFO(packing << " p = " << p << " " << error);
          CHECK(error < 0.5 * previous);
          previous = error;
        }
    }
}



TEST_CASE("A prescribed stress is reached and holds the cell in equilibrium",
          "[top]")
{
  // Free sides: lateral stresses vanish, and so do all shears although three
  // of them are held against rotation.
  const auto  free = run(one_step("H11: 0.1, P22: 0, P33: 0, P12: 0, P13: 0, "
                                  "P23: 0",
                                 {"Newton/Relative tolerance=1e-12"}));
  const auto &row  = free->rows().back();
  for (unsigned int e = 1; e < 9; ++e)
    CHECK(std::abs(row.P[e / 3][e % 3]) < 1e-9 * row.P[0][0]);
  CHECK(row.H[1][1] < 0.);
  CHECK(row.H[1][1] == Approx(row.H[2][2]).epsilon(1e-9));

  // The same by prescribing the sides' contraction, and by the stress P11.
  std::ostringstream held, stress;
  held.precision(17);
  held << "H11: 0.1, H22: " << row.H[1][1] << ", H33: " << row.H[2][2];
  stress.precision(17);
  stress << "P11: " << row.P[0][0] << ", P22: 0, P33: 0";
  CHECK(difference(run(one_step(held.str()))->rows().back().P, row.P) < 1e-8);
  CHECK(difference(run(one_step(stress.str()))->rows().back().H, row.H) < 1e-8);
}



TEST_CASE("The work of the stresses is the stored energy", "[top]")
{
  // By the trapezoidal rule, second order in the step.
  const auto gap = [](const std::string &step) {
    auto entries = one_step(general);
    entries.push_back("Material tests/Test t/Initial step=" + step);
    entries.push_back("Material tests/Test t/Maximum step=" + step);
    const auto row = run(entries)->rows().back();
    return std::abs(row.work - row.energy) / row.energy;
  };
  const double coarse = gap("0.5"), fine = gap("0.25");
  CHECK(coarse < 0.01);
  CHECK(coarse / fine == Approx(4.).epsilon(0.1));
}



TEST_CASE("Impossible material tests are refused in one sentence", "[top]")
{
  const auto error_of = [](const std::vector<std::string> &overrides) {
    try
      {
        parameters_with(overrides);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("(accepted)");
  };
  CHECK_THAT(error_of(one_step("P12: 0, P21: 0")),
             Catch::Contains("both P12 and P21") &&
               Catch::Contains("rotation"));
  CHECK_THAT(error_of(one_step("H11: 0.1, P11: 0")),
             Catch::Contains("component 11 twice"));
  CHECK_THAT(error_of(one_step("H14: 0.1")), Catch::Contains("H14"));
  CHECK_THAT(error_of({"Material tests/Tests=my test"}),
             Catch::Contains("Targets is empty"));
  CHECK_THAT(error_of({"Material tests/Tests=tension 1, tension 1"}),
             Catch::Contains("twice"));
  CHECK_THAT(error_of({"Micro cell/Volume fraction=0.8"}),
             Catch::Contains("Volume fraction is 0.8") &&
               Catch::Contains("0.785"));
  CHECK_THAT(error_of({"Micro cell/Fiber radius=0.5"}),
             Catch::Contains("touch or overlap"));
}



TEST_CASE("From fibers and matrix to a material file", "[top]")
{
  const std::clock_t start  = std::clock();
  const std::string  folder = std::filesystem::temp_directory_path().string() +
                             "/npt_material_test_" + std::to_string(start);
  std::filesystem::create_directories(folder);
  std::ostringstream       screen;
  NumericalMaterialTesting test(
    MaterialTestParameters::read(
      ParameterText(), {"Micro mesh/Elements around=4", "Output/Fields=true"}),
    folder,
    screen);
  test.run();
  REQUIRE(test.identified());
  CHECK(test.curves().size() == 6);
  CHECK(test.identified()->n_data == 6 * 10 * 9);
  // The law has six constants for a composite that is not isotropic across the
  // fibers: within 3 % of each curve's largest stress.
  for (const auto &error : test.identified()->errors)
    CHECK(error.rms < 0.03);
  for (const std::string file : {"material_tests.csv",
                                 "stiffness.csv",
                                 "bundle_material.prm",
                                 "fit.csv",
                                 "fit.gp",
                                 "log.txt",
                                 "used_parameters.prm",
                                 "cell-shear-12.vtu"})
    CHECK(std::filesystem::exists(folder + "/" + file));

  // The same from the table, as prm/identify.prm does.
  const auto identification = IdentificationRunParameters::read(
    ParameterText(), {"Data/Files=" + folder + "/material_tests.csv"});
  const auto again = run_identification(identification,
                                        identification.read_curves(),
                                        "",
                                        screen);
  CHECK(again.constants.c ==
        Approx(test.identified()->constants.c).epsilon(1e-10));
  // The parameters kept with the results read back.
  CHECK_NOTHROW(MaterialTestParameters::read(
    read_parameter_text(folder + "/used_parameters.prm")));
  std::filesystem::remove_all(folder);
  CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 60.);
}
