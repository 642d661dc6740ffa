// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the picture of a deformed cell.

#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/problems/plate_results/cell_picture.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "run_program.h"

namespace
{
  using namespace NPT;
  using dealii::Point;
  using TopTests::read_text;

  struct Drawn
  {
    FabricCell                  cell;
    std::vector<PictureSurface> surfaces;
  };

  IGASpace<3>
  make_space(const FabricCell &cell)
  {
    std::vector<NURBSPatch<3>> patches;
    std::vector<unsigned int>  bodies;
    for (const FiberBundle &bundle : cell.bundles())
      {
        patches.push_back(bundle.patch);
        bodies.push_back(bundle.body);
      }
    return IGASpace<3>(patches, bodies, Basis::NURBS);
  }

  // Straight bundles displaced by w_m. The value of a point is its height in
  // the reference configuration, which a glide plane turns over.
  Drawn
  draw(const std::string                       &type,
       const std::string                       &weave,
       const std::array<double, MacroModes::n> &H)
  {
    CellParameters parameters;
    parameters.type  = type;
    parameters.weave = weave;
    MeshParameters mesh;
    mesh.elements_along = mesh.elements_across = 5;
    FabricCell        cell(parameters, mesh);
    const IGASpace<3> space = make_space(cell);
    PictureState      state;
    state.H = H;
    for (const Point<3> &X : space.control_points())
      {
        Point<3> x = X;
        for (unsigned int n = 0; n < MacroModes::n; ++n)
          x += H[n] * macroscopic_displacement(n, X);
        state.positions.push_back(x);
        state.values.push_back(X[2]);
      }
    auto surfaces = make_picture_surfaces(cell, space, state);
    return {std::move(cell), std::move(surfaces)};
  }

  std::vector<std::array<double, 4>>
  sorted_points(const std::vector<PictureSurface> &surfaces)
  {
    std::vector<std::array<double, 4>> points;
    for (const PictureSurface &surface : surfaces)
      for (auto point : surface.points)
        {
          for (double &x : point)
            x = std::round(1e6 * x) * 1e-6 + 0.;
          point[3] = 0.;
          points.push_back(point);
        }
    std::sort(points.begin(), points.end());
    return points;
  }

} // namespace



TEST_CASE("A picture shows every crossing of the repeat with its two bundles "
          "once, whatever the cell",
          "[output]")
{
  const std::vector<std::array<std::string, 2>> cells = {
    {{"sub-unit cell", "plain"}},
    {{"two-crossing cell", "plain"}},
    {{"unit cell", "plain"}},
    {{"sub-unit cell", "2/2 twill"}},
    {{"primitive cell", "5-harness satin"}}};
  const unsigned int side[] = {2, 2, 2, 4, 5};
  for (unsigned int i = 0; i < cells.size(); ++i)
    {
      INFO(cells[i][0] << ", " << cells[i][1]);
      const Drawn drawn   = draw(cells[i][0], cells[i][1], {});
      const auto  pieces  = drawn.cell.repeat();
      unsigned    n_first = 0, n_last = 0;
      for (const CrossingPiece &piece : pieces)
        {
          n_first += piece.first;
          n_last += piece.last;
        }
      CHECK(pieces.size() == 2 * side[i] * side[i]);
      CHECK(n_first == 2 * side[i]);
      CHECK(n_last == 2 * side[i]);
      // Wide faces and edges of each piece, two sections per strand.
      CHECK(drawn.surfaces.size() == 4 * pieces.size() + 2 * 2 * side[i]);
      // Two points more than quadrilaterals of 2 x 5 spans; 2 spans through.
      std::size_t n_points = 0;
      for (const PictureSurface &surface : drawn.surfaces)
        n_points += surface.points.size();
      CHECK(n_points ==
            pieces.size() * (2 * 11 * 11 + 2 * 11 * 2) + 4 * side[i] * 11 * 3);
    }
}



