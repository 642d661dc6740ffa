// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines in which precision direct solvers factorize.

#ifndef npt_dealii_linear_algebra_factor_precision_h
#define npt_dealii_linear_algebra_factor_precision_h

#include <npt_dealii/linear_algebra/linear_solver.h>

#include <string>

namespace NPT
{
  /// Of the factors of one pattern: single where it pays or is asked for, until
  /// a matrix needs double precision.
  class FactorPrecision
  {
  public:
    FactorPrecision() = default;
    FactorPrecision(const LinearSolverParameters::Precision wish,
                    const unsigned int                      n_unknowns);

    bool
    is_single() const
    {
      return is_single_;
    }
    /// From now on.
    void
    use_double(const std::string &why);

    /// Begins with a comma; empty where nobody has thought of single precision.
    std::string
    description() const;

  private:
    bool        is_single_ = false;
    std::string why;
  };
} // namespace NPT

#endif
