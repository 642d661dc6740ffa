// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the identification of the fiber bundle law: the fit of its six
// constants to tabulated stresses, with confidence and stability.

#ifndef npt_dealii_problems_identification_identification_h
#define npt_dealii_problems_identification_identification_h

#include <npt_dealii/material/fiber_bundle_law.h>
#include <npt_dealii/problems/identification/identification_parameters.h>
#include <npt_dealii/problems/identification/material_curve.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  struct IdentificationResult
  {
    static constexpr unsigned int n_constants = 6;

    /// mu, lambda, a, b, c, d.
    FiberBundleConstants            constants;
    std::array<double, n_constants> standard_error{};
    /// Half the width of the interval that holds the constant with 95 %.
    std::array<double, n_constants> confidence{};
    dealii::FullMatrix<double>      covariance; ///< [MPa^2]

    unsigned int n_data = 0; ///< stress values
    /// Smallest over largest singular value of the equilibrated design matrix.
    double reciprocal_condition = 0;

    struct CurveError
    {
      std::string name;
      double      scale;   ///< largest measured stress that is fitted [MPa]
      double      rms;     ///< root mean square over the scale [-]
      double      largest; ///< over the scale [-]
    };
    std::vector<CurveError> errors; ///< of the curves that were fitted

    unsigned int n_active_constraints = 0;
    /// Of the small-strain stiffness [MPa].
    FiberBundleConstants::LowestEigenvalue stiffness{0., ""};
    /// Lowest acoustic eigenvalue over the fitted range [MPa], and where.
    double                   acoustic = 0;
    std::string              acoustic_place;
    std::vector<std::string> notes;
  };

  /// The six constants as the entries of subsection "Fiber bundle material"
  /// name them, in the order of all vectors here.
  const std::vector<std::string> &
  bundle_constant_names();

  std::vector<double>
  bundle_constant_values(const FiberBundleConstants &constants);

  /// The stress of all nine components by the law with given constants.
  dealii::Tensor<2, 3>
  bundle_stress(const FiberBundleConstants &constants,
                const dealii::Tensor<2, 3> &H);

  /**
   * Fit the six constants of (50)-(53). They enter the stress linearly,
   *
   * @f[ P(F; \theta) = \sum_k \theta_k B_k(F), \qquad
   *     \min_\theta \sum_c \frac{w_c}{s_c^2} \sum_n
   *       | P(F_n; \theta) - P_n |^2, @f]
   *
   * with the weight w_c of a curve and its scale s_c (its largest stress, or 1
   * MPa). Least squares, covariance and condition are GSL's
   * (singular value decomposition).
   *
   * Stability is linear in the constants too, for each F and each pair of unit
   * vectors m, N (acoustic tensor) or each strain e (stiffness at rest):
   * A_iJkL(F; theta) m_i N_J m_k N_L >= margin. So the admissible set is
   * convex, and the constrained fit is found by cutting planes: solve, look
   * for the worst m, N over all points of the fitted curves, add that
   * half-space, solve again (Lawson and Hanson 1974, ch. 23: least distance
   * programming by non-negative least squares).
   *
   * Standard errors assume independent errors of the weighted stresses with
   * equal variance, which is estimated from the residual, and treat active
   * constraints as equations. Where the law cannot follow the data the residual
   * is a misfit and not noise; the interval then is a measure of how sharply
   * the data choose, not a probability.
   *
   * Throws InputError for unknown curve names, fewer data than constants, or
   * data that do not determine all six.
   */
  IdentificationResult
  identify(const std::vector<MaterialCurve> &curves,
           const IdentificationParameters   &parameters);

  /// The errors of given constants (e.g. published ones) on the same data.
  std::vector<IdentificationResult::CurveError>
  curve_errors(const std::vector<MaterialCurve> &curves,
               const IdentificationParameters   &parameters,
               const FiberBundleConstants       &constants);
} // namespace NPT

#endif
