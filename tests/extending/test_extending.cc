// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the examples of doc/extending: each does what its page says, and
// the program knows it by its name.

#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include "../material/material_test_tools.h"
#include "../run_program.h"
#include "contact_law/stiffening_law.h"
#include "material/mooney_rivlin.h"
#include "section/flattened_lens.h"

using namespace NPT;

namespace
{
  /// Run a file of doc/extending with the program that has the examples; the
  /// folder of its results.
  std::string
  run_example(const std::string              &file,
              const std::string              &name,
              const std::vector<std::string> &more = {})
  {
    const auto               folder    = TopTests::fresh_folder(name);
    std::vector<std::string> arguments = {std::string(NPT_SOURCE_DIR) +
                                            "/doc/extending/" + file,
                                          "--output",
                                          folder.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto result = TopTests::run_program(folder, arguments, NPT_EXTENDED);
    INFO(result.err);
    REQUIRE(result.status == 0);
    return folder.string();
  }

  std::vector<CurveRow>
  curve_of_example(const std::string              &file,
                   const std::string              &name,
                   const std::vector<std::string> &more = {})
  {
    std::vector<std::string> arguments = {"--set",
                                          "Output/Fields=none",
                                          "--set",
                                          "Output/Picture=false"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return read_curves(run_example(file, name, arguments) + "/curves.csv");
  }

  const CurveRow &
  end_of(const std::string &stage, const std::vector<CurveRow> &curve)
  {
    const CurveRow *found = nullptr;
    for (const CurveRow &row : curve)
      if (row.stage == stage)
        found = &row;
    REQUIRE(found != nullptr);
    REQUIRE(found->load_factor == 1.);
    return *found;
  }

  template <int dim>
  void
  check_mooney_rivlin()
  {
    using namespace MaterialTests;
    const MooneyRivlin<dim> law(15., 5., 30.);
    std::mt19937            generator(1);
    const double            h = 1e-5; // h^2 of some 1000 MPa, 1e-16/h
    for (unsigned int sample = 0; sample < 3; ++sample)
      {
        const auto     F = random_deformation<dim>(generator);
        Tensor<2, dim> P, P_plus, P_minus, by_energy;
        Tensor<4, dim> A, by_stress;
        law.stress_and_tangent(F, P, A);
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int L = 0; L < dim; ++L)
            {
              Tensor<2, dim> F_plus = F, F_minus = F;
              F_plus[k][L] += h;
              F_minus[k][L] -= h;
              by_energy[k][L] =
                (law.energy(F_plus) - law.energy(F_minus)) / (2. * h);
              law.stress(F_plus, P_plus);
              law.stress(F_minus, P_minus);
              for (unsigned int i = 0; i < dim; ++i)
                for (unsigned int J = 0; J < dim; ++J)
                  by_stress[i][J][k][L] =
                    (P_plus[i][J] - P_minus[i][J]) / (2. * h);
            }
        CHECK(max_difference(P, by_energy) < 1e-6);
        CHECK(max_difference(A, by_stress) < 1e-5);
      }
    Tensor<2, dim> P;
    law.stress(identity<dim>(), P);
    CHECK(P.norm() < 1e-13);
  }
} // namespace



TEST_CASE("Stress and tangent of the Mooney-Rivlin law are the derivatives of "
          "its energy, and it has the given moduli",
          "[extending]")
{
  check_mooney_rivlin<2>();
  check_mooney_rivlin<3>();

  const MooneyRivlinParameters parameters;
  const auto                   stiffness =
    parameters.make_law(dealii::Tensor<1, 3>())->small_strain_stiffness();
  CHECK(stiffness(3, 3) == Approx(2. * (parameters.c1 + parameters.c2)));
  CHECK((stiffness(0, 0) + 2. * stiffness(0, 1)) / 3. ==
        Approx(parameters.bulk_modulus));
}



TEST_CASE("A sheared weave of Mooney-Rivlin bundles with c2 = 0 is that of "
          "neo-Hookean ones, and c2 matters",
          "[extending]")
{
  const std::string section = "Fiber bundle material/";
  const auto        sheared = [&](const std::string              &name,
                           const std::vector<std::string> &entries) {
    std::vector<std::string> arguments;
    for (const std::string &entry : entries)
      {
        arguments.push_back("--set");
        arguments.push_back(section + entry);
      }
    return end_of(
      "shear", curve_of_example("material/mooney_rivlin.prm", name, arguments));
  };
  // mu = 2 (c1 + c2) = 8 MPa and K = 20 MPa in all three.
  const CurveRow of_file = sheared("extending_material", {});
  const CurveRow without_c2 =
    sheared("extending_material_c1", {"Mooney c1=4", "Mooney c2=0"});
  const CurveRow neo_hookean = sheared("extending_neo_hookean",
                                       {"Law=neo-Hookean",
                                        "Young modulus=21.176470588235293",
                                        "Poisson ratio=0.3235294117647059"});
  CHECK(of_file.H[2] == Approx(0.02));
  CHECK(of_file.n[2] > 0.);
  for (const unsigned int mode : {0, 1, 2})
    {
      // Newton's method stops at 1e-7 of the forces.
      CHECK(without_c2.n[mode] == Approx(neo_hookean.n[mode]).epsilon(1e-5));
      CHECK(of_file.n[mode] != Approx(neo_hookean.n[mode]).epsilon(1e-4));
    }
}



TEST_CASE("The stiffening law is the derivative of its energy and twice the "
          "penalty law at its depth",
          "[extending]")
{
  const StiffeningLaw law(100., 0.01);
  CHECK(law(-0.01).pressure == Approx(-2.)); // 100 * 0.01 * 2 by hand
  CHECK(!law(0.01).active);
  for (const double multiplier : {0., -1.5})
    for (const double gap : {-0.03, -0.001, 0.005, 0.03})
      {
        const double h  = 1e-6; // third derivative: h^2 * 1e4
        const auto   at = law(gap, multiplier);
        CHECK(std::abs((law(gap + h, multiplier).energy -
                        law(gap - h, multiplier).energy) /
                         (2 * h) -
                       at.pressure) < 1e-7);
        CHECK(std::abs((law(gap + h, multiplier).pressure -
                        law(gap - h, multiplier).pressure) /
                         (2 * h) -
                       at.slope) < 1e-7);
      }
  // No jump of the energy where contact begins.
  CHECK(std::abs(law(0.015 + 1e-14, -1.5).energy -
                 law(0.015 - 1e-14, -1.5).energy) < 1e-12);
}



TEST_CASE("Woven bundles penetrate less under the stiffening law than under "
          "the penalty law",
          "[extending]")
{
  const std::string file       = "contact_law/stiffening_law.prm";
  const auto        stiffening = curve_of_example(file, "extending_contact");
  const auto        penalty =
    curve_of_example(file,
                     "extending_penalty",
                     {"--set", "Contact/Normal law=penalty"});
  const double with    = end_of("release", stiffening).largest_penetration;
  const double without = end_of("release", penalty).largest_penetration;
  CHECK(with < 0.9 * without);
  CHECK(with > 0.);
}



TEST_CASE("In the 4/1 twill the warp is over at 20 of 25 crossings, and five "
          "of them make a cell",
          "[extending]")
{
  const WeavePattern twill("4/1 twill");
  unsigned int       n_over = 0;
  for (unsigned int warp = 0; warp < 5; ++warp)
    for (unsigned int weft = 0; weft < 5; ++weft)
      n_over += twill.warp_is_over(warp, weft) ? 1 : 0;
  CHECK(n_over == 20);
  CHECK(twill.is_translation(1, -1) != twill.is_translation(1, 1));
  // More over than under: no glide plane exchanges them.
  CHECK(!twill.has_glide());

  CellParameters cell;
  cell.weave = "4/1 twill";
  cell.type  = "primitive cell";
  const FabricCell fabric(cell, MeshParameters());
  CHECK(fabric.area() == Approx(5. * 5. * 5.));

  const auto folder = run_example("weave/four_one_twill.prm",
                                  "extending_weave",
                                  {"--geometry-only"});
  CHECK(std::filesystem::exists(folder + "/geometry.vtu"));
}



TEST_CASE("The flattened lens is exact for any degree and mesh, and its area "
          "is between lens and rectangle",
          "[extending]")
{
  const BundleSection section = {"flattened lens", 3.1, 0.9, 0.2};
  for (const unsigned int degree : {2, 3})
    for (const unsigned int n : {3, 8})
      {
        const auto patch = section.patch(degree, n);
        CHECK(patch.knot_vector(0).n_spans() == n);
        // The midpoint rule in y is of second order; the error of 1e-6 is left.
        const unsigned int n_points = 1000;
        double             area = 0, error = 0;
        for (unsigned int k = 0; k < n_points; ++k)
          {
            const auto P =
              patch.value(dealii::Point<2>((k + 0.5) / n_points, 1.));
            error = std::max(error, std::abs(P[1] - section.half_height(P[0])));
            area += 2. * P[1] * section.width / n_points;
          }
        CHECK(error < 1e-13);
        CHECK(area == Approx(section.area()).epsilon(1e-5));
      }
  const BundleSection lens = {"lens", 3.1, 0.9, 0.2};
  CHECK(section.area() > lens.area());
  CHECK(section.area() < 3.1 * 0.9);
}



TEST_CASE("Bundles with flat faces touch over at least as many nodes as "
          "lenses",
          "[extending]")
{
  const std::string file = "section/flattened_lens.prm";
  const auto        flat = curve_of_example(file, "extending_section");
  const auto        lens =
    curve_of_example(file, "extending_lens", {"--set", "Cell/Section=lens"});
  CHECK(end_of("release", flat).n_active >= end_of("release", lens).n_active);
}



TEST_CASE("Bending after tension keeps the stretch, and the further column "
          "shows that the bundles became longer",
          "[extending]")
{
  const auto curve =
    curve_of_example("load_stage/bending_after_tension.prm", "extending_stage");
  const CurveRow &released  = end_of("release", curve);
  const CurveRow &stretched = end_of("stretch", curve);
  const CurveRow &bent      = end_of("bend", curve);
  CHECK(stretched.H[0] == Approx(0.02));
  CHECK(bent.H[0] == Approx(0.02));
  CHECK(bent.H[3] == Approx(0.02));
  CHECK(std::abs(stretched.n[3]) < 1e-6 * stretched.n[0]);
  CHECK(bent.n[3] > 0.);

  const auto stretch = [](const CurveRow &row) {
    return curve_value(row, "mean_fiber_stretch");
  };
  CHECK(curve_column_unit("mean_fiber_stretch") == "-");
  CHECK(stretch(released) > 1.);
  CHECK(stretch(stretched) > stretch(released));
}



TEST_CASE("A curve of a program without a further column is read, and the "
          "column is no number then",
          "[extending]")
{
  const auto  folder  = TopTests::fresh_folder("extending_column");
  const auto  with    = (folder / "with.csv").string();
  const auto  without = (folder / "without.csv").string();
  CurveRow    row;
  CurveWriter writer(with);
  row.stage                         = "weave";
  row.further["mean_fiber_stretch"] = 1.25;
  writer.write(row);
  CHECK(curve_value(read_curves(with).at(0), "mean_fiber_stretch") == 1.25);

  // Cut out the column.
  const std::vector<std::string> columns = curve_columns();
  const std::size_t              place =
    std::find(columns.begin(), columns.end(), "mean_fiber_stretch") -
    columns.begin();
  REQUIRE(place < columns.size());
  std::ofstream     out(without);
  std::stringstream in(TopTests::read_text(with));
  for (std::string line; std::getline(in, line);)
    {
      std::size_t begin = 0;
      if (line[0] != '#')
        {
          for (std::size_t k = 0; k < place; ++k)
            begin = line.find(',', begin) + 1;
          line.erase(begin, line.find(',', begin) + 1 - begin);
        }
      out << line << '\n';
    }
  out.close();
  const auto rows = read_curves(without);
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].stage == "weave");
  CHECK(std::isnan(curve_value(rows[0], "mean_fiber_stretch")));
}



