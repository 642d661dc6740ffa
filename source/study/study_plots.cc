// SPDX-License-Identifier: LGPL-2.1-or-later
// The frame of a study's gnuplot script.

#include <npt_dealii/output/plots.h>
#include <npt_dealii/output/replace_file.h>
#include <npt_dealii/study/study_plots.h>

#include <ostream>
#include <vector>

namespace NPT
{
  std::string
  gnuplot_text(const std::string &text)
  {
    std::string result = "'";
    for (const char c : text)
      result += (c == '\'' ? std::string("''") : std::string(1, c));
    return result + "'";
  }



  std::string
  study_color(const unsigned int i)
  {
    static const std::vector<std::string> colors = {"#0072b2",
                                                    "#d55e00",
                                                    "#009e73",
                                                    "#cc79a7",
                                                    "#e69f00",
                                                    "#56b4e9",
                                                    "#000000",
                                                    "#999999"};
    return colors[i % colors.size()];
  }



  std::string
  study_line_style(const unsigned int i)
  {
    static const std::vector<unsigned int> symbols = {
      7, 5, 9, 13, 11, 6, 4, 8, 12, 10};
    // The line changes when the colors begin anew.
    return "linecolor rgb '" + study_color(i) + "' linewidth 2 dashtype " +
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
    const unsigned int title_height = title.empty() ? 0 : 30;
    const std::string  size =
      std::to_string(panel_width * n_columns) + "," +
      std::to_string(panel_height * n_rows + title_height);
    const std::string script = directory + "/" + name + ".gp";
    replace_file(script, [&](std::ostream &out) {
      out << "# Draws " << name << ".svg and " << name
          << ".png. Change it and run `gnuplot` on it in this folder.\n"
          << "set datafile separator comma\n"
          << "set datafile columnheaders\n"
          << "set datafile missing 'nan'\n"
          << "set grid linecolor rgb '#dddddd' linetype 1 linewidth 1\n"
          << "set tics nomirror out\n"
          << "set border 3\n"
          << "do for [kind in 'svg pngcairo'] {\n"
          << "  if (strstrt(' '.GPVAL_TERMINALS.' ', ' '.kind.' ') == 0) { "
             "continue }\n"
          << "  if (kind eq 'svg') {\n"
          << "    set terminal svg size " << size
          << " font 'sans-serif,13' background 'white' dynamic\n"
          << "    set output " << gnuplot_text(name + ".svg") << "\n"
          << "  } else {\n"
          << "    set terminal pngcairo size " << size
          << " font 'sans-serif,11' background 'white'\n"
          << "    set output " << gnuplot_text(name + ".png") << "\n"
          << "  }\n"
          << "  set multiplot layout " << n_rows << "," << n_columns;
      if (!title.empty())
        out << " title " << gnuplot_text(title) << " noenhanced";
      out << "\n";
      write_panels(out);
      out << "  unset multiplot\n"
          << "  unset output\n"
          << "}\n";
    });
    return run_gnuplot(script);
  }
} // namespace NPT
