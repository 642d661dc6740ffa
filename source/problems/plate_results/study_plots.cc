// SPDX-License-Identifier: LGPL-2.1-or-later
// Lines and sizes of the pictures of studies.

#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/problems/plate_results/study_plots.h>

#include <vector>

namespace NPT
{
  std::string
  study_line_style(const unsigned int i)
  {
    static const std::vector<unsigned int> symbols = {
      7, 5, 9, 13, 11, 6, 4, 8, 12, 10};
    // The line changes when the colors begin anew.
    return "linecolor rgb '" + gnuplot_color(i) + "' linewidth 2 dashtype " +
           std::to_string(1 + (i / 8) % 4) + " pointtype " +
           std::to_string(symbols[i % symbols.size()]);
  }



  std::string
  draw_picture(const std::string                         &directory,
               const std::string                         &name,
               const std::string                         &title,
               const unsigned int                         n_rows,
               const unsigned int                         n_columns,
               const unsigned int                         panel_width,
               const unsigned int                         panel_height,
               const std::function<void(std::ostream &)> &write_panels)
  {
    GnuplotPicture picture;
    picture.name             = name;
    picture.title            = title;
    picture.n_rows           = n_rows;
    picture.n_columns        = n_columns;
    picture.width            = panel_width * n_columns;
    picture.height           = panel_height * n_rows + (title.empty() ? 0 : 30);
    picture.settings         = "set datafile missing 'nan'\nset border 3\n";
    const std::string script = directory + "/" + name + ".gp";
    write_gnuplot_script(script, picture, write_panels);
    return run_gnuplot(script);
  }
} // namespace NPT
