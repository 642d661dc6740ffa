// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the deformable solids of a problem: their space, laws and reference
// gradients, and the assembly of their virtual work.

#ifndef npt_dealii_solid_deformable_bodies_h
#define npt_dealii_solid_deformable_bodies_h

#include <npt_dealii/base/ranks.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/material/ellipticity.h>
#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/solid/cell_gradients.h>
#include <npt_dealii/solid/natural_state.h>
#include <npt_dealii/solid/solid_kernel.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// One patch of a deformable body.
  struct DeformablePart
  {
    NURBSPatch<3>                       patch;
    std::unique_ptr<HyperelasticLaw<3>> law;
    unsigned int body = 0; ///< patches of one body are joined
    std::string  name;     ///< for messages: "bundle 2", "the matrix"
  };

  /**
   * Bodies of one or several patches in total Lagrangian form. Their virtual
   * work, its linearization and their stored energy are sums over the cells,
   *
   * @f[ \delta W = \sum_c m_c \int_c \delta F : P \, dV, \qquad
   *     \Delta \delta W = \sum_c m_c \int_c \delta F : A : \Delta F \, dV,
   *     \qquad F = 1 + \mathrm{Grad}\, w, @f]
   *
   * where the symmetry_weight m_c is 1 unless symmetry says otherwise: a cell
   * that stands for its image too has 2, the image itself has 0 and is skipped.
   *
   * Unknown 3 A + i is component i of the displacement of control point A [mm].
   * Vectors may be longer: a problem appends its own unknowns (macroscopic
   * gradients, images). The integral over one cell is SolidKernel's.
   *
   * Functions of a state take the natural state of the bodies, in which they
   * bear no stress; without it this is the reference configuration.
   */
  class DeformableBodies
  {
  public:
    /// m_c from the patch of the cell and its center of volume.
    using SymmetryWeight =
      std::function<unsigned int(const unsigned int      patch,
                                 const dealii::Point<3> &center)>;

    /**
     * @param n_gauss_points Per direction; 0 takes degree + 1.
     * @param symmetry_weight Empty: every cell once.
     *
     * Throws InputError if patches of a body do not fit (IGASpace), and
     * InvertedCell if a patch is folded in the reference configuration.
     */
    DeformableBodies(std::vector<DeformablePart> parts,
                     const Basis                 basis,
                     const unsigned int          n_gauss_points  = 0,
                     const SymmetryWeight       &symmetry_weight = {},
                     const Ranks                &ranks           = {});

    /// The processes that share the cells: each assembles those of its
    /// subdomain.
    const Ranks &
    ranks() const
    {
      return ranks_;
    }

    const IGASpace<3> &
    space() const
    {
      return *space_;
    }
    /// By patch.
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &
    laws() const
    {
      return laws_;
    }
    /// By cell.
    const GradientsOfCells &
    gradients() const
    {
      return *gradients_;
    }
    unsigned int
    symmetry_weight(const unsigned int cell) const
    {
      return symmetry_weight_[cell];
    }
    /// Global unknowns of a cell, ordered by component as SolidKernel wants.
    const std::vector<unsigned int> &
    cell_unknowns(const unsigned int cell) const
    {
      return cell_unknowns_[cell];
    }
    unsigned int
    n_displacements() const
    {
      return 3 * space_->n_control_points();
    }

    /// The entries of u that belong to a cell, in the order of
    /// cell_unknowns().
    void
    cell_displacement(const unsigned int            cell,
                      const dealii::Vector<double> &u,
                      std::vector<double>          &w) const;

    /// Numbers of the cells' groups in a system, by cell; invalid if the cell
    /// has m_c = 0 or is another process's.
    using CellGroups = std::vector<unsigned int>;

    /**
     * Announce the cells to a system, before its pattern is built and again
     * after each ConstrainedSystem::reinit().
     *
     * @return What add_tangent() needs to find the cells in that system.
     */
    CellGroups
    add_groups(ConstrainedSystem &system) const;

    /**
     * Add the internal forces of all cells at u to a full residual, which the
     * processes get all.
     *
     * @return Their size before they cancel between cells,
     *   (sum_c m_c |f_c|^2)^(1/2) [N], against which the convergence of
     * Newton's method is measured.
     *
     * Throws InvertedCell with the cell and the name of its part.
     */
    double
    add_residual(const dealii::Vector<double> &u,
                 dealii::Vector<double>       &residual,
                 const NaturalState           &natural = {}) const;

    /**
     * Add the tangent at u of the cells of this process to a system.
     *
     * @param groups What add_groups() returned for this system.
     *
     * Throws InvertedCell as add_residual() does.
     */
    void
    add_tangent(const dealii::Vector<double> &u,
                const CellGroups             &groups,
                ConstrainedSystem            &system,
                const NaturalState           &natural = {}) const;

    /// Stiffness at rest times size^2 [N], the unit of forces of these bodies:
    /// what is 1e-14 of it is round-off.
    double
    force_unit() const
    {
      return force_unit_;
    }

    /// Of the bodies, images included [N mm].
    double
    stored_energy(const dealii::Vector<double> &u,
                  const NaturalState           &natural = {}) const;

    /// The natural state after a fraction of the stress at u has relaxed, see
    /// relaxed_inverse(); of all cells on all processes.
    NaturalState
    relax(const dealii::Vector<double> &u,
          const NaturalState           &natural,
          const double                  fraction) const;

    /// What for_each_point() shows of a quadrature point.
    struct MaterialPoint
    {
      unsigned int         cell;
      unsigned int         q;  ///< number of the point in the cell
      double               dV; ///< m_c JxW [mm^3]
      dealii::Tensor<2, 3> F;  ///< from the reference configuration
      dealii::Tensor<2, 3> P;  ///< [MPa], on the reference configuration
    };

    /// Visit the quadrature points of this process's cells with m_c > 0, in
    /// order, at the state u. Volume averages are sums over these points, and
    /// over the processes.
    void
    for_each_point(const dealii::Vector<double>                     &u,
                   const std::function<void(const MaterialPoint &)> &visit,
                   const NaturalState &natural = {}) const;

    /// Value at a quadrature point of a field given by its coefficients, one
    /// per control point.
    double
    interpolate(const MaterialPoint       &point,
                const std::vector<double> &coefficients) const;

    /**
     * Integrals of the functions, sum_c m_c int_c R_A dV [mm^3], which sum to
     * the volume.
     *
     * @param by_symmetry_weight False: every cell counts once.
     */
    std::vector<double>
    integrals_of_functions(const bool by_symmetry_weight) const;

    /// The point of the bodies that is nearest to losing ellipticity.
    struct Ellipticity
    {
      LowestAcousticEigenvalue<3> lowest; ///< elliptic if its value > 0
      unsigned int                patch = 0;
      dealii::Point<3>            position; ///< reference configuration [mm]
    };
    /// Search all quadrature points at the state u for the lowest eigenvalue
    /// of the acoustic tensor: 0.1 ms per point, a few seconds per state of the
    /// default cell.
    Ellipticity
    lowest_acoustic_eigenvalue(const dealii::Vector<double> &u,
                               const NaturalState &natural = {}) const;
    /// The same if there is a point without ellipticity, else nothing; some
    /// microseconds per point, because most obey is_surely_elliptic().
    std::optional<Ellipticity>
    loss_of_ellipticity(const dealii::Vector<double> &u,
                        const NaturalState           &natural = {}) const;
    /// "bundle 2 at (0.1, 0.2, 0.3): ..." for messages.
    std::string
    describe(const Ellipticity &ellipticity) const;

  private:
    void
    look_at_rest();
    // Of volume, in the reference configuration.
    dealii::Point<3>
    center(const unsigned int cell) const;
    using PointVisitor = std::function<
      void(const unsigned int cell, const unsigned int q, const double *F)>;
    void
    for_each_gradient(const dealii::Vector<double> &u,
                      const NaturalState           &natural,
                      const PointVisitor           &visit) const;
    // Of the reference configuration, or of the natural state in scratch.
    const CellGradients &
    cell_from(const NaturalState &natural,
              const unsigned int  cell,
              CellGradients      &scratch) const;
    Ellipticity
    search_ellipticity(const dealii::Vector<double> &u,
                       const NaturalState           &natural,
                       const bool                    losses_only) const;
    // Throws InvertedCell on all processes if one of them found such a cell;
    // invalid_unsigned_int: none here.
    void
    report_inverted_cell(const unsigned int cell) const;

    bool
    is_mine(const dealii::Triangulation<3>::active_cell_iterator &cell) const;

    Ranks                                            ranks_;
    std::unique_ptr<IGASpace<3>>                     space_;
    std::vector<std::unique_ptr<HyperelasticLaw<3>>> laws_;  // by patch
    std::vector<std::string>                         names_; // by patch
    std::unique_ptr<GradientsOfCells>                gradients_;
    std::vector<unsigned int>                        symmetry_weight_;
    std::vector<unsigned int>              first_point_; // of a cell, among all
    std::vector<std::vector<unsigned int>> cell_unknowns_;
    std::vector<double> shear_moduli_; // smallest at rest, by patch
    double              force_unit_ = 0;
  };
} // namespace NPT

#endif
