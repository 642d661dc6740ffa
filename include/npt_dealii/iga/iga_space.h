// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the discrete space: the triangulation whose cells are the knot spans
// and own the elements, extraction operators, and the global numbering of
// control points over all patches.

#ifndef npt_dealii_iga_iga_space_h
#define npt_dealii_iga_iga_space_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/iga/nurbs_patch.h>

#include <deal.II/base/polynomial.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/grid/tria.h>
#include <deal.II/hp/fe_collection.h>

#include <map>
#include <string>
#include <vector>

namespace NPT
{
  /// Which functions carry geometry and displacement.
  enum class Basis
  {
    NURBS,     ///< smooth splines through Bezier extraction onto FE_Bernstein
    Bernstein, ///< the same patches cut to C0 ("Model B"): FE_Bernstein as is
    Lagrange   ///< the same spans with FE_Q, nodes on the geometry
  };

  template <>
  const EnumNames<Basis> &
  enum_names<Basis>();

  /**
   * The isogeometric space of one or more patches on one dealii::Triangulation.
   *
   * Each nonempty knot span is one active cell, patch after patch; its active
   * cell index is the number of the cell, its material id the number of the
   * patch (which body it belongs to, of which material it is). Vertices are the
   * corners of the spans in the reference configuration [mm], joined where
   * patches of one body meet, so that deal.II knows the neighbors of a cell
   * across patches. Between its vertices a cell is curved: geometry comes from
   * control points, never from the straight edges of the triangulation.
   *
   * Control points that coincide on the boundaries of patches of the same body
   * are one control point, which joins the patches conformingly (C0). Patches
   * of different bodies are never joined.
   *
   * The elements are deal.II's. For Basis::NURBS the splines of a cell are
   * combinations of the functions of FE_Bernstein (extraction), numbered by the
   * lattices of the patches, since neighboring cells share more than what lies
   * on their common face. The two C0 bases are a discretization of deal.II
   * itself: a DoFHandler numbers FE_Bernstein or FE_Q on the triangulation, one
   * degree of freedom per control point. Its numbers are then permuted to the
   * order in which the patches list their control points, which is that of the
   * splines, too.
   *
   * How the twins carry the geometry: the functions of a cell map the reference
   * cell to X, and are taken at its points (isoparametric). With
   * Basis::Lagrange the "control points" are the nodes of FE_Q placed on the
   * geometry and all weights are one: a polynomial approximation of a rational
   * patch. With Basis::Bernstein they are Bezier points with weights, so that
   * the functions of a rational patch are w_A B_A / W with B_A from
   * FE_Bernstein, and the geometry is exact.
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
     * a hanging patch, is not noticed: it stays unjoined.) With the C0 bases
     * cells of one body that have common corners are neighbors; two edges with
     * the same ends but different ways between them are an InputError.
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
    const std::vector<unsigned int> &
    control_points_of_cell(const unsigned int cell) const
    {
      return control_points_of_cell_[cell];
    }

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
      return elements_[element_of_degree_.at(degree(patch))];
    }
    /// The one-dimensional factors of its functions, on [0,1] (before
    /// extraction).
    const std::vector<dealii::Polynomials::Polynomial<double>> &
    local_polynomials(const unsigned int patch) const
    {
      return polynomials_[element_of_degree_.at(degree(patch))];
    }
    /// One active cell per knot span, in the order of cells().
    const dealii::Triangulation<dim> &
    triangulation() const
    {
      return triangulation_;
    }
    /**
     * Give every cell to one of n processes, its subdomain_id(), such that
     * each has about the same work and few neighbors elsewhere (METIS; along a
     * space-filling curve if deal.II was built without it).
     *
     * @param work Of each cell [any unit].
     */
    void
    partition(const unsigned int n, const std::vector<unsigned int> &work);
    /// The numbering of the elements of a C0 basis: one degree of freedom per
    /// control point, with its number. Not for Basis::NURBS.
    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      Assert(basis_ != Basis::NURBS, dealii::ExcNotInitialized());
      return dof_handler_;
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
    // Raise or cut the patch to what the basis needs and choose its element.
    void
    prepare_patch(const unsigned int i);
    // Nodes on the geometry instead of control points beside it.
    void
    place_nodes(const unsigned int i);
    void
    add_cells(const unsigned int i);
    void
    make_triangulation();
    // Numbering of the splines and of the C0 bases.
    void
    number_splines();
    void
    number_elements();
    // Lattice position in its patch of function l of a cell.
    unsigned int
    lattice_position(const Cell &cell, unsigned int l) const;
    // Of the control points that patches share.
    void
    check_weights() const;
    void
    check_interfaces() const;
    void
    check_positions() const;
    // Coefficients of the local functions of a cell in Bernstein polynomials.
    dealii::FullMatrix<double>
    bernstein_operator(const Cell &cell, const unsigned int direction) const;

    Basis                                  basis_;
    std::vector<NURBSPatch<dim>>           patches_;
    std::vector<unsigned int>              bodies_;
    double                                 tolerance_; // of positions, mm
    std::vector<Cell>                      cells_;
    std::vector<dealii::Point<dim>>        control_points_;
    std::vector<double>                    weights_;
    std::vector<std::vector<unsigned int>> local_to_global_;
    std::vector<std::vector<unsigned int>> control_points_of_cell_;
    std::vector<std::array<std::vector<dealii::FullMatrix<double>>, dim>>
      extraction_;
    // One element per degree.
    dealii::hp::FECollection<dim>        elements_;
    std::map<unsigned int, unsigned int> element_of_degree_;
    std::vector<std::vector<dealii::Polynomials::Polynomial<double>>>
      polynomials_;

    dealii::Triangulation<dim> triangulation_;
    dealii::DoFHandler<dim>    dof_handler_; // of the C0 bases
  };
} // namespace NPT

#endif
