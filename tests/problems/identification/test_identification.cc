// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the identification of the fiber bundle law.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/material/ellipticity.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/problems/identification/identification_report.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

namespace
{
  using namespace NPT;
  using dealii::Tensor;

  Tensor<2, 3>
  unit(const unsigned int i, const unsigned int J)
  {
    Tensor<2, 3> H;
    H[i][J] += 0.5;
    H[J][i] += 0.5;
    return H;
  }

  MaterialCurve
  curve(const std::string          &name,
        const Tensor<2, 3>         &direction,
        const double                amplitude,
        const FiberBundleConstants &constants,
        const unsigned int          n = 10)
  {
    MaterialCurve result;
    result.name = name;
    for (unsigned int k = 0; k <= n; ++k)
      {
        result.H.push_back(amplitude * k / n * direction);
        result.P.push_back(bundle_stress(constants, result.H.back()));
      }
    return result;
  }

  // The six modes of Fig. 8.
  std::vector<MaterialCurve>
  six_curves(const FiberBundleConstants &constants, const unsigned int n = 10)
  {
    return {curve("tension 1", unit(0, 0), 0.2, constants, n),
            curve("tension 2", unit(1, 1), 0.2, constants, n),
            curve("tension 3", unit(2, 2), 0.2, constants, n),
            curve("shear 12", unit(0, 1), 0.2, constants, n),
            curve("shear 23", unit(1, 2), 0.2, constants, n),
            curve("shear 31", unit(2, 0), 0.2, constants, n)};
  }

  std::array<double, 6>
  to_array(const FiberBundleConstants &c)
  {
    return {{c.mu, c.lambda, c.a, c.b, c.c, c.d}};
  }

  double
  distance(const FiberBundleConstants &a, const FiberBundleConstants &b)
  {
    double result = 0;
    for (unsigned int k = 0; k < 6; ++k)
      result = std::max(result, std::abs(to_array(a)[k] - to_array(b)[k]));
    return result;
  }

  // What identify() minimizes, with all weights one.
  double
  cost(const std::vector<MaterialCurve> &curves,
       const FiberBundleConstants       &constants)
  {
    double sum = 0;
    for (const auto &error :
         curve_errors(curves, IdentificationParameters(), constants))
      sum += error.rms * error.rms;
    return sum;
  }

  std::string
  error_of(const std::vector<MaterialCurve> &curves,
           const IdentificationParameters   &parameters)
  {
    try
      {
        identify(curves, parameters);
      }
    catch (const InputError &error)
      {
        return error.what();
      }
    return "(accepted)";
  }
} // namespace



TEST_CASE("A fit of data made from the law returns its constants", "[study]")
{
  const FiberBundleConstants table_1;
  FiberBundleConstants       other;
  other.mu = 1., other.lambda = 2., other.a = 0.3, other.b = 4., other.c = 9.,
  other.d = -0.4;
  for (const auto &constants : {table_1, other})
    for (const auto components : {IdentificationParameters::Components::all,
                                  IdentificationParameters::Components::driven})
      for (const bool relative : {true, false})
        {
          IdentificationParameters parameters;
          parameters.components        = components;
          parameters.relative_to_curve = relative;
          const auto result = identify(six_curves(constants), parameters);
          CHECK(distance(result.constants, constants) < 1e-8);
          CHECK(result.n_active_constraints == 0);
          CHECK(result.stiffness.value > 0.);
          CHECK(result.acoustic > 0.);
        }
}



TEST_CASE("With 1 % noise the stated interval holds the constant in 95 % of "
          "the fits",
          "[study]")
{
  // 150 fits x 6 constants, correlated within a fit: the fraction has a
  // standard deviation of at most 1.8 %.
  const FiberBundleConstants       truth;
  const auto                       exact = six_curves(truth, 3);
  std::mt19937                     generator(11);
  std::normal_distribution<double> normal;
  IdentificationParameters         parameters;
  parameters.elliptic          = false; // the slow part, and inactive here
  unsigned int          inside = 0, n = 0;
  std::array<double, 6> mean_square{}, mean_error{};
  for (unsigned int fit = 0; fit < 150; ++fit)
    {
      auto curves = exact;
      for (auto &c : curves)
        {
          double scale = 0;
          for (const auto &P : c.P)
            for (unsigned int e = 0; e < 9; ++e)
              scale = std::max(scale, std::abs(P[e / 3][e % 3]));
          for (auto &P : c.P)
            for (unsigned int e = 0; e < 9; ++e)
              P[e / 3][e % 3] += 0.01 * scale * normal(generator);
        }
      const auto result = identify(curves, parameters);
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double error =
            to_array(result.constants)[k] - to_array(truth)[k];
          inside += std::abs(error) <= result.confidence[k];
          ++n;
          mean_square[k] += error * error / 150.;
          mean_error[k] += result.standard_error[k] / 150.;
        }
    }
  const double fraction = static_cast<double>(inside) / n;
  INFO("inside: " << fraction);
  CHECK(fraction > 0.90);
  CHECK(fraction < 0.99);
  for (unsigned int k = 0; k < 6; ++k)
    CHECK(std::sqrt(mean_square[k]) == Approx(mean_error[k]).epsilon(0.15));
}



