// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the couplings of a cell: relations between control points under its
// symmetry operations, reduced by orbits to AffineConstraints.

#ifndef npt_dealii_homogenization_periodicity_h
#define npt_dealii_homogenization_periodicity_h

#include <npt_dealii/cell/fabric_cell.h>
#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/iga/iga_space.h>

#include <deal.II/lac/affine_constraints.h>

#include <string>
#include <vector>

namespace NPT
{
  /**
   * Relations x_i = s x_j + sum_m c_m M_m with s = +1 or -1 between unknowns,
   * affine in the macro unknowns M.
   *
   * Couplings overlap (glide, lattice, 2-fold axis, pins), and pairwise lines
   * would form chains and cycles, which AffineConstraints refuses or resolves
   * by order. So relations are collected first; every orbit is then reduced
   * once to a representative, or to a value affine in M if it closes with
   * s = -1, and one line per unknown is written.
   */
  class OrbitConstraints
  {
  public:
    using Affine = std::array<double, MacroUnknowns::n_macro>;

    explicit OrbitConstraints(const MacroUnknowns &macro);

    /**
     * Add x_i = sign * x_j + affine.
     *
     * Throws std::logic_error with the name if the relation contradicts
     * earlier ones, i.e. if it would force a combination of macro unknowns to
     * vanish.
     */
    void
    relate(const unsigned int i,
           const double       sign,
           const unsigned int j,
           const Affine &     affine,
           const std::string &name);

    /// Write the lines of all orbits; does not close.
    void
    write(dealii::AffineConstraints<double> &constraints) const;

    /// Representative of an unknown: index, sign, and affine part. Sign 0
    /// means that the unknown is fixed to its affine part.
    struct Representation
    {
      unsigned int root;
      double       sign;
      Affine       affine;
    };
    Representation
    representation(const unsigned int i) const;

  private:
    MacroUnknowns                       macro_;
    mutable std::vector<Representation> parent_;
    std::vector<bool>                   fixed_;
    std::vector<Affine>                 value_;
  };

  /// Which couplings hold in a stage.
  struct CouplingOptions
  {
    /// Weaving: the middle of the end faces is moved to the mid-plane.
    bool hold_end_middles = false;
  };

  /**
   * All couplings of a fabric cell: symmetry operations, the weaving
   * condition, pins where rigid motions would remain.
   *
   * @param height Z3 of each control point used in the jumps of bending and
   *   torsion [mm]; empty: the reference one.
   * @return Closed constraints over macro.n_unknowns() unknowns.
   */
  dealii::AffineConstraints<double>
  make_couplings(const FabricCell &        cell,
                 const IGASpace<3> &       space,
                 const MacroUnknowns &     macro,
                 const CouplingOptions &   options,
                 const std::vector<double> &height = {});

  /// Displacement of straight bundles held apart by `offset` [mm].
  dealii::Vector<double>
  straight_bundles(const FabricCell &   cell,
                   const IGASpace<3> &  space,
                   const MacroUnknowns &macro,
                   const double         offset);
} // namespace NPT

#endif
