// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a cell of several layers of the same fabric.

#ifndef npt_dealii_fabric_layers_h
#define npt_dealii_fabric_layers_h

#include <npt_dealii/fabric/cell_layout.h>
#include <npt_dealii/fabric/cell_parameters.h>

#include <vector>

namespace NPT
{
  /**
   * Put copies of a woven cell on each other, CellParameters::n_layers in all.
   * Layer k is moved by k times the layer shift in plane and by k times three
   * thicknesses along Y3, so that layers are apart while they are woven. All
   * have the translations of the cell. The tops of a layer may touch the
   * bottoms of the next one, with their images as far as a spacing away.
   *
   * @param layer The cell, without glide planes and 2-fold axis.
   * @param translations Of the weave, the identity among them.
   */
  CellLayout
  stack_layers(const CellLayout                     &layer,
               const CellParameters                 &cell,
               const std::vector<SymmetryOperation> &translations);
} // namespace NPT

#endif
