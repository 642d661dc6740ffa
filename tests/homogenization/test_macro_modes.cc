// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the table of macroscopic modes: displacement, parity, names, and
// that everything which counts modes takes their number from it.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/homogenization/macro_unknowns.h>

#include <deal.II/base/symmetric_tensor.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

using namespace NPT;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

namespace
{
  MeshParameters
  small_mesh()
  {
    MeshParameters mesh;
    mesh.elements_along  = 2;
    mesh.elements_across = 2;
    return mesh;
  }

  /// Strain of the jump seen from the reference side, d(Y) = Q w_m(gY) -
  /// w_m(Y), for one unit of H_n. w_m is quadratic, so central differences are
  /// exact.
  SymmetricTensor<2, 3>
  strain_of_jump(const SymmetryOperation &g,
                 const unsigned int       n,
                 const Point<3>          &Y)
  {
    const auto jump = [&](const Point<3> &X) {
      Tensor<1, 3> d = macroscopic_displacement(n, g(X));
      for (unsigned int i = 0; i < 3; ++i)
        d[i] *= g.Q[i];
      return d - macroscopic_displacement(n, X);
    };
    Tensor<2, 3> gradient;
    for (unsigned int j = 0; j < 3; ++j)
      {
        Tensor<1, 3> h;
        h[j]                          = 0.5;
        const Tensor<1, 3> derivative = jump(Y + h) - jump(Y - h);
        for (unsigned int i = 0; i < 3; ++i)
          gradient[i][j] = derivative[i];
      }
    return symmetrize(gradient);
  }
} // namespace



TEST_CASE("The macroscopic field has the gradients it is named after",
          "[homogenization]")
{
  // Strain of H_n at height Z3: extensions and engineering shear, bending
  // strain Z3 H, torsion like shear; and no transverse shear.
  const Point<3> Y(0.4, -0.7, 0.3);
  for (unsigned int n = 0; n < MacroModes::n; ++n)
    {
      SymmetricTensor<2, 3> strain;
      for (unsigned int j = 0; j < 3; ++j)
        {
          Tensor<1, 3> h;
          h[j]                      = 0.5;
          const Tensor<1, 3> column = macroscopic_displacement(n, Y + h) -
                                      macroscopic_displacement(n, Y - h);
          for (unsigned int i = 0; i < 3; ++i)
            strain[i][j] += (i == j ? 1. : 0.5) * column[i];
        }
      const bool bends = MacroModes::table[n].kind == MacroMode::Kind::bending;
      const double          factor = bends ? Y[2] : 1.;
      SymmetricTensor<2, 3> expected;
      if (n % 3 == 2)
        expected[0][1] = 0.5 * factor;
      else
        expected[n % 3][n % 3] = factor;
      CHECK((strain - expected).norm() < 1e-14);
    }
}



TEST_CASE("A mode is kept exactly if its jump is a rigid motion",
          "[homogenization]")
{
  // The operations of the table in doc/theory.md; L = 3.7.
  const double                         L          = 3.7;
  const std::vector<SymmetryOperation> operations = {
    {"glide along Y1", Tensor<1, 3>({1., 1., -1.}), Tensor<1, 3>({L, 0., 0.})},
    {"glide along Y2", Tensor<1, 3>({1., 1., -1.}), Tensor<1, 3>({0., L, 0.})},
    {"2-fold axis Y3", Tensor<1, 3>({-1., -1., 1.}), Tensor<1, 3>()},
    {"2-fold axis Y2", Tensor<1, 3>({-1., 1., -1.}), Tensor<1, 3>({L, 0., 0.})},
    {"screw along Y1", Tensor<1, 3>({1., -1., -1.}), Tensor<1, 3>({L, 0., 0.})},
    {"translation", Tensor<1, 3>({1., 1., 1.}), Tensor<1, 3>({L, -L, 0.})}};
  // H1 .. H6: kept or flipped.
  const std::vector<std::string> table = {
    "kkkfff", "kkkfff", "kkkkkk", "kkfffk", "kkfffk", "kkkkkk"};
  REQUIRE(table[0].size() == MacroModes::n);
  const Point<3> Y(0.3, -0.8, 0.45);
  for (unsigned int o = 0; o < operations.size(); ++o)
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      {
        INFO(operations[o].name << ", " << MacroModes::table[n].name);
        CHECK(keeps_mode(operations[o], n) == (table[o][n] == 'k'));
        const double strain = strain_of_jump(operations[o], n, Y).norm();
        if (table[o][n] == 'k')
          CHECK(strain < 1e-13);
        else
          CHECK(strain > 0.1);
      }
}



TEST_CASE("A mode of odd parity turns into its opposite, and no mode into "
          "another one",
          "[homogenization]")
{
  // w_n(QY) = +-Q w_n(Y) for all reflections Q = diag(+-1, +-1, +-1).
  const Point<3> Y(0.3, -0.8, 0.45);
  for (unsigned int reflection = 0; reflection < 8; ++reflection)
    {
      SymmetryOperation g = SymmetryOperation::identity();
      for (unsigned int d = 0; d < 3; ++d)
        if ((reflection >> d & 1u) != 0)
          g.Q[d] = -1.;
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        {
          INFO(MacroModes::table[n].name << ", Q = " << g.Q);
          const double       sign  = keeps_mode(g, n) ? 1. : -1.;
          const Tensor<1, 3> w     = macroscopic_displacement(n, Y);
          Tensor<1, 3>       image = macroscopic_displacement(n, g(Y));
          for (unsigned int i = 0; i < 3; ++i)
            image[i] -= sign * g.Q[i] * w[i];
          CHECK(image.norm() < 1e-15);
        }
    }
}



