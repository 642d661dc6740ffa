// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the way out of a plate test to other programs: meshes and yarns
// of one repeat of the woven fabric.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric_files/texgen.h>
#include <npt_dealii/homogenization/objective_jumps.h>
#include <npt_dealii/mesh_files/abaqus_file.h>
#include <npt_dealii/problems/plate_exports/cell_mesh.h>
#include <npt_dealii/problems/plate_exports/export_cell.h>
#include <npt_dealii/problems/plate_exports/yarn_sections.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "plate_run.h"

using namespace PlateTestTools;
using dealii::Point;
using dealii::Tensor;

namespace
{
  enum class Kind
  {
    released,
    sheared,
    bent
  };

  // A plain weave of one crossing, whose repeat needs translations and glide
  // planes: woven and released, then sheared; and one of two, which is bent.
  const PlateRun &
  woven_cell(const Kind kind)
  {
    // Never destroyed, because their solver must not outlive MPI.
    static auto &runs = *new std::map<Kind, std::unique_ptr<PlateRun>>;
    auto        &run  = runs[kind];
    if (!run)
      {
        std::vector<std::string> overrides = {
          "Mesh/Elements along=4",
          "Mesh/Elements across=4",
          "Mesh/Elements through=1",
          std::string("Load programme/Stages=weave, release") +
            (kind == Kind::released ? "" : ", load")};
        if (kind == Kind::sheared)
          overrides.push_back("Load programme/Stage load/Targets=H3: 0.05");
        if (kind == Kind::bent) // so that images are rigid motions
          overrides.insert(overrides.end(),
                           {"Load programme/Stage load/Targets=H4: 0.02",
                            "Homogenization/Jumps=objective"});
        run = std::make_unique<PlateRun>(overrides);
        run->run();
      }
    return *run;
  }

  DeformedCell
  deformed(const PlateRun &run)
  {
    const IGASpace<3>    &space = run.cell.bodies().space();
    std::vector<Point<3>> positions;
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      positions.push_back(space.control_points()[A] +
                          Tensor<1, 3>({run.state.u[3 * A],
                                        run.state.u[3 * A + 1],
                                        run.state.u[3 * A + 2]}));
    return {run.cell.fabric(),
            space,
            positions,
            run.woven,
            gradients_of(run.cell.macro(), run.state.u),
            run.parameters.load_programme.stages.back().bends_along};
  }

  // Volume of one repeat by the quadrature of the program.
  double
  volume_of_program(const PlateRun &run)
  {
    const DeformableBodies &bodies = run.cell.bodies();
    SolidKernel             kernel;
    std::vector<double>     w;
    double                  volume = 0;
    for (unsigned int c = 0; c < bodies.space().cells().size(); ++c)
      {
        const CellGradients &cell = bodies.gradients()[c];
        bodies.cell_displacement(c, run.state.u, w);
        const double *F = kernel.deformation_gradients(cell, w);
        for (unsigned int q = 0; q < cell.n_points; ++q, F += 9)
          volume +=
            cell.jxw[q] *
            determinant(Tensor<2, 3>(
              {{F[0], F[1], F[2]}, {F[3], F[4], F[5]}, {F[6], F[7], F[8]}}));
      }
    double crossings = 0;
    for (unsigned int b = 0; b < run.cell.fabric().bundles().size(); ++b)
      crossings += run.cell.fabric().n_crossings(b);
    return volume * run.cell.fabric().repeat().size() / crossings;
  }

  std::filesystem::path
  export_folder()
  {
    const auto folder =
      std::filesystem::path(NPT_BINARY_DIR) / "test_exports_files";
    std::filesystem::create_directories(folder);
    return folder;
  }
} // namespace



