// SPDX-License-Identifier: LGPL-2.1-or-later
// Meshes as Abaqus input files.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/mesh_files/abaqus_file.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <set>
#include <sstream>

namespace NPT
{
  namespace
  {
    // CalculiX reads 20 characters.
    std::string
    abaqus_number(const double value)
    {
      return short_number(value, 12);
    }



    // Names of sets do not depend on case.
    std::string
    upper(std::string name)
    {
      std::transform(name.begin(), name.end(), name.begin(), [](const char c) {
        return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
      });
      return name;
    }



    // Lexicographic positions in the order of C3D8 and C3D20: corners of the
    // bottom and of the top, edges of both, edges between them.
    std::vector<unsigned int>
    abaqus_order(const unsigned int degree)
    {
      if (degree == 1)
        return {0, 1, 3, 2, 4, 5, 7, 6};
      return {0, 2, 8,  6,  18, 20, 26, 24, 1,  5,
              7, 3, 19, 23, 25, 21, 9,  11, 17, 15};
    }



    // S1 to S6 by 2 direction + side.
    unsigned int
    abaqus_face(const HexahedralMesh::Face &face)
    {
      static const std::array<unsigned int, 6> faces = {{6, 4, 3, 5, 1, 2}};
      return faces[2 * face.direction + face.side];
    }



    void
    write_numbers(const std::vector<unsigned int> &numbers, std::ostream &out)
    {
      const unsigned int per_line = 12; // Abaqus: at most 16
      for (std::size_t k = 0; k < numbers.size(); ++k)
        out << numbers[k]
            << (k + 1 == numbers.size() || (k + 1) % per_line == 0 ? "\n" :
                                                                     ", ");
    }



    void
    write_abaqus_nodes(const HexahedralMesh    &mesh,
                       const std::vector<bool> &used,
                       std::ostream            &out)
    {
      out << "*NODE, NSET=ALL_NODES\n";
      for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
        if (used[i])
          {
            out << i + 1;
            for (unsigned int c = 0; c < 3; ++c)
              out << ", " << abaqus_number(mesh.nodes[i][c]);
            out << "\n";
          }
    }



    void
    write_abaqus_elements(const HexahedralMesh &mesh, std::ostream &out)
    {
      const auto order = abaqus_order(mesh.degree);
      for (unsigned int b = 0; b < mesh.bodies.size(); ++b)
        {
          out << "*ELEMENT, TYPE=" << (mesh.degree == 1 ? "C3D8" : "C3D20")
              << ", ELSET=" << upper(mesh.bodies[b].name) << "\n";
          for (std::size_t e = 0; e < mesh.elements.size(); ++e)
            if (mesh.elements[e].body == b)
              {
                // At most 16 numbers in a line; a comma goes on.
                out << e + 1;
                for (std::size_t k = 0; k < order.size(); ++k)
                  out << (k == 10 ? ",\n" : ", ")
                      << mesh.elements[e].nodes[order[k]] + 1;
                out << "\n";
              }
        }
      out << "*ELSET, ELSET=ALL_ELEMENTS\n";
      for (const HexahedralMesh::Body &body : mesh.bodies)
        out << upper(body.name) << "\n";
    }



    // Nodes at the ends of a body along its fibers.
    void
    write_end_sets(const HexahedralMesh    &mesh,
                   const std::vector<bool> &used,
                   std::ostream            &out)
    {
      for (const HexahedralMesh::Body &body : mesh.bodies)
        for (const unsigned int side : {0u, 1u})
          {
            std::set<unsigned int> nodes;
            for (const HexahedralMesh::Face &face : body.faces[side])
              for (const unsigned int a : mesh.nodes_of_face(0, side))
                {
                  const unsigned int node =
                    mesh.elements[face.element].nodes[a];
                  if (used[node])
                    nodes.insert(node + 1);
                }
            out << "*NSET, NSET=" << upper(body.name)
                << (side == 0 ? "_BEGIN" : "_END") << "\n";
            write_numbers({nodes.begin(), nodes.end()}, out);
          }
    }



