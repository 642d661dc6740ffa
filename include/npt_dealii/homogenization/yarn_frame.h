// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines in-plane stretch in the coordinates of fabric testers: the stretches
// of the yarns and the angle between them.

#ifndef npt_dealii_homogenization_yarn_frame_h
#define npt_dealii_homogenization_yarn_frame_h

#include <npt_dealii/base/second_order.h>

#include <array>

namespace NPT
{
  /// H1, H2, H3 [-], or n1, n2, n3 [N/mm].
  using Membrane = std::array<double, 3>;

  /**
   * Yarns a = F e_1 (warp) and b = F e_2 (weft) of the macroscopic deformation
   * F = R U, U = [[1 + H1, H3/2], [H3/2, 1 + H2]]. They do not see R, so a
   * plate test, which has R = 1, stands for any frame that turns the cell.
   */
  struct YarnFrame
  {
    double warp_stretch = 1.; ///< lambda_1 = |a| [-]
    double weft_stretch = 1.; ///< lambda_2 = |b| [-]
    /// g [rad]: pi/2 less the angle between a and b.
    double shear_angle = 0.;
  };

  /// The three coordinates of a stretch and their first two derivatives with
  /// respect to H1, H2, H3.
  namespace YarnFrames
  {
    using Number = SecondOrder<3>;

    /// lambda_1 = |U e_1|.
    Number
    warp_stretch(const Membrane &H);
    /// lambda_2 = |U e_2|.
    Number
    weft_stretch(const Membrane &H);
    /// g = asin(a.b / (lambda_1 lambda_2)) [rad]. U must be positive definite.
    Number
    shear_angle(const Membrane &H);
    /// lambda_b = |U e_b| along the bias, e_b = (e_1 + e_2)/sqrt(2), half way
    /// between warp and weft of the sheet at rest.
    Number
    bias_stretch(const Membrane &H);

    YarnFrame
    of_gradients(const Membrane &H);

    /**
     * The stretch without rotation that has these yarns,
     *
     * @f[ 1 + H_1 = \frac{\lambda_1^2 + d}{t}, \quad
     *     1 + H_2 = \frac{\lambda_2^2 + d}{t}, \quad
     *     \frac{H_3}{2} = \frac{\lambda_1 \lambda_2 \sin g}{t}, \qquad
     *     d = \lambda_1 \lambda_2 \cos g, \quad
     *     t = (\lambda_1^2 + \lambda_2^2 + 2 d)^{1/2} \qquad (A35) @f]
     *
     * the square root of C = F^T F by Cayley and Hamilton. With inextensible
     * yarns (trellis) H1 = H2 = cos(g/2) - 1, H3 = 2 sin(g/2). Stretches must
     * be positive, |g| < pi/2.
     */
    Membrane
    gradients(const YarnFrame &frame);

    /**
     * The forces conjugate to the coordinates q = (lambda_1, lambda_2, g),
     *
     * @f[ n_k = f_j \, \frac{\partial q_j}{\partial H_k} \qquad (A36) @f]
     *
     * f_1, f_2: tension of the sheet along warp and weft per reference width,
     * at a constant angle [N/mm]; f_3 = m: torque per reference area [N/mm].
     *
     * @param n n1, n2, n3 at H [N/mm].
     */
    Membrane
    conjugates(const Membrane &H, const Membrane &n);
  } // namespace YarnFrames
} // namespace NPT

#endif
