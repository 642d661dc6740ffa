// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines which inputs of a function matter: the points at which it is to be
// known, and the indices that follow from its values there.

#ifndef npt_dealii_problems_parameter_study_sensitivity_indices_h
#define npt_dealii_problems_parameter_study_sensitivity_indices_h

#include <vector>

namespace NPT
{
  /**
   * The points of Saltelli's design in the unit cube: row by row that of A,
   * that of B, and for every input i that of A with input i taken from B. Row
   * j of A and B together is point j of Sobol's sequence in twice as many
   * dimensions, so that a design with more rows begins with this one.
   *
   * @param n_inputs At least 1 and at most 20, as GSL's sequence has 40
   *   dimensions.
   * @return n_rows (n_inputs + 2) points.
   *
   * Reference: Saltelli et al., Comput. Phys. Commun. 181, 2010, 259.
   */
  std::vector<std::vector<double>>
  sensitivity_points(const unsigned int n_inputs, const unsigned int n_rows);

  /// How much of the variance of a quantity comes from one input [-], with
  /// standard errors.
  struct SensitivityIndex
  {
    double first       = 0; ///< from this input alone
    double total       = 0; ///< from it alone and together with others
    double first_error = 0, total_error = 0;
  };

  /// A quantity over the ranges of all inputs.
  struct SensitivityResult
  {
    unsigned int n_rows = 0; ///< that have all values
    double       mean = 0, deviation = 0;
    /// Quantiles: least, 5 %, 50 %, 95 %, largest.
    double lowest = 0, low = 0, median = 0, high = 0, highest = 0;
    std::vector<SensitivityIndex> indices; ///< by input
  };

  /**
   * The indices of first order by Saltelli et al. (2010) and the total ones by
   * Jansen (1999), (A44) and (A45),
   *
   * @f[ V = \frac{1}{2N} \sum_j (a_j - m)^2 + (b_j - m)^2, \qquad
   *     S_i = \frac{1}{N V} \sum_j (b_j - m) (c_{ij} - a_j), \qquad
   *     T_i = \frac{1}{2 N V} \sum_j (a_j - c_{ij})^2 , @f]
   *
   * with the values a, b, c_i in the rows j of A, B and A with input i of B,
   * and the mean m of all a and b. Rows in which a value is missing, that is
   * not finite, are left out as a whole: the indices are those over the part
   * of the ranges where all is known.
   *
   * The standard errors are those of 1000 samples of rows drawn with
   * replacement, always the same ones. Sobol's points fill the cube more evenly
   * than random ones, so that they are rather too large.
   *
   * @param values At the points of sensitivity_points(), in their order.
   * @return Without indices if fewer than two rows are complete or all values
   *   are equal.
   *
   * References: M. J. W. Jansen, Comput. Phys. Commun. 117, 1999, 35; as above.
   */
  SensitivityResult
  sensitivity_of(const std::vector<double> &values,
                 const unsigned int         n_inputs);
} // namespace NPT

#endif