TEST_CASE("The strands of a repeat go on over their seams, and its ends are "
          "images of each other, also sheared and bent",
          "[top]")
{
  for (const Kind kind : {Kind::released, Kind::sheared, Kind::bent})
    {
      const DeformedCell cell    = deformed(woven_cell(kind));
      const auto         strands = FabricStrand::of_repeat(cell);
      CHECK(cell.bends_along.has_value() == (kind == Kind::bent));
      REQUIRE(strands.size() == 4);
      for (const FabricStrand &strand : strands)
        {
          CHECK(strand.n_spans(0) == 8);
          for (unsigned int s = 1; s < strand.n_spans(0); ++s)
            for (unsigned int j = 0; j < strand.n_spans(1); ++j)
              {
                const auto before =
                  strand.at({{{s - 1, j, 0}}, {{1., .3, .7}}});
                const auto behind = strand.at({{{s, j, 0}}, {{0., .3, .7}}});
                CHECK(before.x.distance(behind.x) < 1e-10);
              }
        }

      const HexahedralMesh mesh = make_cell_mesh(strands, 2, 1);
      REQUIRE(mesh.periodic.size() == 2);
      for (const auto &pair : mesh.periodic)
        {
          // Two strands, 9 x 3 nodes in a section.
          REQUIRE(pair.nodes.size() == 2 * 9 * 3);
          // By one rigid motion, which is a shift of plane cells.
          const auto from_first = [&](const unsigned int k,
                                      const unsigned int side) {
            return mesh.nodes[pair.nodes[k][side]] -
                   mesh.nodes[pair.nodes[0][side]];
          };
          for (unsigned int k = 0; k < pair.nodes.size(); ++k)
            {
              CHECK(from_first(k, 0).norm() ==
                    Approx(from_first(k, 1).norm()).margin(1e-10));
              if (kind != Kind::bent)
                CHECK((from_first(k, 0) - from_first(k, 1)).norm() < 1e-10);
            }
        }
      const Tensor<1, 3> weft = mesh.nodes[mesh.periodic[1].nodes[0][1]] -
                                mesh.nodes[mesh.periodic[1].nodes[0][0]];
      // Half of the engineering shear turns each family.
      if (kind != Kind::bent)
        CHECK(weft[0] ==
              Approx(kind == Kind::sheared ? 0.25 : 0.).margin(1e-9));
    }
}



TEST_CASE(
  "Layers that lie on each other are strands of their own, whatever the "
  "size of the cell",
  "[top]")
{
  for (const std::string unit : {"", "e-9"}) // mm, pm
    {
      const auto length = [&](const std::string &number) {
        return number + unit;
      };
      PlateRun   run({"Cell/Type=two-crossing cell",
                      "Cell/Layers=2",
                      "Cell/Layer shift=0, 0",
                      "Cell/Crossing spacing=" + length("5"),
                      "Cell/Bundle width=" + length("4"),
                      "Cell/Bundle thickness=" + length("1.2"),
                      "Mesh/Elements along=3",
                      "Mesh/Elements across=3",
                      "Mesh/Elements through=1"});
      const auto strands = FabricStrand::of_repeat(deformed(run));
      CHECK(strands.size() == 8);
      for (const FabricStrand &strand : strands)
        CHECK(strand.n_spans(0) == 6);
    }
}



TEST_CASE("The exported meshes have the volume of the program, positive "
          "Jacobians and unit fibers F A",
          "[top]")
{
  for (const Kind kind : {Kind::released, Kind::sheared, Kind::bent})
    {
      const PlateRun    &run         = woven_cell(kind);
      const DeformedCell cell        = deformed(run);
      const auto         strands     = FabricStrand::of_repeat(cell);
      const double       exact       = volume_of_program(run);
      using Nodes                    = HexahedralMesh::Nodes;
      const HexahedralMesh quadratic = make_cell_mesh(strands, 2, 1);
      for (const Nodes nodes : {Nodes::all, Nodes::serendipity})
        {
          const MeshQuality quality = quality_of(quadratic, nodes);
          CHECK(quality.volume == Approx(exact).epsilon(1e-3));
          CHECK(quality.smallest_jacobian > 0.);
        }
      const HexahedralMesh linear = make_cell_mesh(strands, 1, 5);
      CHECK(quality_of(linear, Nodes::all).volume ==
            Approx(exact).epsilon(3e-3));
      CHECK(quality_of(linear, Nodes::all).smallest_jacobian > 0.);
      CHECK(linear.elements.size() == 125 * quadratic.elements.size());

      for (const HexahedralMesh *mesh : {&quadratic, &linear})
        for (const auto &element : mesh->elements)
          {
            CHECK(element.fiber.norm() == Approx(1.).epsilon(1e-14));
            CHECK(element.across.norm() == Approx(1.).epsilon(1e-14));
            CHECK(std::abs(element.fiber * element.across) < 1e-14);
          }
      // Along the nodes of the finer mesh, up to its curvature.
      for (const auto &element : linear.elements)
        {
          Tensor<1, 3> along;
          for (const unsigned int a : {0, 2, 4, 6})
            along += linear.nodes[element.nodes[a + 1]] -
                     linear.nodes[element.nodes[a]];
          CHECK((along / along.norm() - element.fiber).norm() < 2e-3);
        }
      std::size_t n_faces = 0;
      for (const auto &body : linear.bodies)
        for (const auto &faces : body.faces)
          n_faces += faces.size();
      // Ends 20 x 5, edges 40 x 5, wide faces 40 x 20, twice each.
      CHECK(n_faces == 4 * 2 * (100 + 200 + 800));
    }
}



