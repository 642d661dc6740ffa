// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines Bezier extraction operators by knot insertion.

#include <npt_dealii/iga/bezier_extraction.h>

namespace NPT
{
  std::vector<dealii::FullMatrix<double>>
  bezier_extraction_operators(const KnotVector &knot_vector)
  {
    const unsigned int p      = knot_vector.degree();
    KnotVector         bezier = knot_vector;
    const auto         T =
      knot_vector.insertion_operator(knot_vector.bezier_knots(), bezier);

    std::vector<dealii::FullMatrix<double>> operators;
    for (unsigned int e = 0; e < knot_vector.n_spans(); ++e)
      {
        dealii::FullMatrix<double> C(p + 1, p + 1);
        for (unsigned int a = 0; a <= p; ++a)
          for (unsigned int b = 0; b <= p; ++b)
            C(a, b) = T(e * p + b, knot_vector.first_function(e) + a);
        operators.push_back(C);
      }
    return operators;
  }
} // namespace NPT