TEST_CASE("Weights and the selection of curves decide what is fitted",
          "[study]")
{
  // Shear 12 contradicts the other curves.
  FiberBundleConstants stiff;
  stiff.a -= 2.;
  auto curves = six_curves(FiberBundleConstants());
  curves[3]   = curve("shear 12", unit(0, 1), 0.2, stiff);
  curves[5]   = curve("shear 31", unit(2, 0), 0.2, stiff);

  IdentificationParameters parameters;
  parameters.components       = IdentificationParameters::Components::driven;
  const auto error_of_tension = [&](const double weight) {
    parameters.weights["tension 1"] = weight;
    for (const auto &error : identify(curves, parameters).errors)
      if (error.name == "tension 1")
        return error.rms;
    return -1.;
  };
  const double light = error_of_tension(0.01), heavy = error_of_tension(100.);
  CHECK(heavy < light);

  parameters.curves = {"tension 1", "tension 2", "shear 12", "shear 23"};
  const auto result = identify(curves, parameters);
  CHECK(result.errors.size() == 4);
  CHECK(result.n_data == 10 * (1 + 1 + 2 + 2));
  parameters.weights["tension 1"] = 0.;
  parameters.curves.clear();
  CHECK(identify(curves, parameters).errors.size() == 5);
}



TEST_CASE("Data of an unstable law give the nearest stable one", "[study]")
{
  // Table 1 as printed: E_L = -363 MPa.
  FiberBundleConstants printed;
  printed.d         = -printed.d;
  const auto curves = six_curves(printed);

  IdentificationParameters parameters;
  const auto               result = identify(curves, parameters);
  CHECK(result.n_active_constraints > 0);
  CHECK(result.stiffness.value >= 0.5 * parameters.stability_margin);
  CHECK(result.acoustic >= 0.5 * parameters.stability_margin);
  CHECK(!result.notes.empty());

  // Nearest: on the way from here to any other stable law the cost does not
  // fall. (All curves have the same number of stresses, so the sum of squared
  // rms is what is minimized. The half margin allows a little.)
  const double                           best = cost(curves, result.constants);
  std::mt19937                           generator(2);
  std::uniform_real_distribution<double> entry(-1., 1.);
  unsigned int                           stable = 0;
  for (unsigned int n = 0; n < 300; ++n)
    {
      auto         c    = result.constants;
      const double size = std::pow(10., -2. + 3. * n / 300.);
      c.mu += size * entry(generator);
      c.lambda += size * entry(generator);
      c.a += size * entry(generator);
      c.b += size * entry(generator);
      c.c += size * entry(generator);
      c.d += size * entry(generator);
      if (c.lowest_stiffness_eigenvalue().value < parameters.stability_margin)
        continue;
      // Only those of the random laws that would be better need the expensive
      // check of ellipticity.
      if (cost(curves, c) >= best * (1. - 1e-3))
        {
          ++stable;
          continue;
        }
      Tensor<1, 3> A;
      A[0] = 1.;
      const FiberBundleLaw<3> law(c, A);
      double                  lowest = 1e300;
      for (const auto &one : curves)
        for (const auto &H : one.H)
          {
            if (lowest < parameters.stability_margin)
              break; // not admissible: that is all there is to know
            Tensor<2, 3> F = H;
            for (unsigned int i = 0; i < 3; ++i)
              F[i][i] += 1.;
            lowest =
              std::min(lowest, lowest_acoustic_eigenvalue<3>(law, F).value);
          }
      CHECK(lowest < parameters.stability_margin);
    }
  CHECK(stable > 20);

  parameters.positive_definite = parameters.elliptic = false;
  CHECK(distance(identify(curves, parameters).constants, printed) < 1e-8);
}



