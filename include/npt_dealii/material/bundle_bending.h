// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the bending stiffness of a bundle whose fibers slide, and what else
// follows from the data sheet of a yarn.

#ifndef npt_dealii_material_bundle_bending_h
#define npt_dealii_material_bundle_bending_h

namespace NPT
{
  /**
   * Fiber volume fraction of a bundle: the area of its fibers over its own,
   *
   * @f[ V_0 = \frac{T}{1000 \, \rho \, a} . @f]
   *
   * @param tex     Linear density T [g/km].
   * @param density Of the fibers, rho [g/cm^3].
   * @param area    Section of the bundle a [mm^2].
   */
  double
  fiber_fraction(const double tex, const double density, const double area);

  /**
   * Bending stiffness over that of a solid, of a strip that is bent to waves
   * and whose layers slide on each other with a shear modulus, Eq. (A33):
   *
   * @f[ \frac{B}{E t^3/12} = r(s) = \frac{3 (s - \tanh s)}{s^3}, \qquad
   *     s = \frac{\pi t}{2 L} \sqrt{\frac{E}{G}} . @f]
   *
   * Exact where all points of a section have the same deflection: one for
   * G >> E (t/L)^2, and 3/s^2 = 12 G L^2/(pi^2 E t^2) for loose layers.
   *
   * @param modulus E along the fibers [MPa].
   * @param shear_modulus G along the fibers [MPa].
   * @param slenderness Thickness t over half wave L [-].
   */
  double
  bending_ratio(const double modulus,
                const double shear_modulus,
                const double slenderness);

  /**
   * The inverse of bending_ratio(): the shear modulus [MPa] with which a strip
   * has a given bending stiffness.
   *
   * @param ratio Bending stiffness over that of a solid, 0 < r < 1 [-].
   *
   * Asserts that the ratio lies between 0 and 1.
   */
  double
  shear_modulus_for_bending(const double modulus,
                            const double ratio,
                            const double slenderness);

  /**
   * Bending stiffness of fibers that slide freely over that of a solid of the
   * same section, 3/4 (d/t)^2, Eq. (A34): below this no bundle bends.
   *
   * @param fiber_diameter d [mm]. @param thickness t of the bundle [mm].
   */
  double
  loose_bending_ratio(const double fiber_diameter, const double thickness);

  /**
   * The double modulus of a strip in pure bending whose stiffness differs in
   * tension and compression, Eq. (A34): B = E_r t^3/12 with
   *
   * @f[ E_r = \frac{4 E_t E_c}{(\sqrt{E_t} + \sqrt{E_c})^2} . @f]
   *
   * Reference: Timoshenko and Gere, Theory of Elastic Stability (1961), 3.3.
   */
  double
  double_modulus(const double in_tension, const double in_compression);
} // namespace NPT

#endif
