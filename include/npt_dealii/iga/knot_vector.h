// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines knot vectors: spans, B-spline functions by Cox-de Boor, and the
// linear operators of knot insertion and degree elevation.

#ifndef npt_dealii_iga_knot_vector_h
#define npt_dealii_iga_knot_vector_h

#include <deal.II/lac/full_matrix.h>

#include <vector>

namespace NPT
{
  /**
   * An open (clamped) knot vector of degree p >= 1: the first and the last
   * knot appear p+1 times, interior knots at most p times.
   *
   * Spans are counted without the empty ones: span e is the e-th interval of
   * positive length. On it the functions first_function(e) ...
   * first_function(e)+p are the nonzero ones.
   */
  class KnotVector
  {
  public:
    /// Throws InputError if the knots are not open, decrease, or repeat too
    /// often.
    KnotVector(const unsigned int degree, const std::vector<double> &knots);

    /// Open knot vector on [0,1] with equal spans and C^{p-1} between them.
    static KnotVector
    uniform(const unsigned int degree, const unsigned int n_spans);

    unsigned int
    degree() const
    {
      return degree_;
    }
    const std::vector<double> &
    knots() const
    {
      return knots_;
    }
    unsigned int
    n_functions() const
    {
      return knots_.size() - degree_ - 1;
    }
    unsigned int
    n_spans() const
    {
      return breaks_.size() - 1;
    }
    /// Boundaries of the spans: n_spans()+1 strictly increasing values.
    const std::vector<double> &
    breaks() const
    {
      return breaks_;
    }
    /// Index of the first function that is nonzero on span e.
    unsigned int
    first_function(const unsigned int e) const
    {
      return span_knot_[e] - degree_;
    }
    /// Span containing u; values outside are attributed to the end spans.
    unsigned int
    find_span(const double u) const;

    /// How often a value appears among the knots.
    unsigned int
    multiplicity(const double u) const;

    /**
     * Values and derivatives of the p+1 functions that are nonzero on span e,
     * by the Cox-de Boor recursion (30)-(31) and its derivative.
     *
     * @return table[d][a] = d-th derivative of function first_function(e)+a.
     */
    std::vector<std::vector<double>>
    values(const unsigned int e,
           const double       u,
           const unsigned int n_derivatives) const;

    /// Greville abscissa of function i, the mean of its p interior knots.
    double
    greville(const unsigned int i) const;

    /**
     * Knot insertion (Boehm): the new coefficients are T times the old ones.
     *
     * @param new_knots Values strictly inside the knot vector; a value may
     *   appear several times.
     * @param refined On return the refined knot vector.
     * @return T, n_new x n_old.
     */
    dealii::FullMatrix<double>
    insertion_operator(const std::vector<double> &new_knots,
                       KnotVector                &refined) const;

    /**
     * Degree elevation by `times`: every continuity C^k stays, so each knot
     * gains `times` in multiplicity. The old space is contained in the new
     * one, hence interpolation at the new Greville points is exact.
     */
    dealii::FullMatrix<double>
    elevation_operator(const unsigned int times, KnotVector &elevated) const;

    /**
     * Interpolation at the Greville abscissae of another knot vector on the
     * same interval: coefficients there are T times those here. Exact if every
     * spline of this one is a spline of the other one, too.
     *
     * @return T, n_other x n_this.
     */
    dealii::FullMatrix<double>
    interpolation_operator(const KnotVector &other) const;

    /// Knots that split every span into `parts` equal parts.
    std::vector<double>
    subdividing_knots(const unsigned int parts) const;

    /// Knots that raise every interior knot to multiplicity p (C0, Bezier).
    std::vector<double>
    bezier_knots() const;

  private:
    unsigned int              degree_;
    std::vector<double>       knots_;
    std::vector<double>       breaks_;
    std::vector<unsigned int> span_knot_; // knot index i: [u_i, u_{i+1})
  };
} // namespace NPT

#endif
