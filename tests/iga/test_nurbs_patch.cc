// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the tests of one patch: exact circles, refinement, and bad input.

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;
using Catch::Matchers::Contains;

namespace
{
  // Largest deviation of the sides of a quarter ring 1 < r < 2 from circles.
  double
  circle_error(const NURBSPatch<2> &ring)
  {
    double error = 0.;
    for (unsigned int i = 0; i <= 100; ++i)
      for (const double side : {0., 1.})
        {
          const Point<2> X = ring.value(Point<2>(side, i / 100.));
          error            = std::max(error, std::abs(X.norm() - (1. + side)));
        }
    return error;
  }



  template <int dim>
  void
  check_refinements(const bool rational)
  {
    const NURBSPatch<dim> patch = general_patch<dim>(rational);
    // Coordinates of size 2; convex combinations.
    const double insertion = 1e-14;
    // Solving with the collocation matrix loses about two digits.
    const double elevation = 1e-13;

    for (unsigned int d = 0; d < dim; ++d)
      {
        NURBSPatch<dim> inserted = patch;
        const double    middle   = patch.knot_vector(d).breaks()[0] + 0.35;
        inserted.insert_knots(d, {middle, middle});
        CHECK(inserted.n_control_points(d) == patch.n_control_points(d) + 2);
        CHECK(max_distance(patch, inserted) < insertion);

        NURBSPatch<dim> elevated = patch;
        elevated.elevate_degree(d, 2);
        CHECK(elevated.knot_vector(d).degree() ==
              patch.knot_vector(d).degree() + 2);
        CHECK(max_distance(patch, elevated) < elevation);
      }

    NURBSPatch<dim> c0 = patch;
    c0.reduce_to_c0();
    CHECK(max_distance(patch, c0) < insertion);

    NURBSPatch<dim> all = patch;
    all.make_isotropic();
    for (unsigned int d = 0; d < dim; ++d)
      {
        CHECK(all.knot_vector(d).degree() == 3);
        all.subdivide(d, 2);
        CHECK(all.knot_vector(d).n_spans() ==
              2 * patch.knot_vector(d).n_spans());
      }
    CHECK(max_distance(patch, all) < elevation);
    CHECK(all.is_rational() == rational);
  }
} // namespace



TEST_CASE("A rational quarter circle is exact to rounding", "[iga]")
{
  CHECK(circle_error(quarter_ring(1., 2.)) < 1e-14); // asked for: rounding
}



TEST_CASE("A circle stays exact under every refinement", "[iga]")
{
  NURBSPatch<2> inserted = quarter_ring(1., 2.);
  inserted.insert_knots(1, {0.3, 0.3, 0.77});
  CHECK(circle_error(inserted) < 1e-14); // convex combinations: rounding

  NURBSPatch<2> elevated = quarter_ring(1., 2.);
  elevated.elevate_degree(1, 2);
  CHECK(circle_error(elevated) < 1e-14); // one small collocation matrix

  NURBSPatch<2> k_refined = quarter_ring(1., 2.);
  k_refined.elevate_degree(1, 1);
  k_refined.subdivide(1, 4);
  CHECK(circle_error(k_refined) < 1e-14); // as before

  // Degree 3, C^2 between the four spans: 4 + 3 functions. In the other order
  // the knots gain multiplicity: 4 + 3 * 2 functions.
  NURBSPatch<2> p_after_h = quarter_ring(1., 2.);
  p_after_h.subdivide(1, 4);
  p_after_h.elevate_degree(1, 1);
  CHECK(k_refined.n_control_points(1) == 7);
  CHECK(p_after_h.n_control_points(1) == 10);
  CHECK(circle_error(p_after_h) < 1e-13); // collocation over all spans
}



TEST_CASE("Refinement leaves a plane patch unchanged", "[iga]")
{
  check_refinements<2>(true);
  check_refinements<2>(false);
}



TEST_CASE("Refinement leaves a body in space unchanged", "[iga]")
{
  check_refinements<3>(true);
  check_refinements<3>(false);
}



TEST_CASE("Weights matter only up to a common factor", "[iga]")
{
  const NURBSPatch<3> patch = general_patch<3>(true);
  std::vector<double> weights(patch.weights());
  for (double &w : weights)
    w *= 4.;
  const NURBSPatch<3> scaled(patch.knot_vectors(),
                             patch.control_points(),
                             weights);
  CHECK(max_distance(patch, scaled) < 1e-14); // rounding
  weights[5] *= 1.5;
  const NURBSPatch<3> changed(patch.knot_vectors(),
                              patch.control_points(),
                              weights);
  CHECK(max_distance(patch, changed) > 1e-3);
}



TEST_CASE("Moving the control points by an affine map moves the whole patch",
          "[iga]")
{
  const NURBSPatch<2> patch = general_patch<2>(true);
  const auto          map   = [](const Point<2> &X) {
    return Point<2>(3. - X[1] + 0.2 * X[0], 2. * X[0] + 0.1 * X[1]);
  };
  NURBSPatch<2> moved = patch;
  moved.transform(map);
  double error = 0.;
  for (const Point<2> &u : parameters(patch, 40))
    error = std::max(error, moved.value(u).distance(map(patch.value(u))));
  CHECK(error < 1e-14); // rounding
}



TEST_CASE("Control points are numbered with the first direction fastest",
          "[iga]")
{
  const NURBSPatch<3> patch = general_patch<3>(false);
  CHECK(patch.n_control_points() == 7 * 4 * 3);
  CHECK(patch.index({{1, 0, 0}}) == 1);
  CHECK(patch.index({{0, 1, 0}}) == 7);
  CHECK(patch.index({{0, 0, 1}}) == 28);
  for (unsigned int A = 0; A < patch.n_control_points(); ++A)
    CHECK(patch.index(patch.multi_index(A)) == A);
  // The corners are interpolated.
  CHECK(patch.value(Point<3>(1., 0., 1.)).distance(patch.control_points()[6]) <
        1e-14); // rounding
  CHECK(patch.value(Point<3>(0., 1., 2.))
          .distance(patch.control_points()[patch.index({{0, 3, 2}})]) <
        1e-14); // rounding
}



TEST_CASE("Unusable patches are refused with the reason", "[iga]")
{
  const std::array<KnotVector, 2> knots = {
    {KnotVector::uniform(1, 1), KnotVector::uniform(2, 1)}};
  const std::vector<Point<2>> points(6);
  CHECK_THAT(input_error(
               [&]() { NURBSPatch<2>(knots, std::vector<Point<2>>(5)); }),
             Contains("needs 6 control points") && Contains("found 5"));
  CHECK_THAT(input_error([&]() {
               NURBSPatch<2>(knots, points, {1., 1., 1.});
             }),
             Contains("needs 6 weights") && Contains("found 3"));
  for (const double bad : {0., -1., double(NAN)})
    CHECK_THAT(input_error([&]() {
                 NURBSPatch<2>(knots, points, {1., 1., bad, 1., 1., 1.});
               }),
               Contains("weights must be positive"));
  CHECK(input_error([&]() { NURBSPatch<2>(knots, points); }) == "(accepted)");

  NURBSPatch<2> patch = general_patch<2>(true);
  CHECK_THAT(input_error([&]() {
               patch.insert_knots(0, {0.5, 0.5});
             }),
             Contains("0.5") && Contains("more than degree = 3"));
}
