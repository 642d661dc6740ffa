// SPDX-License-Identifier: LGPL-2.1-or-later
// The formulas of data sheets.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/fabric_files/sheet_formulas.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace NPT
{
  double
  root_of_increasing(const std::function<double(double)> &function,
                     const double                         target,
                     double                               low,
                     double                               high)
  {
    for (unsigned int k = 0; k < 100; ++k)
      (function(0.5 * (low + high)) < target ? low : high) = 0.5 * (low + high);
    return 0.5 * (low + high);
  }



  double
  crimp_of_wave(const double height, const double spacing, const double changes)
  {
    const double s = dealii::numbers::PI * height / spacing;
    const double k = s / std::sqrt(1. + s * s);
    return changes * (2. / dealii::numbers::PI * std::sqrt(1. + s * s) *
                        std::comp_ellint_2(k) -
                      1.);
  }



  double
  wave_of_crimp(const double crimp, const double spacing, const double changes)
  {
    const double highest = 10. * spacing; // crimp beyond 1
    return root_of_increasing(
      [&](const double h) { return crimp_of_wave(h, spacing, changes); },
      crimp,
      0.,
      highest);
  }



  FiberBundleConstants
  bundle_constants(const double E_L, const double G_L, const double G_T)
  {
    Assert(E_L > 0. && G_L > 0. && G_T > 0.,
           dealii::ExcMessage("Moduli must be positive."));
    FiberBundleConstants constants;
    constants.mu     = G_T;
    constants.lambda = 2. / 3. * G_T;
    constants.a      = G_T - G_L;
    constants.b = constants.d = 0.;
    const double lambda       = constants.lambda;
    constants.c               = (E_L - lambda - 2. * G_T + 4. * constants.a +
                   lambda * lambda / (lambda + G_T)) /
                  8.;
    return constants;
  }



  FiberBundleConstants
  with_few_digits(FiberBundleConstants constants,
                  const double         E_L,
                  const double         G_L)
  {
    const auto shorten = [](double &constant, const double largest_change) {
      const double exact = constant;
      for (const unsigned int digits : {5u, 12u})
        {
          constant = std::strtod(short_number(exact, digits).c_str(), nullptr);
          if (std::abs(constant - exact) <= largest_change)
            break;
        }
    };
    // Which moduli they enter, and by which factor at most.
    shorten(constants.lambda, 1e-4 * E_L);
    shorten(constants.a, 1e-4 * std::min(G_L, E_L / 4.));
    shorten(constants.c, 1e-4 * E_L / 8.);
    return constants;
  }
} // namespace NPT
