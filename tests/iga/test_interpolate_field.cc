// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the claims on the transfer of fields between meshes.

#include <npt_dealii/iga/bezier_body.h>
#include <npt_dealii/iga/interpolate_field.h>

#include "iga_test_tools.h"

using namespace NPT;
using namespace IGATests;

namespace
{
  // Two joined patches would need a geometry of their own; one rational patch
  // and one without weights are two bodies.
  std::vector<NURBSPatch<3>>
  two_patches(const unsigned int refinements)
  {
    std::vector<NURBSPatch<3>> patches = {general_patch<3>(true),
                                          general_patch<3>(false)};
    for (unsigned int k = 0; k < refinements; ++k)
      for (NURBSPatch<3> &patch : patches)
        {
          patch.subdivide(0, 2);
          patch.subdivide(1, 3);
          patch.subdivide(2, 2);
        }
    return patches;
  }

  // Coefficients of the field a + B X, which every such space contains.
  dealii::Vector<double>
  linear_field(const IGASpace<3> &space)
  {
    dealii::Vector<double> u(3 * space.n_control_points());
    for (unsigned int A = 0; A < space.n_control_points(); ++A)
      {
        const Point<3> &X = space.control_points()[A];
        u[3 * A]          = 1. + 2. * X[0] - X[1];
        u[3 * A + 1]      = X[2] - 0.3 * X[0];
        u[3 * A + 2]      = -2. + 0.5 * X[1] + X[2];
      }
    return u;
  }

  // Value of component 0 of a field at parameters t of a patch.
  double
  value(const IGASpace<3>            &space,
        const unsigned int            patch,
        const dealii::Vector<double> &u,
        const Point<3>               &t)
  {
    const NURBSPatch<3>                            &p   = space.patch(patch);
    double                                          sum = 0, W = 0;
    std::array<std::vector<std::vector<double>>, 3> N;
    std::array<unsigned int, 3>                     span;
    for (unsigned int d = 0; d < 3; ++d)
      {
        span[d] = p.knot_vector(d).find_span(t[d]);
        N[d]    = p.knot_vector(d).values(span[d], t[d], 0);
      }
    for (unsigned int k = 0; k < N[2][0].size(); ++k)
      for (unsigned int j = 0; j < N[1][0].size(); ++j)
        for (unsigned int i = 0; i < N[0][0].size(); ++i)
          {
            const unsigned int l =
              p.index({{p.knot_vector(0).first_function(span[0]) + i,
                        p.knot_vector(1).first_function(span[1]) + j,
                        p.knot_vector(2).first_function(span[2]) + k}});
            const double w =
              p.weights()[l] * N[0][0][i] * N[1][0][j] * N[2][0][k];
            W += w;
            sum += w * u[3 * space.control_point(patch, l)];
          }
    return sum / W;
  }
} // namespace



TEST_CASE("A field on a mesh is the same field on every refined mesh", "[iga]")
{
  for (const Basis basis : {Basis::NURBS, Basis::Bernstein})
    {
      const IGASpace<3> coarse(two_patches(0), {}, basis),
        fine(two_patches(1), {}, basis);
      std::mt19937                           generator(3);
      std::uniform_real_distribution<double> number(-1., 1.);
      dealii::Vector<double> u(3 * coarse.n_control_points() + 5);
      for (double &x : u)
        x = number(generator);
      const auto fine_u = interpolate_field(coarse, u, fine);
      for (const unsigned int patch : {0u, 1u})
        for (const double s : {0.03, 0.31, 0.77})
          {
            const Point<3> t(s, 0.9 - s, 1.2 + s);
            CHECK(value(fine, patch, fine_u, t) ==
                  Approx(value(coarse, patch, u, t)).margin(1e-12));
          }
    }
}



TEST_CASE("A linear field passes to any other mesh, also to a coarser one",
          "[iga]")
{
  const IGASpace<3> from(two_patches(1), {}, Basis::NURBS),
    to(two_patches(0), {}, Basis::NURBS);
  dealii::Vector<double> difference =
    interpolate_field(from, linear_field(from), to);
  difference -= linear_field(to);
  CHECK(difference.linfty_norm() < 1e-12);
}