TEST_CASE("A woven cell written for TexGen is read as the cell that it was",
          "[top]")
{
  const PlateRun    &run     = woven_cell(Kind::released);
  const DeformedCell cell    = deformed(run);
  const auto         strands = FabricStrand::of_repeat(cell);
  const WovenTextile textile = make_woven_textile(strands, "woven");
  REQUIRE(textile.yarns.size() == 4);

  // Sections along the paths fill the volume of the bundles: Simpson's rule
  // over the stations.
  double volume = 0, length = 0;
  for (const auto &yarn : textile.yarns)
    for (std::size_t k = 0; k + 2 < yarn.size(); k += 2)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const auto &s    = yarn[k + i].section;
          double      area = 0;
          for (std::size_t c = 0; c < s.size(); ++c)
            {
              const auto &a = s[c], &b = s[(c + 1) % s.size()];
              area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
            }
          CHECK(area > 0.); // counterclockwise
          CHECK(std::abs(yarn[k + i].tangent * yarn[k + i].up) < 1e-12);
          const double step =
            yarn[k].position.distance(yarn[k + 1].position) +
            yarn[k + 1].position.distance(yarn[k + 2].position);
          volume += area * step / 6. * (i == 1 ? 4. : 1.);
          length += step / 3.;
        }
  CHECK(volume == Approx(volume_of_program(run)).epsilon(0.01));

  const std::string path = (export_folder() / "woven.tg3").string();
  {
    std::ofstream file(path);
    write_texgen(textile, file);
  }
  const CellParameters  before = run.parameters.cell;
  const ImportedWeave   weave  = read_texgen(path);
  const CellParameters &after  = weave.cell;
  CHECK((after.weave == "ou/uo" || after.weave == "uo/ou"));
  CHECK(after.crossing_spacing.warp ==
        Approx(before.crossing_spacing.warp).epsilon(1e-10));
  CHECK(after.crossing_spacing.weft ==
        Approx(before.crossing_spacing.weft).epsilon(1e-10));
  // Straight bundles with the volume of the woven ones over their length.
  CHECK(after.warp_section().area() * length ==
        Approx(volume_of_program(run)).epsilon(0.01));
  CHECK(after.bundle_thickness.warp ==
        Approx(before.bundle_thickness.warp).epsilon(0.1));
  CHECK(after.warp_section().area() ==
        Approx(after.weft_section().area()).epsilon(0.01));
  REQUIRE(!weave.notes.empty());
  CHECK_THAT(weave.notes[0], Catch::Contains("polygons of a woven state"));

  CHECK_THROWS_AS(make_woven_textile(FabricStrand::of_repeat(
                                       deformed(woven_cell(Kind::sheared))),
                                     "sheared"),
                  InputError);
}



TEST_CASE(
  "Straight lenses written for TexGen have the volume of its lenticular "
  "sections to one percent",
  "[top]")
{
  // As a TexGen file gives it: circular arcs, sharp edges.
  CellParameters cell;
  cell.bundle_width     = 1.6;
  cell.bundle_thickness = 0.4;
  cell.crossing_spacing = 2.;
  const double R = (0.64 + 0.04) / 0.4, angle = std::asin(0.8 / R);
  const double arcs = 2. * R * R * (angle - std::sin(angle) * std::cos(angle));
  const std::string path = (export_folder() / "lens.tg3").string();
  {
    std::ofstream file(path);
    write_texgen(cell, "lens", file);
  }
  CellParameters read = read_texgen(path).cell;
  read.type           = "unit cell";
  MeshParameters mesh;
  mesh.elements_along = mesh.elements_across = 6;
  mesh.elements_through                      = 1;
  const FabricCell           fabric(read, mesh);
  std::vector<NURBSPatch<3>> patches;
  for (const FiberBundle &bundle : fabric.bundles())
    patches.push_back(bundle.patch);
  const IGASpace<3>  space(patches, {}, Basis::NURBS);
  const DeformedCell straight{
    fabric, space, space.control_points(), {}, {}, {}};
  const auto strands = FabricStrand::of_repeat(straight);
  // Four yarns of 4 mm.
  CHECK(quality_of(make_cell_mesh(strands, 2, 1),
                   HexahedralMesh::Nodes::serendipity)
          .volume == Approx(4. * 4. * arcs).epsilon(0.01));
  for (const auto &yarn : make_woven_textile(strands, "lens").yarns)
    for (const auto &station : yarn)
      {
        double area = 0;
        for (std::size_t c = 0; c < station.section.size(); ++c)
          {
            const auto &a = station.section[c],
                       &b = station.section[(c + 1) % station.section.size()];
            area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
          }
        CHECK(area == Approx(arcs).epsilon(0.01));
      }
}



