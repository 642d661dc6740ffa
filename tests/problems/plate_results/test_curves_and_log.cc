// SPDX-License-Identifier: LGPL-2.1-or-later
// Tests of the curve file, its picture and the log.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/io/gnuplot.h>
#include <npt_dealii/io/run_log.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_results/driving_component.h>
#include <npt_dealii/problems/plate_results/plots.h>
#include <npt_dealii/problems/plate_results/stage_starts.h>
#include <npt_dealii/problems/plate_results/step_table.h>

#include <catch2/catch.hpp>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "run_program.h"

using TopTests::read_text;

namespace
{
  std::string
  temporary_folder(const std::string &name)
  {
    const std::string folder =
      std::string(NPT_BINARY_DIR) + "/tests/output_files/" + name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
  }

  // A shear test after weaving, with the locking and the friction loop that
  // such curves show; every column has a value of its own.
  std::vector<NPT::CurveRow>
  made_up_run()
  {
    std::vector<NPT::CurveRow> rows;
    for (unsigned int s = 0; s <= 40; ++s)
      {
        NPT::CurveRow  row;
        const bool     weaving = s <= 10;
        const double   t       = weaving ? s / 10. : (s - 10) / 30.;
        const double   g       = (t < 0.7 ? t / 0.7 : (1.7 - t) / 1.) * 0.5;
        const unsigned n       = static_cast<unsigned int>(100 * t);
        row.step               = s;
        row.stage              = weaving ? "weave" : "shear's loop";
        row.load_factor        = t;
        if (!weaving)
          {
            row.H = {{0.01 * g, -0.02 * g, g, 0.001 * t, 0., 1e-5 / 3.}};
            row.n[2] =
              0.2 * g + 2. * std::pow(g, 5.) + (t < 0.7 ? 0.02 : -0.02);
          }
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            {
              row.N[i][j] = 1. / (3. + i + 10. * j + s);
              row.M[i][j] = -1. / (7. + i + 10. * j + s);
            }
        row.stored_energy       = 0.1 * t * t;
        row.contact_energy      = 1e-3 * t;
        row.friction_energy     = 1e-4 * t;
        row.dissipation         = weaving ? 0. : 0.01 * t;
        row.external_work       = 0.11 * t * t;
        row.largest_penetration = 1e-6 * t;
        row.n_active            = 2 * n;
        row.n_stick             = 2 * n - n / 3;
        row.n_slip              = n / 3;
        row.newton_iterations   = 4 + s % 3;
        row.cuts                = s % 2;
        row.newton_order        = 1.9 + 0.001 * s;
        row.cpu_seconds         = 1.5 * s;
        rows.push_back(row);
      }
    return rows;
  }

  void
  check_equal(const NPT::CurveRow &a, const NPT::CurveRow &b)
  {
    CHECK(a.stage == b.stage);
    for (const std::string &column : NPT::curve_columns())
      if (column != "stage")
        {
          INFO(column);
          // No tolerance: the file holds enough digits.
          CHECK(NPT::curve_value(a, column) == NPT::curve_value(b, column));
        }
  }

  unsigned int
  n_lines_that_begin_with_a_number(const std::string &text)
  {
    std::istringstream in(text);
    unsigned int       n = 0;
    for (std::string line; std::getline(in, line);)
      {
        const std::size_t first = line.find_first_not_of(' ');
        n += (first != std::string::npos &&
              std::isdigit(static_cast<unsigned char>(line[first])));
      }
    return n;
  }
} // namespace


TEST_CASE("Rows of a curve written and read back are equal", "[output]")
{
  const std::string filename = temporary_folder("curve") + "/curves.csv";
  const auto        rows     = made_up_run();
  {
    NPT::CurveWriter writer(filename);
    for (const auto &row : rows)
      writer.write(row);
    // Before the writer is closed: each row is flushed.
    CHECK(NPT::read_curves(filename).size() == rows.size());
  }
  const auto read = NPT::read_curves(filename);
  REQUIRE(read.size() == rows.size());
  for (unsigned int r = 0; r < rows.size(); ++r)
    check_equal(rows[r], read[r]);
}