TEST_CASE("The sub-unit cell represents extension and shear only",
          "[homogenization]")
{
  for (const bool two_fold_axis : {true, false})
    {
      CellParameters parameters;
      parameters.two_fold_axis = two_fold_axis;
      const FabricCell cell(parameters, small_mesh());
      for (unsigned int n = 0; n < MacroModes::n; ++n)
        {
          const bool is_membrane =
            MacroModes::table[n].kind == MacroMode::Kind::membrane;
          CHECK(represents_mode(cell, n) == is_membrane);
          CHECK(obstacle(cell, n) ==
                (is_membrane ? "" : "glide plane along Y1"));
        }
    }
}



TEST_CASE("The smallest cell follows from the modes of the load programme",
          "[homogenization]")
{
  CellParameters parameters;
  const auto     smallest = [&](const std::string &weave, const char *mode) {
    parameters.weave = weave;
    return smallest_cell_type(parameters, {MacroModes::number_of(mode)});
  };
  CHECK(smallest("plain", "H3").first == "sub-unit cell");
  CHECK(smallest("plain", "H4").first == "two-crossing cell");
  CHECK(smallest("2/2 twill", "n1").first == "sub-unit cell");
  CHECK(smallest("2/2 twill", "H6").first == "primitive cell");
  CHECK(smallest("5-harness satin", "H1").first == "primitive cell");
  CHECK(smallest("plain", "H4").second ==
        "because H4 or n4 is prescribed, which glide planes forbid");
  CHECK(smallest("plain", "H3").second ==
        "because only modes among H1, H2 and H3 are prescribed, which glide "
        "planes allow");
}



TEST_CASE("Every mode is found by the name of its gradient and of its "
          "conjugate",
          "[homogenization]")
{
  std::set<std::string> names;
  for (unsigned int n = 0; n < MacroModes::n; ++n)
    {
      const MacroMode &mode = MacroModes::table[n];
      CHECK(MacroModes::number_of(mode.name) == n);
      CHECK(MacroModes::number_of(mode.conjugate) == n);
      CHECK_FALSE(MacroModes::is_conjugate(mode.name));
      CHECK(MacroModes::is_conjugate(mode.conjugate));
      CHECK(names.insert(mode.name).second);
      CHECK(names.insert(mode.conjugate).second);
      CHECK(("|" + MacroModes::choices() + "|")
              .find("|" + std::string(mode.name) + "|") != std::string::npos);
    }
  CHECK(MacroModes::number_of("H0") == MacroModes::n);
  CHECK(MacroModes::number_of("") == MacroModes::n);
  CHECK(MacroModes::choices() == "H1|H2|H3|H4|H5|H6|n1|n2|n3|n4|n5|n6");
  CHECK(MacroModes::meaning_of_gradients() ==
        "H1, H2 extension [-], H3 shear [-], H4, H5 bending [1/mm], H6 torsion "
        "[1/mm]");
  CHECK(MacroModes::units_of_conjugates() ==
        "n1, n2, n3 [N/mm], n4, n5, n6 [N]");
  CHECK(MacroModes::list_of_names({0, 1, 2}) == "H1, H2 and H3");
  CHECK(MacroModes::list_of_names({0}) == "H1");
}



TEST_CASE("The work of a mode per area is its conjugate times its gradient",
          "[homogenization]")
{
  // Units: [-] [N/mm] = [1/mm] [N] = N/mm, and rigidity times gradient gives
  // the conjugate.
  for (const MacroMode &mode : MacroModes::table)
    {
      const bool membrane = mode.kind == MacroMode::Kind::membrane;
      CHECK(mode.unit() == std::string(membrane ? "-" : "1/mm"));
      CHECK(mode.conjugate_unit() == std::string(membrane ? "N/mm" : "N"));
      CHECK(mode.rigidity_unit() == std::string(membrane ? "N/mm" : "N mm"));
    }
  static_assert(MacroUnknowns::n_modes == MacroModes::n, "");
  static_assert(MacroUnknowns::n_macro == MacroModes::n + 1, "");
}



TEST_CASE(
  "No other file knows how many modes there are or what they are called",
  "[homogenization]")
{
  // Literals by which a file would have to be edited for a seventh mode: sizes
  // and loops of 6, membrane modes as n < 3, names made from numbers. A hit
  // that means something else is listed with its reason.
  const std::regex literal("double, 6>|< 6;|\\[6\\]|== 6\\b|[a-z] < 3 \\?|"
                           "\"H1\\||\"H\" \\+ std::to_string|"
                           "\"n\" \\+ std::to_string|, H\" << n");
  const std::set<std::string> listed = {
    "homogenization/macro_modes.h"}; // the table itself
  for (const std::string tree : {"source", "include/npt_dealii"})
    for (const std::string room : {"fabric",
                                   "homogenization",
                                   "problems/load_programme",
                                   "problems/plate_results",
                                   "problems/plate_test",
                                   "problems/parameter_study"})
      for (const auto &entry : std::filesystem::directory_iterator(
             std::string(NPT_SOURCE_DIR) + "/" + tree + "/" + room))
        {
          const std::string name =
            room + "/" + entry.path().filename().string();
          if (listed.count(name) > 0)
            continue;
          std::ifstream in(entry.path());
          unsigned int  number = 0;
          for (std::string line; std::getline(in, line);)
            {
              ++number;
              INFO(name << ":" << number << ": " << line);
              CHECK_FALSE(std::regex_search(line, literal));
            }
        }
}
