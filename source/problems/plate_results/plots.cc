// SPDX-License-Identifier: LGPL-2.1-or-later
// The choice of panels, and the script that draws them.

#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/problems/plate_results/driving_component.h>
#include <npt_dealii/problems/plate_results/plots.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ostream>

namespace NPT
{
  namespace
  {
    // What a column means, without its unit.
    std::string
    column_name(const std::string &column)
    {
      if (const unsigned int k = MacroModes::number_of(column);
          k < MacroModes::n)
        return (MacroModes::is_conjugate(column) ?
                  "" :
                  std::string(MacroModes::table[k].meaning) + " ") +
               column.substr(0, 1) + "_" + column.substr(1);
      if (column.size() == 3 && (column[0] == 'N' || column[0] == 'M'))
        return column.substr(0, 1) + "_{" + column.substr(1) + "}";
      if (column == "n_active")
        return "active points";
      if (column == "n_stick")
        return "sticking";
      if (column == "n_slip")
        return "sliding";
      if (column == "cpu_seconds")
        return "cpu time";

      std::string words = column;
      for (char &c : words)
        if (c == '_')
          c = ' ';
      return words;
    }

    // Several columns on one axis: their names, and the unit if it is common.
    std::string
    axis_label(const std::string              &given,
               const std::vector<std::string> &columns)
    {
      if (!given.empty() || columns.empty())
        return given;
      if (columns.size() == 1)
        return column_label(columns[0]);

      std::string names, unit = curve_column_unit(columns[0]);
      for (const std::string &column : columns)
        {
          names += (names.empty() ? "" : ", ") + column_name(column);
          if (curve_column_unit(column) != unit)
            unit.clear();
        }
      return names + (unit.empty() ? "" : " [" + unit + "]");
    }

    double
    range_of(const std::vector<CurveRow> &rows, const std::string &column)
    {
      double lowest = 0., highest = 0.;
      for (std::size_t r = 0; r < rows.size(); ++r)
        {
          const double value = curve_value(rows[r], column);
          lowest             = (r == 0 ? value : std::min(lowest, value));
          highest            = (r == 0 ? value : std::max(highest, value));
        }
      return highest - lowest;
    }

    // 1, 2 or 5 times a power of ten, about five in the range.
    double
    distance_of_tics(const double range)
    {
      if (!(range > 0.))
        return 0.;
      const double power = std::pow(10., std::floor(std::log10(range / 5.)));
      for (const double factor : {1., 2., 5.})
        if (factor * power >= range / 6.)
          return factor * power;
      return 10. * power;
    }

    void
    write_panel(std::ostream &out, const PlotSpec &plot)
    {
      curve_column_unit(plot.x_column); // throws if there is no such column

      out << "\n  set title " << gnuplot_text(plot.title) << " noenhanced\n"
          << "  set xlabel "
          << gnuplot_text(axis_label(plot.x_label, {plot.x_column}))
          << "\n  set ylabel "
          << gnuplot_text(axis_label(plot.y_label, plot.y_columns)) << '\n';
      if (plot.x_tics > 0.)
        out << "  set xtics " << plot.x_tics << '\n';
      else
        out << "  set xtics autofreq\n";
      if (plot.y2_columns.empty())
        out << "  set border 3; unset y2tics; unset y2label; set ytics "
               "nomirror\n";
      else
        out << "  set border 11; set y2tics; set ytics nomirror\n"
            << "  set y2label "
            << gnuplot_text(axis_label(plot.y2_label, plot.y2_columns)) << '\n';

      // A single curve needs no legend: the axis names it.
      const bool   legend = plot.y_columns.size() + plot.y2_columns.size() > 1;
      unsigned int style  = 1;
      const char  *separator = "  plot \\\n";
      const auto   draw = [&](const std::string &column, const bool second) {
        curve_column_unit(column);
        std::string condition;
        for (const std::string &stage : plot.stages)
          condition += (condition.empty() ? "" : " || ") +
                       ("strcol('stage') eq " + gnuplot_text(stage));
        // Of the abscissa as well: its range is that of all its numbers.
        const auto values_of = [&](const std::string &name) {
          return condition.empty() ?
                     "(column('" + name + "'))" :
                     "(" + condition + " ? column('" + name + "') : NaN)";
        };
        out << separator << "    curves using " << values_of(plot.x_column)
            << ':' << values_of(column) << (second ? " axes x1y2" : "")
            << " with linespoints linestyle " << style++
            << (legend ? " title " + gnuplot_text(column_name(column) +
                                                  (second ? " (right)" : "")) :
                           std::string(" notitle"));
        separator = ", \\\n";
      };
      for (const std::string &column : plot.y_columns)
        draw(column, false);
      for (const std::string &column : plot.y2_columns)
        draw(column, true);
      out << '\n';
    }
  } // namespace



  std::string
  column_label(const std::string &column)
  {
    return column_name(column) + " [" + curve_column_unit(column) + "]";
  }



  namespace
  {
    // Stages with their driving component; neighbors with the same one join.
    struct StageGroup
    {
      std::vector<std::string>    stages;
      std::vector<CurveRow>       rows;
      std::optional<unsigned int> component;
      const StageAxes            *axes;

