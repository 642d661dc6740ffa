// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the gmsh file of a mesh.

#ifndef npt_dealii_mesh_files_gmsh_file_h
#define npt_dealii_mesh_files_gmsh_file_h

#include <npt_dealii/mesh_files/hexahedral_mesh.h>

#include <iosfwd>

namespace NPT
{
  /**
   * Write a mesh as a text file of gmsh (.msh, format 4.1, which gmsh, meshio
   * and deal.II read).
   *
   * Elements have 8 nodes (type 5) or 27 nodes (type 12), their faces 4 (type
   * 3) or 9 (type 10). Each body is a physical volume of its name; its faces
   * are physical surfaces NAME_begin, NAME_end, NAME_edge_1, NAME_edge_2,
   * NAME_bottom, NAME_top. Physical numbers: 1 and on for the volumes, then for
   * the surfaces. Fields of the elements: `fiber_direction`, unit vectors, and
   * `bundle`. `$Periodic` pairs the nodes of the ends of each body. deal.II
   * reads meshes of degree 1 only.
   */
  void
  write_gmsh(const HexahedralMesh &mesh, std::ostream &out);
} // namespace NPT

#endif
