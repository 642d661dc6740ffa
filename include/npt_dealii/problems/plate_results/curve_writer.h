// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines curves.csv, the curve of a run with one row per accepted load step:
// its columns, their units, writing and reading.

#ifndef npt_dealii_problems_plate_results_curve_writer_h
#define npt_dealii_problems_plate_results_curve_writer_h

#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/io/output_file.h>

#include <deal.II/base/tensor.h>

#include <array>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /**
   * One accepted load step. Columns of the file carry the names below, those
   * of MacroModes::table for the arrays, N11 to N33 and M11 to M33 for the
   * tensors.
   * Energies are those of one unit cell.
   */
  struct CurveRow
  {
    unsigned int step = 0;
    std::string  stage;
    double       load_factor = 0.;

    /// Generalized displacement gradients, by mode.
    std::array<double, MacroModes::n> H{};

    /// Their conjugates.
    std::array<double, MacroModes::n> n{};

    /// Resultants as volume averages, N [N/mm], M [N].
    dealii::Tensor<2, 3> N, M;

    double stored_energy   = 0.; ///< [N mm]
    double contact_energy  = 0.; ///< of the normal penalty [N mm]
    double friction_energy = 0.; ///< of the tangential penalty [N mm]
    double dissipation     = 0.; ///< cumulative [N mm]
    double external_work   = 0.; ///< cumulative [N mm]

    double       largest_penetration = 0.; ///< [mm]
    unsigned int n_active            = 0;
    unsigned int n_stick             = 0;
    unsigned int n_slip              = 0;
    unsigned int newton_iterations   = 0;
    unsigned int cuts                = 0; ///< before this step was accepted

    /// Observed order of convergence; not a number if it cannot be told.
    double newton_order = std::numeric_limits<double>::quiet_NaN();
    double cpu_seconds  = 0.;

    /// Values of the columns in Registry<CurveColumn>, by name; not a number
    /// where there is none.
    std::map<std::string, double> further;
  };

  /// The names of all columns in the order of the file.
  std::vector<std::string>
  curve_columns();

  /// The unit of a column, e.g. "N/mm", "-" for a number, "" for the text of
  /// `stage`. Throws InputError with the possible names for any other name.
  std::string
  curve_column_unit(const std::string &column);

  /// The value of a column. Throws InputError as above, also for `stage`.
  double
  curve_value(const CurveRow &row, const std::string &column);

  /**
   * Writes curves.csv row by row. Each row is on disk when write() returns, so
   * that the file of an interrupted run is complete up to its last step.
   * Numbers have the fewest digits that read back to the same double.
   */
  class CurveWriter
  {
  public:
    /// Begin a new file with two comment lines, the names of the columns, and
    /// the rows that there are already. Throws OutputError, as write() does.
    explicit CurveWriter(const std::string           &filename,
                         const std::vector<CurveRow> &rows = {});

    /// Throws InputError if the name of the stage contains a comma or a quote.
    void
    write(const CurveRow &row);

  private:
    std::unique_ptr<OutputFile> file_;
  };

  /**
   * Read a curve file; columns are found by name, others than those of
   * CurveRow are ignored. Throws InputError if a column is missing (those that
   * register themselves may be) or an entry is no number. A last line without
   * its end (an interrupted run) is dropped.
   */
  std::vector<CurveRow>
  read_curves(const std::string &filename);
} // namespace NPT

#endif
