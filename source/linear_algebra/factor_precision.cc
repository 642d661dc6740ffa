// SPDX-License-Identifier: LGPL-2.1-or-later
// The precision of factors.

#include <npt_dealii/linear_algebra/factor_precision.h>

namespace NPT
{
  // Number of unknowns from which on factors of single precision, and more
  // products with them, take less time than those of double precision.
  constexpr unsigned int single_precision_pays = 5000;



  FactorPrecision::FactorPrecision(const LinearSolverParameters::Precision wish,
                                   const unsigned int n_unknowns)
  {
    using Precision = LinearSolverParameters::Precision;
    if (wish == Precision::single_precision)
      why = "as asked for";
    else if (wish == Precision::automatic &&
             n_unknowns >= single_precision_pays)
      why = "as there are at least " + std::to_string(single_precision_pays) +
            " unknowns";
    is_single_ = !why.empty();
  }



  void
  FactorPrecision::use_double(const std::string &given_why)
  {
    is_single_ = false;
    why        = given_why;
  }



  std::string
  FactorPrecision::description() const
  {
    if (why.empty())
      return "";
    return ", factors in " + std::string(is_single_ ? "single" : "double") +
           " precision, " + why;
  }
} // namespace NPT
