// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the comparison of curves with a reference, error against work, and
// what follows from it: Pareto front and recommended settings.

#ifndef npt_dealii_problems_parameter_study_work_precision_h
#define npt_dealii_problems_parameter_study_work_precision_h

#include <npt_dealii/problems/plate_results/stage_starts.h>

#include <string>
#include <vector>

namespace NPT
{
  /// A curve y(x), linear between its points; x strictly monotone.
  struct StudyCurve
  {
    std::vector<double> x, y;
  };

  /// The rows of one stage, and before them the state in which it began: the
  /// last row of the stage before, or the undeformed state. Empty if the stage
  /// has no accepted step.
  std::vector<CurveRow>
  stage_rows(const std::vector<CurveRow> &rows,
             const std::string           &stage,
             const StageStarts           &starts = {});

  /**
   * Take one stage of a run as a curve, beginning with the state before the
   * stage.
   *
   * Throws InputError if the stage is missing or x does not increase or
   * decrease strictly (a stage in which x is not driven).
   */
  StudyCurve
  stage_curve(const std::vector<CurveRow> &rows,
              const std::string           &stage,
              const std::string           &x_column,
              const std::string           &y_column,
              const StageStarts           &starts = {});

  /// Distance of a curve from a reference.
  struct CurveError
  {
    double l2    = 0; ///< relative L2 norm over the common range [-]
    double end   = 0; ///< relative error at the end of the common range [-]
    double range = 0; ///< common range over the range of the reference [-]
  };

  /**
   * Compare a curve with a reference over the common range [x_0, x_1],
   *
   * @f[ e = \left( \frac{\int_{x_0}^{x_1} (y - y_{ref})^2 \, dx}
   *                     {\int_{x_0}^{x_1} y_{ref}^2 \, dx} \right)^{1/2},
   *     \qquad e_{end} = \left|\frac{y(x_1)-y_{ref}(x_1)}
   *                                {y_{ref}(x_1)}\right| . @f]
   *
   * Both are linear between their points, so that the integrals are exact:
   * over an interval h without a point inside they are h (d_0^2 + d_0 d_1 +
   * d_1^2)/3. Few load steps therefore count as an error where the curve is
   * bent.
   *
   * Throws InputError if the ranges do not overlap or the reference vanishes.
   */
  CurveError
  compare_curves(const StudyCurve &curve, const StudyCurve &reference);

  /**
   * Which points nobody beats: no other one costs no more and errs no more,
   * one of both less. Of equal points all are on the front. Values that are
   * not finite are never on it.
   */
  std::vector<bool>
  pareto_front(const std::vector<double> &cost,
               const std::vector<double> &error);

  /// The cheapest point with an error of at most @p accuracy; -1: none.
  int
  cheapest_within(const std::vector<double> &cost,
                  const std::vector<double> &error,
                  const double               accuracy);

  /// One case of a work-precision study.
  struct WorkPoint
  {
    unsigned int group = 0; ///< which curve (shear, tension, ...)
    std::string  series;    ///< method: one symbol in the picture
    std::string  setting;   ///< all swept entries with their values
    std::string  folder;
    std::string  status;
    bool         complete = false; ///< whole curve: error and work compare
    double       cpu      = 0;     ///< [s]
    CurveError   error;
    bool         on_front = false; ///< set by write_work_precision()
  };

  /// One curve of a work-precision study.
  struct WorkGroup
  {
    std::string name;     ///< "shear"
    std::string quantity; ///< "n3(H3)"

    /// Difference of the two finest cases: what the reference itself can be
    /// wrong by; not a number if there is only one.
    double      reference_error = 0;
    double      reference_cpu   = 0;
    std::string reference_folder;
  };

  /**
   * Write the results of a work-precision study into a folder:
   * `work_precision.csv` with all points; `recommended.csv` and
   * `recommended.txt` with the cheapest setting per accuracy, for each curve
   * and, if there are several, for all of them together (the sum of the CPU
   * times against the largest error); `work_precision.gp`, `.svg` and `.png`
   * with error against CPU seconds.
   *
   * @param accuracies Relative errors, as 0.1, 0.01, 0.001.
   * @return Warning of the plotting program, or empty.
   */
  std::string
  write_work_precision(const std::string            &directory,
                       const std::vector<WorkGroup> &groups,
                       std::vector<WorkPoint>       &points,
                       const std::vector<double>    &accuracies,
                       const std::string            &title);
} // namespace NPT

#endif