TEST_CASE("A page that does not show its file as it is is found and renewed",
          "[extending]")
{
  const auto tree = TopTests::fresh_folder("extending_pages");
  std::filesystem::create_directories(tree / "doc");
  std::ofstream(tree / "README.md") << "# Title\n";
  std::ofstream(tree / "doc/a.cc") << "int a;\n";
  std::ofstream(tree / "doc/a.md")
    << "Before.\n\n<!-- file: doc/a.cc -->\n\nBehind.\n";
  const auto show_files = [&](const std::string &option) {
    const std::string command = "'" + std::string(NPT_SOURCE_DIR) +
                                "/scripts/show_files' " + option + " '" +
                                tree.string() + "' > '" +
                                (tree / "report.txt").string() + "' 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  };
  const std::string shown = "Before.\n\n<!-- file: doc/a.cc -->\n```cpp\n"
                            "int a;\n```\n\nBehind.\n";
  CHECK(show_files("") == 1);
  CHECK(show_files("--refresh") == 0);
  CHECK(TopTests::read_text(tree / "doc/a.md") == shown);
  CHECK(show_files("") == 0);

  std::ofstream(tree / "doc/a.cc") << "int b;\n";
  CHECK(show_files("") == 1);
  CHECK(TopTests::read_text(tree / "report.txt").find("doc/a.md") !=
        std::string::npos);
  std::filesystem::remove(tree / "doc/a.cc");
  CHECK(show_files("--refresh") == 1);
}



TEST_CASE("A pulled bar without lateral contraction carries mu A (s - 1/s)",
          "[extending]")
{
  const Table table = read_table(
    run_example("problem/pulled_bar.prm", "extending_problem") + "/bar.csv");
  const auto elongation = table.column("elongation");
  const auto force      = table.column("force");
  REQUIRE(elongation.back() == Approx(0.2));
  for (unsigned int k = 0; k < force.size(); ++k)
    {
      const double s = 1. + elongation[k];
      CHECK(force[k] == Approx(50. * (s - 1. / s)).epsilon(1e-8));
    }

  // The same problem with the material of another example, by its name.
  const Table soft =
    read_table(run_example("problem/pulled_bar.prm",
                           "extending_soft_bar",
                           {"--set", "Material/Law=Mooney-Rivlin"}) +
               "/bar.csv");
  CHECK(soft.column("force").back() > 0.);
}
