// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the test data of a material: curves of displacement gradients and
// stresses, and their file.

#ifndef npt_dealii_problems_identification_material_curve_h
#define npt_dealii_problems_identification_material_curve_h

#include <deal.II/base/tensor.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * A test of the bundle: displacement gradients H and first Piola-Kirchhoff
   * stresses P [MPa], fiber along direction 1. Components iJ are row major.
   */
  struct MaterialCurve
  {
    std::string                       name;
    std::vector<dealii::Tensor<2, 3>> H;
    std::vector<dealii::Tensor<2, 3>> P;

    /// Which stresses were measured; a test rig does not see all nine.
    std::array<bool, 9> measured{
      {true, true, true, true, true, true, true, true, true}};
  };

  /**
   * Read curves from a CSV file with a header: H11 ... H33 (missing columns:
   * zero), P11 ... P33 [MPa] (missing columns: not measured), and optionally
   * `test`, the name of the curve a row belongs to. Other columns are ignored.
   * Without `test` the file is one curve with the name of the file.
   *
   * Throws InputError if there is no H or no P column, or no row.
   */
  std::vector<MaterialCurve>
  read_material_curves(const std::string &filename);
} // namespace NPT

#endif
