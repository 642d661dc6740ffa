// SPDX-License-Identifier: LGPL-2.1-or-later
// The columns of the table of load steps in the log.

#include <npt_dealii/problems/plate_results/step_table.h>

#include <deal.II/base/exceptions.h>

#include <cmath>
#include <cstdio>

namespace NPT
{
  namespace
  {
    // printf formats align numbers more readably than stream manipulators.
    template <typename... Arguments>
    std::string
    format(const char *pattern, const Arguments &...arguments)
    {
      char buffer[256];
      std::snprintf(buffer, sizeof(buffer), pattern, arguments...);
      return buffer;
    }
  } // namespace



  StepTable::StepTable(RunLog &log)
    : log_(log)
  {}



  void
  StepTable::show_components(const std::vector<unsigned int> &components)
  {
    for (const unsigned int i : components)
      {
        (void)i;
        AssertIndexRange(i, MacroModes::n);
      }
    components_ = components;
    columns_.clear();
    first_step_ = true; // the titles change
  }



  void
  StepTable::show_columns(const std::vector<std::string> &columns)
  {
    components_.clear();
    columns_    = columns;
    first_step_ = true;
  }



  void
  StepTable::add_row(const CurveRow &row, const double residual)
  {
    if (first_step_ || row.stage != last_stage_)
      {
        std::string titles =
          format("%5s %-10s %10s", "step", "stage", "factor");
        if (components_.empty() && columns_.empty())
          titles += format("  %13s", "largest H");
        for (const std::string &column : columns_)
          titles += format("  %14s", column.c_str());
        for (const unsigned int i : components_)
          titles += format("  %10s", MacroModes::table[i].name);
        titles += format(" %5s %8s %5s %6s %6s %6s %8s %9s",
                         "iter.",
                         "residual",
                         "order",
                         "active",
                         "stick",
                         "slip",
                         "penetr.",
                         "cpu [s]");
        log_.line(titles);
        first_step_ = false;
        last_stage_ = row.stage;
      }

    std::string text =
      format("%5u %-10s %10.6f", row.step, row.stage.c_str(), row.load_factor);
    if (components_.empty() && columns_.empty())
      {
        // By work: gradients [-] and curvatures [1/mm] are not comparable.
        unsigned int largest = 0;
        for (unsigned int i = 1; i < MacroModes::n; ++i)
          if (std::abs(row.n[i] * row.H[i]) >
              std::abs(row.n[largest] * row.H[largest]))
            largest = i;
        text += format("  %s %10.3e",
                       MacroModes::table[largest].name,
                       row.H[largest]);
      }
    for (const std::string &column : columns_)
      text += format("  %14.6g", curve_value(row, column));
    for (const unsigned int i : components_)
      text += format("  %10.3e", row.H[i]);
    text += format(" %5u %8.1e ", row.newton_iterations, residual);
    text +=
      (std::isfinite(row.newton_order) ? format("%5.1f", row.newton_order) :
                                         format("%5s", "-"));
    text += format(" %6u %6u %6u %8.1e %9.1f",
                   row.n_active,
                   row.n_stick,
                   row.n_slip,
                   row.largest_penetration,
                   row.cpu_seconds);
    log_.line(text);
  }
} // namespace NPT
