// SPDX-License-Identifier: LGPL-2.1-or-later
// Error bars from the differences of runs.

#include <npt_dealii/problems/accuracy/error_bars.h>
#include <npt_dealii/problems/plate_results/stage_starts.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NPT
{
  namespace
  {
    // Value at a load factor, linear between steps.
    double
    interpolate(const AnswerCurve &curve, const double load_factor)
    {
      const auto &t = curve.load_factor;
      const auto  i = std::lower_bound(t.begin(), t.end(), load_factor);
      if (i == t.begin())
        return curve.y.front();
      if (i == t.end())
        return curve.y.back();
      const std::size_t k = i - t.begin();
      const double      s = (load_factor - t[k - 1]) / (t[k] - t[k - 1]);
      return (1. - s) * curve.y[k - 1] + s * curve.y[k];
    }

    // The largest of each value and its neighbors.
    std::vector<double>
    envelope(const std::vector<double> &values)
    {
      std::vector<double> result(values);
      for (std::size_t i = 0; i < values.size(); ++i)
        {
          if (i > 0)
            result[i] = std::max(result[i], values[i - 1]);
          if (i + 1 < values.size())
            result[i] = std::max(result[i], values[i + 1]);
        }
      return result;
    }

    // L2 norm over the load factor by the trapezoidal rule.
    double
    norm(const std::vector<double> &t, const std::vector<double> &values)
    {
      double square = 0;
      for (std::size_t i = 1; i < t.size(); ++i)
        square += 0.5 * (t[i] - t[i - 1]) *
                  (values[i] * values[i] + values[i - 1] * values[i - 1]);
      return std::sqrt(square);
    }

    // The column that answers a target in the terms of testers; empty for those
    // that accompany another one.
    std::string
    answer_to(const std::string &target)
    {
      return target == "shear_angle"    ? "shear_torque" :
             target == "bias_stretch"   ? "bias_force" :
             target == "plate_distance" ? "pressure" :
             target == "pressure"       ? "plate_distance" :
                                          "";
    }
  } // namespace



  std::vector<AnswerCurve>
  answer_curves(const std::vector<LoadStage> &stages,
                const std::vector<CurveRow>  &rows)
  {
    std::vector<AnswerCurve> result;
    for (const LoadStage &stage : stages)
      {
        if (!stage.is_test())
          continue;
        const auto first =
          std::find_if(rows.begin(), rows.end(), [&](const CurveRow &row) {
            return row.stage == stage.name;
          });
        if (first == rows.end())
          continue;
        const CurveRow *const start_row =
          row_before(rows,
                     stage.name,
                     stage.start.empty() ?
                       StageStarts() :
                       StageStarts{{stage.name, stage.start}});
        const CurveRow before = start_row == nullptr ? CurveRow() : *start_row;
        const auto     add    = [&](const std::string &driven,
                             const std::string &answer,
                             const double       target) {
          AnswerCurve curve;
          curve.stage  = stage.name;
          curve.driven = driven;
          curve.answer = answer;
          // A resultant that is held is so to the tolerance of Newton's method.
          if (std::abs(curve_value(before, curve.driven) - target) <=
              1e-4 * std::abs(target))
            return;
          for (auto row = first; row != rows.end() && row->stage == stage.name;
               ++row)
            {
              curve.load_factor.push_back(row->load_factor);
              curve.x.push_back(curve_value(*row, curve.driven));
              curve.y.push_back(curve_value(*row, curve.answer));
            }
          result.push_back(curve);
        };
        for (const auto &[name, target] : stage.tester_targets)
          if (const std::string answer = answer_to(name); !answer.empty())
            add(name, answer, target);
        if (stage.leads_yarns()) // H follows
          continue;
        for (const auto &[n, target] : stage.H_targets)
          add(MacroModes::table[n].name,
              MacroModes::table[n].conjugate,
              target);
        for (const auto &[n, target] : stage.n_targets)
          if (target != 0.)
            add(MacroModes::table[n].conjugate,
                MacroModes::table[n].name,
                target);
      }
    return result;
  }



  ErrorBars
  estimate_errors(const Probes<AnswerCurve> &curves)
  {
    ErrorBars result;
    result.main = curves.main;
    double end  = 1e300;
    for (const AnswerCurve *curve : {&curves.main,
                                     &curves.coarse,
                                     &curves.base,
                                     &curves.more_layers,
                                     &curves.soft_contact,
                                     &curves.long_steps})
      end = std::min(end, curve->load_factor.back());
    std::size_t n = 0;
    while (n < curves.main.load_factor.size() &&
           curves.main.load_factor[n] <= end * (1. + 1e-9))
      ++n;
    for (auto *column :
         {&result.main.load_factor, &result.main.x, &result.main.y})
      column->resize(n);

    auto &[mesh, layers, penalty, step] = result.parts;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double t    = result.main.load_factor[i];
        const double base = interpolate(curves.base, t);
        const double correction =
          (base - interpolate(curves.soft_contact, t)) / (penalty_ratio - 1.);
        result.value.push_back(result.main.y[i] + correction);
        mesh.push_back(
          std::abs(result.main.y[i] - interpolate(curves.coarse, t)));
        layers.push_back(std::abs(interpolate(curves.more_layers, t) - base));
        penalty.push_back(0.5 * std::abs(correction));
        // Between its own steps a longer step would be compared with a chord.
        const auto &own = curves.long_steps.load_factor;
        const bool  met =
          std::any_of(own.begin(), own.end(), [&](const double other) {
            return std::abs(other - t) < 1e-9;
          });
        step.push_back(
          met ? std::abs(interpolate(curves.long_steps, t) - base) : 0.);
      }

    result.bar.assign(n, 0.);
    // An answer that vanishes has no relative error that could be met.
    const double size = std::max(norm(result.main.load_factor, result.value),
                                 std::numeric_limits<double>::min());
    for (unsigned int s = 0; s < n_error_sources; ++s)
      {
        result.parts[s] = envelope(result.parts[s]);
        for (std::size_t i = 0; i < n; ++i)
          result.bar[i] += factor_of_safety * result.parts[s][i];
        result.relative_parts[s] =
          norm(result.main.load_factor, result.parts[s]) / size;
      }
    result.relative = norm(result.main.load_factor, result.bar) / size;
    return result;
  }
} // namespace NPT
