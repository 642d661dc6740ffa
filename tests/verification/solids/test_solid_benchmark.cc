// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about exact solutions, the bodies they belong to, and the rates and
// stresses with which the program meets them.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/iga/iga_values.h>
#include <npt_dealii/verification/solids/benchmark_bodies.h>
#include <npt_dealii/verification/solids/solid_benchmark.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <sstream>

#include "run_program.h"

using namespace NPT;
using namespace TopTests;
using dealii::Point;
using dealii::Tensor;
namespace fs = std::filesystem;

namespace
{
  const fs::path verification = NPT_SOURCE_DIR "/prm/verification";
  const double   E = 7., nu = 0.3;

  std::vector<std::unique_ptr<ElasticSolution>>
  elastic_solutions()
  {
    std::vector<std::unique_ptr<ElasticSolution>> solutions;
    solutions.push_back(std::make_unique<HoleUnderTension>(2., 1., E, nu));
    solutions.push_back(
      std::make_unique<PressurizedCylinder>(2., 1., 1.6, E, nu));
    solutions.push_back(
      std::make_unique<PressurizedSphere>(2., 1., 1.6, E, nu));
    return solutions;
  }

  /// Run a file of prm/verification with changes, in this process.
  SolidBenchmark
  make_benchmark(const std::string              &file,
                 const std::vector<std::string> &overrides,
                 std::ostream                   &screen)
  {
    return SolidBenchmark(SolidBenchmarkParameters::read(read_parameter_text(
                                                           verification / file),
                                                         overrides),
                          "",
                          screen);
  }

  double
  volume(std::vector<NURBSPatch<3>> patches, const unsigned int degree)
  {
    for (NURBSPatch<3> &patch : patches)
      refine(patch, degree, {{2, 2, 2}});
    const IGASpace<3> space(patches,
                            std::vector<unsigned int>(patches.size(), 0),
                            Basis::NURBS);
    IGAValues<3>      values(space, 7);
    double            sum = 0;
    for (const auto &span : space.triangulation().active_cell_iterators())
      {
        values.reinit(span);
        for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
          sum += values.JxW(q);
      }
    return sum;
  }
} // namespace



TEST_CASE("The exact solutions obey Hooke's law and equilibrium", "[top]")
{
  const double mu     = E / (2. * (1. + nu)),
               lambda = 2. * mu * nu / (1. - 2. * nu);
  const double h      = 1e-4; // central differences: error about h^2
  for (const auto &solution : elastic_solutions())
    for (const Point<3> &X : {Point<3>(1.1, 0.3, 0.4), Point<3>(0.2, 1.2, 0.7)})
      {
        Tensor<2, 3> grad_u;
        Tensor<1, 3> divergence;
        for (unsigned int j = 0; j < 3; ++j)
          {
            const Tensor<1, 3> step = h * Point<3>::unit_vector(j);
            const Tensor<1, 3> du   = solution->displacement(X + step) -
                                    solution->displacement(X - step);
            const Tensor<2, 3> ds =
              solution->stress(X + step) - solution->stress(X - step);
            for (unsigned int i = 0; i < 3; ++i)
              {
                grad_u[i][j] = du[i] / (2. * h);
                divergence[i] += ds[i][j] / (2. * h);
              }
          }
        Tensor<2, 3> sigma = mu * (grad_u + transpose(grad_u));
        for (unsigned int i = 0; i < 3; ++i)
          sigma[i][i] += lambda * trace(grad_u);
        CHECK((sigma - solution->stress(X)).norm() < 1e-6);
        CHECK(divergence.norm() < 1e-6);
      }
}



TEST_CASE("The hole is free of traction and the walls carry the pressure",
          "[top]")
{
  const auto solutions = elastic_solutions();
  for (const double theta : {0., 0.4, 1.2})
    {
      const Tensor<1, 3> n({std::cos(theta), std::sin(theta), 0.});
      CHECK((solutions[0]->stress(Point<3>(n)) * n).norm() < 1e-13);
      for (unsigned int k = 1; k < 3; ++k)
        {
          CHECK((solutions[k]->stress(Point<3>(n)) * n + 2. * n).norm() <
                1e-13);
          CHECK((solutions[k]->stress(Point<3>(1.6 * n)) * n).norm() < 1e-13);
        }
    }
  // Three times the tension beside the hole, and the tension far away.
  CHECK(solutions[0]->stress(Point<3>(0, 1, 0))[0][0] == Approx(6.));
  CHECK(solutions[0]->stress(Point<3>(500, 700, 0))[0][0] ==
        Approx(2.).epsilon(1e-5));
}



TEST_CASE("The closed forms of homogeneous states are the stresses of the laws",
          "[top]")
{
  std::vector<MaterialParameters> materials(2,
                                            MaterialParameters("neo-Hookean"));
  materials[1].constants<NeoHookeanParameters>().volumetric_energy =
    VolumetricEnergy::ciarlet;
  materials.emplace_back("fiber bundle");
  for (const MaterialParameters &material : materials)
    for (unsigned int axis = 0; axis < 3; ++axis)
      {
        const auto law =
          make_material<3>(material, Point<3>::unit_vector(axis));
        for (const auto mode : {HomogeneousMode::uniaxial,
                                HomogeneousMode::equibiaxial,
                                HomogeneousMode::dilation,
                                HomogeneousMode::simple_shear})
          for (const double amount : {0.9, 1.12, 0.3})
            {
              if ((mode == HomogeneousMode::simple_shear) != (amount == 0.3))
                continue;
              const auto state =
                homogeneous_state(material, axis, mode, amount);
              Tensor<2, 3> P;
              law->stress(state.F, P);
              CHECK((P - state.P).norm() < 1e-12 * (1. + P.norm()));
              if (mode == HomogeneousMode::uniaxial)
                CHECK(std::abs(P[1][1]) + std::abs(P[2][2]) < 1e-11);
            }
      }
}



