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
  /**
   * Write one repeat of the deformed fabric as BASE.inp, BASE.msh, BASE.tg3.
   *
   * @param laws By bundle of the cell.
   * @param base Folder and name of the files without ending.
   * @param title What it is, one line.
   * @return One sentence per file: its name, what is in it, and for meshes
   *   their volume and smallest Jacobian.
   *
   * Throws InputError if a format cannot hold the repeat, OutputError if a file
   * cannot be written.
   */
  std::vector<std::string>
  export_cell(const DeformedCell                                     &deformed,
              const std::vector<std::unique_ptr<HyperelasticLaw<3>>> &laws,
              const ExportParameters &parameters,
              const std::string      &base,
              const std::string      &title);
} // namespace NPT

#endif
