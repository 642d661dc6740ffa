// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cell kernel of a solid in total Lagrangian form: internal force
// and consistent stiffness from the gradients of the shape functions.

#ifndef npt_dealii_solid_solid_kernel_h
#define npt_dealii_solid_solid_kernel_h

#include <npt_dealii/material/hyperelastic_law.h>

#include <vector>

namespace NPT
{
  /**
   * Reference gradients of the functions of one cell. In a total Lagrangian
   * method they never change, so they are computed once.
   */
  struct CellGradients
  {
    /// Functions that the kernel treats at once.
    static constexpr unsigned int n_lanes = 4;

    unsigned int        n_functions = 0;
    unsigned int        n_points    = 0;
    unsigned int        stride      = 0; ///< n_functions and filling
    std::vector<double> gradients;       ///< [point][J][function or zero], 1/mm
    std::vector<double> values;          ///< [point][function]
    std::vector<double> jxw; ///< reference volume of the points, mm^3
    /// F without displacement, [point][iJ]; empty: 1. See NaturalState.
    std::vector<double> at_rest;

    /// Set the sizes, and the gradients to zero.
    void
    reinit(const unsigned int n_functions, const unsigned int n_points);
  };

  /**
   * Internal virtual work of a cell and its linearization,
   *
   * @f[ f_{iA} = \int P_{iJ} N_{A,J} \, dV, \qquad
   *     K_{iA,kB} = \int N_{A,J} A_{iJkL} N_{B,L} \, dV . @f]
   *
   * Local unknowns are ordered by component: position i * n_functions + A.
   * The stiffness is computed on and above the diagonal and mirrored (it is
   * symmetric for a hyperelastic law). The loops run over contiguous functions
   * and are compiled for several processors; the right version is taken at run
   * time.
   */
  class SolidKernel
  {
  public:
    /**
     * @param displacement Local unknowns w [mm].
     * @param force Receives (not adds) f [N].
     * @param stiffness Receives K, row major, or null for the force alone.
     *
     * Throws InvertedCell if det F <= 0 at a point.
     */
    void
    evaluate(const HyperelasticLaw<3>  &law,
             const CellGradients       &cell,
             const std::vector<double> &displacement,
             std::vector<double>       &force,
             std::vector<double>       *stiffness);

    /// Stored energy of the cell.
    double
    energy(const HyperelasticLaw<3>  &law,
           const CellGradients       &cell,
           const std::vector<double> &displacement);

    /// F at all points of the cell, each row major; valid until the next call.
    const double *
    deformation_gradients(const CellGradients       &cell,
                          const std::vector<double> &displacement);

  private:
    std::vector<double> padded_; // a vector of the cell in the stride
    std::vector<double> deformation_gradients_, stresses_, tangents_;
    std::vector<double> scratch_;
  };
} // namespace NPT

#endif
