// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the mesh of hexahedra of one repeat of the fabric.

#ifndef npt_dealii_problems_plate_exports_cell_mesh_h
#define npt_dealii_problems_plate_exports_cell_mesh_h

#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/mesh_files/hexahedral_mesh.h>
#include <npt_dealii/problems/plate_exports/fabric_strand.h>

#include <memory>
#include <vector>

namespace NPT
{
  /**
   * Constants of linear elasticity of a law at F = 1, in the axes of a bundle.
   *
   * @param along Unit vector of the fibers.
   * @param through Unit vector through the thickness, normal to the fibers.
   *
   * Throws InputError if the stiffness cannot be inverted.
   */
  OrthotropicConstants
  orthotropic_constants(const HyperelasticLaw<3>   &law,
                        const dealii::Tensor<1, 3> &along,
                        const dealii::Tensor<1, 3> &through);

  /**
   * One repeat of the fabric as hexahedra: every knot span of every strand is
   * divided into subdivision^3 elements, whose nodes lie on the bundles. Every
   * strand is a body, and the strands share no nodes. Elements have the fiber
   * direction at their center.
   *
   * Periodic pairs are LEFT, RIGHT (the ends of the warp) and FRONT, BACK
   * (those of the weft), strand by strand; plies have both.
   *
   * @param degree 1 or 2.
   * @param subdivision >= 1.
   */
  HexahedralMesh
  make_cell_mesh(const std::vector<FabricStrand> &strands,
                 const unsigned int               degree,
                 const unsigned int               subdivision);

  /**
   * Give the bodies of a mesh their materials: one for the warp, one for the
   * weft, one for every ply.
   *
   * @param laws By bundle of the cell.
   */
  void
  add_materials(const FabricCell                                       &cell,
                const std::vector<FabricStrand>                        &strands,
                const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
                HexahedralMesh                                         &mesh);
} // namespace NPT

#endif
