// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the error bars of a plate test: what further, cheaper runs say about
// the curve of a run.

#ifndef npt_dealii_problems_accuracy_error_bars_h
#define npt_dealii_problems_accuracy_error_bars_h

#include <npt_dealii/problems/load_programme/load_programme.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>

#include <array>
#include <string>
#include <vector>

namespace NPT
{
  /// What a load stage answers to one driven component: the resultant of a
  /// prescribed gradient, or the gradient of a prescribed resultant.
  struct AnswerCurve
  {
    std::string         stage;
    std::string         driven; ///< column of the driven component, "H3"
    std::string         answer; ///< column of its conjugate, "n3"
    std::vector<double> load_factor, x, y; ///< by accepted step
  };

  /// One curve for every component that a load stage changes. Stages without
  /// an accepted step, and components that stay where they are, have none.
  std::vector<AnswerCurve>
  answer_curves(const std::vector<LoadStage> &stages,
                const std::vector<CurveRow>  &rows);

  /// Where errors come from, in the order of ErrorBars::parts.
  enum class ErrorSource
  {
    mesh,    ///< elements along and across
    layers,  ///< elements through the thickness
    penalty, ///< both penalties of contact
    step     ///< length of the load steps
  };
  constexpr unsigned int n_error_sources = 4;

  /// Runs that differ from a setting in one respect.
  template <typename T>
  struct Probes
  {
    T main;         ///< the setting itself
    T coarse;       ///< the same on the next coarser mesh
    T base;         ///< on a coarse mesh, from which the following differ
    T more_layers;  ///< one element more through the thickness
    T soft_contact; ///< penalties divided by `penalty_ratio`
    T long_steps;   ///< twice the load step
  };
  constexpr double penalty_ratio    = 3.;
  constexpr double factor_of_safety = 1.25;

  /**
   * A curve with its error bar. At every step of the main run
   *
   * @f[ y = y_{main} + \frac{y_{base} - y_{soft}}{r - 1}, \qquad
   *     e = 1.25 \sum_s e_s , @f]
   *
   * because the error by a penalty is proportional to its inverse; r is
   * penalty_ratio. The parts are e_mesh = |y_main - y_coarse|, e_layers =
   * |y_layers - y_base|, e_penalty = half of the correction, and e_step =
   * |y_long - y_base|, each the largest at the step and its two neighbors:
   * two curves that cross are not exact where they cross. e_mesh is what
   * Richardson's extrapolation would give for an error of second order if the
   * coarser mesh has 1.4 times larger elements; the mesh is not extrapolated,
   * because the edge of the contact zone makes errors scatter. Steps of other
   * runs that lie between those of the main run are interpolated. 1.25 is the
   * factor of safety of Roache's grid convergence index (Journal of Fluids
   * Engineering 116, 1994, 405).
   */
  struct ErrorBars
  {
    AnswerCurve                                      main;
    std::vector<double>                              value, bar;
    std::array<std::vector<double>, n_error_sources> parts;
    /// L2 norm of the bar and of its parts (these without the factor) over the
    /// load factor, relative to that of value.
    double                              relative = 0;
    std::array<double, n_error_sources> relative_parts{};
  };

  /// @param curves The same answer in all runs, over the whole stage; the part
  ///   that all have reached counts.
  ErrorBars
  estimate_errors(const Probes<AnswerCurve> &curves);
} // namespace NPT

#endif
