// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about meshes of hexahedra: volumes, orders of nodes, and that deal.II
// reads the files of gmsh.

#include <npt_dealii/mesh_files/abaqus_file.h>
#include <npt_dealii/mesh_files/gmsh_file.h>

#include <deal.II/grid/grid_in.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cctype>
#include <functional>
#include <sstream>

using namespace NPT;
using dealii::Point;

namespace
{
  // Bodies beside each other, each of n x 2 x 1 elements on a unit cube, under
  // a map.
  HexahedralMesh
  cubes(const unsigned int                               degree,
        const unsigned int                               n_bodies,
        const unsigned int                               n,
        const std::function<Point<3>(const Point<3> &)> &map)
  {
    HexahedralMesh mesh;
    mesh.degree    = degree;
    mesh.materials = {
      {"yarn", {{{100., 10., 5.}}, {{.3, .2, .1}}, {{4., 3., 2.}}}}};
    const std::array<unsigned int, 3> size = {{n, 2, 1}};
    HexahedralMesh::PeriodicPair      ends{"left", "right", 0, {}};
    for (unsigned int b = 0; b < n_bodies; ++b)
      {
        const unsigned int          first = mesh.nodes.size();
        std::array<unsigned int, 3> points;
        for (unsigned int d = 0; d < 3; ++d)
          points[d] = degree * size[d] + 1;
        const auto node = [&](const unsigned int i,
                              const unsigned int j,
                              const unsigned int k) {
          return first + i + points[0] * (j + points[1] * k);
        };
        for (unsigned int k = 0; k < points[2]; ++k)
          for (unsigned int j = 0; j < points[1]; ++j)
            for (unsigned int i = 0; i < points[0]; ++i)
              {
                mesh.nodes.push_back(map(
                  Point<3>(static_cast<double>(i) / (points[0] - 1),
                           static_cast<double>(j) / (points[1] - 1) + 2. * b,
                           static_cast<double>(k) / (points[2] - 1))));
                if (i == 0)
                  ends.nodes.push_back(
                    {{node(0, j, k), node(points[0] - 1, j, k)}});
              }
        mesh.bodies.push_back({"yarn_" + std::to_string(b + 1), 0, {}});
        for (unsigned int k = 0; k < size[2]; ++k)
          for (unsigned int j = 0; j < size[1]; ++j)
            for (unsigned int i = 0; i < size[0]; ++i)
              {
                HexahedralMesh::Element element;
                element.body   = b;
                element.fiber  = Point<3>(1., 0., 0.);
                element.across = Point<3>(0., 1., 0.);
                for (unsigned int c = 0; c <= degree; ++c)
                  for (unsigned int a = 0; a <= degree; ++a)
                    for (unsigned int l = 0; l <= degree; ++l)
                      element.nodes.push_back(
                        node(i * degree + l, j * degree + a, k * degree + c));
                const std::array<unsigned int, 3> e = {{i, j, k}};
                for (unsigned int d = 0; d < 3; ++d)
                  for (const unsigned int side : {0u, 1u})
                    if (e[d] == side * (size[d] - 1))
                      mesh.bodies[b].faces[2 * d + side].push_back(
                        {static_cast<unsigned int>(mesh.elements.size()),
                         d,
                         side});
                mesh.elements.push_back(element);
              }
      }
    mesh.periodic = {ends};
    return mesh;
  }

  // Quadratic in one direction each: exact for Lagrange elements of degree 2
  // and, without products of squares, for serendipity ones.
  Point<3>
  curved(const Point<3> &X)
  {
    return Point<3>(X[0] + 0.2 * X[1] * X[1],
                    X[1] + 0.1 * X[2],
                    X[2] + 0.3 * X[0] * X[0]);
  }
} // namespace



