// SPDX-License-Identifier: LGPL-2.1-or-later
// Table and pictures of stability maps.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/stability_map.h>
#include <npt_dealii/problems/plate_results/study_plots.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <ostream>

namespace NPT
{
  namespace
  {
    const std::string all_done       = "done, no cuts";
    const std::string done_with_cuts = "done, with cuts";

    std::string
    outcome(const RunSummary &result)
    {
      if (result.status == "done")
        return result.cuts == 0 ? all_done : done_with_cuts;
      return result.reason;
    }

    // Success is blue, failures have the warm colors.
    std::string
    outcome_color(const std::string &name)
    {
      // Reasons have the same color in all maps.
      static const std::map<std::string, std::string> colors = {
        {all_done, "#9ecae1"},
        {done_with_cuts, "#3182bd"},
        {"iteration limit", "#fdae6b"},
        {"line search failed", "#d55e00"},
        {"loss of ellipticity", "#cc79a7"},
        {"active set cycling", "#f0e442"},
        {"inverted cell", "#a50f15"},
        {"projection lost", "#8c6d31"},
        {"augmentation limit", "#74c476"},
        {"diverged", "#7570b3"},
        {"stagnated", "#e6ab02"},
        {"time limit", "#636363"}};
      const auto known = colors.find(name);
      return known == colors.end() ? "#000000" : known->second;
    }

    std::string
    cell_text(const RunSummary &result, const std::string &last_stage)
    {
      if (result.status == "done")
        return "";
      if (result.stage.empty())
        return "start";
      if (result.stage != last_stage)
        return result.stage;
      return short_number(std::floor(100 * result.load_factor + 1e-9)) + "%";
    }

    void
    write_axes(std::ostream &out, const MapAxis &x_axis, const MapAxis &y_axis)
    {
      const auto tics = [](const MapAxis &axis) {
        std::string text = "(";
        for (std::size_t i = 0; i < axis.values.size(); ++i)
          text += (i == 0 ? "" : ", ") + gnuplot_text(axis.values[i]) + " " +
                  std::to_string(i);
        return text + ")";
      };
      out << "  unset grid; set border 15; set tics scale 0\n"
          << "  set xrange [-0.5:" << x_axis.values.size() - 0.5 << "]\n"
          << "  set yrange [-0.5:" << y_axis.values.size() - 0.5 << "]\n"
          << "  set xtics " << tics(x_axis) << "\n"
          << "  set ytics " << tics(y_axis) << "\n"
          << "  set xlabel " << gnuplot_text(x_axis.name) << " noenhanced\n"
          << "  set ylabel " << gnuplot_text(y_axis.name) << " noenhanced\n"
          << "  set style fill solid border rgb 'white'\n";
    }


    // The table of a map and its three pictures.
    class StabilityMap
    {
    public:
      StabilityMap(const MapAxis                  &x_axis,
                   const MapAxis                  &y_axis,
                   const std::vector<std::string> &panels,
                   const std::vector<MapCell>     &cells)
        : x_axis_(x_axis)
        , y_axis_(y_axis)
        , panels_(panels)
        , cells_(cells)
        , outcomes_({all_done, done_with_cuts})
        , n_columns_(panels.size() <= 3 ? panels.size() :
                     panels.size() == 4 ? 2 :
                                          4)
        , n_rows_((panels.size() + n_columns_ - 1) / n_columns_)
        , height_(170 + 40 * y_axis.values.size())
      {
        for (const MapCell &cell : cells)
          if (number_of(outcome(cell.result)) == outcomes_.size())
            outcomes_.push_back(outcome(cell.result));
        std::size_t longest_title = 0;
        for (const std::string &panel : panels)
          longest_title = std::max(longest_title, panel.size());
        width_ = std::max<std::size_t>(
          {400, 150 + 62 * x_axis.values.size(), 40 + 8 * longest_title});
      }

