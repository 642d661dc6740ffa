// SPDX-License-Identifier: LGPL-2.1-or-later
// Macroscopic modes under the symmetry of a cell.

#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/homogenization/cell_modes.h>

#include <deal.II/base/exceptions.h>

namespace NPT
{
  using dealii::Point;
  using dealii::Tensor;

  Tensor<1, 3>
  macroscopic_displacement(const unsigned int n, const Point<3> &Y)
  {
    AssertIndexRange(n, MacroModes::n);
    return MacroModes::table[n].displacement(Y);
  }



  Tensor<1, 3>
  macroscopic_jump(const unsigned int       n,
                   const SymmetryOperation &g,
                   const Point<3>          &Y)
  {
    const Tensor<1, 3> here = macroscopic_displacement(n, Y);
    Tensor<1, 3>       jump = macroscopic_displacement(n, g(Y));
    for (unsigned int i = 0; i < 3; ++i)
      jump[i] -= g.Q[i] * here[i];
    return jump;
  }



  bool
  keeps_mode(const SymmetryOperation &g, const unsigned int n)
  {
    AssertIndexRange(n, MacroModes::n);
    double sign = 1.;
    for (unsigned int d = 0; d < 3; ++d)
      if (MacroModes::table[n].odd[d])
        sign *= g.Q[d];
    return sign > 0;
  }



  bool
  represents_mode(const FabricCell &cell, const unsigned int n)
  {
    return obstacle(cell, n).empty();
  }



  std::vector<unsigned int>
  represented_modes(const FabricCell &cell)
  {
    std::vector<unsigned int> modes;
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      if (represents_mode(cell, n))
        modes.push_back(n);
    return modes;
  }



  std::string
  obstacle(const FabricCell &cell, const unsigned int n)
  {
    for (const SymmetryOperation &operation : cell.operations())
      if (!keeps_mode(operation, n))
        return operation.name;
    return "";
  }



  double
  length_unit(const CellParameters &cell)
  {
    return 0.2 * cell.crossing_spacing.smaller();
  }



  double
  displacement_unit(const CellParameters &cell, const unsigned int n)
  {
    const double length = length_unit(cell);
    return MacroModes::table[n].kind == MacroMode::Kind::membrane ?
             length :
             length * length;
  }



  std::pair<std::string, std::string>
  smallest_cell_type(const CellParameters            &cell,
                     const std::vector<unsigned int> &modes)
  {
    const WeavePattern weave(cell.weave);
    const std::string  by_translations =
      weave.is_plain() ? "two-crossing cell" : "primitive cell";
    if (!weave.has_glide())
      return {by_translations,
              "because no glide plane exchanges over and under in this weave"};
    const auto glide = SymmetryOperation::glide_plane("", Tensor<1, 3>());
    for (const unsigned int n : modes)
      if (!keeps_mode(glide, n))
        return {by_translations,
                std::string("because ") + MacroModes::table[n].name + " or " +
                  MacroModes::table[n].conjugate +
                  " is prescribed, which glide planes forbid"};
    std::vector<unsigned int> kept;
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      if (keeps_mode(glide, n))
        kept.push_back(n);
    return {"sub-unit cell",
            "because only modes among " + MacroModes::list_of_names(kept) +
              " are prescribed, which glide planes allow"};
  }
} // namespace NPT
