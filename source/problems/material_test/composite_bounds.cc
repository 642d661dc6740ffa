// SPDX-License-Identifier: LGPL-2.1-or-later
// Formulas of the bounds of Hill and Hashin.

#include <npt_dealii/problems/material_test/composite_bounds.h>

#include <algorithm>

namespace NPT
{
  namespace
  {
    struct Plane
    {
      Plane(const double E, const double nu)
        : G(0.5 * E / (1. + nu))
        , k(0.5 * E / ((1. + nu) * (1. - 2. * nu)))
      {}
      double G, k;
    };
  } // namespace



  CompositeBounds
  unidirectional_bounds(const double v_f,
                        const double E_f,
                        const double nu_f,
                        const double E_m,
                        const double nu_m)
  {
    const double v_m = 1. - v_f;
    const Plane  f(E_f, nu_f), m(E_m, nu_m);
    const auto   sorted = [](const double a, const double b) {
      return Interval{std::min(a, b), std::max(a, b)};
    };

    // Each bound is the modulus of a composite with one constituent (1, share
    // v_1) around the other: matrix outside is one bound, fiber the other.
    const auto k = [](const Plane &o, const Plane &i, const double v_i) {
      return i.k == o.k ?
               o.k :
               o.k + v_i / (1. / (i.k - o.k) + (1. - v_i) / (o.k + o.G));
    };
    const auto G_L = [](const Plane &o, const Plane &i, const double v_i) {
      return i.G == o.G ?
               o.G :
               o.G + v_i / (1. / (i.G - o.G) + (1. - v_i) / (2. * o.G));
    };
    const auto G_T = [](const Plane &o, const Plane &i, const double v_i) {
      return i.G == o.G ?
               o.G :
               o.G + v_i / (1. / (i.G - o.G) + (1. - v_i) * (o.k + 2. * o.G) /
                                                 (2. * o.G * (o.k + o.G)));
    };
    const auto E_L = [&](const double G) {
      const double d = nu_m - nu_f;
      return v_f * E_f + v_m * E_m +
             4. * v_f * v_m * d * d / (v_f / m.k + v_m / f.k + 1. / G);
    };

    CompositeBounds bounds;
    bounds.rule_of_mixtures = v_f * E_f + v_m * E_m;
    bounds.E_L              = sorted(E_L(m.G), E_L(f.G));
    bounds.k_T              = sorted(k(m, f, v_f), k(f, m, v_m));
    bounds.G_L              = sorted(G_L(m, f, v_f), G_L(f, m, v_m));
    bounds.G_T              = sorted(G_T(m, f, v_f), G_T(f, m, v_m));
    const double nu_min = std::min(nu_f, nu_m), nu_max = std::max(nu_f, nu_m);
    bounds.E_T.lower = 4. / (1. / bounds.k_T.lower + 1. / bounds.G_T.lower +
                             4. * nu_max * nu_max / bounds.E_L.lower);
    bounds.E_T.upper = 4. / (1. / bounds.k_T.upper + 1. / bounds.G_T.upper +
                             4. * nu_min * nu_min / bounds.E_L.upper);
    return bounds;
  }
} // namespace NPT