TEST_CASE("Images continue a macroscopic deformation", "[output]")
{
  // With w = w_m every point of the picture is a point of the straight fabric
  // displaced by w_m.
  const std::array<double, MacroModes::n> H = {{0.1, -0.05, 0.2, 0., 0., 0.}};
  for (const std::string type :
       {"sub-unit cell", "two-crossing cell", "unit cell"})
    {
      const auto at_rest = draw(type, "plain", {}).surfaces;
      const auto moved   = draw(type, "plain", H).surfaces;
      REQUIRE(at_rest.size() == moved.size());
      double error  = 0;
      double low[3] = {9, 9, 9}, high[3] = {-9, -9, -9};
      for (unsigned int s = 0; s < at_rest.size(); ++s)
        for (unsigned int i = 0; i < at_rest[s].points.size(); ++i)
          {
            const auto &X = at_rest[s].points[i], &x = moved[s].points[i];
            error =
              std::max({error,
                        std::abs(x[0] - (1 + H[0]) * X[0] - 0.5 * H[2] * X[1]),
                        std::abs(x[1] - (1 + H[1]) * X[1] - 0.5 * H[2] * X[0]),
                        std::abs(x[2] - X[2])});
            for (unsigned int d = 0; d < 3; ++d)
              {
                low[d]  = std::min(low[d], X[d]);
                high[d] = std::max(high[d], X[d]);
              }
          }
      CHECK(error < 1e-12);
      // Two crossings by two, 5 mm apart, bundles 1.2 mm thick.
      for (unsigned int d = 0; d < 2; ++d)
        CHECK(high[d] - low[d] == Approx(10.).epsilon(1e-12));
      CHECK(low[2] == Approx(-0.6).epsilon(1e-12));
      CHECK(high[2] == Approx(0.6).epsilon(1e-12));
    }
}



TEST_CASE("A bent fabric looks the same from the two-crossing and the unit "
          "cell",
          "[output]")
{
  const std::array<double, MacroModes::n> H = {
    {0.1, 0., 0.2, 0.02, -0.01, 0.015}};
  const auto two =
    sorted_points(draw("two-crossing cell", "plain", H).surfaces);
  const auto unit = sorted_points(draw("unit cell", "plain", H).surfaces);
  REQUIRE(two.size() == unit.size());
  double difference = 0;
  for (unsigned int i = 0; i < two.size(); ++i)
    for (unsigned int d = 0; d < 3; ++d)
      difference = std::max(difference, std::abs(two[i][d] - unit[i][d]));
  CHECK(difference < 1.5e-6); // the points were rounded to be sorted
}



TEST_CASE("The face that faces down is the lower one, also after a glide",
          "[output]")
{
  for (const PictureSurface &surface :
       draw("sub-unit cell", "plain", {}).surfaces)
    {
      double mean = 0;
      for (const auto &point : surface.points)
        mean += point[2] / surface.points.size();
      CHECK((surface.facing == PictureSurface::Facing::down) == (mean < -0.1));
    }
}



TEST_CASE("Table and script of a cell's picture are complete and come out "
          "alike twice",
          "[output]")
{
  const std::string folder =
    std::string(NPT_BINARY_DIR) + "/tests/output_files/cell_picture";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const auto surfaces = draw("sub-unit cell", "plain", {}).surfaces;
  const auto write    = [&]() {
    write_cell_picture(
      folder, "cell_rest", "Stage rest", "height [mm]", surfaces);
    return read_text(folder + "/cell_rest.dat") +
           read_text(folder + "/cell_rest.gp");
  };
  const std::string first = write();
  CHECK(first == write());

  std::ifstream table(folder + "/cell_rest.dat");
  std::size_t   n_points = 0, n_expected = 0;
  for (std::string line; std::getline(table, line);)
    n_points += !line.empty() && line[0] != '#';
  for (const PictureSurface &surface : surfaces)
    n_expected += surface.points.size();
  CHECK(n_points == n_expected);

  // Only where there is a gnuplot.
  if (run_gnuplot(folder + "/cell_rest.gp").empty())
    {
      const std::string svg = read_text(folder + "/cell_rest.svg");
      // 2 x 5 by 2 x 5 quadrilaterals on the 8 upper faces alone.
      std::size_t n_polygons = 0;
      for (std::size_t at = svg.find("<polygon"); at != std::string::npos;
           at             = svg.find("<polygon", at + 1))
        ++n_polygons;
      CHECK(n_polygons >= 800);
      CHECK(svg.find("height [mm]") != std::string::npos);
    }
}
