// SPDX-License-Identifier: LGPL-2.1-or-later
// The door of the isogeometric room on a patch face: surface functions with
// derivatives up to the third order at any parameter.

#ifndef npt_dealii_iga_iga_surface_h
#define npt_dealii_iga_iga_surface_h

#include <npt_dealii/iga/iga_space.h>

namespace NPT
{
  /// Numbers of independent first, second and third derivatives of a function
  /// of m parameters, and where each one is stored.
  template <int m>
  struct SymmetricIndices
  {
    static constexpr unsigned int n_first  = m;
    static constexpr unsigned int n_second = m * (m + 1) / 2;
    static constexpr unsigned int n_third  = m * (m + 1) * (m + 2) / 6;
    /// 11, 12, 22 -> 0, 1, 2 (m = 2); 11 -> 0 (m = 1).
    static constexpr unsigned int
    second(const unsigned int a, const unsigned int b)
    {
      return a + b;
    }
    /// 111, 112, 122, 222 -> 0, 1, 2, 3 (m = 2); 111 -> 0 (m = 1).
    static constexpr unsigned int
    third(const unsigned int a, const unsigned int b, const unsigned int c)
    {
      return a + b + c;
    }
  };

  /// The functions that are nonzero at a point of a surface; the outer index
  /// counts derivatives, the inner one the functions.
  template <int m>
  struct SurfaceShape
  {
    using Indices = SymmetricIndices<m>;
    /// Position of each function's control point on the surface lattice.
    std::vector<unsigned int>                          lattice;
    std::vector<double>                                value;
    std::array<std::vector<double>, Indices::n_first>  first;
    std::array<std::vector<double>, Indices::n_second> second;
    std::array<std::vector<double>, Indices::n_third>  third;
  };

  /**
   * One face of a patch as a surface (33) with m = dim-1 parameters: the other
   * parametric directions of the patch in cyclic order, so that for dim = 3
   * orientation() a_1 x a_2 is the outward normal of the body; for dim = 2 it
   * is orientation() times the tangent turned clockwise, (a_2, -a_1).
   */
  template <int dim>
  class IGASurface
  {
  public:
    static constexpr int m = dim - 1;
    using Parameter        = std::array<double, m>;

    /**
     * @param direction Parametric direction normal to the face.
     * @param side 0: begin, 1: end of that direction.
     */
    IGASurface(const IGASpace<dim> &space,
               const unsigned int   patch,
               const unsigned int   direction,
               const unsigned int   side);

    unsigned int
    n_control_points() const
    {
      return control_points_.size();
    }
    unsigned int
    n_control_points(const unsigned int a) const
    {
      return knots_[a].n_functions();
    }
    /// Global control point of a lattice position.
    unsigned int
    control_point(const unsigned int lattice) const
    {
      return control_points_[lattice];
    }
    /// Reference position of a lattice position.
    const dealii::Point<dim> &
    reference_position(const unsigned int lattice) const
    {
      return space_->control_points()[control_points_[lattice]];
    }
    const KnotVector &
    knot_vector(const unsigned int a) const
    {
      return knots_[a];
    }
    /// +1 or -1, see the class documentation.
    double
    orientation() const
    {
      return orientation_;
    }
    unsigned int
    body() const
    {
      return space_->body(patch_);
    }
    unsigned int
    degree() const
    {
      return space_->degree(patch_);
    }

    /**
     * Evaluate the surface functions.
     *
     * @param u Parameters inside the knot vectors.
     * @param n_derivatives 0 to 3.
     * @param span If given, use the polynomial of this span even if u lies
     *   outside (needed at span boundaries, where one side is meant).
     */
    void
    evaluate(const Parameter                   &u,
             const unsigned int                 n_derivatives,
             SurfaceShape<m>                   &shape,
             const std::array<unsigned int, m> *span = nullptr) const;

    /**
     * Nonnegative functions that sum to one, for mortar averaging (37). They
     * are the surface functions themselves, except for Basis::Lagrange, whose
     * functions change sign: there the Bernstein polynomials of the same cells
     * are used, so that both C0 bases give the same method.
     */
    void
    evaluate_averaging(const Parameter &u, SurfaceShape<m> &shape) const;

    /// Point of integration over the reference surface.
    struct QuadraturePoint
    {
      Parameter                   u;
      std::array<unsigned int, m> span;
      double             area;  ///< weight times reference area element [mm^m]
      SurfaceShape<m>    shape; ///< values and first derivatives
      SurfaceShape<m>    averaging;
      dealii::Point<dim> X;
    };
    /// Gauss points of all spans, n per direction (0: degree + 1).
    std::vector<QuadraturePoint>
    quadrature(const unsigned int n) const;

  private:
    // Coefficients in powers of t in [0,1] of the p+1 functions of a span.
    using SpanPolynomials = std::vector<std::vector<double>>;

    void
    evaluate(const std::array<std::vector<SpanPolynomials>, m> &polynomials,
             const bool                                         rational,
             const Parameter                                   &u,
             const unsigned int                                 n_derivatives,
             const std::array<unsigned int, m>                 *span,
             SurfaceShape<m>                                   &shape) const;

    const IGASpace<dim>                        *space_;
    unsigned int                                patch_;
    double                                      orientation_;
    std::vector<KnotVector>                     knots_;
    std::vector<unsigned int>                   control_points_;
    std::vector<double>                         weights_;
    bool                                        rational_;
    std::array<std::vector<SpanPolynomials>, m> polynomials_;
    std::array<std::vector<SpanPolynomials>, m> averaging_polynomials_;
  };
} // namespace NPT

#endif
