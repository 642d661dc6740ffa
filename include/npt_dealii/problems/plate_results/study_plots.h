// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the pictures of all studies have in common: panels of one size,
// colors and symbols of curves.

#ifndef npt_dealii_problems_plate_results_study_plots_h
#define npt_dealii_problems_plate_results_study_plots_h

#include <npt_dealii/io/gnuplot.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace NPT
{
  /// Options of gnuplot for curve i: color, symbol, line.
  std::string
  study_line_style(const unsigned int i);

  /**
   * Write the script NAME.gp in a folder and run it: draws NAME.svg and
   * NAME.png.
   *
   * @param n_rows, n_columns Panels of the picture.
   * @param panel_width, panel_height [pixels].
   * @param write_panels      Writes the gnuplot commands between `set
   *   multiplot` and `unset multiplot`.
   * @return Empty, or a warning of one line.
   */
  std::string
  draw_picture(const std::string                         &directory,
               const std::string                         &name,
               const std::string                         &title,
               const unsigned int                         n_rows,
               const unsigned int                         n_columns,
               const unsigned int                         panel_width,
               const unsigned int                         panel_height,
               const std::function<void(std::ostream &)> &write_panels);
} // namespace NPT

#endif