    void
    write_periodic_sets(const HexahedralMesh    &mesh,
                        const std::vector<bool> &used,
                        std::ostream            &out)
    {
      for (const HexahedralMesh::PeriodicPair &pair : mesh.periodic)
        for (const unsigned int k : {0u, 1u})
          {
            std::vector<unsigned int> nodes;
            for (const auto &nodes_of_pair : pair.nodes)
              if (used[nodes_of_pair[k]])
                nodes.push_back(nodes_of_pair[k] + 1);
            out << "** Node k of " << upper(pair.first)
                << " is the image of node k of " << upper(pair.second)
                << ".\n*NSET, NSET=" << upper(k == 0 ? pair.first : pair.second)
                << ", UNSORTED\n";
            write_numbers(nodes, out);
          }
    }



    void
    write_abaqus_surface(const std::string                       &name,
                         const std::vector<HexahedralMesh::Face> &faces,
                         std::ostream                            &out)
    {
      out << "*SURFACE, NAME=" << upper(name) << ", TYPE=ELEMENT\n";
      for (const HexahedralMesh::Face &face : faces)
        out << face.element + 1 << ", S" << abaqus_face(face) << "\n";
    }



    void
    write_surfaces_of_bodies(const HexahedralMesh &mesh, std::ostream &out)
    {
      for (const HexahedralMesh::Body &body : mesh.bodies)
        {
          std::vector<HexahedralMesh::Face> all;
          for (unsigned int k = 2; k < 6; ++k)
            all.insert(all.end(), body.faces[k].begin(), body.faces[k].end());
          write_abaqus_surface(body.name + "_surface", all, out);
          write_abaqus_surface(body.name + "_bottom", body.faces[4], out);
          write_abaqus_surface(body.name + "_top", body.faces[5], out);
        }
    }



    void
    write_orientations(const HexahedralMesh &mesh, std::ostream &out)
    {
      out << "** By element: points on the local axes 1 (fiber) and 2 "
             "(across).\n"
             "** Abaqus wants the table, CalculiX warns of it and goes on.\n"
             "*DISTRIBUTION TABLE, NAME=FIBER_TABLE\nCOORD3D, COORD3D\n"
             "*DISTRIBUTION, NAME=FIBERS, LOCATION=ELEMENT, "
             "TABLE=FIBER_TABLE\n"
             ", 1., 0., 0., 0., 1., 0.\n";
      for (std::size_t e = 0; e < mesh.elements.size(); ++e)
        {
          out << e + 1;
          for (const auto &axis :
               {mesh.elements[e].fiber, mesh.elements[e].across})
            for (unsigned int c = 0; c < 3; ++c)
              out << ", " << abaqus_number(axis[c]);
          out << "\n";
        }
      out << "*ORIENTATION, NAME=FIBER, SYSTEM=RECTANGULAR\nFIBERS\n";
    }



    void
    write_materials(const HexahedralMesh &mesh, std::ostream &out)
    {
      for (const HexahedralMesh::Material &material : mesh.materials)
        {
          const OrthotropicConstants &c = material.constants;
          out << "** Stiffness of the law of the bundle at F = 1.\n"
              << "*MATERIAL, NAME=" << upper(material.name) << "\n"
              << "*ELASTIC, TYPE=ENGINEERING CONSTANTS\n";
          for (const double value :
               {c.E[0], c.E[1], c.E[2], c.nu[0], c.nu[1], c.nu[2], c.G[0]})
            out << abaqus_number(value) << ", ";
          out << abaqus_number(c.G[1]) << ",\n"
              << abaqus_number(c.G[2]) << "\n";
        }
      for (const HexahedralMesh::Body &body : mesh.bodies)
        out << "*SOLID SECTION, ELSET=" << upper(body.name)
            << ", ORIENTATION=FIBER, MATERIAL="
            << upper(mesh.materials[body.material].name) << "\n";
    }
  } // namespace



  void
  write_abaqus(const HexahedralMesh &mesh,
               const std::string    &title,
               std::ostream         &out)
  {
    std::istringstream lines(title);
    out << "*HEADING\nnpt_dealii: lengths in mm, moduli in MPa\n";
    for (std::string line; std::getline(lines, line);)
      out << "** " << line << "\n";
    const std::vector<bool> used =
      mesh.used_nodes(HexahedralMesh::Nodes::serendipity);
    write_abaqus_nodes(mesh, used, out);
    write_abaqus_elements(mesh, out);
    write_end_sets(mesh, used, out);
    write_periodic_sets(mesh, used, out);
    write_surfaces_of_bodies(mesh, out);
    write_orientations(mesh, out);
    write_materials(mesh, out);
  }
} // namespace NPT