TEST_CASE("The constants of an exported material are those of its law", "[top]")
{
  const PlateRun    &run = woven_cell(Kind::released);
  const auto        &law = *run.cell.bodies().laws()[0];
  const Tensor<1, 3> e1({1., 0., 0.}), e3({0., 0., 1.});
  REQUIRE(run.cell.fabric().bundles()[0].direction == e1);
  const OrthotropicConstants constants = orthotropic_constants(law, e1, e3);
  const auto                 C         = law.small_strain_stiffness();
  // Uniaxial stress along the fibers gives E_1, and shears decouple.
  CHECK(constants.E[0] * (1. + 0. * C(0, 0)) ==
        Approx(C(0, 0) - C(0, 1) * (2. * C(0, 1)) / (C(1, 1) + C(1, 2))));
  CHECK(constants.nu[0] == Approx(C(0, 1) / (C(1, 1) + C(1, 2))));
  CHECK(constants.G[0] == Approx(C(5, 5)));
  CHECK(constants.G[2] == Approx(C(3, 3)));
  // The weft has its fibers along Y2 and the same law.
  const auto weft = orthotropic_constants(*run.cell.bodies().laws()[1],
                                          Tensor<1, 3>({0., 1., 0.}),
                                          e3);
  for (unsigned int i = 0; i < 3; ++i)
    {
      CHECK(weft.E[i] == Approx(constants.E[i]));
      CHECK(weft.nu[i] == Approx(constants.nu[i]));
      CHECK(weft.G[i] == Approx(constants.G[i]));
    }
}



TEST_CASE("Wrong exports are refused before anything is computed", "[top]")
{
  const auto refused = [](const std::vector<std::string> &overrides) {
    try
      {
        PlateTestParameters::read(make_parameter_text("", "export.prm"),
                                  overrides);
      }
    catch (const InputError &error)
      {
        return std::string(error.what());
      }
    return std::string();
  };
  CHECK_THAT(refused({"Output/Export=abaqus, none"}),
             Catch::Contains("none beside a format"));
  CHECK_THAT(refused(
               {"Output/Export=abaqus", "Output/Export after stage=weawe"}),
             Catch::Contains("did you mean 'weave'"));
  CHECK_THAT(refused({"Output/Export=texgen", "Cell/Type=laminate"}),
             Catch::Contains("no yarns"));
  CHECK(refused({"Output/Export=gmsh, texgen",
                 "Output/Export after stage=weave, release"})
          .empty());
}



namespace
{
  // All nodes moved linearly. CalculiX wants an unknown: a corner of a cube far
  // away.
  void
  write_deck_of_strain(const HexahedralMesh        &mesh,
                       const Tensor<2, 3>          &strain,
                       const std::filesystem::path &path)
  {
    const unsigned int n = mesh.nodes.size(), m = mesh.elements.size();
    std::ofstream      deck(path);
    deck.precision(12);
    deck << "*INCLUDE, INPUT=cell.inp\n*NODE, NSET=CUBE_NODES\n";
    for (unsigned int k = 0; k < 8; ++k)
      deck << n + k + 1 << ", " << 100 + ((k + 1) / 2) % 2 << ", " << k / 2 % 2
           << ", " << k / 4 << "\n";
    deck << "*ELEMENT, TYPE=C3D8, ELSET=CUBE\n" << m + 1;
    for (unsigned int k = 0; k < 8; ++k)
      deck << ", " << n + k + 1;
    deck << "\n*MATERIAL, NAME=OTHER\n*ELASTIC\n1., 0.3\n*SOLID SECTION, "
            "ELSET=CUBE, MATERIAL=OTHER\n*STEP\n*STATIC\n*BOUNDARY\n";
    const auto used = mesh.used_nodes(HexahedralMesh::Nodes::serendipity);
    for (unsigned int i = 0; i < n; ++i)
      if (used[i])
        for (unsigned int c = 0; c < 3; ++c)
          deck << i + 1 << ", " << c + 1 << ", " << c + 1 << ", "
               << (strain * mesh.nodes[i])[c] << "\n";
    for (unsigned int k = 0; k < 7; ++k)
      deck << n + k + 1 << ", 1, 3\n";
    deck << "*EL PRINT, ELSET=ALL_ELEMENTS, TOTALS=ONLY\nELSE, EVOL\n"
            "*END STEP\n";
  }

