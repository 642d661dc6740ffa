// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines shape functions on a patch face: values and derivatives up to the
// third order at any parameter.

#ifndef npt_dealii_iga_iga_surface_h
#define npt_dealii_iga_iga_surface_h

#include <npt_dealii/iga/iga_space.h>

#include <utility>
#include <vector>

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
    /// Position of each function's control point on the surface lattice: with
    /// rows of the first parameter's functions, those of the face first.
    std::vector<unsigned int>                          lattice;
    std::vector<double>                                value;
    std::array<std::vector<double>, Indices::n_first>  first;
    std::array<std::vector<double>, Indices::n_second> second;
    std::array<std::vector<double>, Indices::n_third>  third;
  };

  /// A point of a surface and its derivatives with respect to the parameters.
  template <int dim>
  struct SurfaceJet
  {
    using Indices = SymmetricIndices<dim - 1>;
    dealii::Tensor<1, dim>                                x;
    std::array<dealii::Tensor<1, dim>, Indices::n_first>  first;
    std::array<dealii::Tensor<1, dim>, Indices::n_second> second;
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
     * @param kink_rounding Fraction alpha, in [0, 1/2], of the spans on either
     *   side of a C0 knot over which the functions of the surface are rounded,
     *   (A19) of doc/theory.md: between xi - alpha h_- and xi + alpha h_+ the
     *   cubic with the values and slopes at both ends takes the place of each
     *   function (times its weight). The surface is C1 then, and still depends
     *   on all of its control points. Functions without kinks stay as they
     *   are. 0: none.
     * @param end_rounding Length, in the last parameter of the surface, over
     *   which the surface leaves the face at both ends of that parameter and
     *   turns into the body down to its middle, (A47) and (A48) of
     *   doc/theory.md: a round edge instead of the one where two faces of the
     *   patch meet. Less than half of the parameter's range. 0: none.
     */
    IGASurface(const IGASpace<dim> &space,
               const unsigned int   patch,
               const unsigned int   direction,
               const unsigned int   side,
               const double         kink_rounding = 0.,
               const double         end_rounding  = 0.);

    /// All that the surface depends on: the control points of the face and,
    /// behind them, those inside the body that round ends meet.
    unsigned int
    n_control_points() const
    {
      return control_points_.size();
    }
    /// The control points of the face, the first ones of the lattice.
    unsigned int
    n_face_control_points() const
    {
      return n_face_control_points_;
    }
    double
    end_rounding() const
    {
      return end_rounding_;
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

    /// Intervals on which the surface functions are polynomials (times
    /// weights): the knot spans, and the rounded kinks between them.
    const std::vector<double> &
    segment_breaks(const unsigned int a) const
    {
      return segments_[a].breaks;
    }
    unsigned int
    n_segments(const unsigned int a) const
    {
      return segments_[a].breaks.size() - 1;
    }
    /// Segment containing u; values outside are attributed to the end ones.
    unsigned int
    find_segment(const unsigned int a, const double u) const
    {
      return segments_[a].find(u);
    }
    /// Whether the surface is C1 across the interior break i.
    bool
    is_smooth(const unsigned int a, const unsigned int i) const
    {
      return segments_[a].smooth[i];
    }

    /**
     * Evaluate the surface functions.
     *
     * @param u Parameters inside the knot vectors.
     * @param n_derivatives 0 to 3.
     * @param segment If given, use the polynomial of this segment even if u
     *   lies outside (needed at breaks, where one side is meant).
     */
    void
    evaluate(const Parameter                   &u,
             const unsigned int                 n_derivatives,
             SurfaceShape<m>                   &shape,
             const std::array<unsigned int, m> *segment = nullptr) const;

    /**
     * A point with its derivatives up to second order: what evaluate() and a
     * sum over the functions give, without storing the functions.
     *
     * @param positions Of the control points, in the order of the lattice.
     * @param segment Use the polynomials of this segment.
     */
    SurfaceJet<dim>
    jet(const Parameter                       &u,
        const std::vector<dealii::Point<dim>> &positions,
        const std::array<unsigned int, m>     &segment) const;

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
    /// Gauss points of all spans, n per direction (0: degree + 1). Where a
    /// round end begins within a span, both parts have points of their own.
    std::vector<QuadraturePoint>
    quadrature(const unsigned int n) const;

  private:
    // The functions of one direction that are nonzero on a segment: powers of
    // t = (u - origin) / length.
    struct Segment
    {
      double                           origin, length;
      unsigned int                     first_function;
      std::vector<std::vector<double>> coefficients;
      /// Row of each function on the lattice, in a round end; empty: one after
      /// the other from first_function on.
      std::vector<unsigned int> rows;
    };
    struct Segments
    {
      std::vector<double>  breaks;
      std::vector<bool>    smooth; // per break
      std::vector<Segment> segments;

      unsigned int
      find(const double u) const;
      // Segment s as it is, cut to its part between two parameters.
      void
      append(const Segment &s, const double begin, const double end);
    };

    void
    round_kinks(Segments &segments, const double kink_rounding) const;

    // Let the surface turn into the body at both ends of the last parameter.
    void
    round_ends(const unsigned int direction, const unsigned int side);

    // The round end at the begin (0) or end (1) of the last parameter.
    void
    append_round_end(const unsigned int direction,
                     const unsigned int side,
                     const unsigned int end);

    // A part of a round end without knots, between tau_begin and tau_end.
    Segment
    round_segment(const unsigned int direction,
                  const unsigned int side,
                  const unsigned int end,
                  const double       tau_begin,
                  const double       tau_end);

    // Values of tau at which the round end meets a knot of the two directions
    // that it runs through, with 0 and 1, and whether it is C1 there.
    std::vector<std::pair<double, bool>>
    cuts_of_round_end(const unsigned int direction,
                      const unsigned int side,
                      const unsigned int end) const;

    // Row on the lattice of function j of the last parameter, in a layer of
    // control points below the face; a new one if there is none yet.
    unsigned int
    row_on_lattice(const unsigned int j, const unsigned int layer);

    void
    set_control_points(const unsigned int direction, const unsigned int side);

    // Gauss points lie between these parameters.
    std::vector<double>
    integration_breaks(const unsigned int a) const;

    void
    evaluate(const std::array<Segments, m>     &segments,
             const bool                         rational,
             const Parameter                   &u,
             const unsigned int                 n_derivatives,
             const std::array<unsigned int, m> *segment,
             SurfaceShape<m>                   &shape) const;

    const IGASpace<dim>    *space_;
    unsigned int            patch_;
    double                  orientation_;
    std::vector<KnotVector> knots_;
    double                  end_rounding_;
    // Function of the last parameter and layer below the face of each row.
    std::vector<std::pair<unsigned int, unsigned int>> rows_;
    unsigned int                                       n_face_control_points_;
    std::vector<unsigned int>                          control_points_;
    std::vector<double>                                weights_;
    bool                                               rational_;
    std::array<Segments, m>                            segments_;
    std::array<Segments, m>                            averaging_segments_;
  };
} // namespace NPT

#endif
