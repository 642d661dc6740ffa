// SPDX-License-Identifier: LGPL-2.1-or-later
// Claims about the cross sections of bundles.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/fabric/bundle_section.h>
#include <npt_dealii/fabric/cell_parameters.h>
#include <npt_dealii/fabric/named_weave.h>
#include <npt_dealii/fabric/section_shape.h>
#include <npt_dealii/fabric/weave_pattern.h>

#include <deal.II/base/quadrature_lib.h>

#include <catch2/catch.hpp>

#include <cmath>

using namespace NPT;
using dealii::Point;

namespace
{
  BundleSection
  section_of(const std::string &shape)
  {
    return {shape, 3.1, 0.9, 0.2};
  }

  /// Area of a patch and its smallest Jacobian over the Gauss points and the
  /// corners of all spans, by central differences of the mapping.
  std::pair<double, double>
  area_and_smallest_jacobian(const NURBSPatch<2> &patch)
  {
    const dealii::QGauss<1> gauss(8);
    const auto             &breaks = patch.knot_vector(0).breaks();
    double                  area = 0, smallest = 1e99;
    for (unsigned int e = 0; e + 1 < breaks.size(); ++e)
      {
        // The area between the faces: int 2 h dy by parts of y(u).
        const double du = breaks[e + 1] - breaks[e];
        for (unsigned int q = 0; q < gauss.size(); ++q)
          {
            const double u     = breaks[e] + du * gauss.point(q)[0];
            const double d     = 1e-4 * du;
            const double slope = (patch.value(Point<2>(u + d, 1.))[0] -
                                  patch.value(Point<2>(u - d, 1.))[0]) /
                                 (2 * d);
            area += gauss.weight(q) * du * slope * 2 *
                    patch.value(Point<2>(u, 1.))[1];
          }
        for (const double t : {0., 0.5, 1.})
          {
            const double u     = breaks[e] + t * du;
            const double d     = 1e-6 * du * (t == 1. ? -1. : 1.);
            const double slope = (patch.value(Point<2>(u + d, 1.))[0] -
                                  patch.value(Point<2>(u, 1.))[0]) /
                                 d;
            smallest =
              std::min(smallest, slope * 2 * patch.value(Point<2>(u, 1.))[1]);
          }
      }
    return {area, smallest};
  }

  /// Largest distance of the upper face from h(y), over many points.
  double
  largest_error(const BundleSection &section, const NURBSPatch<2> &patch)
  {
    double error = 0;
    for (unsigned int k = 0; k <= 1000; ++k)
      {
        const Point<2> P = patch.value(Point<2>(k / 1000., 1.));
        error = std::max(error, std::abs(P[1] - section.half_height(P[0])));
      }
    return error;
  }
} // namespace



TEST_CASE("Lens, ellipse and rounded rectangle are exact for any degree and "
          "mesh",
          "[cell]")
{
  for (const std::string shape : {"lens", "ellipse", "rounded rectangle"})
    for (const unsigned int degree : {2, 3})
      for (const unsigned int n : {3, 8})
        {
          const BundleSection section = section_of(shape);
          const NURBSPatch<2> patch   = section.patch(degree, n);
          CHECK(patch.knot_vector(0).n_spans() == n);
          CHECK(patch.knot_vector(0).degree() == degree);
          CHECK(largest_error(section, patch) < 1e-13);
          // Differences of the mapping leave 1e-8.
          CHECK(area_and_smallest_jacobian(patch).first ==
                Approx(section.area()).epsilon(1e-6));
        }
}



TEST_CASE("The power ellipse converges with the order of its splines, and is "
          "lens and ellipse for n = 2 and n = 1",
          "[cell]")
{
  BundleSection section = section_of("power ellipse");
  for (const unsigned int degree : {2, 3})
    {
      const double coarse = largest_error(section, section.patch(degree, 32));
      const double fine   = largest_error(section, section.patch(degree, 64));
      // 2.9 and 3.2 here; the orders 3 and 4 are reached slowly, because the
      // arch is steep near its edge (3.8 for p = 3 and 256 spans).
      CHECK(std::log2(coarse / fine) > degree + 0.15);
    }
  for (const double y : {0., 0.4, 1.2, 1.55})
    {
      section.numbers["Section power"] = 2.;
      CHECK(section.half_height(y) ==
            Approx(section_of("lens").half_height(y)));
      section.numbers["Section power"] = 1.;
      CHECK(section.half_height(y) ==
            Approx(section_of("ellipse").half_height(y)));
    }
  CHECK(section_of("lens").half_height(1.55) == Approx(0.2));
}



