// SPDX-License-Identifier: LGPL-2.1-or-later
// Tables and picture of a sensitivity study.

#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/sensitivity_results.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_results/plots.h>
#include <npt_dealii/problems/plate_results/study_plots.h>

#include <algorithm>
#include <ostream>

namespace NPT
{
  namespace
  {
    // In the picture, where abscissas are 1 apart.
    double
    bar_width(const std::vector<std::string> &inputs)
    {
      return 0.8 / inputs.size();
    }

    // The numbers that are found among others, in the order of their first
    // appearance.
    template <typename T>
    std::vector<T>
    distinct(const std::vector<SensitivityQuantity> &quantities,
             T SensitivityQuantity::*member)
    {
      std::vector<T> result;
      for (const SensitivityQuantity &quantity : quantities)
        if (std::find(result.begin(), result.end(), quantity.*member) ==
            result.end())
          result.push_back(quantity.*member);
      return result;
    }

    template <typename T>
    std::size_t
    place_of(const T &value, const std::vector<T> &all)
    {
      return std::find(all.begin(), all.end(), value) - all.begin();
    }

    void
    write_index_table(const std::string                      &filename,
                      const std::vector<std::string>         &inputs,
                      const std::vector<SensitivityQuantity> &quantities,
                      const std::string                      &x_column)
    {
      TableWriter table(filename,
                        {"panel",
                         "place",
                         "bar",
                         "first_order",
                         "first_order_error",
                         "total",
                         "total_error",
                         "quantity",
                         x_column,
                         "input"},
                        {"Part of the variance of the quantity over all ranges "
                         "that comes from an input alone (first order), and "
                         "from it alone and together with others (total), with "
                         "standard errors; panel, place and bar are the "
                         "numbers by which they are drawn."});
      const auto  columns = distinct(quantities, &SensitivityQuantity::column);
      const auto  places  = distinct(quantities, &SensitivityQuantity::at);
      for (const SensitivityQuantity &quantity : quantities)
        for (std::size_t i = 0; i < quantity.result.indices.size(); ++i)
          {
            const SensitivityIndex &index = quantity.result.indices[i];
            const double            shift =
              (i + 0.5 - 0.5 * inputs.size()) * bar_width(inputs);
            table.add_row({place_of(quantity.column, columns),
                           place_of(quantity.at, places) + shift,
                           i,
                           index.first,
                           index.first_error,
                           index.total,
                           index.total_error,
                           quantity.column,
                           quantity.at,
                           inputs[i]});
          }
    }

    void
    write_band_table(const std::string                      &filename,
                     const std::vector<SensitivityQuantity> &quantities,
                     const std::string                      &x_column)
    {
      TableWriter table(filename,
                        {"quantity",
                         x_column,
                         "mean",
                         "deviation",
                         "lowest",
                         "5 %",
                         "median",
                         "95 %",
                         "highest",
                         "rows",
                         "rows_left_out",
                         "cases_missing"},
                        {"The quantity over the ranges of all inputs, at the "
                         "random points of the design. Rows in which a case "
                         "ended before are left out as a whole."});
      for (const SensitivityQuantity &quantity : quantities)
        {
          const SensitivityResult &result = quantity.result;
          table.add_row({quantity.column,
                         quantity.at,
                         result.mean,
                         result.deviation,
                         result.lowest,
                         result.low,
                         result.median,
                         result.high,
                         result.highest,
                         result.n_rows,
                         quantity.n_rows - result.n_rows,
                         quantity.n_missing});
        }
    }

    void
    write_panel_of(std::ostream                           &out,
                   const std::size_t                       panel,
                   const std::vector<std::string>         &inputs,
                   const std::vector<SensitivityQuantity> &quantities,
                   const std::string                      &x_column)
    {
      const auto columns = distinct(quantities, &SensitivityQuantity::column);
      const auto places  = distinct(quantities, &SensitivityQuantity::at);
      out << "  set title " << gnuplot_text(columns[panel]) << " noenhanced\n"
          << "  set xlabel " << gnuplot_text(column_label(x_column))
          << "\n  set ylabel 'part of the variance [-]'\n  set xtics (";
      for (std::size_t k = 0; k < places.size(); ++k)
        out << (k == 0 ? "" : ", ") << "'" << places[k] << "' " << k;
      out << ")\n  set xrange [-0.5:" << places.size() - 0.5
          << "]\n  set yrange [0:*]\n  set key outside right top noenhanced\n"
          << "  set boxwidth " << 0.9 * bar_width(inputs) << "\n  plot ";
      for (std::size_t i = 0; i < inputs.size(); ++i)
        {
          const std::string bar =
            "'sensitivity.csv' using (column('panel') == " +
            std::to_string(panel) +
            " && column('bar') == " + std::to_string(i) +
            " ? column('place') : NaN):";
          const std::string color = " linecolor rgb '" + gnuplot_color(i) + "'";
          out << (i == 0 ? "" : ", \\\n    ") << bar
              << "(column('total')) with boxes fillstyle solid 0.3" << color
              << " notitle, \\\n    " << bar
              << "(column('first_order') > 0 ? column('first_order') : 0) with "
                 "boxes fillstyle solid 1"
              << color << " title " << gnuplot_text(inputs[i]) << ", \\\n    "
              << bar
              << "(column('total')):(column('total_error')) with yerrorbars "
                 "pointtype 0 linecolor rgb '#404040' notitle";
        }
      out << "\n";
    }
  } // namespace



  std::string
  describe(const SensitivityQuantity      &quantity,
           const std::string              &x_column,
           const std::vector<std::string> &inputs)
  {
    const SensitivityResult &result = quantity.result;
    std::string              text = quantity.column + " at " + x_column + " " +
                       short_number(quantity.at) + ": ";
    text += std::to_string(result.n_rows) + " of " +
            std::to_string(quantity.n_rows) + " rows";
    if (quantity.n_missing > 0)
      text += " (" + std::to_string(quantity.n_missing) +
              " cases do not come so far)";
    if (result.n_rows > 0)
      text += ", mean " + short_number(result.mean, 3) + ", 5 to 95 % " +
              short_number(result.low, 3) + " to " +
              short_number(result.high, 3);
    for (std::size_t i = 0; i < result.indices.size(); ++i)
      text += (i == 0 ? "; first order and total: " : ", ") + inputs[i] + " " +
              short_number(result.indices[i].first, 2) + " " +
              short_number(result.indices[i].total, 2);
    return text + ".";
  }



  std::string
  write_sensitivity(const std::string                      &directory,
                    const std::vector<std::string>         &inputs,
                    const std::vector<SensitivityQuantity> &quantities,
                    const std::string                      &x_column,
                    const std::string                      &title)
  {
    write_index_table(directory + "/sensitivity.csv",
                      inputs,
                      quantities,
                      x_column);
    write_band_table(directory + "/sensitivity_band.csv", quantities, x_column);
    const unsigned int n_panels =
      distinct(quantities, &SensitivityQuantity::column).size();
    if (std::all_of(quantities.begin(),
                    quantities.end(),
                    [](const SensitivityQuantity &quantity) {
                      return quantity.result.indices.empty();
                    }))
      return "No abscissa has two complete rows of the design, so that there "
             "are no indices.";
    return draw_picture(directory,
                        "sensitivity",
                        title,
                        n_panels,
                        1,
                        820,
                        380,
                        [&](std::ostream &out) {
                          for (unsigned int p = 0; p < n_panels; ++p)
                            write_panel_of(
                              out, p, inputs, quantities, x_column);
                        });
  }
} // namespace NPT
