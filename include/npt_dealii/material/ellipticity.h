// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the search for loss of ellipticity: the lowest eigenvalue of the
// acoustic tensor over all directions.

#ifndef npt_dealii_material_ellipticity_h
#define npt_dealii_material_ellipticity_h

#include <npt_dealii/material/hyperelastic_law.h>

#include <deal.II/base/tensor.h>

namespace NPT
{
  /// Where a(m, N) = A_iJkL m_i N_J m_k N_L is lowest among unit vectors.
  template <int dim>
  struct LowestAcousticEigenvalue
  {
    double                 value;        ///< [MPa]; elliptic if positive
    dealii::Tensor<1, dim> normal;       ///< N, reference configuration
    dealii::Tensor<1, dim> polarization; ///< m, current configuration
  };

  /**
   * Find the lowest eigenvalue of the acoustic tensor Q(N) over all unit
   * directions N,
   *
   * @f[ Q_{ik}(N) = A_{iJkL} N_J N_L, \qquad
   *     \min_{|N| = 1} \lambda_{min}(Q(N))
   *       = \min_{|m| = |N| = 1} A_{iJkL} m_i N_J m_k N_L . @f]
   *
   * Positive: strongly elliptic, plane waves propagate. Zero or negative: a
   * jump of the displacement gradient m (x) N costs no energy, and the discrete
   * problem depends on the mesh. m parallel to F^{-T} N is a compaction band,
   * m normal to it a shear or kink band.
   *
   * The search is deterministic: Q on a fixed set of directions (10 degrees
   * apart in 3d), then descent from every one that is lower than its
   * neighbors. It costs as much as some 500 evaluations of the tangent: meant
   * for accepted steps, not for every Newton iteration. For dim = 2 only
   * directions in the plane are considered.
   *
   * @param A Tangent dP/dF [MPa] with major symmetry, row-major as in
   *   HyperelasticLaw::stress_and_tangent().
   */
  template <int dim>
  LowestAcousticEigenvalue<dim>
  lowest_acoustic_eigenvalue(const double *A);

  template <int dim>
  LowestAcousticEigenvalue<dim>
  lowest_acoustic_eigenvalue(const dealii::Tensor<4, dim> &dP_dF);

  /// The same of a law at the deformation gradient F.
  template <int dim>
  LowestAcousticEigenvalue<dim>
  lowest_acoustic_eigenvalue(const HyperelasticLaw<dim>   &law,
                             const dealii::Tensor<2, dim> &F);

  /**
   * A sufficient condition for ellipticity that costs as much as a few
   * tangents: whether for one of some numbers tau the quadratic form
   *
   * @f[ H : A : H + \tau \, \frac{\partial^2 J}{\partial F^2}[H, H] > 0,
   *     \qquad H \ne 0 . @f]
   *
   * The second term is zero for H = m (x) N, so the form is a(m, N) there. For
   * a neo-Hookean law one tau always fits.
   *
   * @param A Tangent at F, as above.
   * @param F Deformation gradient, row-major.
   * @param shear_modulus Of the law at rest, the unit of tau [MPa].
   * @return True: strongly elliptic. False: lowest_acoustic_eigenvalue() must
   *   tell.
   */
  bool
  is_surely_elliptic(const double *A,
                     const double *F,
                     const double  shear_modulus);
} // namespace NPT

#endif
