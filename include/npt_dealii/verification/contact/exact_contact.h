// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the exact solutions that contact is verified against: Hertz, partial
// slip of Cattaneo and Mindlin, twisting contact, the belt on a drum.

#ifndef npt_dealii_verification_contact_exact_contact_h
#define npt_dealii_verification_contact_exact_contact_h

namespace NPT
{
  /**
   * Modulus of two elastic half-spaces in frictionless contact [MPa],
   *
   * @f[ \frac{1}{E^*} = \frac{1 - \nu_1^2}{E_1} + \frac{1 - \nu_2^2}{E_2} . @f]
   *
   * A rigid body has Young's modulus infinity.
   */
  double
  contact_modulus(const double young_modulus_1,
                  const double poisson_ratio_1,
                  const double young_modulus_2,
                  const double poisson_ratio_2);



  /**
   * Hertz' contact of two cylinders with parallel axes (plane strain),
   *
   * @f[ a = \sqrt{\frac{4 P R}{\pi E^*}}, \quad p_0 = \frac{2 P}{\pi a}, \quad
   *     p(x) = p_0 \sqrt{1 - x^2/a^2}, \quad 1/R = 1/R_1 + 1/R_2 . @f]
   *
   * Reference: K. L. Johnson, Contact Mechanics (1985), Eqs. (4.43)-(4.45).
   */
  struct HertzLine
  {
    double load;          ///< P [N/mm]
    double half_width;    ///< a [mm]
    double peak_pressure; ///< p_0 [MPa]

    /// @param radius R [mm]; @param modulus E* [MPa].
    static HertzLine
    from_load(const double load, const double radius, const double modulus);
    static HertzLine
    from_half_width(const double half_width,
                    const double radius,
                    const double modulus);

    /// p(x), zero outside of the contact.
    double
    pressure(const double x) const;
  };



  /**
   * Hertz' contact of two smooth surfaces whose distance is
   * x^2/(2 R_x) + y^2/(2 R_y), with an elliptic contact area of half axes a, b,
   *
   * @f[ p = p_0 \sqrt{1 - x^2/a_x^2 - y^2/a_y^2}, \quad
   *     p_0 = \frac{3 P}{2 \pi a b}, \quad
   *     (a b)^{3/2} = \frac{3 P \sqrt{R_x R_y}}{4 E^*} F_1^3(e), @f]
   *
   * where the eccentricity e, e^2 = 1 - b^2/a^2, solves
   *
   * @f[ \frac{R'}{R''} = \frac{(a/b)^2 E(e) - K(e)}{K(e) - E(e)},
   *     \qquad R' \ge R'' . @f]
   *
   * R_x = R_y is the sphere. Reference: Johnson (1985), Eqs. (4.24)-(4.32).
   */
  struct HertzPoint
  {
    double load;          ///< P [N]
    double half_axis_x;   ///< [mm]
    double half_axis_y;   ///< [mm]
    double peak_pressure; ///< p_0 [MPa]
    double approach;      ///< of distant points [mm]

    static HertzPoint
    from_load(const double load,
              const double radius_x,
              const double radius_y,
              const double modulus);

    /// The load that gives a half axis along x.
    static HertzPoint
    from_half_axis_x(const double half_axis_x,
                     const double radius_x,
                     const double radius_y,
                     const double modulus);

    double
    pressure(const double x, const double y) const;
  };



  /**
   * Partial slip of two similar cylinders (plane strain) pressed together by P
   * and then sheared by Q < mu P (Cattaneo 1938, Mindlin 1949),
   *
   * @f[ q(x) = \mu p_0 \left[ \sqrt{1 - x^2/a^2}
   *            - \frac{c}{a} \sqrt{1 - x^2/c^2} \right], \qquad
   *     c = a \sqrt{1 - \frac{Q}{\mu P}}, @f]
   *
   * the second root only within the stick zone |x| < c. In cycles between +Q
   * and -Q, Masing's rule on the slip part of the displacement,
   * (mu P / (pi E*)) [(1-k) ln(1-k) + k] with k = Q/(mu P), gives the loss per
   * cycle
   *
   * @f[ W = \frac{2 (\mu P)^2}{\pi E^*}
   *         \left[ 2 (1-k) \ln(1-k) + 2 k - k^2 \right] . @f]
   *
   * The displacement itself depends on the shape of the bodies, the loss does
   * not. Reference: Johnson (1985), section 7.2; the loss is derived in
   * doc/verification.md.
   */
  struct PartialSlipLine
  {
    HertzLine normal;
    double    friction_coefficient;
    double    tangential_load; ///< Q [N/mm]

    double
    stick_half_width() const;
    /// q(x) [MPa] after the first loading.
    double
    traction(const double x) const;
    /// W [N] per cycle and length of the cylinders.
    double
    loss_per_cycle(const double modulus) const;
  };



  /**
   * Twist of a Hertzian contact (sphere) by a torque about its normal (Lubkin
   * 1951). Slip begins at the edge and leaves a sticking circle of radius c.
   * The shear traction is a superposition of those of twisted rigid circles of
   * radius s, c < s < a (Jaeger 1995), hence by Abel's transformation with
   * k^2 = 1 - c^2/a^2 and B(s) = K - E at k(s)
   *
   * @f[ \beta = \frac{\mu p_0}{2 G} B(c), \qquad
   *     M = \frac{8 \mu p_0}{3} \left[ c^3 B(c) + 3 \int_c^a s^2 B(s) \, ds
   *         \right] . @f]
   *
   * beta is the twist of one elastic body against a rigid one; two equal bodies
   * have 2 beta. c = 0: full slip, M = 3 pi mu P a / 16.
   */
  struct TwistedSphere
  {
    HertzPoint normal; ///< half_axis_x = half_axis_y = a
    double     friction_coefficient;
    double     shear_modulus; ///< G of the elastic body [MPa]

    double
    twist(const double stick_radius) const;
    /// [N mm]
    double
    torque(const double stick_radius) const;
    /// Inverse of twist(); 0 < angle.
    double
    stick_radius(const double angle) const;
  };

  /**
   * Torque of a disc under uniform pressure that slips as a whole,
   * M = 2/3 mu P R [N mm].
   */
  double
  torque_of_slipping_disc(const double friction_coefficient,
                          const double load,
                          const double radius);

  /// Ratio of the tensions of a thin belt that slips on a drum,
  /// T_2/T_1 = exp(mu theta) (Euler, Eytelwein).
  double
  capstan_ratio(const double friction_coefficient, const double wrap_angle);
} // namespace NPT

#endif
