// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the VTU and PVD files.

#include <npt_dealii/io/vtu_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <catch2/catch.hpp>

#ifdef DEAL_II_WITH_ZLIB
#  include <zlib.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

namespace
{
  using Degrees = std::array<unsigned int, 3>;

  std::string
  temporary_file(const std::string &name)
  {
    const std::string folder =
      std::string(NPT_BINARY_DIR) + "/tests/output_files";
    std::filesystem::create_directories(folder);
    return folder + "/" + name;
  }

  std::string
  file_content(const std::string &filename)
  {
    std::ifstream     in(filename, std::ios::binary);
    std::stringstream content;
    content << in.rdbuf();
    return content.str();
  }

  // The text between the tags of the array with the given name.
  std::string
  array_text(const std::string &file, const std::string &name)
  {
    const std::size_t tag = file.find("Name=\"" + name + "\"");
    REQUIRE(tag != std::string::npos);
    const std::size_t begin = file.find('>', tag) + 1;
    return file.substr(begin, file.find("</DataArray>", begin) - begin);
  }

  std::vector<double>
  array_values(const std::string &file, const std::string &name)
  {
    std::istringstream  in(array_text(file, name));
    std::vector<double> values;
    for (double value; in >> value;)
      values.push_back(value);
    return values;
  }

  // A quarter ring, exact with degree 2 around and degree 1 elsewhere, radii 1
  // and 2, height 1; all directions raised to the same kind of cell.
  NPT::BezierMesh
  quarter_ring()
  {
    NPT::BezierMesh mesh;
    mesh.degrees          = {{{2, 1, 1}}};
    const double     x[3] = {1, 1, 0};
    const double     y[3] = {0, 1, 1};
    const double     w[3] = {1, std::sqrt(0.5), 1};
    NPT::BezierField z    = {"height", 1, {}};
    for (unsigned int k = 0; k < 2; ++k)
      for (unsigned int j = 0; j < 2; ++j)
        for (unsigned int i = 0; i < 3; ++i)
          {
            for (const double coordinate :
                 {(1. + j) * x[i], (1. + j) * y[i], 1. * k})
              mesh.points.push_back(coordinate);
            mesh.weights.push_back(w[i]);
            z.values.push_back(k);
          }
    mesh.point_data.push_back(z);
    mesh.cell_data.push_back({"bundle", 1, {7}});
    return mesh;
  }
} // namespace


TEST_CASE("VTK's numbering of a cell is a permutation of its control points",
          "[output]")
{
  for (const unsigned int dim : {2u, 3u})
    for (const Degrees &p : {Degrees{{1, 1, 1}},
                             Degrees{{2, 2, 2}},
                             Degrees{{3, 3, 3}},
                             Degrees{{4, 4, 4}},
                             Degrees{{2, 3, 4}},
                             Degrees{{4, 1, 2}}})
      {
        std::vector<unsigned int> position = NPT::lexicographic_to_vtk(dim, p);
        std::sort(position.begin(), position.end());
        std::vector<unsigned int> expected(position.size());
        std::iota(expected.begin(), expected.end(), 0);
        REQUIRE(position == expected);
      }
}


TEST_CASE("Corners, edges, faces and interior lie where VTK looks for them",
          "[output]")
{
  for (unsigned int p = 1; p <= 4; ++p)
    {
      const auto position = NPT::lexicographic_to_vtk(3, {{p, p, p}});
      const auto at = [&](unsigned int i, unsigned int j, unsigned int k) {
        return position[(k * (p + 1) + j) * (p + 1) + i];
      };
      CHECK(at(0, 0, 0) == 0);
      CHECK(at(p, 0, 0) == 1);
      CHECK(at(p, p, 0) == 2);
      CHECK(at(0, p, 0) == 3);
      CHECK(at(0, 0, p) == 4);
      CHECK(at(p, p, p) == 6);
      if (p == 1)
        continue;
      // Around the bottom, around the top, then upright, counter-clockwise:
      // the third upright edge stands on corner 2 (file version >= 2.1).
      const unsigned int m = p - 1;
      CHECK(at(1, 0, 0) == 8);
      CHECK(at(p, 1, 0) == 8 + m);
      CHECK(at(1, p, 0) == 8 + 2 * m);
      CHECK(at(0, 1, 0) == 8 + 3 * m);
      CHECK(at(1, 0, p) == 8 + 4 * m);
      CHECK(at(0, 0, 1) == 8 + 8 * m);
      CHECK(at(p, 0, 1) == 8 + 9 * m);
      CHECK(at(p, p, 1) == 8 + 10 * m);
      CHECK(at(0, p, 1) == 8 + 11 * m);
      CHECK(at(0, 1, 1) == 8 + 12 * m);
      CHECK(at(p, 1, 1) == 8 + 12 * m + m * m);
      CHECK(at(1, 0, 1) == 8 + 12 * m + 2 * m * m);
      CHECK(at(1, 1, p) == 8 + 12 * m + 5 * m * m);
      CHECK(at(1, 1, 1) == 8 + 12 * m + 6 * m * m);
    }

  // Printed by VTK 9.1 itself (PointIndexFromIJK) for unequal degrees, of
  // which a wrong stride would show.
  const std::vector<unsigned int> from_vtk = {
    0,  8,  1,  12, 50, 9,  13, 51, 10, 3,  11, 2,  20, 44, 23,
    32, 54, 38, 33, 55, 39, 29, 47, 26, 21, 45, 24, 34, 56, 40,
    35, 57, 41, 30, 48, 27, 22, 46, 25, 36, 58, 42, 37, 59, 43,
    31, 49, 28, 4,  14, 5,  18, 52, 15, 19, 53, 16, 7,  17, 6};
  CHECK(NPT::lexicographic_to_vtk(3, {{2, 3, 4}}) == from_vtk);
}