TEST_CASE("No section has degenerate cells, and spans are equally wide",
          "[cell]")
{
  for (const std::string shape :
       {"lens", "ellipse", "power ellipse", "rounded rectangle"})
    {
      const BundleSection section = section_of(shape);
      const NURBSPatch<2> patch   = section.patch(2, 7);
      const auto [area, smallest] = area_and_smallest_jacobian(patch);
      // Against the mean of dy/du times the height.
      CHECK(smallest > 0.1 * area);
      CHECK(section.edge_angle() < 75.);
      if (shape == "rounded rectangle")
        continue;
      const auto &breaks = patch.knot_vector(0).breaks();
      for (unsigned int e = 0; e < 7; ++e)
        CHECK(patch.value(Point<2>(breaks[e + 1], 1.))[0] -
                patch.value(Point<2>(breaks[e], 1.))[0] ==
              Approx(3.1 / 7));
    }
}



TEST_CASE("A rounded rectangle is C1 where its arcs meet the flat", "[cell]")
{
  const NURBSPatch<2> patch  = section_of("rounded rectangle").patch(2, 3);
  const auto         &breaks = patch.knot_vector(0).breaks();
  const double        u = breaks[1], d = 1e-6;
  for (unsigned int i = 0; i < 2; ++i)
    {
      const auto value = [&](const double x) {
        return patch.value(Point<2>(x, 1.))[i];
      };
      CHECK((value(u + d) - value(u)) / d ==
            Approx((value(u) - value(u - d)) / d).margin(1e-4));
    }
}



namespace
{
  // A section and a weave of which no other file knows: a bar with a height of
  // its own, and the 4/1 twill.
  NURBSPatch<2>
  bar_patch(const BundleSection &section,
            const unsigned int   degree,
            const unsigned int   n_across)
  {
    const double  a     = 0.5 * section.width;
    const double  h     = section.number("Bar height") * section.thickness;
    NURBSPatch<2> patch = SectionTools::between_faces(KnotVector::uniform(2, 1),
                                                      {-a, 0., a},
                                                      {h, h, h},
                                                      {1., 1., 1.});
    patch.elevate_degree(0, degree - 2);
    patch.subdivide(0, n_across);
    return patch;
  }

  const Registry<SectionShape>::Registration
    bar("bar",
        {[](const BundleSection &section, const double) {
           return section.number("Bar height") * section.thickness;
         },
         [](const BundleSection &section) {
           return 2. * section.number("Bar height") * section.width *
                  section.thickness;
         },
         [](const BundleSection &) { return 0.; },
         bar_patch,
         {{"Bar height",
           0.5,
           "Bar only: half height over thickness [-].",
           std::make_shared<dealii::Patterns::Double>(0.1, 0.5)}}});

  const Registry<NamedWeave>::Registration
    twill("4/1 twill", {"oooou/ooouo/oouoo/ouooo/uoooo"});
} // namespace

TEST_CASE("A section and a weave that register themselves are read like the "
          "others",
          "[cell]")
{
  CellParameters           cell;
  dealii::ParameterHandler prm;
  cell.add_parameters(prm);
  prm.parse_input_from_string("subsection Cell\nset Section = bar\n"
                              "set Bar height = 0.4\n"
                              "set Weave = 4/1 twill\nend\n");
  cell.check();
  const BundleSection section = cell.warp_section();
  CHECK(section.area() == Approx(2 * 0.4 * 1.2 * 4.));
  CHECK(largest_error(section, section.patch(3, 4)) < 1e-14);
  CHECK(WeavePattern(cell.weave).n_warp() == 5);
  CHECK_THROWS_WITH(WeavePattern("plane"),
                    Catch::Contains("did you mean 'plain'"));
}
