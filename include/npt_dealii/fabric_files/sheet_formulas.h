// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the formulas of data sheets: crimp, constants of bundles.

#ifndef npt_dealii_fabric_files_sheet_formulas_h
#define npt_dealii_fabric_files_sheet_formulas_h

#include <npt_dealii/material/fiber_bundle_law.h>

#include <functional>

namespace NPT
{
  /**
   * Crimp of a bundle whose middle line goes from side to side as a sine wave
   * of the given height, and is straight between crossings on the same side,
   *
   * @f[ c = \frac{n_{changes}}{n_{crossings}} \left( \frac{2}{\pi}
   *         \sqrt{1 + s^2} \, E(k) - 1 \right), \quad
   *     s = \frac{\pi h}{\bar L}, \quad k^2 = \frac{s^2}{1 + s^2} , @f]
   *
   * (A40), with the complete elliptic integral E of the second kind.
   *
   * @param height Amplitude h of the middle line [mm].
   * @param spacing Distance Lbar between the bundles across [mm].
   * @param changes Changes of side per crossing, 1 for the plain weave.
   */
  double
  crimp_of_wave(const double height,
                const double spacing,
                const double changes);

  /// The inverse of crimp_of_wave(): the height [mm].
  double
  wave_of_crimp(const double crimp, const double spacing, const double changes);

  /**
   * Constants of (51), (52) for a bundle with the given moduli [MPa] and a
   * contraction nu_LT = .2,
   *
   * @f[ \mu = G_T, \quad \lambda = \tfrac23 G_T, \quad a = G_T - G_L, \quad
   *     b = d = 0, \quad 8 c = E_L - \lambda - 2 \mu + 4 a
   *     + \frac{\lambda^2}{\lambda + \mu} . \quad (A42) @f]
   *
   * Any positive moduli make a stable solid; Debug: asserts them.
   */
  FiberBundleConstants
  bundle_constants(const double E_L, const double G_L, const double G_T);

  /**
   * The constants of (A42) as a file shows them: with five digits each, or with
   * twelve where five would change a modulus by more than a part in 1e4, since
   * G_L = mu - a and E_L are small differences of large constants if the moduli
   * lie far apart.
   *
   * @param E_L, G_L The moduli that the constants were made for [MPa].
   */
  FiberBundleConstants
  with_few_digits(FiberBundleConstants constants,
                  const double         E_L,
                  const double         G_L);

  /// Where an increasing function has the target, between low and high, to
  /// round-off; the nearer end if it is nowhere there.
  double
  root_of_increasing(const std::function<double(double)> &function,
                     const double                         target,
                     double                               low,
                     double                               high);
} // namespace NPT

#endif
