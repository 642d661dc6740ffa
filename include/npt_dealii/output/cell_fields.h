// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the step from the state of a cell to the fields of a VTU file.

#ifndef npt_dealii_output_cell_fields_h
#define npt_dealii_output_cell_fields_h

#include <npt_dealii/contact/contact_assembler.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/material/solid_kernel.h>
#include <npt_dealii/output/field_writer.h>

#include <deal.II/lac/vector.h>

#include <memory>
#include <vector>

namespace NPT
{
  /**
   * Bundles in the current configuration as Bezier cells, with displacement
   * [mm], Cauchy stress [MPa], von Mises stress [MPa], stretch of the fibers
   * sqrt(I4) [-] and the number of the bundle. Stresses live at Gauss points;
   * each control point gets the mean weighted with its function.
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
