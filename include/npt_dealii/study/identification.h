// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the identification of the fiber bundle law: the fit of its six
// constants to tabulated stresses, with confidence and stability.

#ifndef npt_dealii_study_identification_h
#define npt_dealii_study_identification_h

#include <npt_dealii/material/fiber_bundle_law.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/tensor.h>
#include <deal.II/lac/full_matrix.h>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * A test of the bundle: displacement gradients H and first Piola-Kirchhoff
   * stresses P [MPa], fiber along direction 1. Components iJ are row major.
   */
  struct MaterialCurve
  {
    std::string                       name;
    std::vector<dealii::Tensor<2, 3>> H;
    std::vector<dealii::Tensor<2, 3>> P;

    /// Which stresses were measured; a test rig does not see all nine.
    std::array<bool, 9> measured{
      {true, true, true, true, true, true, true, true, true}};
  };

  /**
   * Read curves from a CSV file with a header: H11 ... H33 (missing columns:
   * zero), P11 ... P33 [MPa] (missing columns: not measured), and optionally
   * `test`, the name of the curve a row belongs to. Other columns are ignored.
   * Without `test` the file is one curve with the name of the file.
   *
   * Throws InputError if there is no H or no P column, or no row.
   */
  std::vector<MaterialCurve>
  read_material_curves(const std::string &filename);

  /// Subsection "Identification".
  struct IdentificationParameters
  {
    enum class Components
    {
      all,   ///< every measured stress
      driven ///< stresses whose component of H is not zero in the curve
    };

    std::vector<std::string>      curves; ///< names; empty: all
    std::map<std::string, double> weights;
    Components                    components        = Components::all;
    bool                          relative_to_curve = true;
    bool                          positive_definite = true;
    bool                          elliptic          = true;
    double                        stability_margin  = 0.01; ///< [MPa]

    static void
    declare_parameters(dealii::ParameterHandler &prm);
    void
    parse_parameters(dealii::ParameterHandler &prm);
  };

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

  /// A report of several lines for the log.
  std::vector<std::string>
  describe(const IdentificationResult &result);

  /**
   * Write the file that other parameter files include: subsection "Fiber
   * bundle material" with the constants, and the report as comments.
   */
  void
  write_material_file(const std::string          &filename,
                      const IdentificationResult &result);

  /**
   * Write fit.csv, fit.gp and the pictures fit.svg, fit.png (test as points,
   * fit as lines, tension left, shear right, as Fig. 8) into a folder.
   *
   * @param picture Call gnuplot.
   * @return Empty, or a warning of one line.
   */
  std::string
  write_fit(const std::string                &directory,
            const std::vector<MaterialCurve> &curves,
            const FiberBundleConstants       &constants,
            const bool                        picture);
} // namespace NPT

#endif
