// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the cell of the fabric: its bundles have the shape that the
// parameters say, and its operations are symmetries of the structure.

#include <npt_dealii/fabric/fabric_cell.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/iga/iga_values.h>

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <tuple>

using namespace NPT;
using dealii::Point;
using dealii::Tensor;

namespace
{
  MeshParameters
  small_mesh(const unsigned int along, const unsigned int across)
  {
    MeshParameters mesh;
    mesh.elements_along  = along;
    mesh.elements_across = across;
    return mesh;
  }

  CellParameters
  odd_cell()
  {
    CellParameters cell;
    cell.crossing_spacing = 3.7;
    cell.bundle_width     = 3.1;
    cell.bundle_thickness = 0.9;
    cell.blunt_tip        = 0.17;
    return cell;
  }

  const std::vector<std::pair<std::string, std::string>> cells_of_weaves = {
    {"sub-unit cell", "plain"},
    {"two-crossing cell", "plain"},
    {"primitive cell", "plain"},
    {"unit cell", "plain"},
    {"sub-unit cell", "2/2 twill"},
    {"primitive cell", "2/2 twill"},
    {"unit cell", "2/2 twill"},
    {"primitive cell", "5-harness satin"},
    {"unit cell", "5-harness satin"},
    {"primitive cell", "ouu/uou/uuo"},
    {"primitive cell", "2/2 rib"},
    {"unit cell", "2/2 rib"},
    {"sub-unit cell", "2/2 basket"},
    {"primitive cell", "2/2 basket"},
    {"unit cell", "2/2 basket"},
    {"primitive cell", "oouuo/uouoo/ouoou"}};

  std::vector<NURBSPatch<3>>
  patches(const FabricCell &cell)
  {
    std::vector<NURBSPatch<3>> result;
    for (const FiberBundle &bundle : cell.bundles())
      result.push_back(bundle.patch);
    return result;
  }
} // namespace



TEST_CASE("The volume of a lens bundle is its section times its length",
          "[cell]")
{
  for (const CellParameters &parameters : {CellParameters(), odd_cell()})
    for (const unsigned int degree : {2, 3})
      for (const Basis basis :
           {Basis::NURBS, Basis::Bernstein, Basis::Lagrange})
        {
          MeshParameters mesh = small_mesh(3, 4);
          mesh.degree         = degree;
          mesh.basis          = basis;
          const FabricCell  cell(parameters, mesh);
          const IGASpace<3> space(patches(cell), {}, basis);

          // int 2 h(y) dy, h = e + (t/2 - e)(1 - (2y/w)^2).
          const double w       = parameters.bundle_width.warp;
          const double t       = parameters.bundle_thickness.warp;
          const double e       = parameters.blunt_tip * t;
          const double section = 2 * e * w + 4. / 3. * (t / 2 - e) * w;

          std::vector<double> volume(space.n_patches(), 0.);
          IGAValues<3>        values(space);
          for (const auto &span : space.triangulation().active_cell_iterators())
            {
              values.reinit(span);
              for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
                volume[span->material_id()] += values.JxW(q);
            }
          for (const double V : volume)
            CHECK(V == Approx(section * parameters.crossing_spacing.warp)
                         .epsilon(1e-12));
        }
}



TEST_CASE("The surfaces of a bundle follow the lens", "[cell]")
{
  const CellParameters parameters = odd_cell();
  const FabricCell     cell(parameters, small_mesh(2, 5));
  const double e = parameters.blunt_tip * parameters.bundle_thickness.warp;
  for (const FiberBundle &bundle : cell.bundles())
    for (const double u : {0., 0.3, 1.})
      for (const double v : {0., 0.25, 0.61, 1.})
        for (const double side : {0., 1.})
          {
            const Point<3> X    = bundle.patch.value(Point<3>(u, v, side));
            const bool     warp = bundle.family == FiberBundle::Family::warp;
            const double   y    = warp ? X[1] : X[0];
            const double   h =
              e + (parameters.bundle_thickness.warp / 2 - e) *
                    (1 - std::pow(2 * y / parameters.bundle_width.warp, 2));
            CHECK(X[2] == Approx(side > 0 ? h : -h).margin(1e-14));
            CHECK((warp ? X[0] : X[1]) ==
                  Approx((u - 0.5) * parameters.crossing_spacing.warp));
          }
}



TEST_CASE("Warp and weft are one bundle, turned by 90 degrees", "[cell]")
{
  const FabricCell cell(odd_cell(), small_mesh(3, 4));
  REQUIRE(cell.bundles().size() == 2);
  const FiberBundle &warp = cell.bundles()[0], &weft = cell.bundles()[1];
  CHECK(warp.family == FiberBundle::Family::warp);
  CHECK(weft.family == FiberBundle::Family::weft);
  CHECK(warp.direction[0] == 1.);
  CHECK(weft.direction[1] == 1.);
  for (unsigned int l = 0; l < warp.patch.n_control_points(); ++l)
    {
      const Point<3> &P = warp.patch.control_points()[l];
      CHECK(weft.patch.control_points()[l].distance(
              Point<3>(-P[1], P[0], P[2])) < 1e-14);
    }
  CHECK(cell.area() == Approx(3.7 * 3.7));
}



