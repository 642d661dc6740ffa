// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the cell of a laminate: plies of parallel fibers, stacked.

#ifndef npt_dealii_fabric_laminate_h
#define npt_dealii_fabric_laminate_h

#include <npt_dealii/fabric/cell_layout.h>
#include <npt_dealii/fabric/cell_parameters.h>

namespace NPT
{
  /// A rectangle with the spacings of the crossings as edges. Its plies are
  /// equally thick, from bottom to top, and one body; translations by the edges
  /// are its only operations.
  CellLayout
  make_laminate(const CellParameters &cell, const MeshParameters &mesh);
} // namespace NPT

#endif