TEST_CASE("A quarter ring written as VTU and read back has its control points",
          "[output]")
{
  const NPT::BezierMesh mesh     = quarter_ring();
  const std::string     filename = temporary_file("ring_ascii.vtu");
  NPT::write_vtu(filename, mesh, NPT::Encoding::ascii);

  const std::string file = file_content(filename);
  CHECK(file.find("version=\"2.2\"") != std::string::npos);
  // 17 digits: equality without tolerance.
  CHECK(array_values(file, "Points") == mesh.points);
  CHECK(array_values(file, "RationalWeights") == mesh.weights);
  CHECK(array_values(file, "height") == mesh.point_data[0].values);
  CHECK(array_values(file, "bundle") == std::vector<double>{7});
  CHECK(array_values(file, "HigherOrderDegrees") ==
        std::vector<double>{2, 1, 1});
  CHECK(array_values(file, "types") == std::vector<double>{79});
  CHECK(array_values(file, "offsets") == std::vector<double>{12});
  // Corners, then the midpoints of the four edges around.
  CHECK(array_values(file, "connectivity") ==
        std::vector<double>{0, 2, 5, 3, 6, 8, 11, 9, 1, 4, 7, 10});
}


#ifdef DEAL_II_WITH_ZLIB
TEST_CASE("A compressed array unpacks to the numbers that were written",
          "[output]")
{
  const NPT::BezierMesh mesh     = quarter_ring();
  const std::string     filename = temporary_file("ring.vtu");
  NPT::write_vtu(filename, mesh);

  std::string text = array_text(file_content(filename), "Points");
  for (const char blank : {' ', '\n'})
    text.erase(std::remove(text.begin(), text.end(), blank), text.end());
  // Four 64-bit numbers, 32 bytes, are 44 characters of base64.
  const auto    header = dealii::Utilities::decode_base64(text.substr(0, 44));
  const auto    data   = dealii::Utilities::decode_base64(text.substr(44));
  std::uint64_t sizes[4];
  REQUIRE(header.size() >= sizeof(sizes));
  std::memcpy(sizes, header.data(), sizeof(sizes));
  REQUIRE(sizes[0] == 1);
  REQUIRE(sizes[1] == mesh.points.size() * sizeof(double));

  std::vector<double> points(mesh.points.size());
  uLongf              n_bytes = sizes[1];
  REQUIRE(uncompress(reinterpret_cast<Bytef *>(points.data()),
                     &n_bytes,
                     data.data(),
                     sizes[3]) == Z_OK);
  CHECK(points == mesh.points);
}
#endif


TEST_CASE("A surface in space becomes Bezier quadrilaterals", "[output]")
{
  NPT::BezierMesh mesh;
  mesh.dim     = 2;
  mesh.degrees = {{{1, 1, 0}}, {{2, 1, 0}}};
  mesh.weights.assign(10, 1.);
  mesh.points.assign(30, 0.);
  const std::string filename = temporary_file("surface.vtu");
  NPT::write_vtu(filename, mesh, NPT::Encoding::ascii);
  const std::string file = file_content(filename);
  CHECK(array_values(file, "types") == std::vector<double>{77, 77});
  CHECK(array_values(file, "connectivity") ==
        std::vector<double>{0, 1, 3, 2, 4, 6, 9, 7, 5, 8});
}


TEST_CASE("A field with a value too few is refused", "[output]")
{
#ifdef DEBUG
  NPT::BezierMesh mesh = quarter_ring();
  mesh.point_data[0].values.pop_back();
  CHECK_THROWS(NPT::write_vtu(temporary_file("wrong.vtu"), mesh));
  CHECK(!std::filesystem::exists(temporary_file("wrong.vtu")));
  CHECK(!std::filesystem::exists(temporary_file("wrong.vtu.part")));
#endif
  CHECK_THROWS(
    NPT::write_vtu(temporary_file("no/such/folder.vtu"), quarter_ring()));
}


TEST_CASE("The record of a run is complete after every output", "[output]")
{
  const std::string filename = temporary_file("fields.pvd");
  std::vector<std::pair<double, std::string>> records;
  for (const double time : {0., 1e-9 + 1., 2.})
    {
      records.emplace_back(time, "fields_" + std::to_string(records.size()));
      NPT::write_pvd(filename, records);
      const std::string file = file_content(filename);
      CHECK(file.find(records.back().second) != std::string::npos);
      CHECK(file.find("</VTKFile>") != std::string::npos);
    }
  CHECK(file_content(filename).find("1.000000001") != std::string::npos);
}