TEST_CASE("The curve file names its columns and units", "[output]")
{
  const std::string filename = temporary_folder("columns") + "/curves.csv";
  NPT::CurveWriter  writer(filename);
  std::ifstream     in(filename);
  std::string       what, units, columns;
  std::getline(in, what);
  std::getline(in, units);
  std::getline(in, columns);
  CHECK(what[0] == '#');
  CHECK(units.find("# units:") == 0);
  for (const char *group : {" H1 H2 H3 [-],",
                            " H4 H5 H6 [1/mm],",
                            " n1 n2 n3 [N/mm],",
                            " M33 [N],",
                            " cpu_seconds [s]"})
    CHECK(units.find(group) != std::string::npos);
  CHECK(columns == "step,stage,load_factor,H1,H2,H3,H4,H5,H6,n1,n2,n3,n4,n5,n6,"
                   "N11,N12,N13,N21,N22,N23,N31,N32,N33,"
                   "M11,M12,M13,M21,M22,M23,M31,M32,M33,"
                   "stored_energy,contact_energy,friction_energy,dissipation,"
                   "external_work,largest_penetration,n_active,n_stick,n_slip,"
                   "newton_iterations,cuts,newton_order,cpu_seconds");
}


TEST_CASE("A wrong curve file is refused with its line and column", "[output]")
{
  const std::string filename = temporary_folder("wrong") + "/curves.csv";
  std::ofstream(filename) << "step,stage\n1,load\n";
  CHECK_THROWS_WITH(NPT::read_curves(filename),
                    Catch::Contains("'load_factor' is missing"));
  {
    NPT::CurveWriter writer(filename);
  }
  std::ofstream(filename, std::ios::app) << "1,load,much\n";
  CHECK_THROWS_WITH(NPT::read_curves(filename),
                    Catch::Contains("Line 4") &&
                      Catch::Contains("'load_factor' has 'much'"));
  CHECK_THROWS_AS(NPT::curve_column_unit("H7"), NPT::InputError);

  NPT::CurveWriter writer(filename);
  NPT::CurveRow    row;
  row.stage = "shear, then bend";
  CHECK_THROWS_AS(writer.write(row), NPT::InputError);
}


TEST_CASE("The picture of a shear test draws n3 over H3", "[output]")
{
  const std::vector<NPT::CurveRow> rows  = made_up_run();
  const auto                       plots = NPT::default_plots(rows);
  REQUIRE(plots.size() == 4);
  CHECK(plots[0].x_column == "load_factor"); // weaving: no H changes
  CHECK(plots[2].x_column == "H3");
  CHECK(plots[2].y_columns == std::vector<std::string>{"n3"});
  CHECK(plots[3].y2_columns == std::vector<std::string>{"dissipation"});

  const std::string script = temporary_folder("script") + "/curves.gp";
  NPT::write_plot_script(script, "curves.csv", "curves", plots);
  const std::string text = read_text(script);
  for (const char *part : {"column('H3')",
                           "column('n3')",
                           "'shear''s loop'",
                           "'shear H_3 [-]'",
                           "'n_3 [N/mm]'",
                           "'curves.svg'"})
    CHECK(text.find(part) != std::string::npos);

  NPT::PlotSpec unknown;
  unknown.x_column  = "H3";
  unknown.y_columns = {"n7"};
  CHECK_THROWS_AS(
    NPT::write_plot_script(script, "curves.csv", "curves", {unknown}),
    NPT::InputError);
}


TEST_CASE("The loaded component is found although a curvature changes less",
          "[output]")
{
  // Bending: small curvature with a moment, larger free stretch without force.
  std::vector<NPT::CurveRow> rows(2);
  rows[1].H = {{0.01, 0., 0., 0.002, 0., 0.}};
  rows[1].n = {{0., 5., 0., 0.3, 0., 0.}};
  CHECK(NPT::driving_component(rows) == 3);
  rows[1].n = {};
  CHECK(NPT::driving_component(rows) == 0);
  rows[1].H = {};
  CHECK(!NPT::driving_component(rows).has_value());
}


TEST_CASE("A run is drawn, or the missing gnuplot is reported in one line",
          "[output]")
{
  const std::string folder = temporary_folder("it's a picture");
  {
    NPT::CurveWriter writer(folder + "/curves.csv");
    for (const auto &row : made_up_run())
      writer.write(row);
  }
  REQUIRE(NPT::write_curves_script(folder));
  const std::string warning = NPT::run_gnuplot(folder, {"curves.gp"});
  INFO(warning);
  if (std::system("gnuplot --version >/dev/null 2>&1") == 0)
    {
      CHECK(warning.empty());
      CHECK(read_text(folder + "/curves.svg").find("</svg>") !=
            std::string::npos);
      // gnuplot does not say that a disk is full.
      std::filesystem::remove(folder + "/curves.svg");
      std::filesystem::create_symlink("/dev/full", folder + "/curves.svg");
      CHECK_THROWS_WITH(NPT::run_gnuplot(folder, {"curves.gp"}),
                        "The file '" + folder +
                          "/curves.svg' cannot be written: No space left on "
                          "device.");
    }
  else
    CHECK(warning.find("gnuplot was not found") != std::string::npos);
}


