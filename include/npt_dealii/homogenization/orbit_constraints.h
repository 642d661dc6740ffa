// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns relations between unknowns that are affine in macro unknowns, and their
// reduction by orbits to AffineConstraints.

#ifndef npt_dealii_homogenization_orbit_constraints_h
#define npt_dealii_homogenization_orbit_constraints_h

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
    /// Coefficients of the macro unknowns.
    using Affine = std::vector<double>;

    /**
     * @param n_unknowns Unknowns 0 .. n_unknowns-1 may be related; the macro
     *   unknowns follow them directly.
     */
    OrbitConstraints(const unsigned int n_unknowns, const unsigned int n_macro);

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
           const Affine      &affine,
           const std::string &name);

    /// Write the lines of all orbits; does not close.
    void
    write(dealii::AffineConstraints<double> &constraints) const;

    /// Representative of an unknown: index, sign (+1 or -1), and affine part.
    struct Representation
    {
      unsigned int root;
      double       sign;
      Affine       affine;
    };
    Representation
    representation(const unsigned int i) const;

  private:
    const unsigned int                  n_macro_;
    mutable std::vector<Representation> parent_;
    std::vector<bool>                   fixed_;
    std::vector<Affine>                 value_;
  };

} // namespace NPT

#endif
