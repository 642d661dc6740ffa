// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the export of a deformed cell to other programs.

#ifndef npt_dealii_problems_plate_exports_export_cell_h
#define npt_dealii_problems_plate_exports_export_cell_h

#include <npt_dealii/material/hyperelastic_law.h>
#include <npt_dealii/problems/plate_exports/export_parameters.h>
#include <npt_dealii/problems/plate_exports/fabric_strand.h>

#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /// What became of an export, one sentence per file.
  struct ExportReport
  {
    /// Name and contents of a file; for meshes volume and smallest Jacobian.
    std::vector<std::string> written;
    /// Why a format cannot hold this repeat.
    std::vector<std::string> refused;
  };

  /**
   * Write one repeat of the deformed fabric as BASE.inp, BASE.msh, BASE.tg3.
   *
   * @param laws By bundle of the cell.
   * @param base Folder and name of the files without ending.
   * @param title What it is, one line.
   *
   * Throws OutputError if a file cannot be written.
   */
  ExportReport
  export_cell(const DeformedCell                                     &deformed,
              const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
              const ExportParameters &parameters,
              const std::string      &base,
              const std::string      &title);
} // namespace NPT

#endif
