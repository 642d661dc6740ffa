// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines tables and picture of a sensitivity study.

#ifndef npt_dealii_problems_parameter_study_sensitivity_results_h
#define npt_dealii_problems_parameter_study_sensitivity_results_h

#include <npt_dealii/problems/parameter_study/sensitivity_indices.h>

#include <string>
#include <vector>

namespace NPT
{
  /// What a study knows of the ordinate of a curve at one abscissa.
  struct SensitivityQuantity
  {
    std::string       column;
    double            at        = 0; ///< abscissa
    unsigned int      n_rows    = 0; ///< of the design
    unsigned int      n_missing = 0; ///< cases that do not come so far
    SensitivityResult result;        ///< over the rows that do
  };

  /// One line for the screen: "shear_torque at shear_angle 10: ...".
  std::string
  describe(const SensitivityQuantity      &quantity,
           const std::string              &x_column,
           const std::vector<std::string> &inputs);

  /**
   * Write `sensitivity.csv` with the indices of all inputs, and
   * `sensitivity_band.csv` with mean, deviation and quantiles over the ranges;
   * draw `sensitivity`, bars over the abscissas: total indices with their
   * standard errors, and within them those of first order.
   *
   * @return Warning of the plotting program, or empty.
   */
  std::string
  write_sensitivity(const std::string                      &directory,
                    const std::vector<std::string>         &inputs,
                    const std::vector<SensitivityQuantity> &quantities,
                    const std::string                      &x_column,
                    const std::string                      &title);
} // namespace NPT

#endif
