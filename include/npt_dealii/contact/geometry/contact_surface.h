// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a surface that takes part in contact: a patch face with its unknowns,
// possibly seen through an affine map (the image in a neighboring cell).

#ifndef npt_dealii_contact_geometry_contact_surface_h
#define npt_dealii_contact_geometry_contact_surface_h

#include <npt_dealii/contact/geometry/surface_metric.h>
#include <npt_dealii/iga/iga_surface.h>

#include <deal.II/lac/vector.h>

#include <array>
#include <optional>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * A patch face in contact. Its control points have reference positions and
   * unknowns; for an image in a neighboring cell these are the mapped
   * positions and the unknowns of the image that AffineConstraints ties to the
   * base cell and the macro unknowns. Contact itself does not know the
   * difference.
   */
  template <int dim>
  class ContactSurface
  {
  public:
    static constexpr int m = dim - 1;

    /// A face of the base cell: unknown dim*control_point + component.
    explicit ContactSurface(const IGASurface<dim> &surface)
      : surface_(&surface)
      , orientation_(surface.orientation())
    {
      for (unsigned int l = 0; l < surface.n_control_points(); ++l)
        {
          reference_.push_back(surface.reference_position(l));
          first_dof_.push_back(dim * surface.control_point(l));
        }
      find_smooth_pieces();
    }

    /**
     * An image of a face.
     *
     * @param reference Mapped reference positions per lattice position.
     * @param first_dof First of the dim unknowns of the image per lattice
     * position.
     * @param mirrored The map has determinant -1: the normal turns over.
     */
    ContactSurface(const IGASurface<dim>                 &surface,
                   const std::vector<dealii::Point<dim>> &reference,
                   const std::vector<unsigned int>       &first_dof,
                   const bool                             mirrored)
      : surface_(&surface)
      , orientation_(surface.orientation() * (mirrored ? -1. : 1.))
      , reference_(reference)
      , first_dof_(first_dof)
    {
      AssertDimension(reference.size(), surface.n_control_points());
      AssertDimension(first_dof.size(), surface.n_control_points());
      find_smooth_pieces();
    }

    /**
     * Place this piece on a longer strand made of several images: the slip of
     * a point that moves from one piece to the next is the difference of
     * parameter + shift.
     *
     * @param strand Pieces with the same number form one strand.
     * @param shift Added to the parameter along the strand.
     * @param before, after Index of the neighboring pieces at the begin and
     *   the end of that parameter, or -1.
     * @param along Which parameter runs along the strand.
     */
    void
    set_strand(const int          strand,
               const double       shift,
               const int          before,
               const int          after,
               const unsigned int along = 0)
    {
      along_        = along;
      strand_       = strand;
      shift_        = shift;
      neighbors_[0] = before;
      neighbors_[1] = after;
    }
    int
    strand() const
    {
      return strand_;
    }
    int
    along() const
    {
      return along_;
    }
    double
    shift() const
    {
      return shift_;
    }
    /// Piece that continues this one at the begin (0) or end (1) of the
    /// parameter along() the strand, or -1.
    int
    neighbor(const unsigned int side) const
    {
      return neighbors_[side];
    }

    /**
     * Round the boundary of the surface for contact, (A15) of doc/theory.md.
     *
     * @param radius [mm]; 0: sharp.
     */
    void
    set_edge_radius(const double radius)
    {
      edge_radius_ = radius;
    }
    double
    edge_radius() const
    {
      return edge_radius_;
    }

    /// Fibers of the body in the reference configuration: a unit vector that
    /// is tangent to the surface. Without it they run along the surface's
    /// parameter along().
    void
    set_fiber(const dealii::Tensor<1, dim> &fiber)
    {
      fiber_ = fiber;
    }
    /**
     * Unit vector along the fibers at a point, F A / |F A|, from the tangents
     * of the surface.
     *
     * @param shape Of the point, with first derivatives.
     * @param positions Current control points.
     */
    dealii::Tensor<1, dim>
    fiber_direction(const SurfaceShape<m>                 &shape,
                    const std::vector<dealii::Point<dim>> &positions) const
    {
      std::array<dealii::Tensor<1, dim>, m> reference, current;
      for (int a = 0; a < m; ++a)
        for (unsigned int l = 0; l < shape.lattice.size(); ++l)
          {
            reference[a] += shape.first[a][l] * reference_[shape.lattice[l]];
            current[a] += shape.first[a][l] * positions[shape.lattice[l]];
          }
      dealii::Tensor<1, dim> result = current[along_];
      if (fiber_)
        {
          SurfaceMatrix<m> metric{};
          for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b)
              metric[a][b] = reference[a] * reference[b];
          const SurfaceMatrix<m> inverse = invert_symmetric<m>(metric);
          result                         = 0;
          for (int a = 0; a < m; ++a)
            for (int b = 0; b < m; ++b)
              result += inverse[a][b] * (reference[b] * *fiber_) * current[a];
        }
      return result / result.norm();
    }

    /// Point of the surface at parameters u.
    dealii::Point<dim>
    position(const std::array<double, m>           &u,
             const std::vector<dealii::Point<dim>> &positions) const
    {
      SurfaceShape<m> shape;
      surface_->evaluate(u, 0, shape);
      dealii::Point<dim> x;
      for (unsigned int l = 0; l < shape.lattice.size(); ++l)
        x += shape.value[l] * positions[shape.lattice[l]];
      return x;
    }
    /// Unit vector in the tangent plane at u along which parameter k rises and
    /// the other one, if there is one, stays.
    dealii::Tensor<1, dim>
    direction(const std::array<double, m>           &u,
              const int                              k,
              const std::vector<dealii::Point<dim>> &positions) const
    {
      SurfaceShape<m> shape;
      surface_->evaluate(u, 1, shape);
      std::array<dealii::Tensor<1, dim>, m> a;
      for (int b = 0; b < m; ++b)
        for (unsigned int l = 0; l < shape.lattice.size(); ++l)
          a[b] += shape.first[b][l] * positions[shape.lattice[l]];
      dealii::Tensor<1, dim> result = a[k];
      if (m == 2)
        {
          const auto &other = a[1 - k];
          result -= (result * other) / other.norm_square() * other;
        }
      return result / result.norm();
    }

    const IGASurface<dim> &
    surface() const
    {
      return *surface_;
    }
    /// Sign that makes a_1 x a_2 the outward normal.
    double
    orientation() const
    {
      return orientation_;
    }
    unsigned int
    first_dof(const unsigned int lattice) const
    {
      return first_dof_[lattice];
    }
    const dealii::Point<dim> &
    reference_position(const unsigned int lattice) const
    {
      return reference_[lattice];
    }

    /// Current positions x = X + w of the control points.
    void
    update_positions(const dealii::Vector<double>    &displacement,
                     std::vector<dealii::Point<dim>> &positions) const
    {
      positions = reference_;
      for (unsigned int l = 0; l < positions.size(); ++l)
        for (unsigned int c = 0; c < dim; ++c)
          positions[l][c] += displacement[first_dof_[l] + c];
    }

    /// Interval of parameters around a segment over which the surface is C1.
    const std::pair<double, double> &
    smooth_piece(const unsigned int direction, const unsigned int segment) const
    {
      return smooth_pieces_[direction][segment];
    }

  private:
    void
    find_smooth_pieces()
    {
      for (int k = 0; k < m; ++k)
        {
          const auto        &breaks     = surface_->segment_breaks(k);
          const unsigned int n_segments = surface_->n_segments(k);
          for (unsigned int e = 0; e < n_segments; ++e)
            {
              unsigned int begin = e, end = e + 1;
              while (begin > 0 && surface_->is_smooth(k, begin))
                --begin;
              while (end < n_segments && surface_->is_smooth(k, end))
                ++end;
              smooth_pieces_[k].emplace_back(breaks[begin], breaks[end]);
            }
        }
    }

    const IGASurface<dim>                                *surface_;
    double                                                orientation_;
    double                                                edge_radius_ = 0.;
    std::optional<dealii::Tensor<1, dim>>                 fiber_;
    std::vector<dealii::Point<dim>>                       reference_;
    std::vector<unsigned int>                             first_dof_;
    std::array<std::vector<std::pair<double, double>>, m> smooth_pieces_;
    int                                                   strand_ = -1;
    int                                                   along_  = 0;
    double                                                shift_  = 0;
    int neighbors_[2]                                             = {-1, -1};
  };
} // namespace NPT

#endif