TEST_CASE(
  "Quadratic elements of both kinds have the volume of a body whose map "
  "they contain, and folded ones a negative Jacobian",
  "[mesh_files]")
{
  // det = 1 + 0.024 X0 X1
  const double exact = 1. + 0.2 * 2. * 0.5 * 0.1 * 0.3 * 2. * 0.5;
  for (const auto which :
       {HexahedralMesh::Nodes::all, HexahedralMesh::Nodes::serendipity})
    {
      const auto quality = quality_of(cubes(2, 1, 3, curved), which);
      CHECK(quality.volume == Approx(exact).epsilon(1e-12));
      CHECK(quality.smallest_jacobian > 0.);
      const auto folded =
        quality_of(cubes(2,
                         1,
                         3,
                         [](const Point<3> &X) {
                           return Point<3>(X[0], X[1], X[2] * (0.4 - X[0]));
                         }),
                   which);
      CHECK(folded.smallest_jacobian < 0.);
    }
  CHECK(quality_of(cubes(1, 2, 3, [](const Point<3> &X) { return X; }),
                   HexahedralMesh::Nodes::all)
          .volume == Approx(2.).epsilon(1e-12));
}



TEST_CASE("A linear mesh written for gmsh is read by deal.II with its volumes, "
          "bodies and faces",
          "[mesh_files]")
{
  const HexahedralMesh mesh = cubes(1, 2, 3, [](const Point<3> &X) {
    return Point<3>(X[0] + 0.2 * X[1], X[1], X[2] * (1. + 0.5 * X[0]));
  });
  std::stringstream    file;
  write_gmsh(mesh, file);
  dealii::Triangulation<3> triangulation;
  dealii::GridIn<3>        reader(triangulation);
  reader.read_msh(file);
  CHECK(triangulation.n_active_cells() == mesh.elements.size());
  CHECK(
    dealii::GridTools::volume(triangulation) ==
    Approx(quality_of(mesh, HexahedralMesh::Nodes::all).volume).epsilon(1e-12));
  std::array<unsigned int, 2> cells{}, ends{};
  for (const auto &cell : triangulation.active_cell_iterators())
    {
      REQUIRE((cell->material_id() == 1 || cell->material_id() == 2));
      ++cells[cell->material_id() - 1];
      // Faces are numbered behind the two bodies: begin of the first is 3.
      for (const unsigned int f : cell->face_indices())
        if (cell->face(f)->at_boundary() &&
            cell->face(f)->boundary_id() == 3u + 6u * (cell->material_id() - 1))
          {
            ++ends[cell->material_id() - 1];
            CHECK(cell->face(f)->center()[0] ==
                  Approx(0.2 * cell->face(f)->center()[1]));
          }
    }
  CHECK(cells == std::array<unsigned int, 2>{{6, 6}});
  CHECK(ends == std::array<unsigned int, 2>{{2, 2}});
}



TEST_CASE(
  "The faces of a gmsh file are seen counterclockwise from outside, and "
  "its periodic nodes are those of the pairs",
  "[mesh_files]")
{
  for (const unsigned int degree : {1u, 2u})
    {
      const HexahedralMesh mesh =
        cubes(degree, 1, 2, [](const Point<3> &X) { return X; });
      std::stringstream file;
      write_gmsh(mesh, file);
      std::string  word;
      unsigned int n = 0, n_quadrilaterals = 0;
      while (file >> word && word != "$Elements")
        ;
      unsigned int n_blocks, other;
      file >> n_blocks >> n >> other >> other;
      for (unsigned int block = 0, left = 0, type = 0; block < n_blocks;)
        {
          if (left == 0)
            {
              file >> other >> other >> type >> left;
              continue;
            }
          block += --left == 0 ? 1 : 0;
          const unsigned int n_nodes = type == 5  ? 8 :
                                       type == 12 ? 27 :
                                       type == 3  ? 4 :
                                                    9;
          file >> other;
          std::vector<Point<3>> x(n_nodes);
          for (Point<3> &point : x)
            {
              unsigned int node;
              file >> node;
              point = mesh.nodes[node - 1];
            }
          if (n_nodes == 27) // the center of the corners
            CHECK(x[26].distance(0.5 * (x[0] + x[6])) < 1e-12);
          if (type == 5 || type == 12)
            continue;
          ++n_quadrilaterals;
          const auto normal = cross_product_3d(x[1] - x[0], x[3] - x[0]);
          const auto middle = 0.5 * (x[0] + x[2]);
          CHECK(normal * (middle - Point<3>(0.5, 0.5, 0.5)) > 0.);
          if (n_nodes == 9)
            {
              CHECK(x[8].distance(Point<3>(middle)) < 1e-12);
              for (unsigned int k = 0; k < 4; ++k)
                CHECK(x[4 + k].distance(
                        Point<3>(0.5 * (x[k] + x[(k + 1) % 4]))) < 1e-12);
            }
        }
      CHECK(n_quadrilaterals == 2 * (2 + 4 + 2));
      while (file >> word && word != "$Periodic")
        ;
      unsigned int count;
      file >> other >> other >> other >> other >> other >> count;
      CHECK(count == (2 * degree + 1) * (degree + 1));
      for (unsigned int k = 0; k < count; ++k)
        {
          unsigned int a, b;
          file >> a >> b;
          CHECK(mesh.nodes[a - 1].distance(mesh.nodes[b - 1] +
                                           Point<3>(1., 0., 0.)) < 1e-12);
        }
    }
}



