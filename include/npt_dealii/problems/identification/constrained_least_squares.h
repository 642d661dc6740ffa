// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines linear least squares with linear inequalities as constraints.

#ifndef npt_dealii_problems_identification_constrained_least_squares_h
#define npt_dealii_problems_identification_constrained_least_squares_h

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace NPT
{
  /// Linear least squares by GSL (singular value decomposition), min |X t - y|.
  struct LeastSquares
  {
    LeastSquares(const dealii::FullMatrix<double> &X,
                 const std::vector<double>        &y);

    std::vector<double>        solution; ///< t
    dealii::FullMatrix<double> inverse;  ///< (X^T X)^{-1}
    /// Smallest over largest singular value, columns of X equilibrated.
    double reciprocal_condition = 0;
  };

  /// The half-space g.t >= bound.
  struct HalfSpace
  {
    std::vector<double> g;
    double              bound;
  };

  /**
   * Return the t nearest to @p start in all half-spaces, in the metric of the
   * fit: min z.z with t = start + L z and inverse = L L^T. The dual is solved
   * by non-negative least squares (Lawson and Hanson 1974, ch. 23: least
   * distance programming).
   *
   * @param inverse (X^T X)^{-1} of the fit without constraints.
   * @param active  By half-space: whether its border holds t back.
   *
   * Throws if no t lies in all half-spaces.
   */
  std::vector<double>
  nearest_admissible(const std::vector<double>        &start,
                     const dealii::FullMatrix<double> &inverse,
                     const std::vector<HalfSpace>     &cuts,
                     std::vector<bool>                &active);
} // namespace NPT

#endif
