// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the extraction operators that express B-splines on a span by the
// Bernstein polynomials of that span.

#ifndef npt_dealii_iga_bezier_extraction_h
#define npt_dealii_iga_bezier_extraction_h

#include <npt_dealii/iga/knot_vector.h>

namespace NPT
{
  /**
   * Extraction operators of all spans of a knot vector,
   *
   * @f[ N_a(\xi) = \sum_b C^e_{ab} B_b(\xi), \qquad a, b = 0, \dots, p, @f]
   *
   * with the B-splines N_a that are nonzero on span e and the Bernstein
   * polynomials B_b of the span mapped to [0,1]. Inserting every interior knot
   * up to multiplicity p turns the spline into Bezier segments; C^e is the
   * transpose of the block of the insertion operator that belongs to the span
   * (Borden, Scott, Evans, Hughes 2011).
   */
  std::vector<dealii::FullMatrix<double>>
  bezier_extraction_operators(const KnotVector &knot_vector);
} // namespace NPT

#endif
