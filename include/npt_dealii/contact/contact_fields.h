// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the fields of a contact surface for a VTU file.

#ifndef npt_dealii_contact_contact_fields_h
#define npt_dealii_contact_contact_fields_h

#include <npt_dealii/contact/contact_pair.h>
#include <npt_dealii/iga/iga_space.h>
#include <npt_dealii/io/vtu_file.h>

#include <deal.II/lac/vector.h>

namespace NPT
{
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
                      const ContactPair<3>         &contact,
                      const ContactEvaluation<3>   &evaluation,
                      const dealii::Vector<double> &u);
} // namespace NPT

#endif
