// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines relations between unknowns that are affine in macro unknowns, and
// their reduction by orbits to AffineConstraints.

#ifndef npt_dealii_homogenization_orbit_constraints_h
#define npt_dealii_homogenization_orbit_constraints_h

#include <deal.II/lac/affine_constraints.h>

#include <map>
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
   *
   * Conditions x_i = sum_k f_k x_{j_k} + sum_m c_m M_m with several unknowns
   * on the right (a smooth closure) come on top: each eliminates the
   * representative of one orbit.
   */
  class OrbitConstraints
  {
  public:
    /// Coefficients of the macro unknowns.
    using Affine = std::vector<double>;

    /**
     * @param n_unknowns Unknowns 0 .. n_unknowns-1 may be related; the macro
     *   unknowns follow them directly.
     * @param unit Of the coefficients of each macro unknown, in their
     *   dimension: contradictions and round-off are told by 1e-9 and 1e-14 of
     *   it.
     */
    OrbitConstraints(const unsigned int n_unknowns, const Affine &unit);

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

    /// One unknown on the right of a combination.
    struct Term
    {
      double       factor;
      unsigned int j;
    };

    /**
     * Add x_i = sum_k factor_k x_{j_k} + affine.
     *
     * The images of such a condition under the relations are conditions too,
     * so it may be told once per orbit or for every member: the first one
     * eliminates the orbit of i, the others must follow from it; write()
     * checks that they do.
     */
    void
    combine(const unsigned int       i,
            const std::vector<Term> &terms,
            const Affine            &affine,
            const std::string       &name);

    /**
     * Write the lines of all orbits, in terms of free unknowns and macro
     * unknowns only; does not close.
     *
     * Throws std::logic_error with the name of a combination that contradicts
     * the rest: if its unknown is reached again from its right side, or if it
     * would restrict unknowns on its right because its left side is fixed or
     * eliminated already.
     */
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
    // A linear form of free representatives and macro unknowns.
    struct Form
    {
      std::map<unsigned int, double> free;
      Affine                         affine;
    };
    struct Combination
    {
      unsigned int      i;
      std::vector<Term> terms;
      Affine            affine;
      std::string       name;
    };
    // Representatives that combinations have been reduced to so far, and those
    // that are being reduced.
    struct Reduction
    {
      std::map<unsigned int, unsigned int> combination_of; // root -> number
      std::map<unsigned int, Form>         done;
      std::map<unsigned int, bool>         begun;
    };
    Form
    reduced_root(const unsigned int root, Reduction &reduction) const;
    Form
    reduced(const unsigned int i, Reduction &reduction) const;
    Form
    right_side(const Combination &combination, Reduction &reduction) const;

    const unsigned int                  n_macro_;
    const Affine                        unit_;
    mutable std::vector<Representation> parent_;
    std::vector<bool>                   fixed_;
    std::vector<Affine>                 value_;
    std::vector<Combination>            combinations_;
  };

} // namespace NPT

#endif
