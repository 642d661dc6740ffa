// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the pictures of a run: which columns of curves.csv are drawn against
// which.

#ifndef npt_dealii_problems_plate_results_plots_h
#define npt_dealii_problems_plate_results_plots_h

#include <npt_dealii/problems/plate_results/stage_starts.h>

#include <map>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * One panel of a picture. Columns are named as in curves.csv; labels left
   * empty are made from the names and units of the columns.
   */
  struct PlotSpec
  {
    std::string              title;
    std::string              x_column;
    std::vector<std::string> y_columns;
    std::string              x_label;
    std::string              y_label;

    /// Drawn against the right-hand axis; may be empty.
    std::vector<std::string> y2_columns;
    std::string              y2_label;

    /// Only the rows of these stages; empty for the whole run.
    std::vector<std::string> stages;

    /// Distance of the tics of the abscissa; 0 leaves it to gnuplot.
    double x_tics = 0.;
  };

  /// What a stage is drawn by, where it is not a mode and its conjugate.
  struct StageAxes
  {
    std::string              x_column;
    std::vector<std::string> y_columns;
  };

  /// By the name of the stage.
  using AxesOfStages = std::map<std::string, StageAxes>;

  /// Name and unit of a column in gnuplot's enhanced text, "shear H_3 [-]".
  std::string
  column_label(const std::string &column);

  /**
   * Choose two panels per stage (stages that follow each other and drive the
   * same component share theirs, so that a cycle shows as a loop): the driving
   * component against its conjugate, and what happens meanwhile: sticking and
   * sliding contact points with the dissipation, or without contact the normal
   * resultants of the extensions. A stage in which no H changes is drawn over
   * its load factor. Stages with fewer than two rows are left out. Those with
   * axes of their own have these.
   */
  std::vector<PlotSpec>
  default_plots(const std::vector<CurveRow> &rows,
                const AxesOfStages          &axes   = {},
                const StageStarts           &starts = {});

  /**
   * Write a gnuplot script that reads @p curve_file and writes
   * @p picture.svg and, if gnuplot can, @p picture.png, all beside the script.
   * Throws InputError if a column does not exist.
   */
  void
  write_plot_script(const std::string           &script,
                    const std::string           &curve_file,
                    const std::string           &picture,
                    const std::vector<PlotSpec> &plots);

  /**
   * Write curves.gp, which draws the curves.csv of an output folder with the
   * panels of default_plots(), into that folder.
   *
   * @return false, and no file, if no stage has two load steps.
   */
  bool
  write_curves_script(const std::string  &folder,
                      const AxesOfStages &axes   = {},
                      const StageStarts  &starts = {});
} // namespace NPT

#endif
