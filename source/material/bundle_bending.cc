// SPDX-License-Identifier: LGPL-2.1-or-later
// Formulas for the bending of a bundle of fibers.

#include <npt_dealii/material/bundle_bending.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <cmath>

namespace NPT
{
  namespace
  {
    // r(s) of Eq. (A33); near zero its series, because s - tanh s cancels.
    double
    ratio_of_sliding(const double s)
    {
      if (s < 0.03)
        return 1. - 0.4 * s * s + 17. / 105. * s * s * s * s;
      return 3. * (s - std::tanh(s)) / (s * s * s);
    }
  } // namespace



  double
  fiber_fraction(const double tex, const double density, const double area)
  {
    return 1e-3 * tex / (density * area);
  }



  double
  bending_ratio(const double modulus,
                const double shear_modulus,
                const double slenderness)
  {
    return ratio_of_sliding(0.5 * dealii::numbers::PI * slenderness *
                            std::sqrt(modulus / shear_modulus));
  }



  double
  shear_modulus_for_bending(const double modulus,
                            const double ratio,
                            const double slenderness)
  {
    Assert(ratio > 0. && ratio < 1., dealii::ExcInternalError());
    // r falls from 1 at s = 0 and is below 3/s^2.
    std::uintmax_t n_evaluations = 200;
    const auto     bracket       = boost::math::tools::toms748_solve(
      [&](const double s) { return ratio_of_sliding(s) - ratio; },
      0.,
      std::sqrt(3. / ratio),
      boost::math::tools::eps_tolerance<double>(50),
      n_evaluations);
    const double s = 0.5 * (bracket.first + bracket.second);
    const double b = 0.5 * dealii::numbers::PI * slenderness / s;
    return modulus * b * b;
  }



  double
  loose_bending_ratio(const double fiber_diameter, const double thickness)
  {
    const double d_over_t = fiber_diameter / thickness;
    return 0.75 * d_over_t * d_over_t;
  }



  double
  double_modulus(const double in_tension, const double in_compression)
  {
    const double root = std::sqrt(in_tension) + std::sqrt(in_compression);
    return 4. * in_tension * in_compression / (root * root);
  }
} // namespace NPT
