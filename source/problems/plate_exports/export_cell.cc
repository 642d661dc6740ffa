// SPDX-License-Identifier: LGPL-2.1-or-later
// Files of the deformed cell for other programs.

#include <npt_dealii/base/exceptions.h>
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



    void
    export_meshes(const DeformedCell              &cell,
                  const std::vector<FabricStrand> &strands,
                  const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
                  const ExportParameters   &parameters,
                  const std::string        &base,
                  const std::string        &title,
                  std::vector<std::string> &written)
    {
      using Format = ExportParameters::Format;
      using Nodes  = HexahedralMesh::Nodes;
      HexahedralMesh mesh =
        make_cell_mesh(strands, parameters.degree, parameters.subdivision);
      if (parameters.has(Format::abaqus))
        {
          add_materials(cell.cell, strands, laws, mesh);
          replace_file(base + ".inp", [&](std::ostream &out) {
            write_abaqus(mesh, title, out);
          });
          written.push_back(
            describe_mesh(mesh, Nodes::serendipity, base + ".inp"));
        }
      if (parameters.has(Format::gmsh))
        {
          replace_file(base + ".msh",
                       [&](std::ostream &out) { write_gmsh(mesh, out); });
          written.push_back(describe_mesh(mesh, Nodes::all, base + ".msh"));
        }
    }



    void
    export_yarns(const std::vector<FabricStrand> &strands,
                 const std::string               &base,
                 std::vector<std::string>        &written)
    {
      const WovenTextile textile =
        make_woven_textile(strands, name_of_file(base));
      replace_file(base + ".tg3",
                   [&](std::ostream &out) { write_texgen(textile, out); });
      written.push_back(name_of_file(base + ".tg3") + ": " +
                        std::to_string(textile.yarns.size()) +
                        " yarns with sections at their nodes.");
    }
  } // namespace



  ExportReport
  export_cell(const DeformedCell                                     &deformed,
              const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
              const ExportParameters &parameters,
              const std::string      &base,
              const std::string      &title)
  {
    using Format         = ExportParameters::Format;
    const auto   strands = FabricStrand::of_repeat(deformed);
    ExportReport report;
    // What one format cannot hold is no reason to leave out another one.
    const auto attempt = [&](const auto &write) {
      try
        {
          write();
        }
      catch (const InputError &obstacle)
        {
          report.refused.push_back(obstacle.what());
        }
    };
    if (parameters.has(Format::abaqus) || parameters.has(Format::gmsh))
      attempt([&]() {
        export_meshes(
          deformed, strands, laws, parameters, base, title, report.written);
      });
    if (parameters.has(Format::texgen))
      attempt([&]() { export_yarns(strands, base, report.written); });
    return report;
  }
} // namespace NPT
