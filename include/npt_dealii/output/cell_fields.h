// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the step from the state of a cell to the fields of a VTU file.

#ifndef npt_dealii_output_cell_fields_h
#define npt_dealii_output_cell_fields_h

#include <npt_dealii/contact/contact_assembler.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/material/solid_kernel.h>
#include <npt_dealii/output/field_writer.h>

#include <deal.II/lac/vector.h>

#include <array>
#include <memory>
#include <vector>

namespace NPT
{
  /// Cauchy stress (xx, yy, zz, xy, yz, xz), von Mises stress [MPa], J [-].
  constexpr unsigned int n_control_point_stresses = 8;
  /// Place of the von Mises stress among them.
  constexpr unsigned int von_mises_stress = 6;

  /**
   * Coefficients of the stress at the state u, one row per control point.
   * Stresses live at Gauss points; each control point gets the mean weighted
   * with its function,
   *
   * @f[ s_A = \int R_A s \, dV \Big/ \int R_A \, dV . @f]
   */
  std::vector<std::array<double, n_control_point_stresses>>
  stresses_at_control_points(
    const IGASpace<3>                                      &space,
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
    const std::vector<CellGradients>                       &gradients,
    const dealii::Vector<double>                           &u);

  /**
   * Bundles in the current configuration as Bezier cells, with displacement
   * [mm], Cauchy stress [MPa], von Mises stress [MPa], volume ratio J [-] and
   * the number of the bundle. Stresses are those of
   * stresses_at_control_points().
   */
  BezierMesh
  make_bundle_fields(
    const IGASpace<3>                                      &space,
    const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
    const std::vector<CellGradients>                       &gradients,
    const dealii::Vector<double>                           &u);

  /**
   * Secondary contact surface in the current configuration as Bezier
   * quadrilaterals with gap [mm], pressure (positive in compression) [MPa],
   * friction traction vector [MPa], slip increment [mm] and state (0 open, 1
   * sticking or frictionless contact, 2 slipping) of the contact nodes.
   */
  BezierMesh
  make_contact_fields(const IGASpace<3>            &space,
                      const unsigned int            patch,
                      const unsigned int            direction,
                      const unsigned int            side,
                      const ContactAssembler<3>    &contact,
                      const dealii::Vector<double> &u);
} // namespace NPT

#endif
