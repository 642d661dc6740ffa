// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes as files of gmsh.

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/mesh_files/gmsh_file.h>

#include <algorithm>
#include <functional>
#include <ostream>

namespace NPT
{
  using dealii::Point;

  namespace
  {
    const std::array<const char *, 6> face_names = {
      {"begin", "end", "edge_1", "edge_2", "bottom", "top"}};

    // Lexicographic positions in gmsh's order: corners, edges, faces, center.
    std::vector<unsigned int>
    gmsh_order(const unsigned int degree)
    {
      if (degree == 1)
        return {0, 1, 3, 2, 4, 5, 7, 6};
      return {0,  2,  8,  6,  18, 20, 26, 24, 1,  3,  9,  5,  11, 7,
              17, 15, 19, 21, 23, 25, 4,  10, 12, 14, 16, 22, 13};
    }



    // The same of a face, and turned so that its normal points outward.
    std::vector<unsigned int>
    gmsh_order_of_face(const unsigned int degree, const bool turned)
    {
      std::vector<unsigned int> order = {0, 1, 3, 2};
      if (degree == 2)
        order = {0, 2, 8, 6, 1, 5, 7, 3, 4};
      if (!turned)
        return order;
      // Mirrored at the diagonal.
      const unsigned int n = degree + 1;
      for (unsigned int &a : order)
        a = a % n * n + a / n;
      return order;
    }



    unsigned int
    surface_number(const HexahedralMesh &mesh,
                   const unsigned int    body,
                   const unsigned int    face)
    {
      return mesh.bodies.size() + 6 * body + face + 1;
    }



    void
    write_physical_names(const HexahedralMesh &mesh, std::ostream &out)
    {
      out << "$PhysicalNames\n" << 7 * mesh.bodies.size() << "\n";
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        for (unsigned int f = 0; f < 6; ++f)
          out << "2 " << surface_number(mesh, b, f) << " \""
              << mesh.bodies[b].name << "_" << face_names[f] << "\"\n";
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        out << "3 " << b + 1 << " \"" << mesh.bodies[b].name << "\"\n";
      out << "$EndPhysicalNames\n";
    }



    // Nodes by body: gmsh and deal.II look for them in their entities.
    std::vector<std::vector<unsigned int>>
    nodes_of_bodies(const HexahedralMesh &mesh)
    {
      std::vector<std::vector<unsigned int>> nodes(mesh.bodies.size());
      std::vector<bool>                      seen(mesh.nodes.size(), false);
      for (const HexahedralMesh::Element &element : mesh.elements)
        for (const unsigned int node : element.nodes)
          if (!seen[node])
            {
              seen[node] = true;
              nodes[element.body].push_back(node);
            }
      return nodes;
    }



    std::string
    gmsh_point(const Point<3> &x)
    {
      return EntryValue<double>::text(x[0]) + ' ' +
             EntryValue<double>::text(x[1]) + ' ' +
             EntryValue<double>::text(x[2]);
    }



    // Boxes of nodes, physical numbers, surfaces of volumes.
    void
    write_entities(const HexahedralMesh                         &mesh,
                   const std::vector<std::vector<unsigned int>> &nodes,
                   std::ostream                                 &out)
    {
      std::vector<std::string> boxes;
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        {
          Point<3> low = mesh.nodes[nodes[b].at(0)], high = low;
          for (const unsigned int node : nodes[b])
            for (unsigned int c = 0; c < 3; ++c)
              {
                low[c]  = std::min(low[c], mesh.nodes[node][c]);
                high[c] = std::max(high[c], mesh.nodes[node][c]);
              }
          boxes.push_back(gmsh_point(low) + ' ' + gmsh_point(high));
        }
      out << "$Entities\n0 0 " << 6 * mesh.bodies.size() << ' '
          << mesh.bodies.size() << "\n";
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        for (unsigned int f = 0; f < 6; ++f)
          {
            const unsigned int number = surface_number(mesh, b, f);
            out << number << ' ' << boxes[b] << " 1 " << number << " 0\n";
          }
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        {
          out << b + 1 << ' ' << boxes[b] << " 1 " << b + 1 << " 6";
          for (unsigned int f = 0; f < 6; ++f)
            out << ' ' << surface_number(mesh, b, f);
          out << "\n";
        }
      out << "$EndEntities\n";
    }



    void
    write_gmsh_nodes(const HexahedralMesh                         &mesh,
                     const std::vector<std::vector<unsigned int>> &nodes,
                     std::ostream                                 &out)
    {
      std::size_t n = 0;
      for (const auto &of_body : nodes)
        n += of_body.size();
      out << "$Nodes\n"
          << mesh.bodies.size() << ' ' << n << " 1 " << mesh.nodes.size()
          << "\n";
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        {
          out << "3 " << b + 1 << " 0 " << nodes[b].size() << "\n";
          for (const unsigned int node : nodes[b])
            out << node + 1 << "\n";
          for (const unsigned int node : nodes[b])
            out << gmsh_point(mesh.nodes[node]) << "\n";
        }
      out << "$EndNodes\n";
    }



    // Elements of the bodies, then their faces; fields follow the same order.
    std::vector<std::vector<unsigned int>>
    elements_of_bodies(const HexahedralMesh &mesh)
    {
      std::vector<std::vector<unsigned int>> elements(mesh.bodies.size());
      for (unsigned int e = 0; e < mesh.elements.size(); ++e)
        elements[mesh.elements[e].body].push_back(e);
      return elements;
    }



