// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the discrete space: cells (knot spans), reference elements,
// extraction operators, and the global numbering of control points over all
// patches.

#ifndef npt_dealii_iga_iga_space_h
#define npt_dealii_iga_iga_space_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/iga/nurbs_patch.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/tria.h>

#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /// Which functions carry geometry and displacement.
  enum class Basis
  {
    NURBS,     ///< smooth splines through Bezier extraction onto FE_Bernstein
    Bernstein, ///< the same patches cut to C0 ("Model B"), FE_Bernstein as is
    Lagrange   ///< the same spans with deal.II's FE_Q, nodes on the geometry
  };

  template <>
  const EnumNames<Basis> &
  enum_names<Basis>();

  /**
   * The isogeometric space of one or more patches. Each nonempty knot span is
   * one active cell of a hexahedral (quadrilateral) Triangulation in parameter
   * space, patch after patch; its material id is the patch number.
   *
   * Control points that coincide on the boundaries of patches of the same body
   * are one control point, which joins the patches conformingly (C0). Patches
   * of different bodies are never joined.
   *
   * With Basis::Lagrange the "control points" are the nodes of FE_Q placed on
   * the geometry (isoparametric, weights one).
   *
   * FE_Bernstein exists with one degree for all directions only, so each patch
   * is elevated to its highest degree first; the geometry stays the same.
   */
  template <int dim>
  class IGASpace
  {
  public:
    /// A knot span: patch and position of the span in each direction.
    struct Cell
    {
      unsigned int                  patch;
      std::array<unsigned int, dim> span;
    };

    /**
     * @param patches The bodies' patches.
     * @param bodies Body number of each patch; empty: every patch is a body.
     *
     * Throws InputError if patches of a body meet in a face with different
     * control points or weights. (A patch that meets a part of a larger face,
     * a hanging patch, is not noticed: it stays unjoined.)
     */
    IGASpace(const std::vector<NURBSPatch<dim>> &patches,
             const std::vector<unsigned int>    &bodies,
             const Basis                         basis);

    Basis
    basis() const
    {
      return basis_;
    }
    unsigned int
    n_patches() const
    {
      return patches_.size();
    }
    const NURBSPatch<dim> &
    patch(const unsigned int i) const
    {
      return patches_[i];
    }
    unsigned int
    body(const unsigned int patch) const
    {
      return bodies_[patch];
    }
    unsigned int
    degree(const unsigned int patch) const
    {
      return patches_[patch].knot_vector(0).degree();
    }
    const std::vector<Cell> &
    cells() const
    {
      return cells_;
    }
    unsigned int
    n_control_points() const
    {
      return control_points_.size();
    }
    /// Reference positions [mm] of all control points.
    const std::vector<dealii::Point<dim>> &
    control_points() const
    {
      return control_points_;
    }
    const std::vector<double> &
    weights() const
    {
      return weights_;
    }
    /// Global number of control point `local` (lexicographic) of a patch.
    unsigned int
    control_point(const unsigned int patch, const unsigned int local) const
    {
      return local_to_global_[patch][local];
    }
    /// Global numbers of the (p+1)^dim control points of a cell,
    /// lexicographic.
    std::vector<unsigned int>
    control_points_of_cell(const unsigned int cell) const;

    /// Extraction operator C^e of a span (identity for the C0 bases).
    const dealii::FullMatrix<double> &
    extraction_operator(const unsigned int patch,
                        const unsigned int direction,
                        const unsigned int span) const
    {
      return extraction_[patch][direction][span];
    }
    /// FE_Bernstein or FE_Q of the patch's degree.
    const dealii::FiniteElement<dim> &
    reference_element(const unsigned int patch) const
    {
      return *elements_[patch];
    }
    /// Lexicographic to the reference element's own numbering.
    const std::vector<unsigned int> &
    lexicographic_numbering(const unsigned int patch) const
    {
      return lexicographic_[patch];
    }
    /// The one-dimensional local functions on [0,1] (before extraction).
    const std::vector<dealii::Polynomials::Polynomial<double>> &
    local_polynomials(const unsigned int patch) const
    {
      return polynomials_[patch];
    }
    /// Parametric mesh, one cell per knot span, in the order of cells().
    const dealii::Triangulation<dim> &
    triangulation() const
    {
      return triangulation_;
    }

    /**
     * Express a field by the Bernstein polynomials of one cell: from
     * coefficients of the cell's own functions to rational Bezier points.
     *
     * @param coefficients One vector of n_components numbers per control point
     *   of the cell.
     * @param bezier_weights On return the weights of the Bezier points.
     * @return Projected Bezier coefficients (not multiplied with the weight).
     */
    std::vector<std::vector<double>>
    bezier_coefficients(const unsigned int                      cell,
                        const std::vector<std::vector<double>> &coefficients,
                        std::vector<double> &bezier_weights) const;

  private:
    void
    merge_control_points();
    void
    check_interfaces() const;
    void
    make_triangulation();

    Basis                                  basis_;
    std::vector<NURBSPatch<dim>>           patches_;
    std::vector<unsigned int>              bodies_;
    std::vector<Cell>                      cells_;
    std::vector<dealii::Point<dim>>        control_points_;
    std::vector<double>                    weights_;
    std::vector<std::vector<unsigned int>> local_to_global_;
    std::vector<std::array<std::vector<dealii::FullMatrix<double>>, dim>>
                                                             extraction_;
    std::vector<std::unique_ptr<dealii::FiniteElement<dim>>> elements_;
    std::vector<std::vector<unsigned int>>                   lexicographic_;
    std::vector<std::vector<dealii::Polynomials::Polynomial<double>>>
                               polynomials_;
    dealii::Triangulation<dim> triangulation_;
  };
} // namespace NPT

#endif
