// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines meshes of hexahedra as other programs read them: nodes, elements with
// their fibers, bodies, faces, periodic pairs, materials.

#ifndef npt_dealii_mesh_files_hexahedral_mesh_h
#define npt_dealii_mesh_files_hexahedral_mesh_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  /// Constants of an orthotropic material: direction 1 along the fiber, 2
  /// across, 3 through the thickness. Moduli in MPa.
  struct OrthotropicConstants
  {
    std::array<double, 3> E;  ///< E_1, E_2, E_3
    std::array<double, 3> nu; ///< nu_12, nu_13, nu_23
    std::array<double, 3> G;  ///< G_12, G_13, G_23
  };

  /**
   * A mesh of hexahedra in space, of degree 1 or 2, a value.
   *
   * The nodes of an element are in lexicographic order, the first direction
   * fastest: 8 for degree 1, 27 for degree 2. Directions of a fiber bundle: 0
   * along, 1 across, 2 through the thickness.
   */
  struct HexahedralMesh
  {
    /// Which nodes of a quadratic element a program uses.
    enum class Nodes
    {
      all,        ///< 8 or 27
      serendipity ///< 8 or 20: none in faces and none inside
    };

    struct Element
    {
      unsigned int              body;
      std::vector<unsigned int> nodes;
      dealii::Tensor<1, 3>      fiber;  ///< unit vector at its center
      dealii::Tensor<1, 3>      across; ///< unit vector normal to the fiber
    };

    struct Face
    {
      unsigned int element;
      unsigned int direction; ///< normal to the face
      unsigned int side;      ///< 0 begin, 1 end of that direction
    };

    struct Body
    {
      std::string  name;
      unsigned int material;
      /// Faces by 2 direction + side.
      std::array<std::vector<Face>, 6> faces;
    };

    /// Nodes that are images of each other, pair by pair.
    struct PeriodicPair
    {
      std::string                              first, second; ///< names of sets
      unsigned int                             direction;     ///< of the bodies
      std::vector<std::array<unsigned int, 2>> nodes;
    };

    struct Material
    {
      std::string          name;
      OrthotropicConstants constants;
    };

    unsigned int                  degree = 2;
    std::vector<dealii::Point<3>> nodes; ///< [mm]
    std::vector<Element>          elements;
    std::vector<Body>             bodies;
    std::vector<PeriodicPair>     periodic;
    std::vector<Material>         materials;

    /// Lexicographic positions of the nodes of a face of any element.
    std::vector<unsigned int>
    nodes_of_face(const unsigned int direction, const unsigned int side) const;

    /// Whether a program that uses these nodes has this one, by node.
    std::vector<bool>
    used_nodes(const Nodes which) const;
  };

  /// What the elements of a mesh fill.
  struct MeshQuality
  {
    double volume = 0; ///< [mm^3]
    /// Smallest determinant of the map from the unit cube at Gauss points and
    /// corners, over the volume of its element [-]; negative where an element
    /// is folded.
    double smallest_jacobian = 0;
  };

  /**
   * Volume and Jacobians of the elements as another program sees them: with
   * Lagrange or serendipity functions through the nodes, four Gauss points per
   * direction.
   */
  MeshQuality
  quality_of(const HexahedralMesh &mesh, const HexahedralMesh::Nodes which);
} // namespace NPT

#endif