    std::size_t
    n_faces(const HexahedralMesh &mesh)
    {
      std::size_t n = 0;
      for (const HexahedralMesh::Body &body : mesh.bodies)
        for (const auto &faces : body.faces)
          n += faces.size();
      return n;
    }



    void
    write_gmsh_elements(const HexahedralMesh &mesh, std::ostream &out)
    {
      const std::size_t n = mesh.elements.size() + n_faces(mesh);
      out << "$Elements\n"
          << 7 * mesh.bodies.size() << ' ' << n << " 1 " << n << "\n";
      std::size_t number   = 0;
      const auto  order    = gmsh_order(mesh.degree);
      const auto  elements = elements_of_bodies(mesh);
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        {
          out << "3 " << b + 1 << (mesh.degree == 1 ? " 5 " : " 12 ")
              << elements[b].size() << "\n";
          for (const unsigned int e : elements[b])
            {
              out << ++number;
              for (const unsigned int a : order)
                out << ' ' << mesh.elements[e].nodes[a] + 1;
              out << "\n";
            }
        }
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        for (unsigned int f = 0; f < 6; ++f)
          {
            const auto places = mesh.nodes_of_face(f / 2, f % 2);
            // The other two directions in order make a right-handed system
            // with the first and the last one, but not with the second.
            const auto face_order =
              gmsh_order_of_face(mesh.degree, (f % 2 == 0) != (f / 2 == 1));
            out << "2 " << surface_number(mesh, b, f)
                << (mesh.degree == 1 ? " 3 " : " 10 ")
                << mesh.bodies[b].faces[f].size() << "\n";
            for (const HexahedralMesh::Face &face : mesh.bodies[b].faces[f])
              {
                out << ++number;
                for (const unsigned int a : face_order)
                  out << ' '
                      << mesh.elements[face.element].nodes[places[a]] + 1;
                out << "\n";
              }
          }
      out << "$EndElements\n";
    }



    // The ends of the bodies, which are physical surfaces, in pairs.
    void
    write_gmsh_pairs(const HexahedralMesh &mesh, std::ostream &out)
    {
      std::vector<int> image(mesh.nodes.size(), -1);
      for (const HexahedralMesh::PeriodicPair &pair : mesh.periodic)
        if (pair.direction == 0)
          for (const auto &nodes : pair.nodes)
            image[nodes[1]] = nodes[0];
      out << "$Periodic\n" << mesh.bodies.size() << "\n";
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        {
          std::vector<bool>         seen(mesh.nodes.size(), false);
          std::vector<unsigned int> ends;
          for (const HexahedralMesh::Face &face : mesh.bodies[b].faces[1])
            for (const unsigned int a : mesh.nodes_of_face(0, 1))
              {
                const unsigned int node = mesh.elements[face.element].nodes[a];
                if (!seen[node] && image[node] >= 0)
                  ends.push_back(node);
                seen[node] = true;
              }
          out << "2 " << surface_number(mesh, b, 1) << ' '
              << surface_number(mesh, b, 0) << "\n0\n"
              << ends.size() << "\n";
          for (const unsigned int node : ends)
            out << node + 1 << ' ' << image[node] + 1 << "\n";
        }
      out << "$EndPeriodic\n";
    }



    // A field of all elements, volumes and faces, as meshio wants it; faces
    // have the values of their element.
    void
    write_element_field(
      const HexahedralMesh                                      &mesh,
      const std::string                                         &name,
      const unsigned int                                         n_components,
      const std::function<double(const HexahedralMesh::Element &element,
                                 const unsigned int component)> &value,
      std::ostream                                              &out)
    {
      out << "$ElementData\n1\n\"" << name << "\"\n1\n0\n3\n0\n"
          << n_components << "\n"
          << mesh.elements.size() + n_faces(mesh) << "\n";
      std::size_t number = 0;
      const auto  write  = [&](const HexahedralMesh::Element &element) {
        out << ++number;
        for (unsigned int c = 0; c < n_components; ++c)
          out << ' ' << EntryValue<double>::text(value(element, c));
        out << "\n";
      };
      for (const auto &of_body : elements_of_bodies(mesh))
        for (const unsigned int e : of_body)
          write(mesh.elements[e]);
      for (const HexahedralMesh::Body &body : mesh.bodies)
        for (const auto &faces : body.faces)
          for (const HexahedralMesh::Face &face : faces)
            write(mesh.elements[face.element]);
      out << "$EndElementData\n";
    }
  } // namespace



  void
  write_gmsh(const HexahedralMesh &mesh, std::ostream &out)
  {
    using Element = HexahedralMesh::Element;
    out << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
    write_physical_names(mesh, out);
    const auto nodes = nodes_of_bodies(mesh);
    write_entities(mesh, nodes, out);
    write_gmsh_nodes(mesh, nodes, out);
    write_gmsh_elements(mesh, out);
    write_gmsh_pairs(mesh, out);
    write_element_field(
      mesh,
      "fiber_direction",
      3,
      [](const Element &element, const unsigned int c) {
        return element.fiber[c];
      },
      out);
    write_element_field(
      mesh,
      "bundle",
      1,
      [](const Element &element, const unsigned int) {
        return element.body + 1.;
      },
      out);
  }
} // namespace NPT
