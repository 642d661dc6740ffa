// SPDX-License-Identifier: LGPL-2.1-or-later
// Entries of the export.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_exports/export_parameters.h>

#include <algorithm>

namespace NPT
{
  template <>
  const EnumNames<ExportParameters::Format> &
  enum_names<ExportParameters::Format>()
  {
    using Format                         = ExportParameters::Format;
    static const EnumNames<Format> names = {{Format::none, "none"},
                                            {Format::abaqus, "abaqus"},
                                            {Format::gmsh, "gmsh"},
                                            {Format::texgen, "texgen"}};
    return names;
  }



  bool
  ExportParameters::has(const Format format) const
  {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
  }



  bool
  ExportParameters::is_wanted() const
  {
    return std::any_of(formats.begin(), formats.end(), [](const Format format) {
      return format != Format::none;
    });
  }



  bool
  ExportParameters::is_due(const std::string &stage, const bool is_last) const
  {
    if (!is_wanted())
      return false;
    if (after_stage == "last")
      return is_last;
    const auto names = split_list(after_stage);
    return std::find(names.begin(), names.end(), stage) != names.end();
  }



  void
  ExportParameters::check(const std::vector<std::string> &stages) const
  {
    if (is_wanted() && has(Format::none))
      throw InputError("Export names none beside a format; leave one of them "
                       "(subsection Output).");
    if (after_stage == "last")
      return;
    for (const std::string &name : split_list(after_stage))
      if (std::find(stages.begin(), stages.end(), name) == stages.end())
        {
          std::string list;
          for (const std::string &stage : stages)
            list += (list.empty() ? "" : ", ") + stage;
          throw InputError("Export after stage is '" + name +
                           "', which is neither last nor a stage of this file "
                           "(" +
                           list + ")" + did_you_mean(name, stages) +
                           " (subsection Output).");
        }
  }



  void
  ExportParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(
      prm,
      "Export",
      formats,
      "Files of one repeat of the deformed fabric for other programs, a list "
      "of abaqus (cell_STAGE.inp: hexahedra, orientations, sets, surfaces; "
      "CalculiX reads it), gmsh (.msh) and texgen (.tg3: paths and sections "
      "along the yarns); or none. The shape is exported, not the stress in "
      "it: relax the stress before (a stage of type relax) for a stress-free "
      "start.");
    add_parameter(prm,
                  "Export after stage",
                  after_stage,
                  "last, or a list of stages at whose ends the files are "
                  "written.");
    add_parameter(prm,
                  "Export degree",
                  degree,
                  "Of the exported elements: 2 (C3D20; 27 nodes in gmsh) "
                  "follows the curved bundles, 1 (C3D8; 8 nodes) is what "
                  "contact and explicit solvers like best [-].",
                  dealii::Patterns::Integer(1, 2));
    add_parameter(prm,
                  "Export subdivision",
                  subdivision,
                  "Exported elements per knot span and direction [-]; 3 or "
                  "more with degree 1, whose faces are flat.",
                  dealii::Patterns::Integer(1, 20));
  }
} // namespace NPT