      void
      write_table(const std::string &filename,
                  const std::string &last_stage) const
      {
        TableWriter table(
          filename,
          {"panel",
           "x",
           "y",
           "color",
           "iterations_per_step",
           "cuts",
           "text",
           "load_factor",
           "newton_iterations",
           "cpu_seconds",
           "stage",
           "outcome",
           "panel_name",
           x_axis_.name,
           y_axis_.name,
           "case"},
          {"One row per cell of the maps; panel, x, y and color "
           "are the numbers by which they are drawn. Failed "
           "cases have no iterations and cuts here."});
        for (const MapCell &cell : cells_)
          {
            const RunSummary &r    = cell.result;
            const std::string text = cell_text(r, last_stage);
            table.add_row({cell.panel,
                           cell.x,
                           cell.y,
                           number_of(outcome(r)),
                           iterations_per_step(r),
                           cuts(r),
                           text.empty() ? std::string(" ") : text,
                           r.load_factor,
                           r.newton_iterations,
                           r.cpu_seconds,
                           r.stage,
                           outcome(r),
                           panels_[cell.panel],
                           x_axis_.values[cell.x],
                           y_axis_.values[cell.y],
                           cell.folder});
          }
      }

      // How the cases ended, by color.
      std::string
      draw_outcomes(const std::string &directory,
                    const std::string &title) const
      {
        return draw_picture(directory,
                            "map_outcome",
                            title,
                            n_rows_,
                            n_columns_,
                            width_,
                            outcome_panel_height(),
                            [&](std::ostream &out) {
                              write_axes(out, x_axis_, y_axis_);
                              // One legend under all panels, drawn with the
                              // last.
                              out << "  set bmargin " << 4 + n_legend_rows()
                                  << "\n  unset key\n";
                              for (unsigned int p = 0; p < panels_.size(); ++p)
                                {
                                  if (p + 1 == panels_.size())
                                    write_legend(out);
                                  write_outcome_panel(out, p);
                                }
                              // The next terminal draws the same panels again.
                              out << "  unset object\n  unset label\n";
                            });
      }

      std::string
      draw_iterations(const std::string &directory,
                      const std::string &title) const
      {
        return draw_numbers(directory,
                            title,
                            "map_iterations",
                            "iterations_per_step",
                            "Newton iterations per step",
                            most(iterations_per_step));
      }

      std::string
      draw_cuts(const std::string &directory, const std::string &title) const
      {
        return draw_numbers(
          directory, title, "map_cuts", "cuts", "failed steps", most(cuts));
      }

    private:
      static constexpr unsigned int legend_row = 20; // pixels
      static constexpr const char  *box =
        ":(column('x')-0.5):(column('x')+0.5):(column('y')"
        "-0.5):(column('y')+0.5)";

      static double
      iterations_per_step(const RunSummary &r)
      {
        return r.status == "done" && r.steps > 0 ?
                 static_cast<double>(r.newton_iterations) / r.steps :
                 std::numeric_limits<double>::quiet_NaN();
      }

      static double
      cuts(const RunSummary &r)
      {
        return r.status == "done" ? static_cast<double>(r.cuts) :
                                    std::numeric_limits<double>::quiet_NaN();
      }

      // The largest number on the map, at least one.
      double
      most(double (*number)(const RunSummary &)) const
      {
        double result = 1;
        for (const MapCell &cell : cells_)
          result = std::max(result, number(cell.result));
        return result;
      }

      unsigned int
      number_of(const std::string &name) const
      {
        return std::find(outcomes_.begin(), outcomes_.end(), name) -
               outcomes_.begin();
      }

      unsigned int
      n_legend_columns() const
      {
        return std::max(1u, n_columns_ * width_ / 190);
      }

      unsigned int
      n_legend_rows() const
      {
        return (outcomes_.size() + n_legend_columns() - 1) / n_legend_columns();
      }

      unsigned int
      outcome_panel_height() const
      {
        return height_ + legend_row * n_legend_rows();
      }

      static std::string
      in_panel(const unsigned int p)
      {
        return "(column('panel') == " + std::to_string(p) +
               " ? column('x') : NaN)";
      }

