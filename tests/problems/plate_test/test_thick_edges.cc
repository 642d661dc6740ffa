// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about bundles with thick blunt edges.

#include <npt_dealii/homogenization/bundle_overlap.h>
#include <npt_dealii/problems/plate_test/cell_contacts.h>
#include <npt_dealii/problems/plate_test/numerical_plate_testing.h>

#include <catch2/catch.hpp>

#include <sstream>

#include "plate_run.h"

namespace
{
  using namespace NPT;

  // The cell of prm/studies/thick_edges.prm.
  std::vector<std::string>
  thick_cell(const std::string &method, const std::string &n)
  {
    return {"Cell/Blunt tip=0.333333333333",
            "Fiber bundle material/Law=neo-Hookean",
            "Fiber bundle material/Young modulus=8.314",
            "Fiber bundle material/Poisson ratio=0.2722",
            "Contact/Method=" + method,
            "Mesh/Elements along=" + n,
            "Mesh/Elements across=" + n,
            "Load programme/Stages=weave, release, shear",
            "Load programme/Stage weave/Friction=true",
            "Load programme/Stage release/Friction=true",
            "Load programme/Stage shear/Targets=H3: 0.2",
            "Load programme/Stage shear/Initial step=0.05",
            "Load programme/Stage shear/Maximum step=0.05"};
  }



  FabricCell
  cell_with_tip(const double blunt_tip, const std::string &type)
  {
    CellParameters parameters;
    parameters.type      = type;
    parameters.blunt_tip = blunt_tip;
    return FabricCell(parameters, MeshParameters());
  }
} // namespace



TEST_CASE("A cell of bundles with thick edges is woven and sheared without a "
          "cut by both methods",
          "[plate test]")
{
  for (const std::string method : {"mortar", "KTS"})
    {
      INFO(method);
      std::ostringstream    screen;
      NumericalPlateTesting test(
        PlateTestParameters::read(make_parameter_text("", "thick.prm"),
                                  thick_cell(method, "5")),
        "",
        screen);
      test.run();
      REQUIRE(!test.curve().empty());
      unsigned int n_cuts = 0;
      for (const CurveRow &row : test.curve())
        n_cuts += row.cuts;
      CHECK(n_cuts == 0);
      // Within 10 % of .129 N/mm, which finer meshes tend to.
      CHECK(test.curve().back().n[2] == Approx(0.129).epsilon(0.1));
    }
}



TEST_CASE("Edges are round by themselves where they are thick, in cells that "
          "are woven, and always or never if the file says so",
          "[plate test]")
{
  ContactParameters contact;
  const auto        thin     = cell_with_tip(0.25, "sub-unit cell");
  const auto        thick    = cell_with_tip(0.3, "sub-unit cell");
  const auto        laminate = cell_with_tip(0.3, "laminate");
  CHECK(!has_round_edges(thin, contact));
  CHECK(has_round_edges(thick, contact));
  CHECK(!has_round_edges(laminate, contact));
  contact.round_edges = ContactParameters::RoundEdges::yes;
  CHECK(has_round_edges(thin, contact));
  CHECK(!has_round_edges(laminate, contact));
  contact.round_edges = ContactParameters::RoundEdges::no;
  CHECK(!has_round_edges(thick, contact));
}