TEST_CASE("The bodies of the benchmarks are exact in every degree", "[top]")
{
  const double pi = 4. * std::atan(1.);
  for (const unsigned int p : {2u, 3u})
    {
      CHECK(volume(quarter_plate_with_hole(1., 2., 0.5), p) ==
            Approx(0.5 * (4. - pi / 4.)).epsilon(1e-10));
      CHECK(volume({quarter_tube(1., 2., 0.5)}, p) ==
            Approx(0.5 * pi / 4. * 3.).epsilon(1e-10));
      // The pole is a degenerate edge.
      CHECK(volume({sphere_octant(1., 2.)}, p) ==
            Approx(pi / 6. * 7.).epsilon(1e-9));
      NURBSPatch<3> block = unit_block();
      refine(block, p, {{2, 2, 2}});
      const auto straight = block.control_points();
      distort(block, 0.25);
      CHECK(volume({block}, p) == Approx(1.).epsilon(1e-13));
      CHECK(straight[block.index({{1, 1, 1}})].distance(
              block.control_points()[block.index({{1, 1, 1}})]) > 1e-3);
    }
}



TEST_CASE("Cylinder and sphere converge at the rates of theory in all bases",
          "[top]")
{
  // Meshes that are as coarse as 0.1 allows; smooth splines of higher degree
  // need the finer ones of prm/verification.
  std::ostringstream screen;
  const auto         run = [&](const std::string              &file,
                       const std::vector<std::string> &overrides) {
    auto benchmark = make_benchmark(file, overrides, screen);
    CHECK_NOTHROW(benchmark.run());
    return benchmark.rates().size();
  };
  CHECK(run("cylinder.prm",
            {"Benchmark/Bases=NURBS, Bernstein, Lagrange",
             "Benchmark/Degrees=2",
             "Benchmark/Elements=4, 8"}) == 6);
  CHECK(run("cylinder_c0.prm",
            {"Benchmark/Degrees=3", "Benchmark/Elements=4, 8"}) == 4);
  CHECK(run("sphere_c0.prm",
            {"Benchmark/Bases=NURBS, Bernstein",
             "Benchmark/Degrees=2",
             "Benchmark/Elements=4, 6"}) == 4);
}



TEST_CASE("The plate with a hole converges at the rates of theory", "[top]")
{
  std::ostringstream screen;
  auto               plate = make_benchmark("plate_with_hole.prm",
                              {"Benchmark/Bases=Bernstein",
                                             "Benchmark/Degrees=3",
                                             "Benchmark/Elements=8, 12"},
                              screen);
  CHECK_NOTHROW(plate.run());
}



TEST_CASE("Homogeneous states come out of the program in a distorted mesh",
          "[top]")
{
  const fs::path folder = fresh_folder("solid_benchmark");
  for (const std::string law : {"neo_hookean", "fiber_bundle"})
    {
      const auto run =
        run_program(folder,
                    {(verification / ("homogeneous_" + law + ".prm")).string(),
                     "--set=Benchmark/Degrees=2",
                     "--set=Benchmark/Bases=NURBS, Lagrange",
                     "--output",
                     law});
      INFO(run.err);
      CHECK(run.status == 0);
      CHECK(fs::exists(folder / law / "homogeneous.csv"));
      CHECK(fs::exists(folder / law / "used_parameters.prm"));
    }
}



TEST_CASE("A benchmark that misses its tolerance ends with status 1 and its "
          "table",
          "[top]")
{
  const fs::path folder = fresh_folder("solid_benchmark_missed");
  const auto     run    = run_program(folder,
                               {(verification / "cylinder.prm").string(),
                                       "--set=Benchmark/Bases=NURBS",
                                       "--set=Benchmark/Degrees=2",
                                       "--set=Benchmark/Elements=1, 2"});
  CHECK(run.status == 1);
  CHECK_THAT(run.err,
             Catch::Contains("NURBS, p = 2: rate") &&
               Catch::Contains("in the energy norm, 2 expected, 0.10 allowed"));
  CHECK(fs::exists(folder / "output-cylinder/convergence.csv"));
  CHECK(fs::exists(folder / "output-cylinder/convergence.gp"));
}



TEST_CASE("Unusable benchmarks are refused with one sentence", "[top]")
{
  const auto message = [](const std::vector<std::string> &overrides) {
    try
      {
        std::ostringstream screen;
        make_benchmark("cylinder.prm", overrides, screen).run();
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string("no InputError");
  };
  CHECK(message({"Benchmark/Outer size=1"}) ==
        "Outer size is 1 mm; it must be larger than the inner radius of 1 mm "
        "(subsection Benchmark).");
  CHECK_THAT(message({"Benchmark/Elements=4"}),
             Catch::Contains("at least two (subsection Benchmark)"));
  CHECK(message({"Benchmark/Elements=4, 2"}) ==
        "Elements has 2 after 4; the numbers must increase (subsection "
        "Benchmark).");
  CHECK_THAT(message({"Benchmark/Degrees=2, 2"}),
             Catch::Contains("Degrees names 2 twice"));
  CHECK_THAT(message({"Material/Law=fiber bundle"}),
             Catch::Contains("the one of the neo-Hookean law"));
}



TEST_CASE("A block of a law without closed forms is refused", "[top]")
{
  CHECK_THROWS_WITH(SolidBenchmarkParameters::read(
                      {}, {"Benchmark/Case=block", "Material/Law=dry bundle"}),
                    Catch::Contains(
                      "Law is dry bundle; closed forms of homogeneous states"));
}
