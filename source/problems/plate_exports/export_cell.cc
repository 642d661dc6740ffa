// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of the deformed cell for other programs.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/mesh_files/abaqus_file.h>
#include <npt_dealii/mesh_files/gmsh_file.h>
#include <npt_dealii/problems/plate_exports/cell_mesh.h>
#include <npt_dealii/problems/plate_exports/export_cell.h>
#include <npt_dealii/problems/plate_exports/yarn_sections.h>

namespace NPT
{
  namespace
  {
    // The last part of a path.
    std::string
    name_of_file(const std::string &path)
    {
      return path.substr(path.find_last_of('/') + 1);
    }



    std::string
    describe_mesh(const HexahedralMesh       &mesh,
                  const HexahedralMesh::Nodes which,
                  const std::string          &path)
    {
      const MeshQuality quality = quality_of(mesh, which);
      return name_of_file(path) + ": " + std::to_string(mesh.elements.size()) +
             " hexahedra in " + std::to_string(mesh.bodies.size()) +
             " bundles, " + short_number(quality.volume, 6) +
             " mm^3; smallest Jacobian " +
             short_number(quality.smallest_jacobian, 2) +
             " of the volume of its element" +
             (quality.smallest_jacobian > 0. ?
                "." :
                ". An element is folded; what to try: a larger Export "
                "subdivision (subsection Output).");
    }
  } // namespace



  std::vector<std::string>
  export_cell(const DeformedCell                                     &deformed,
              const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
              const ExportParameters &parameters,
              const std::string      &base,
              const std::string      &title)
  {
    const auto               strands = FabricStrand::of_repeat(deformed);
    std::vector<std::string> report;
    if (parameters.has(ExportParameters::Format::abaqus) ||
        parameters.has(ExportParameters::Format::gmsh))
      {
        HexahedralMesh mesh =
          make_cell_mesh(strands, parameters.degree, parameters.subdivision);
        add_materials(deformed.cell, strands, laws, mesh);
        if (parameters.has(ExportParameters::Format::abaqus))
          {
            replace_file(base + ".inp", [&](std::ostream &out) {
              write_abaqus(mesh, title, out);
            });
            report.push_back(describe_mesh(mesh,
                                           HexahedralMesh::Nodes::serendipity,
                                           base + ".inp"));
          }
        if (parameters.has(ExportParameters::Format::gmsh))
          {
            replace_file(base + ".msh",
                         [&](std::ostream &out) { write_gmsh(mesh, out); });
            report.push_back(
              describe_mesh(mesh, HexahedralMesh::Nodes::all, base + ".msh"));
          }
      }
    if (parameters.has(ExportParameters::Format::texgen))
      {
        const WovenTextile textile =
          make_woven_textile(strands, name_of_file(base));
        replace_file(base + ".tg3",
                     [&](std::ostream &out) { write_texgen(textile, out); });
        report.push_back(name_of_file(base + ".tg3") + ": " +
                         std::to_string(textile.yarns.size()) +
                         " yarns with sections at their nodes.");
      }
    return report;
  }
} // namespace NPT
