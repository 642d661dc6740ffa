// SPDX-License-Identifier: LGPL-2.1-or-later
// Reading test data.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/identification/material_curve.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace NPT
{
  using dealii::Tensor;

  namespace
  {
    // Numbers of another unit would be taken as if they were of this one.
    void
    check_unit(const Table                    &table,
               const std::string              &column,
               const std::vector<std::string> &units)
    {
      const std::string unit = table.unit(column);
      if (unit.empty() ||
          std::find(units.begin(), units.end(), unit) != units.end())
        return;
      throw InputError("The column " + column + " of the table " +
                       table.filename + " is in " + in_quotes(unit) +
                       "; it must be in " + units[0] +
                       ", convert its numbers.");
    }
  } // namespace



  std::vector<MaterialCurve>
  read_material_curves(const std::string &filename)
  {
    const Table                      table = read_table(filename);
    std::vector<std::vector<double>> H(9), P(9);
    std::array<bool, 9>              measured{};
    bool                             has_H = false, has_P = false;
    for (unsigned int e = 0; e < 9; ++e)
      {
        const std::string index =
          std::to_string(e / 3 + 1) + std::to_string(e % 3 + 1);
        if (table.has_column("H" + index))
          {
            check_unit(table, "H" + index, {"-", "1", "mm/mm"});
            H[e]  = table.column("H" + index);
            has_H = true;
          }
        else
          H[e].assign(table.n_rows(), 0.);
        if (table.has_column("P" + index))
          {
            check_unit(table, "P" + index, {"MPa", "N/mm^2", "N/mm2"});
            P[e]        = table.column("P" + index);
            measured[e] = true;
            has_P       = true;
          }
        else
          P[e].assign(table.n_rows(), 0.);
      }
    if (!has_H || !has_P)
      throw InputError("The table " + filename + " has no column " +
                       (has_H ? "of stresses P11 ... P33" :
                                "of displacement gradients H11 ... H33") +
                       "; test data need at least one of each kind.");
    if (table.n_rows() == 0)
      throw InputError("The table " + filename + " has no rows.");

    const std::string stem  = std::filesystem::path(filename).stem().string();
    const auto        names = table.has_column("test") ?
                                table.text_column("test") :
                                std::vector<std::string>(table.n_rows(), stem);

    std::vector<MaterialCurve> curves;
    for (unsigned int r = 0; r < table.n_rows(); ++r)
      {
        if (curves.empty() || curves.back().name != names[r])
          {
            curves.emplace_back();
            curves.back().name     = names[r];
            curves.back().measured = measured;
          }
        Tensor<2, 3> h, p;
        for (unsigned int e = 0; e < 9; ++e)
          {
            h[e / 3][e % 3] = H[e][r];
            p[e / 3][e % 3] = P[e][r];
            if (!std::isfinite(H[e][r]) || !std::isfinite(P[e][r]))
              throw InputError(filename + ", line " +
                               std::to_string(table.lines[r]) +
                               ": a component of H or P is not finite.");
          }
        if (!(determinant(dealii::unit_symmetric_tensor<3>() + h) > 0.))
          throw InputError(filename + ", line " +
                           std::to_string(table.lines[r]) +
                           ": the determinant of 1 + H is not positive.");
        curves.back().H.push_back(h);
        curves.back().P.push_back(p);
      }
    return curves;
  }
} // namespace NPT
