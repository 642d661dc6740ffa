// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the Abaqus input file of a mesh, which CalculiX reads, too.

#ifndef npt_dealii_mesh_files_abaqus_file_h
#define npt_dealii_mesh_files_abaqus_file_h

#include <npt_dealii/mesh_files/hexahedral_mesh.h>

#include <iosfwd>
#include <string>

namespace NPT
{
  /**
   * Write a mesh as the model part of an Abaqus input file (.inp): no step, no
   * loads, to be included in a deck by `*INCLUDE, INPUT=cell_weave.inp`.
   *
   * Elements are C3D8 for degree 1 and C3D20 for degree 2. C3D20 and not C3D27,
   * because CalculiX has no C3D27, and Abaqus turns C3D20 into C3D27 by itself
   * where it is the secondary side of a contact pair. By element: ELSET of the
   * body (its name), its fiber direction (*DISTRIBUTION, *ORIENTATION FIBER:
   * local axis 1 along the fiber, 2 across). By body: *SOLID SECTION, sets of
   * the nodes at its ends (NAME_BEGIN, NAME_END), *SURFACE by elements
   * NAME_SURFACE, NAME_TOP, NAME_BOTTOM. Sets of periodic nodes, LEFT and RIGHT
   * or FRONT and BACK, with their pairs at equal places. Materials are
   * *ELASTIC, TYPE=ENGINEERING CONSTANTS. Lengths in mm, moduli in MPa.
   *
   * @param title Lines of text at the head of the file.
   */
  void
  write_abaqus(const HexahedralMesh &mesh,
               const std::string    &title,
               std::ostream         &out);
} // namespace NPT

#endif