TEST_CASE(
  "An Abaqus file has the nodes of C3D20 at their places, and no others",
  "[mesh_files]")
{
  const HexahedralMesh mesh = cubes(2, 1, 1, [](const Point<3> &X) {
    return Point<3>(X[0] - 1e-17 / 3., X[1] / 3., X[2]);
  });
  std::ostringstream   out;
  write_abaqus(mesh, "One line.\nAnother one.", out);
  const std::string  text = out.str();
  std::istringstream file(text.substr(text.find("TYPE=C3D20")));
  std::string        line, more;
  std::getline(file, line);
  std::getline(file, line);
  std::getline(file, more);
  line += more;
  std::replace(line.begin(), line.end(), ',', ' ');
  std::istringstream numbers(line);
  unsigned int       number;
  numbers >> number;
  std::vector<Point<3>> x;
  while (numbers >> number)
    x.push_back(mesh.nodes[number - 1]);
  REQUIRE(x.size() == 20);
  const std::array<std::array<unsigned int, 2>, 12> edges = {{{{0, 1}},
                                                              {{1, 2}},
                                                              {{2, 3}},
                                                              {{3, 0}},
                                                              {{4, 5}},
                                                              {{5, 6}},
                                                              {{6, 7}},
                                                              {{7, 4}},
                                                              {{0, 4}},
                                                              {{1, 5}},
                                                              {{2, 6}},
                                                              {{3, 7}}}};
  for (unsigned int e = 0; e < 12; ++e)
    CHECK(x[8 + e].distance(Point<3>(0.5 * (x[edges[e][0]] + x[edges[e][1]]))) <
          1e-12);
  CHECK(cross_product_3d(x[1] - x[0], x[3] - x[0]) * (x[4] - x[0]) > 0.);
  const auto used = mesh.used_nodes(HexahedralMesh::Nodes::serendipity);
  // Two elements with a common face.
  CHECK(std::count(used.begin(), used.end(), true) == 20 + 12);
  for (const std::string words : {"** Another one.",
                                  "*SURFACE, NAME=YARN_1_SURFACE, TYPE=ELEMENT",
                                  "NSET=RIGHT",
                                  "*ELASTIC, TYPE=ENGINEERING CONSTANTS",
                                  "NSET=YARN_1_BEGIN",
                                  "MATERIAL=YARN"})
    CHECK(text.find(words) != std::string::npos);
  // Abaqus reads at most 256 characters of a line, CalculiX 20 of a number.
  std::istringstream lines(text);
  while (std::getline(lines, line))
    {
      CHECK(line.size() < 200);
      std::istringstream items(line);
      for (std::string item; line[0] != '*' && std::getline(items, item, ',');)
        CHECK((std::isalpha(item[0]) || item.size() <= 21)); // and a blank
    }
}
