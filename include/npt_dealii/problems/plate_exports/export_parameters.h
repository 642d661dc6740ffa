// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the entries of a parameter file for the export to other programs.

#ifndef npt_dealii_problems_plate_exports_export_parameters_h
#define npt_dealii_problems_plate_exports_export_parameters_h

#include <npt_dealii/base/parameter_binding.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace NPT
{
  /// Entries "Export..." of subsection "Output".
  struct ExportParameters
  {
    enum class Format
    {
      none,
      abaqus, ///< .inp, CalculiX reads it, too
      gmsh,   ///< .msh
      texgen  ///< .tg3
    };

    std::vector<Format> formats     = {Format::none};
    std::string         after_stage = "last"; ///< "last", or names of stages
    unsigned int        degree      = 2;      ///< of the elements
    unsigned int        subdivision = 1;      ///< of knot spans

    bool
    has(const Format format) const;
    /// Whether there is any format but none.
    bool
    is_wanted() const;
    /// Whether a stage is one of those of the entry.
    bool
    is_due(const std::string &stage, const bool is_last) const;

    /// Throws InputError for a stage that does not exist and for `none` beside
    /// a format.
    void
    check(const std::vector<std::string> &stages) const;

    /// Bind the members to entries of the present subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<ExportParameters::Format> &
  enum_names<ExportParameters::Format>();
} // namespace NPT

#endif