      // Whether a stage that is driven so goes on in the same panel.
      bool
      is_continued_by(const std::optional<unsigned int> &other,
                      const StageAxes                   *other_axes) const
      {
        if (axes == nullptr || other_axes == nullptr)
          return axes == other_axes && other && component == other;
        return axes->x_column == other_axes->x_column &&
               axes->y_columns == other_axes->y_columns;
      }
    };

    std::vector<StageGroup>
    group_stages(const std::vector<CurveRow> &rows,
                 const AxesOfStages          &axes,
                 const StageStarts           &starts)
    {
      std::vector<StageGroup> groups;
      for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end)
        {
          while (end < rows.size() && rows[end].stage == rows[begin].stage)
            ++end;
          const std::vector<CurveRow> stage(rows.begin() + begin,
                                            rows.begin() + end);
          if (stage.size() < 2)
            continue;
          const auto             component = driving_component(stage);
          const auto             own       = axes.find(stage[0].stage);
          const StageAxes *const stage_axes =
            own == axes.end() ? nullptr : &own->second;
          if (groups.empty() || starts.count(stage[0].stage) > 0 ||
              !groups.back().is_continued_by(component, stage_axes))
            groups.push_back({{}, {}, component, stage_axes});
          groups.back().stages.push_back(stage[0].stage);
          groups.back().rows.insert(groups.back().rows.end(),
                                    stage.begin(),
                                    stage.end());
        }
      return groups;
    }



    PlotSpec
    response_panel(const StageGroup &group)
    {
      PlotSpec panel;
      panel.stages = group.stages;
      for (const std::string &name : group.stages)
        panel.title += (panel.title.empty() ? "" : ", ") + name;
      if (group.axes != nullptr)
        {
          panel.x_column  = group.axes->x_column;
          panel.y_columns = group.axes->y_columns;
        }
      else if (group.component)
        {
          const MacroMode &mode = MacroModes::table[*group.component];
          panel.x_column        = mode.name;
          panel.y_columns       = {mode.conjugate};
        }
      else
        {
          panel.x_column  = "load_factor";
          panel.y_columns = {"stored_energy"};
        }
      panel.x_tics = distance_of_tics(range_of(group.rows, panel.x_column));
      return panel;
    }



    // What happens meanwhile, over the same abscissa.
    PlotSpec
    companion_panel(const StageGroup &group, const PlotSpec &response)
    {
      PlotSpec panel = response;
      panel.y_columns.clear();
      bool contact = false, friction = false;
      for (const CurveRow &row : group.rows)
        {
          contact  = contact || row.n_active > 0;
          friction = friction || row.n_stick + row.n_slip > 0;
        }
      if (contact)
        {
          panel.title += ": contact";
          if (friction)
            panel.y_columns = {"n_stick", "n_slip"};
          else
            panel.y_columns = {"n_active"};
          panel.y_label = "contact points";
          // Less growth could not be read beside the dissipation before.
          if (range_of(group.rows, "dissipation") >
              1e-3 * curve_value(group.rows.back(), "dissipation"))
            panel.y2_columns = {"dissipation"};
        }
      else
        {
          panel.title += ": normal resultants";
          for (const MacroMode &mode : MacroModes::table)
            if (mode.is_extension())
              panel.y_columns.push_back(mode.conjugate);
        }
      return panel;
    }
  } // namespace



  std::vector<PlotSpec>
  default_plots(const std::vector<CurveRow> &rows,
                const AxesOfStages          &axes,
                const StageStarts           &starts)
  {
    std::vector<PlotSpec> plots;
    for (const StageGroup &group : group_stages(rows, axes, starts))
      {
        const PlotSpec response = response_panel(group);
        plots.push_back(response);
        plots.push_back(companion_panel(group, response));
      }
    return plots;
  }



  void
  write_plot_script(const std::string           &script,
                    const std::string           &curve_file,
                    const std::string           &picture,
                    const std::vector<PlotSpec> &plots)
  {
    GnuplotPicture frame;
    frame.name      = picture;
    frame.n_columns = plots.size() > 1 ? 2 : 1;
    frame.n_rows    = std::max<unsigned int>(1,
                                          (plots.size() + frame.n_columns - 1) /
                                            frame.n_columns);
    frame.width     = 520 * frame.n_columns;
    frame.height    = 360 * frame.n_rows;
    frame.settings  = "curves = " + gnuplot_text(curve_file) +
                     "\nset key left top reverse Left samplen 2\n"
                     "set format '%g'\n";
    static const char *const symbols[] = {"7 pointsize 0.5",
                                          "5 pointsize 0.5",
                                          "9 pointsize 0.6",
                                          "13 pointsize 0.6"};
    for (unsigned int i = 0; i < 4; ++i)
      frame.settings += "set style line " + std::to_string(i + 1) +
                        " linecolor rgb '" + gnuplot_color(i) +
                        "' linewidth 2 pointtype " + symbols[i] + "\n";
    write_gnuplot_script(script, frame, [&](std::ostream &out) {
      for (const PlotSpec &plot : plots)
        write_panel(out, plot);
    });
  }



  bool
  write_curves_script(const std::string  &folder,
                      const AxesOfStages &axes,
                      const StageStarts  &starts)
  {
    const std::vector<PlotSpec> panels =
      default_plots(read_curves(folder + "/curves.csv"), axes, starts);
    if (panels.empty())
      return false;
    write_plot_script(folder + "/curves.gp", "curves.csv", "curves", panels);
    return true;
  }
} // namespace NPT
