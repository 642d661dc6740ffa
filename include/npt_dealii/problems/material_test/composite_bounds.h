// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the classical bounds for the moduli of a unidirectional composite, to
// judge computed ones.

#ifndef npt_dealii_problems_material_test_composite_bounds_h
#define npt_dealii_problems_material_test_composite_bounds_h

namespace NPT
{
  struct Interval
  {
    double lower, upper;
  };

  /**
   * Bounds of Hill (1964) and Hashin (1965) for parallel fibers in a matrix,
   * both isotropic, arranged so that the composite is transversely isotropic.
   * Moduli in MPa.
   */
  struct CompositeBounds
  {
    /// Rule of mixtures v_f E_f + v_m E_m, the lower bound of E_L; exact for
    /// equal Poisson's ratios.
    double   rule_of_mixtures;
    Interval E_L;
    Interval k_T; ///< plane-strain bulk modulus (C22 + C23)/2
    Interval G_L; ///< shear along the fibers
    Interval G_T; ///< shear across the fibers
    Interval E_T; ///< from the other bounds: 4/E_T = 1/k_T + 1/G_T +
                  ///< 4 nu_L^2/E_L, with nu_L between those of the constituents
  };

  CompositeBounds
  unidirectional_bounds(const double volume_fraction,
                        const double young_fiber,
                        const double poisson_fiber,
                        const double young_matrix,
                        const double poisson_matrix);
} // namespace NPT

#endif
