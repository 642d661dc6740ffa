// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines stability maps: how runs end over two swept entries.

#ifndef npt_dealii_problems_parameter_study_stability_map_h
#define npt_dealii_problems_parameter_study_stability_map_h

#include <npt_dealii/problems/plate_results/run_summary.h>

#include <string>
#include <vector>

namespace NPT
{
  /// An axis of a map; its values are drawn at equal distances.
  struct MapAxis
  {
    std::string              name;
    std::vector<std::string> values;
  };

  /// One case on the map.
  struct MapCell
  {
    unsigned int panel = 0, x = 0, y = 0; ///< numbers of panel and values
    std::string  folder;
    RunSummary   result;
  };

  /**
   * Write `map.csv` and draw three pictures over the same axes, one panel per
   * combination of the other swept entries:
   *
   * - `map_outcome`: done without cuts, done with cuts, or the reason of the
   *   failure as the program names it, each with its color; in the cell the
   *   percentage of the last stage that was reached, or the stage in which it
   *   ended before;
   * - `map_iterations`: Newton iterations per accepted step;
   * - `map_cuts`: failed steps.
   *
   * @param last_stage Stage whose end is success.
   * @return Warning of the plotting program, or empty.
   */
  std::string
  write_stability_map(const std::string              &directory,
                      const MapAxis                  &x_axis,
                      const MapAxis                  &y_axis,
                      const std::vector<std::string> &panels,
                      const std::vector<MapCell>     &cells,
                      const std::string              &last_stage,
                      const std::string              &title);
} // namespace NPT

#endif