  // Order 11, 22, 33, 23, 13, 12.
  dealii::FullMatrix<double>
  stiffness(const OrthotropicConstants &c)
  {
    dealii::FullMatrix<double> S(6, 6), C(6, 6);
    for (unsigned int i = 0; i < 3; ++i)
      {
        S(i, i)         = 1. / c.E[i];
        S(3 + i, 3 + i) = 1. / c.G[2 - i];
      }
    S(0, 1) = S(1, 0) = -c.nu[0] / c.E[0];
    S(0, 2) = S(2, 0) = -c.nu[1] / c.E[0];
    S(1, 2) = S(2, 1) = -c.nu[2] / c.E[1];
    C.invert(S);
    return C;
  }

  // 1/2 eps : C eps V by element, C in the axes of the element.
  double
  energy_of_strain(const HexahedralMesh &mesh, const Tensor<2, 3> &strain)
  {
    double energy = 0;
    for (const auto &element : mesh.elements)
      {
        HexahedralMesh one;
        one.degree   = mesh.degree;
        one.nodes    = mesh.nodes;
        one.elements = {element};
        Tensor<2, 3> R;
        R[0] = element.fiber;
        R[1] = element.across;
        R[2] = cross_product_3d(element.fiber, element.across);
        const Tensor<2, 3>     e = R * strain * transpose(R);
        dealii::Vector<double> v(6), s(6);
        for (unsigned int i = 0; i < 3; ++i)
          v[i] = e[i][i];
        v[3] = 2. * e[1][2];
        v[4] = 2. * e[0][2];
        v[5] = 2. * e[0][1];
        stiffness(mesh.materials[mesh.bodies[element.body].material].constants)
          .vmult(s, v);
        energy += 0.5 * (v * s) *
                  quality_of(one, HexahedralMesh::Nodes::serendipity).volume;
      }
    return energy;
  }

  std::vector<double>
  numbers_in(const std::filesystem::path &path)
  {
    std::ifstream       file(path);
    std::vector<double> numbers;
    for (std::string word; file >> word;)
      {
        char        *end   = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        if (*end == '\0')
          numbers.push_back(value);
      }
    return numbers;
  }
} // namespace



// Whether CalculiX understands the file as it is meant.
TEST_CASE("CalculiX finds the energy of a uniform strain in the exported "
          "elements, fibers included",
          "[top]")
{
  if (std::system("command -v ccx > /dev/null 2>&1") != 0)
    {
      WARN("ccx is not installed, so its reading is not tested");
      return;
    }
  const PlateRun    &run     = woven_cell(Kind::released);
  const DeformedCell cell    = deformed(run);
  const auto         strands = FabricStrand::of_repeat(cell);
  const auto         folder  = export_folder();
  const Tensor<2, 3> strain(
    {{1e-3, 2e-4, -1e-4}, {2e-4, -5e-4, 3e-4}, {-1e-4, 3e-4, 7e-4}});
  for (const unsigned int degree : {1u, 2u})
    {
      HexahedralMesh mesh = make_cell_mesh(strands, degree, 1);
      add_materials(run.cell.fabric(), strands, run.cell.bodies().laws(), mesh);
      {
        std::ofstream file(folder / "cell.inp");
        write_abaqus(mesh, "End of stage release", file);
      }
      write_deck_of_strain(mesh, strain, folder / "deck.inp");
      const std::string command = "cd '" + folder.string() +
                                  "' && rm -f deck.dat && OMP_NUM_THREADS=1 "
                                  "ccx deck > deck.log 2>&1";
      REQUIRE(std::system(command.c_str()) == 0);
      const auto numbers = numbers_in(folder / "deck.dat");
      const auto finds   = [&](const double expected, const double tolerance) {
        return std::any_of(numbers.begin(), numbers.end(), [&](const double x) {
          return x == Approx(expected).epsilon(tolerance);
        });
      };
      // CalculiX prints seven digits.
      CHECK(finds(energy_of_strain(mesh, strain), 1e-5));
      CHECK(finds(quality_of(mesh, HexahedralMesh::Nodes::serendipity).volume,
                  1e-6));
    }
}
