// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the characteristic values of Kawabata's tests, from the curves of a
// run.

#ifndef npt_dealii_problems_plate_results_kes_values_h
#define npt_dealii_problems_plate_results_kes_values_h

#include <npt_dealii/problems/plate_results/stage_starts.h>

#include <deal.II/base/parameter_handler.h>

#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "KES": which stages are which test of Kawabata's evaluation
  /// system; none by default.
  struct KesParameters
  {
    std::vector<std::string> bending, shear, tension, compression;

    void
    add_parameters(dealii::ParameterHandler &prm);
    /// All names, with the entry that has them.
    std::vector<std::pair<std::string, std::string>>
    stages() const;
  };

  /// A measured curve, in the order of time.
  struct TestCurve
  {
    std::vector<double> x, y;
  };

  /// Units of the instruments, in mm, N and degrees.
  namespace KesUnits
  {
    constexpr double gf            = 0.00980665;      ///< [N]
    constexpr double gf_per_cm     = gf / 10.;        ///< [N/mm]
    constexpr double gf_per_cm2    = gf / 100.;       ///< [MPa]
    constexpr double gf_cm_per_cm  = gf;              ///< moment [N]
    constexpr double gf_cm2_per_cm = 10. * gf;        ///< B [N mm]
    constexpr double gf_cm_per_cm2 = 10. * gf / 100.; ///< work [N/mm]
    constexpr double per_cm        = 0.1;             ///< curvature [1/mm]
  }                                                   // namespace KesUnits

  /**
   * Both branches of a loop between -A and A. With y^+ and y^- on the branches
   * of growing and falling x,
   *
   * @f[ G = \frac{1}{4} \sum_{\pm, branches}
   *         \frac{y(\pm x_2) - y(\pm x_1)}{\pm (x_2 - x_1)}, \qquad
   *     2HG(x) = \frac{1}{2} \sum_{\pm} |y^+(\pm x) - y^-(\pm x)| . @f]
   *
   * The last two branches of the curve count, so that one that begins at rest
   * needs three: to A, to -A, and back to A. Values that the curve does not
   * reach are not numbers.
   */
  class LoopValues
  {
  public:
    explicit LoopValues(const TestCurve &curve);

    double
    slope(const double x1, const double x2) const;
    double
    width(const double x) const;
    double
    amplitude() const
    {
      return amplitude_;
    }

  private:
    TestCurve first_, second_; // branches
    double    amplitude_ = 0;
  };

  /**
   * Loading to the largest y and back:
   *
   * @f[ W = \int_{loading} y \, dx, \quad W' = - \int_{unloading} y \, dx,
   *     \qquad L = \frac{2 W}{y_m |x_m - x_0|}, \quad R = 100 \frac{W'}{W} .
   * @f]
   */
  struct CycleValues
  {
    double x_start;    ///< x_0
    double x_end;      ///< x_m, at the largest y
    double y_largest;  ///< y_m
    double work;       ///< W
    double linearity;  ///< L [-]
    double resilience; ///< R [%]; not a number without unloading

    /// @param y_start Where the test begins: parts of the curve with smaller y
    ///   do not count.
    CycleValues(const TestCurve &curve, const double y_start);
  };

  /// A line of kes.csv.
  struct KesValue
  {
    std::string name; ///< "2HG5"
    double      value;
    std::string unit; ///< in mm, N
    double      kes_value;
    std::string kes_unit;
    std::string meaning;
  };

  /**
   * The values of all tests that the parameters name:
   *
   * | test | curve | values |
   * | --- | --- | --- |
   * | bending | n over H of the mode that bends | B: slope from .05 to .15 /mm;
   * 2HB: width at .1 /mm |
   * | shear | F_sh over g | G: slope from .5 to 2.5 degrees; 2HG, 2HG5: width
   * at .5 and 5 degrees |
   * | tension | n over H of the mode that stretches | EMT, LT, WT, RT |
   * | compression | pressure over the distance of the plates | T0 at .5
   * gf/cm^2, Tm at the largest pressure, LC, WC, RC |
   *
   * A bending test to another amplitude than .25 /mm has its curvatures at the
   * same fractions of it. Reference: S. Kawabata, The Standardization and
   * Analysis of Hand Evaluation, 2nd ed., The Textile Machinery Society of
   * Japan, 1980.
   */
  std::vector<KesValue>
  kes_values(const std::vector<CurveRow> &curve,
             const KesParameters         &parameters,
             const StageStarts           &starts = {});

  /// One sentence for the log: "KES: B = ...".
  std::string
  describe(const std::vector<KesValue> &values);

  void
  write_kes_values(const std::string           &filename,
                   const std::vector<KesValue> &values);
} // namespace NPT

#endif