      void
      write_legend(std::ostream &out) const
      {
        for (unsigned int o = 0; o < outcomes_.size(); ++o)
          {
            const double x =
              (o % n_legend_columns() + 0.1) / n_legend_columns();
            const double y = (n_legend_rows() - o / n_legend_columns() - 0.4) *
                             legend_row /
                             (n_rows_ * outcome_panel_height() + 30.);
            out << "  set object rectangle center screen " << x << ", screen "
                << y
                << " size screen 0.012, screen 0.016 fillstyle solid "
                   "noborder fillcolor rgb '"
                << outcome_color(outcomes_[o]) << "'\n  set label "
                << gnuplot_text(outcomes_[o]) << " at screen " << x + 0.012
                << ", screen " << y << " noenhanced\n";
          }
      }

      void
      write_outcome_panel(std::ostream &out, const unsigned int p) const
      {
        out << "  set title " << gnuplot_text(panels_[p]) << " noenhanced\n"
            << "  plot ";
        for (unsigned int o = 0; o < outcomes_.size(); ++o)
          out << "'map.csv' using (column('panel') == " << p
              << " && column('color') == " << o
              << " ? column('x') : NaN):(column('y'))" << box
              << " with boxxyerror linecolor rgb '"
              << outcome_color(outcomes_[o]) << "' notitle, \\\n    ";
        out << "'map.csv' using " << in_panel(p)
            << ":(column('y')):(strcol('text')) with labels font ',9' "
               "noenhanced notitle\n";
      }

      // A number in every cell, and its color; failed cases are gray.
      std::string
      draw_numbers(const std::string &directory,
                   const std::string &title,
                   const std::string &name,
                   const std::string &column,
                   const std::string &meaning,
                   const double       largest) const
      {
        return draw_picture(
          directory,
          name,
          title,
          n_rows_,
          n_columns_,
          width_ + 60,
          height_,
          [&](std::ostream &out) {
            write_axes(out, x_axis_, y_axis_);
            out << "  unset key\n"
                << "  set palette defined (0 '#f7fbff', 0.4 '#9ecae1', 0.7 "
                   "'#3182bd', 1 '#08306b')\n"
                << "  set cbrange [0:" << largest << "]\n  set cblabel "
                << gnuplot_text(meaning) << "\n";
            for (unsigned int p = 0; p < panels_.size(); ++p)
              out << "  set title " << gnuplot_text(panels_[p])
                  << " noenhanced\n  plot 'map.csv' using (column('panel') == "
                  << p
                  << " && column('color') > 1 ? column('x') : NaN):(column("
                  << "'y'))" << box
                  << " with boxxyerror linecolor rgb '#d9d9d9', \\\n    "
                     "'map.csv' using (column('panel') == "
                  << p
                  << " && column('color') < 2 ? column('x') : NaN):(column("
                  << "'y'))" << box << ":(column('" << column
                  << "')) with boxxyerror linecolor palette, \\\n    'map.csv' "
                     "using "
                  << in_panel(p) << ":(column('y')):(column('color') < 2 ? "
                  << "sprintf('%.3g', column('" << column
                  << "')) : 'failed'):(column('" << column << "') > "
                  << 0.6 * largest
                  << " ? 0xffffff : 0x000000) with labels font ',9' textcolor "
                     "rgb variable\n";
          });
      }

      const MapAxis                  &x_axis_, &y_axis_;
      const std::vector<std::string> &panels_;
      const std::vector<MapCell>     &cells_;
      std::vector<std::string>        outcomes_;
      const unsigned int              n_columns_, n_rows_;
      unsigned int                    width_ = 0; // of a panel [pixels]
      const unsigned int              height_;
    };
  } // namespace



  std::string
  write_stability_map(const std::string              &directory,
                      const MapAxis                  &x_axis,
                      const MapAxis                  &y_axis,
                      const std::vector<std::string> &panels,
                      const std::vector<MapCell>     &cells,
                      const std::string              &last_stage,
                      const std::string              &title)
  {
    const StabilityMap map(x_axis, y_axis, panels, cells);
    map.write_table(directory + "/map.csv", last_stage);
    std::string warning;
    for (const std::string &message : {map.draw_outcomes(directory, title),
                                       map.draw_iterations(directory, title),
                                       map.draw_cuts(directory, title)})
      if (warning.empty())
        warning = message;
    return warning;
  }
} // namespace NPT
