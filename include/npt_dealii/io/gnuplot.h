// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what all pictures have in common: quoting, colors, the frame of the
// gnuplot script, and calling gnuplot.

#ifndef npt_dealii_io_gnuplot_h
#define npt_dealii_io_gnuplot_h

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace NPT
{
  /// Text in gnuplot's single quotes, which take all but the quote literally.
  std::string
  gnuplot_text(const std::string &text);

  /// Color i of eight that color-blind readers can tell apart (Okabe, Ito);
  /// more begin anew.
  std::string
  gnuplot_color(const unsigned int i);

  /// A picture of panels in rows and columns.
  struct GnuplotPicture
  {
    std::string  name;       ///< the files NAME.svg and NAME.png
    unsigned int width  = 0; ///< of the whole picture [pixels]
    unsigned int height = 0; ///< [pixels]
    unsigned int n_rows = 1, n_columns = 1;
    std::string  title;    ///< above all panels, may be empty
    std::string  settings; ///< commands before the panels, one per line
  };

  /**
   * Write a gnuplot script that draws a picture as SVG and, if gnuplot can, as
   * PNG, beside the script. Data files are tables as TableWriter writes them.
   *
   * @param write_panels Writes the commands between `set multiplot` and `unset
   *   multiplot`; they are run once for each of the two files.
   */
  void
  write_gnuplot_script(const std::string                         &script,
                       const GnuplotPicture                      &picture,
                       const std::function<void(std::ostream &)> &write_panels);

  /// Seconds that gnuplot may take. The pictures of a plate test of 76,490
  /// unknowns took it a few; one that waits for ever would keep the run.
  constexpr double gnuplot_patience = 120;

  /**
   * Run gnuplot on a script in the script's folder, or once on several scripts
   * of one folder, which saves half of the time of a simple picture.
   *
   * @param patience Seconds after which gnuplot, and what it has started, is
   *   ended.
   * @return Empty if all went well, else a warning of one line: without
   *   gnuplot a run has its numbers and only lacks the picture.
   *
   * Throws OutputError for a picture that is not complete, because gnuplot does
   * not tell of a full disk; what there is of the picture is removed.
   */
  std::string
  run_gnuplot(const std::string &script,
              const double       patience = gnuplot_patience);
  std::string
  run_gnuplot(const std::string              &folder,
              const std::vector<std::string> &scripts,
              const double                    patience = gnuplot_patience);
} // namespace NPT

#endif
