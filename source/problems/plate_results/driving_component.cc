// SPDX-License-Identifier: LGPL-2.1-or-later
// The work of every mode.

#include <npt_dealii/problems/plate_results/driving_component.h>

#include <cmath>

namespace NPT
{
  double
  amount_of_work(const std::vector<CurveRow> &rows,
                 const std::size_t            first,
                 const std::size_t            last,
                 const unsigned int           k)
  {
    double work = 0;
    for (std::size_t i = first; i < last; ++i)
      work += 0.5 * (std::abs(rows[i].n[k]) + std::abs(rows[i + 1].n[k])) *
              std::abs(rows[i + 1].H[k] - rows[i].H[k]);
    return work;
  }



  std::optional<unsigned int>
  driving_component(const std::vector<CurveRow> &rows)
  {
    std::optional<unsigned int> driving, first;
    double                      most = 0;
    for (unsigned int k = 0; k < MacroModes::n && !rows.empty(); ++k)
      {
        const double work = amount_of_work(rows, 0, rows.size() - 1, k);
        if (work > most)
          {
            driving = k;
            most    = work;
          }
        for (std::size_t r = 1; r < rows.size() && !first; ++r)
          if (rows[r].H[k] != rows[r - 1].H[k])
            first = k;
      }
    return driving ? driving : first;
  }
} // namespace NPT
