// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables and pictures of families of curves.

#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/plate_results/curve_family.h>
#include <npt_dealii/problems/plate_results/plots.h>
#include <npt_dealii/problems/plate_results/study_plots.h>

#include <algorithm>
#include <ostream>

namespace NPT
{
  namespace
  {
    unsigned int
    n_columns_of(const std::size_t n_panels)
    {
      return n_panels <= 3 ? n_panels : n_panels == 4 ? 2 : 3;
    }

    // One plot command: all members of a panel, from a long table.
    void
    plot_members(std::ostream                    &out,
                 const std::vector<FamilyMember> &members,
                 const unsigned int               panel,
                 const std::string               &file,
                 const std::string               &x_column,
                 const std::string               &y_column,
                 const std::string               &with)
    {
      unsigned int n = 0;
      for (std::size_t m = 0; m < members.size(); ++m)
        if (members[m].panel == panel)
          {
            out << (n == 0 ? "  plot " : ", \\\n    ") << gnuplot_text(file)
                << " using (column('member') == " << m << " ? column('"
                << x_column << "') : NaN):(column('" << y_column << "')) with "
                << with << " " << study_line_style(n) << " pointsize 0.5 title "
                << gnuplot_text(members[m].label);
            ++n;
          }
      // gnuplot takes an empty panel for an error.
      if (n == 0)
        out << "  plot NaN notitle";
      out << "\n";
    }

    std::size_t
    most_in_a_panel(const std::vector<FamilyMember> &members,
                    const std::size_t                n_panels)
    {
      std::vector<std::size_t> n(n_panels, 0);
      for (const FamilyMember &member : members)
        ++n[member.panel];
      return *std::max_element(n.begin(), n.end());
    }

    // Legends stand below: inside they would hide curves. Long labels need a
    // line each.
    void
    set_key(std::ostream &out, const std::vector<FamilyMember> &members)
    {
      std::size_t longest = 0;
      for (const FamilyMember &member : members)
        longest = std::max(longest, member.label.size());
      out << "  set key below maxcols " << (longest > 30 ? 1 : 2)
          << " reverse Left samplen 2 noenhanced\n"
          << "  set offsets graph 0, graph 0, graph 0.03, graph 0\n";
    }
  } // namespace



  std::string
  write_curve_family(const std::string               &directory,
                     const std::vector<std::string>  &panels,
                     const std::vector<FamilyMember> &members,
                     const std::string               &x_column,
                     const std::vector<std::string>  &y_columns,
                     const std::string               &title)
  {
    std::vector<std::string> columns = {"member", x_column};
    columns.insert(columns.end(), y_columns.begin(), y_columns.end());
    columns.push_back("case");
    columns.push_back("label");
    {
      TableWriter table(directory + "/curves.csv",
                        columns,
                        {"The curves of all cases; member is the number of the "
                         "case in the picture, units as in the curves.csv of a "
                         "run."});
      for (std::size_t m = 0; m < members.size(); ++m)
        for (const CurveRow &row : members[m].rows)
          {
            std::vector<TableCell> cells = {m, curve_value(row, x_column)};
            for (const std::string &column : y_columns)
              cells.emplace_back(curve_value(row, column));
            cells.emplace_back(members[m].folder);
            cells.emplace_back(members[m].label);
            table.add_row(cells);
          }
    }

    // Panels of one quantity stand in a row; a single panel per quantity lets
    // the quantities stand side by side.
    const std::size_t  n_pictures = panels.size() * y_columns.size();
    const unsigned int n_columns =
      n_columns_of(panels.size() > 1 ? panels.size() : n_pictures);
    const unsigned int n_rows = (n_pictures + n_columns - 1) / n_columns;
    const std::size_t  n_most = most_in_a_panel(members, panels.size());
    return draw_picture(directory,
                        "curves",
                        title,
                        n_rows,
                        n_columns,
                        n_columns == 1 ? 640 : 540,
                        380 + 18 * n_most,
                        [&](std::ostream &out) {
                          set_key(out, members);
                          out << "  set format '%g'\n  set xlabel "
                              << gnuplot_text(column_label(x_column)) << "\n";
                          for (const std::string &column : y_columns)
                            for (unsigned int p = 0; p < panels.size(); ++p)
                              {
                                out << "  set title " << gnuplot_text(panels[p])
                                    << " noenhanced\n  set ylabel "
                                    << gnuplot_text(column_label(column))
                                    << "\n";
                                plot_members(out,
                                             members,
                                             p,
                                             "curves.csv",
                                             x_column,
                                             column,
                                             "linespoints");
                              }
                        });
  }



  std::vector<MeanIterations>
  mean_iterations(const std::vector<CurveRow> &rows, const unsigned int n_steps)
  {
    std::vector<MeanIterations> result;
    for (std::size_t begin = 0; begin < rows.size(); begin += n_steps)
      {
        const std::size_t end = std::min(begin + n_steps, rows.size());
        MeanIterations    mean;
        mean.first_step = begin + 1;
        mean.last_step  = end;
        for (std::size_t r = begin; r < end; ++r)
          mean.iterations += rows[r].newton_iterations;
        mean.iterations /= end - begin;
        result.push_back(mean);
      }
    return result;
  }



  std::string
  write_iterations(const std::string               &directory,
                   const std::vector<std::string>  &panels,
                   const std::vector<FamilyMember> &members,
                   const unsigned int               n_steps,
                   const std::string               &title)
  {
    {
      TableWriter table(directory + "/iterations.csv",
                        {"member",
                         "first_step",
                         "last_step",
                         "step",
                         "mean_iterations",
                         "case",
                         "label"},
                        {"Mean number of Newton iterations in consecutive load "
                         "steps of the stage; step is their middle."});
      for (std::size_t m = 0; m < members.size(); ++m)
        {
          // The first row is the state before the stage.
          const std::vector<CurveRow> &rows = members[m].rows;
          for (const MeanIterations &mean : mean_iterations(
                 {rows.begin() + (rows.empty() ? 0 : 1), rows.end()}, n_steps))
            table.add_row({m,
                           mean.first_step,
                           mean.last_step,
                           0.5 * (mean.first_step + mean.last_step),
                           mean.iterations,
                           members[m].folder,
                           members[m].label});
        }
    }
    const unsigned int n_columns = n_columns_of(panels.size());
    const std::size_t  n_most    = most_in_a_panel(members, panels.size());
    return draw_picture(directory,
                        "iterations",
                        title,
                        (panels.size() + n_columns - 1) / n_columns,
                        n_columns,
                        n_columns == 1 ? 640 : 540,
                        360 + 18 * n_most,
                        [&](std::ostream &out) {
                          set_key(out, members);
                          out << "  set format '%g'\n  set yrange [0:*]\n"
                              << "  set xlabel 'load step'\n"
                              << "  set ylabel 'mean Newton iterations per "
                              << (n_steps == 1 ?
                                    std::string("step") :
                                    std::to_string(n_steps) + " steps")
                              << "'\n";
                          for (unsigned int p = 0; p < panels.size(); ++p)
                            {
                              out << "  set title " << gnuplot_text(panels[p])
                                  << " noenhanced\n";
                              plot_members(out,
                                           members,
                                           p,
                                           "iterations.csv",
                                           "step",
                                           "mean_iterations",
                                           "linespoints");
                            }
                        });
  }
} // namespace NPT
