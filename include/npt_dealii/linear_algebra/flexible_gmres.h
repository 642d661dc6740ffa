// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines GMRES with a preconditioner that is nearly the inverse.

#ifndef npt_dealii_linear_algebra_flexible_gmres_h
#define npt_dealii_linear_algebra_flexible_gmres_h

#include <deal.II/lac/vector.h>

#include <functional>

namespace NPT
{
  /// y from x, which are not the same; y is resized.
  using LinearMap = std::function<void(const dealii::Vector<double> &x,
                                       dealii::Vector<double>       &y)>;

  /**
   * Find x with |b - A x| <= tolerance, from x = 0, by GMRES with the
   * preconditioner M on the right, which need not be the same linear map each
   * time (Saad 1993):
   *
   * @f[ x = \sum_j y_j M v_j, \qquad
   *     y = \arg\min_y \Big\| b - \sum_j y_j A M v_j \Big\| @f]
   *
   * with orthonormal v_j, v_1 = b / |b|, that the A M v_j span. Each iteration
   * costs one M and one product; all v_j and M v_j are kept.
   *
   * deal.II's SolverFGMRES sees the residual of an iteration only after M and A
   * of the next one. Where two or three iterations do, that is a third of all
   * solutions with the factors.
   *
   * @param A         The matrix.
   * @param M         Nearly its inverse.
   * @param tolerance Of the residual of the recursion, which runs ahead of the
   *   true one near round-off: the caller computes that.
   * @return Iterations. It also ends, with the best x so far, after the
   *   largest number of them, and where M gives no more directions: zero, or
   *   what is not finite.
   */
  unsigned int
  flexible_gmres(const LinearMap              &A,
                 const LinearMap              &M,
                 const dealii::Vector<double> &b,
                 const double                  tolerance,
                 const unsigned int            max_iterations,
                 dealii::Vector<double>       &x);
} // namespace NPT

#endif
