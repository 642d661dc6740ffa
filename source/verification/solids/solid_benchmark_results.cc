// SPDX-License-Identifier: LGPL-2.1-or-later
// Results of solid benchmarks: log, tables, picture, and whether tolerances are
// met.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/verification/comparison.h>
#include <npt_dealii/verification/solids/solid_benchmark.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace NPT
{
  namespace
  {
    std::string
    format(const double value, const int digits, const unsigned int width)
    {
      std::ostringstream text;
      if (std::isnan(value))
        text << std::setw(width) << "-";
      else
        text << std::setw(width) << std::fixed << std::setprecision(digits)
             << value;
      return text.str();
    }

    std::string
    format_error(const double value)
    {
      std::ostringstream text;
      text << std::setw(11) << std::scientific << std::setprecision(2) << value;
      return text.str();
    }

    // Errors over the number of elements in two panels: a color per degree, a
    // symbol per basis, and dashed lines of the slope that theory expects.
    std::string
    plot_rates(const std::string                 &folder,
               const std::string                 &title,
               const std::vector<ConvergenceRow> &rows)
    {
      const std::array<std::string, 3> symbols = {{"7", "5", "8"}};
      std::vector<std::string>         bases;
      std::vector<unsigned int>        degrees;
      for (const ConvergenceRow &row : rows)
        {
          if (std::find(bases.begin(), bases.end(), row.basis) == bases.end())
            bases.push_back(row.basis);
          if (std::find(degrees.begin(), degrees.end(), row.degree) ==
              degrees.end())
            degrees.push_back(row.degree);
        }

      GnuplotPicture picture;
      picture.name             = "convergence";
      picture.width            = 1040;
      picture.height           = 480;
      picture.n_columns        = 2;
      picture.settings         = "set logscale xy\n"
                                 "set format y '10^{%T}'\n"
                                 "set xlabel 'elements per direction'\n"
                                 "set key bottom left Left reverse samplen 2\n";
      const std::string script = folder + "/convergence.gp";
      write_gnuplot_script(script, picture, [&](std::ostream &out) {
        for (const bool energy : {true, false})
          {
            out << "  set title " << gnuplot_text(title)
                << "\n  set ylabel 'relative "
                << "error, " << (energy ? "energy" : "L_2") << " norm'\n";
            std::string separator = "  plot \\\n";
            for (unsigned int b = 0; b < bases.size(); ++b)
              for (unsigned int k = 0; k < degrees.size(); ++k)
                {
                  out << separator << "    'convergence.csv' using "
                      << "(column('elements')):(strcol('basis') eq '"
                      << bases[b] << "' && column('degree') == " << degrees[k]
                      << " ? column('error_" << (energy ? "energy" : "L2")
                      << "') : NaN) with linespoints lw 1.5 pt "
                      << symbols[b % 3] << " ps 0.7 lc rgb '"
                      << gnuplot_color(k) << "' title '" << bases[b] << " "
                      << degrees[k] << "'";
                  separator = ", \\\n";
                }
            // Through half the last error of the first basis.
            for (unsigned int k = 0; k < degrees.size(); ++k)
              {
                const ConvergenceRow *last = nullptr;
                for (const ConvergenceRow &row : rows)
                  if (row.basis == bases[0] && row.degree == degrees[k])
                    last = &row;
                const double error =
                  energy ? last->error_energy : last->error_L2;
                out << separator << "    " << 0.5 * error << "*(x/"
                    << last->n_elements << ".)**(-"
                    << degrees[k] + (energy ? 0 : 1) << ") dt 2 lw 1 lc rgb '"
                    << gnuplot_color(k) << "' notitle";
              }
            out << "\n";
          }
      });
      return run_gnuplot(script);
    }
  } // namespace



  void
  SolidBenchmark::begin_output()
  {
    std::ostringstream constants;
    constants << parameters_.material.law;
    if (const auto *isotropic =
          parameters_.material.selected<NeoHookeanParameters>())
      constants << ", E = " << isotropic->young_modulus
                << " MPa, nu = " << isotropic->poisson_ratio;
    log_.header("Solid benchmark: " + parameters_.name,
                {{"law", constants.str()},
                 {"linearized", exact_ ? "at the natural state" : "no"}});
    if (exact_)
      log_.line("basis      p    n   cells  unknowns  energy err.  rate"
                "      L2 err.  rate   CPU s");
    else
      log_.line("mode          fiber  basis      p  n  iterations  "
                "error of <P>   of P at a point");
    if (directory_.empty())
      return;

    replace_file(directory_ + "/used_parameters.prm",
                 [&](std::ostream &out) { out << parameters_.used_file; });
    if (exact_)
      table_ = std::make_unique<TableWriter>(
        directory_ + "/convergence.csv",
        std::vector<std::string>{"basis",
                                 "degree",
                                 "elements",
                                 "cells",
                                 "unknowns",
                                 "error_energy",
                                 "rate_energy",
                                 "error_L2",
                                 "rate_L2",
                                 "cpu_seconds"},
        std::vector<std::string>{
          "Errors of " + parameters_.name +
          " relative to the norm of the exact solution."});
    else
      {
        std::vector<std::string> columns{"mode",
                                         "fiber_direction",
                                         "basis",
                                         "degree",
                                         "elements",
                                         "newton_iterations",
                                         "error_average",
                                         "error_pointwise"};
        for (const std::string kind : {"P", "exact_P"})
          for (unsigned int e = 0; e < 9; ++e)
            columns.push_back(kind + std::to_string(e / 3 + 1) +
                              std::to_string(e % 3 + 1));
        table_ = std::make_unique<TableWriter>(
          directory_ + "/homogeneous.csv",
          columns,
          std::vector<std::string>{
            "Homogeneous states: average first Piola-Kirchhoff stress P [MPa] "
            "and its closed form; errors relative to the largest component."});
      }
  }



  void
  SolidBenchmark::judge_and_write(ConvergenceRow row)
  {
    const bool first = row.n_elements == parameters_.n_elements.front();
    if (!first)
      {
        const ConvergenceRow &coarser = rates_.back();
        const double          refinement =
          std::log(static_cast<double>(row.n_elements) / coarser.n_elements);
        row.rate_energy =
          std::log(coarser.error_energy / row.error_energy) / refinement;
        row.rate_L2 = std::log(coarser.error_L2 / row.error_L2) / refinement;
      }
    rates_.push_back(row);

    // Only the finest pair is meant to be in the range where theory holds.
    if (row.n_elements == parameters_.n_elements.back())
      {
        const auto judge =
          [&](const std::string &norm, const double rate, const double theory) {
            if (!(std::abs(rate - theory) <= parameters_.rate_tolerance))
              misses_.push_back(
                row.basis + ", p = " + std::to_string(row.degree) + ": rate " +
                format(rate, 2, 0) + " in the " + norm + " norm, " +
                format(theory, 0, 0) + " expected, " +
                format(parameters_.rate_tolerance, 2, 0) + " allowed");
          };
        judge("energy", row.rate_energy, row.degree);
        judge("L2", row.rate_L2, row.degree + 1.);
      }

    std::ostringstream line;
    line << std::left << std::setw(10) << row.basis << std::right
         << std::setw(2) << row.degree << std::setw(5) << row.n_elements
         << std::setw(8) << row.n_cells << std::setw(10) << row.n_unknowns
         << "  " << format_error(row.error_energy)
         << format(row.rate_energy, 2, 6) << "  " << format_error(row.error_L2)
         << format(row.rate_L2, 2, 6) << format(row.cpu_seconds, 2, 8);
    log_.line(line.str());
    if (table_)
      table_->add_row({row.basis,
                       row.degree,
                       row.n_elements,
                       row.n_cells,
                       row.n_unknowns,
                       row.error_energy,
                       row.rate_energy,
                       row.error_L2,
                       row.rate_L2,
                       row.cpu_seconds});
  }



  void
  SolidBenchmark::judge_and_write(const HomogeneousRow &row)
  {
    const bool isotropic =
      parameters_.material.selected<NeoHookeanParameters>() != nullptr;
    const std::string fiber =
      isotropic ? "-" : std::to_string(row.fiber_axis + 1);
    states_.push_back(row);
    const auto judge_stress = [&](const std::string          &what,
                                  const double                error,
                                  const std::optional<double> allowed) {
      if (allowed && !(error <= *allowed))
        misses_.push_back(row.mode + ", fiber along " + fiber + ", " +
                          row.basis + ", p = " + std::to_string(row.degree) +
                          ": error of the " + what + format_error(error) +
                          ", allowed" + format_error(*allowed));
    };
    judge_stress("average stress",
                 row.error_average,
                 parameters_.stress_tolerance);
    judge_stress("stress at the worst point",
                 row.error_pointwise,
                 parameters_.pointwise_tolerance);

    std::ostringstream line;
    line << std::left << std::setw(14) << row.mode << std::setw(7) << fiber
         << std::setw(10) << row.basis << std::right << std::setw(2)
         << row.degree << std::setw(3) << row.n_elements << std::setw(12)
         << row.n_iterations << "   " << format_error(row.error_average)
         << "       " << format_error(row.error_pointwise);
    log_.line(line.str());
    if (!table_)
      return;
    std::vector<TableCell> cells{row.mode,
                                 fiber,
                                 row.basis,
                                 row.degree,
                                 row.n_elements,
                                 row.n_iterations,
                                 row.error_average,
                                 row.error_pointwise};
    for (const auto &P : {row.P, row.P_exact})
      for (unsigned int e = 0; e < 9; ++e)
        cells.emplace_back(P[e / 3][e % 3]);
    table_->add_row(cells);
  }



  void
  SolidBenchmark::finish_output()
  {
    if (exact_ && parameters_.picture && !directory_.empty())
      {
        const std::string warning =
          plot_rates(directory_, parameters_.name, rates_);
        if (!warning.empty())
          log_.warning(warning);
      }
    if (misses_.empty())
      {
        log_.line(exact_ ? "All rates are within their tolerance." :
                           "All stresses are within their tolerance.");
        return;
      }
    std::string text = "The comparison with the exact solution failed: ";
    for (unsigned int k = 0; k < misses_.size(); ++k)
      text += (k == 0 ? "" : "; ") + misses_[k];
    throw ToleranceMissed(text + ".");
  }
} // namespace NPT
