// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the cell and mesh entries of the parameter file.

#ifndef npt_dealii_cell_cell_parameters_h
#define npt_dealii_cell_cell_parameters_h

#include <npt_dealii/iga/iga_space.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "Cell": geometry of the weave.
  struct CellParameters
  {
    double              crossing_spacing = 5.0; ///< Lbar [mm]
    double              bundle_width     = 4.0; ///< w [mm]
    double              bundle_thickness = 1.2; ///< t [mm]
    double              blunt_tip        = 0.1; ///< e / t [-]
    double              weaving_depth    = 1.0; ///< [-]
    std::string         type             = "sub-unit cell";
    std::string         weave         = "plain"; ///< name or over/under table
    bool                two_fold_axis = true;
    bool                images        = true;
    std::vector<double> plies         = {0.}; ///< laminate: angles [degrees]

    static void
    declare_parameters(dealii::ParameterHandler &prm);
    /// Throws InputError for impossible combinations.
    void
    parse_parameters(dealii::ParameterHandler &prm);
  };

  /// Subsection "Mesh": discretization of each bundle.
  struct MeshParameters
  {
    Basis        basis            = Basis::NURBS;
    unsigned int degree           = 2;
    unsigned int elements_along   = 9;
    unsigned int elements_across  = 9;
    unsigned int elements_through = 2;

    static void
    declare_parameters(dealii::ParameterHandler &prm);
    void
    parse_parameters(dealii::ParameterHandler &prm);
  };
} // namespace NPT

#endif