TEST_CASE("The fitted law is elliptic over the fitted range", "[study]")
{
  // Compression along the fiber by 16 %: Table 1 has lost ellipticity at 13 %.
  const FiberBundleConstants table_1;
  auto                       curves = six_curves(table_1);
  curves.push_back(curve("compression 1", unit(0, 0), -0.16, table_1, 8));

  IdentificationParameters parameters;
  parameters.elliptic = false;
  const auto free     = identify(curves, parameters);
  CHECK(free.acoustic < 0.);
  CHECK_THAT(free.acoustic_place, Catch::Contains("compression 1"));
  CHECK(distance(free.constants, table_1) < 1e-8);

  parameters.elliptic = true;
  const auto held     = identify(curves, parameters);
  CHECK(held.acoustic >= 0.5 * parameters.stability_margin);
  CHECK(held.n_active_constraints > 0);
  CHECK(cost(curves, held.constants) > 0.);
}



TEST_CASE("A fit without enough data is refused with the reason", "[study]")
{
  const auto               curves = six_curves(FiberBundleConstants());
  IdentificationParameters parameters;

  auto few = std::vector<MaterialCurve>{
    curve("tension 1", unit(0, 0), 0.2, FiberBundleConstants(), 5)};
  parameters.components = IdentificationParameters::Components::driven;
  CHECK_THAT(error_of(few, parameters),
             Catch::Contains("5 stress values") &&
               Catch::Contains("fewer than the six constants"));

  parameters.curves = {"tension 1"};
  CHECK_THAT(error_of(curves, parameters),
             Catch::Contains("do not determine all six constants"));

  parameters.curves = {"tensoin 1"};
  CHECK_THAT(error_of(curves, parameters),
             Catch::Contains("'tensoin 1'") &&
               Catch::Contains("did you mean 'tension 1'"));
}



TEST_CASE("A user's table may lack columns", "[study]")
{
  const std::string folder = std::filesystem::temp_directory_path().string() +
                             "/npt_identification_" +
                             std::to_string(std::rand());
  std::filesystem::create_directories(folder);
  const std::string file = folder + "/my test.csv";
  {
    std::ofstream out(file);
    out << "# tension with free sides\nH11, H22, H33, P11, force\n"
           "0.01, -0.003, -0.003, 0.5, 7\n0.02, -0.006, -0.006, 1.0, 14\n";
  }
  const auto curves = read_material_curves(file);
  REQUIRE(curves.size() == 1);
  CHECK(curves[0].name == "my test");
  CHECK(curves[0].H[1][1][1] == -0.006);
  CHECK(curves[0].P[1][0][0] == 1.);
  CHECK(curves[0].measured[0]);
  CHECK(!curves[0].measured[4]);

  {
    std::ofstream out(file);
    out << "H11, force\n0.01, 7\n";
  }
  CHECK_THROWS_WITH(read_material_curves(file),
                    Catch::Contains("no column of stresses"));

  // Stresses in another unit would be taken for MPa.
  {
    std::ofstream out(file);
    out << "H11 [-]; P11 [MPa]\n0,01; 1,5\n";
  }
  CHECK(read_material_curves(file)[0].P[0][0][0] == 1.5);
  {
    std::ofstream out(file);
    out << "H11,P11\n[-],[GPa]\n0.01,1.5\n";
  }
  CHECK_THROWS_WITH(read_material_curves(file),
                    Catch::Contains("is in 'GPa'; it must be in MPa"));

  // The material file is what other parameter files include.
  const auto result =
    identify(six_curves(FiberBundleConstants()), IdentificationParameters());
  write_material_file(folder + "/bundle_material.prm", result);
  {
    std::ofstream out(folder + "/plate.prm");
    out << "include bundle_material.prm\n";
  }
  MaterialParameters       material;
  dealii::ParameterHandler prm;
  material.add_parameters(prm);
  parse_parameter_text(prm, read_parameter_text(folder + "/plate.prm"));
  CHECK(distance(material.constants<FiberBundleParameters>().constants,
                 result.constants) < 1e-12);
  std::filesystem::remove_all(folder);
}