TEST_CASE("The log has one line per accepted step", "[output]")
{
  const std::string  logfile = temporary_folder("log") + "/log.txt";
  std::ostringstream screen;
  const auto         rows = made_up_run();
  NPT::RunLog        log(logfile, screen, true);
  log.header("npt_dealii 0.1", {{"unknowns", "2904"}, {"weave", "plain"}});
  NPT::StepTable table(log);
  table.show_components({2});
  for (const auto &row : rows)
    {
      table.add_row(row, 1e-10);
      log.progress(row.step / 40., row.cpu_seconds);
    }
  log.cut("shear", 0.35, "inverted cell", 0.0125);
  log.warning("no picture");
  log.finish();

  const std::string text = read_text(logfile);
  CHECK(n_lines_that_begin_with_a_number(text) == rows.size());
  CHECK(text.find("deal.II " DEAL_II_PACKAGE_VERSION) != std::string::npos);
  CHECK(text.find("cut shear at 0.350000: inverted cell; next step 0.0125") !=
        std::string::npos);
  CHECK(text.find("\nWarning: no picture\n") != std::string::npos);
  // The bar belongs to the terminal, not to the file.
  CHECK(text.find('\r') == std::string::npos);
  CHECK(screen.str().find("50 %, about 30 s left") != std::string::npos);
}


TEST_CASE("The progress bar never writes when the screen is not a terminal",
          "[output]")
{
  std::ostringstream screen;
  NPT::RunLog        log("", screen, false);
  for (unsigned int i = 0; i <= 100; ++i)
    log.progress(i / 100., i);
  log.finish();
  CHECK(screen.str().empty());
  log.line("one line");
  CHECK(screen.str() == "one line\n");
}


TEST_CASE("A quiet log shows warnings and keeps the rest in its file",
          "[output]")
{
  const std::string  logfile = temporary_folder("quiet") + "/log.txt";
  std::ostringstream screen;
  NPT::RunLog        log(logfile, screen, true, true);
  log.line("a line");
  log.progress(0.5, 10.);
  log.warning("look here");
  CHECK(screen.str() == "Warning: look here\n");
  CHECK(read_text(logfile) == "a line\nWarning: look here\n");
}


TEST_CASE("A line after the progress bar leaves nothing of the bar", "[output]")
{
  std::ostringstream screen;
  NPT::RunLog        log("", screen, true);
  log.progress(0.5, 100.);
  const std::size_t bar = screen.str().size();
  log.line("x");
  CHECK(screen.str().substr(bar) ==
        "\r" + std::string(bar, ' ') + "\r" + "x\n");
  CHECK(NPT::format_duration(42.) == "42 s");
  CHECK(NPT::format_duration(185.) == "3 min 05 s");
  CHECK(NPT::format_duration(7620.) == "2 h 07 min");
}



TEST_CASE("Of several tests of one state each has its own way and its own "
          "picture",
          "[output]")
{
  std::vector<NPT::CurveRow> rows;
  for (const std::string name :
       {"weave", "weave", "shear", "shear", "again", "again", "again"})
    {
      NPT::CurveRow row;
      row.stage = name;
      row.step  = rows.size() + 1;
      row.H[2]  = name == "weave" ? 0. : 0.1 * row.step;
      row.n[2]  = row.H[2];
      rows.push_back(row);
    }
  const NPT::StageStarts starts = {{"again", "weave"}};
  CHECK(NPT::row_before(rows, "weave", starts) == nullptr);
  CHECK(NPT::row_before(rows, "shear", starts)->step == 2);
  CHECK(NPT::row_before(rows, "again", starts)->step == 2);
  CHECK(NPT::row_before(rows, "again")->step == 4);
  CHECK(NPT::row_before(rows, "next")->step == 7);
  CHECK(NPT::rows_to(rows, "again", starts).size() == 5);
  CHECK(NPT::rows_to(rows, "again", starts)[2].stage == "again");
  CHECK(NPT::rows_to(rows, "again").size() == 7);
  const auto last_panel = [&](const NPT::StageStarts &of) {
    return NPT::default_plots(rows, {}, of).back().stages;
  };
  CHECK(last_panel({}) == std::vector<std::string>{"shear", "again"});
  CHECK(last_panel(starts) == std::vector<std::string>{"again"});
}