TEST_CASE("Every operation maps control points inside the cell onto control "
          "points, and the end faces onto each other",
          "[cell]")
{
  for (const auto &[type, weave] : cells_of_weaves)
    for (const unsigned int across : {3, 4})
      {
        CellParameters parameters   = odd_cell();
        parameters.type             = type;
        parameters.weave            = weave;
        parameters.mirror_planes    = CellParameters::MirrorPlanes::yes;
        parameters.crossing_spacing = WarpWeft(3.7, 3.3);
        parameters.bundle_width     = WarpWeft(3.1, 2.9);
        const FabricCell cell(parameters, small_mesh(3, across));
        const double     L         = parameters.crossing_spacing.warp;
        unsigned int     n_related = 0;
        for (const SymmetryOperation &g : cell.operations())
          for (const FiberBundle &bundle : cell.bundles())
            for (const Point<3> &P : bundle.patch.control_points())
              {
                const Point<3> image = g(P);
                for (const FiberBundle &other : cell.bundles())
                  {
                    if (other.family != bundle.family)
                      continue;
                    const auto &points = other.patch.control_points();
                    bool        found  = false;
                    for (const Point<3> &Q : points)
                      found = found || Q.distance(image) < 1e-12 * L;
                    n_related += found;
                    // A point that lands inside the bundle must hit a control
                    // point, or the operation could not be a constraint.
                    const Point<3> &low = points.front(), &high = points.back();
                    bool            inside = true;
                    for (unsigned int i = 0; i < 2; ++i)
                      inside =
                        inside &&
                        image[i] > std::min(low[i], high[i]) - 1e-9 * L &&
                        image[i] < std::max(low[i], high[i]) + 1e-9 * L;
                    if (inside)
                      CHECK(found);
                  }
              }
        CHECK(n_related > 0);
      }
}



TEST_CASE("Each cell stands for as many crossings as its area says", "[cell]")
{
  // A contact pair touches one crossing per strand; images add pieces of the
  // same strands only.
  for (const auto &[type, weave] : cells_of_weaves)
    {
      CellParameters parameters   = odd_cell();
      parameters.type             = type;
      parameters.weave            = weave;
      parameters.crossing_spacing = WarpWeft(3.7, 3.3);
      parameters.bundle_width     = WarpWeft(3.1, 2.9);
      const FabricCell cell(parameters, small_mesh(1, 1));
      const double     L         = std::sqrt(3.7 * 3.3);
      unsigned int     crossings = 0;
      for (const ContactCandidates &pair : cell.contacts())
        for (const SurfaceImage &image : pair.primaries)
          crossings += image.period == 0;
      CHECK(crossings == Approx(cell.area() / (L * L)));
    }
}



TEST_CASE("Shifts of the table make the cell as small as the weave allows",
          "[cell]")
{
  // Crossings and bundles of each cell, counted by hand on the table.
  const std::vector<std::tuple<std::string, std::string, double, unsigned int>>
    cases = {{"sub-unit cell", "plain", 1, 2},
             {"two-crossing cell", "plain", 2, 2},
             {"unit cell", "plain", 4, 4},
             {"sub-unit cell", "2/2 twill", 2, 2},
             {"primitive cell", "2/2 twill", 4, 2},
             {"unit cell", "2/2 twill", 16, 8},
             {"primitive cell", "5-harness satin", 5, 2},
             {"unit cell", "5-harness satin", 25, 10},
             {"primitive cell", "oouuo/uouoo/ouoou", 15, 8}};
  for (const auto &[type, weave, crossings, n_bundles] : cases)
    {
      CellParameters parameters;
      parameters.type  = type;
      parameters.weave = weave;
      const FabricCell cell(parameters, small_mesh(1, 1));
      INFO(type << ", " << weave);
      CHECK(cell.area() == Approx(25. * crossings));
      CHECK(cell.bundles().size() == n_bundles);
      // Bundles of the smallest cells lie on 2-fold axes: nothing floats in
      // plane, and along Y3 only without a glide plane.
      if (n_bundles == 2)
        for (unsigned int b = 0; b < 2; ++b)
          CHECK(cell.can_float(b) ==
                std::array<bool, 3>{{false, false, type != "sub-unit cell"}});
    }
}



TEST_CASE("Weaves have the neighbors and the mirrors that one sees in their "
          "tables",
          "[cell]")
{
  // Equal neighboring warps, wefts; a mirror (or glide mirror) across a family.
  const std::vector<std::tuple<std::string, bool, bool, bool>> weaves = {
    {"plain", false, false, true},
    {"2/1 rib", false, true, true},
    {"2/2 rib", false, true, true},
    {"oouu/uuoo", true, false, true},
    {"2/2 basket", true, true, true},
    {"2/1 twill", false, false, false},
    {"3/1 twill", false, false, false},
    {"2/2 twill", false, false, false},
    {"crowfoot", false, false, true},
    {"5-harness satin", false, false, false},
    {"8-harness satin", false, false, false}};
  for (const auto &[name, warps, wefts, mirror] : weaves)
    {
      INFO(name);
      const WeavePattern weave(name);
      CHECK(weave.has_equal_neighbors(true) == warps);
      CHECK(weave.has_equal_neighbors(false) == wefts);
      CHECK(weave.has_mirror() == mirror);
    }
}



TEST_CASE("Satins bind once per bundle and never side by side", "[cell]")
{
  for (const std::string name :
       {"crowfoot", "5-harness satin", "8-harness satin"})
    {
      INFO(name);
      const WeavePattern weave(name);
      REQUIRE(weave.n_warp() == weave.n_weft());
      const int n = weave.n_warp();
      for (int j = 0; j < n; ++j)
        {
          int in_row = 0, in_column = 0;
          for (int i = 0; i < n; ++i)
            {
              in_row += weave.warp_is_over(i, j);
              in_column += weave.warp_is_over(j, i);
              if (name != "crowfoot" && weave.warp_is_over(i, j))
                CHECK_FALSE((weave.warp_is_over(i + 1, j + 1) ||
                             weave.warp_is_over(i - 1, j + 1)));
            }
          CHECK(in_row == 1);
          CHECK(in_column == 1);
        }
    }
}



TEST_CASE("Symmetry weights count every point of the cell once", "[cell]")
{
  for (const bool two_fold_axis : {true, false})
    for (const unsigned int along : {4, 5})
      for (const unsigned int across : {4, 5})
        {
          CellParameters parameters = odd_cell();
          parameters.two_fold_axis  = two_fold_axis;
          const MeshParameters mesh = small_mesh(along, across);
          const FabricCell     cell(parameters, mesh);

          unsigned int n_points = 0, sum = 0;
          for (unsigned int b = 0; b < cell.bundles().size(); ++b)
            for (const Point<3> &P : cell.bundles()[b].patch.control_points())
              {
                const unsigned int own = cell.symmetry_weight(b, P);
                const unsigned int image =
                  cell.symmetry_weight(b, Point<3>(-P[0], -P[1], P[2]));
                CHECK(own + image == 2);
                sum += own;
                ++n_points;
              }
          CHECK(sum == n_points);

          // The volume of the integrated part, counted with its images.
          const IGASpace<3> space(patches(cell), {}, mesh.basis);
          IGAValues<3>      values(space);
          double            weighted = 0, volume = 0;
          for (const auto &span : space.triangulation().active_cell_iterators())
            {
              values.reinit(span);
              for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
                {
                  volume += values.JxW(q);
                  weighted += values.JxW(q) *
                              cell.symmetry_weight(span->material_id(),
                                                   values.quadrature_point(q));
                }
            }
          CHECK(weighted == Approx(volume).epsilon(1e-12));
        }
}



TEST_CASE("With mirror planes, too, the part that is integrated stands for the "
          "whole cell, and is a quarter of it where the weave has them",
          "[cell]")
{
  for (const auto &[type, weave] : cells_of_weaves)
    for (const unsigned int along : {2, 3})
      {
        INFO(type << " of " << weave);
        CellParameters parameters   = odd_cell();
        parameters.type             = type;
        parameters.weave            = weave;
        parameters.mirror_planes    = CellParameters::MirrorPlanes::yes;
        parameters.integrate_pieces = true;
        const MeshParameters mesh   = small_mesh(along, 3);
        const FabricCell     cell(parameters, mesh);
        const IGASpace<3>    space(patches(cell), {}, mesh.basis);
        IGAValues<3>         values(space);
        double               weighted = 0, volume = 0, integrated = 0;
        for (const auto &span : space.triangulation().active_cell_iterators())
          {
            values.reinit(span);
            for (unsigned int q = 0; q < values.n_quadrature_points(); ++q)
              {
                const unsigned int weight =
                  cell.symmetry_weight(span->material_id(),
                                       values.quadrature_point(q));
                volume += values.JxW(q);
                weighted += weight * values.JxW(q);
                integrated += weight > 0 ? values.JxW(q) : 0.;
              }
          }
        CHECK(weighted == Approx(volume).epsilon(1e-12));
        // Quadrature points lie on the planes of an odd number of elements.
        if (weave == "plain" || weave == "2/2 rib" || weave == "2/2 basket")
          CHECK(integrated < 0.36 * volume);
      }
}
