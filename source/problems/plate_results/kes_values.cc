// SPDX-License-Identifier: LGPL-2.1-or-later
// Slopes, widths and works of the curves of Kawabata's tests.

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/plate_results/driving_component.h>
#include <npt_dealii/problems/plate_results/kes_values.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace NPT
{
  namespace
  {
    constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

    // y at x on a curve of monotone x.
    double
    value_at(const TestCurve &curve, const double x)
    {
      for (std::size_t i = 1; i < curve.x.size(); ++i)
        {
          const double a = curve.x[i - 1], b = curve.x[i];
          if (a != b && (x - a) * (x - b) <= 0.)
            return curve.y[i - 1] +
                   (x - a) / (b - a) * (curve.y[i] - curve.y[i - 1]);
        }
      return not_known;
    }

    TestCurve
    part_of(const TestCurve  &curve,
            const std::size_t first,
            const std::size_t last)
    {
      TestCurve part;
      for (std::size_t i = first; i <= last; ++i)
        {
          part.x.push_back(curve.x[i]);
          part.y.push_back(curve.y[i]);
        }
      return part;
    }

    // Where the monotone branch begins that ends at a point.
    std::size_t
    begin_of_branch(const TestCurve &curve, std::size_t i)
    {
      if (i == 0)
        return 0;
      const double sign = curve.x[i] > curve.x[i - 1] ? 1. : -1.;
      while (i > 0 && sign * (curve.x[i] - curve.x[i - 1]) > 0.)
        --i;
      return i;
    }

    double
    integral(const TestCurve &curve)
    {
      double sum = 0;
      for (std::size_t i = 1; i < curve.x.size(); ++i)
        sum +=
          0.5 * (curve.y[i] + curve.y[i - 1]) * (curve.x[i] - curve.x[i - 1]);
      return sum;
    }

    // Points of y >= y_start, with the ends where the curve crosses it.
    TestCurve
    above(const TestCurve &curve, const double y_start)
    {
      TestCurve result;
      for (std::size_t i = 0; i < curve.x.size(); ++i)
        {
          if (i > 0 && (curve.y[i] - y_start) * (curve.y[i - 1] - y_start) < 0.)
            {
              const double s =
                (y_start - curve.y[i - 1]) / (curve.y[i] - curve.y[i - 1]);
              result.x.push_back(curve.x[i - 1] +
                                 s * (curve.x[i] - curve.x[i - 1]));
              result.y.push_back(y_start);
            }
          if (curve.y[i] >= y_start)
            {
              result.x.push_back(curve.x[i]);
              result.y.push_back(curve.y[i]);
            }
        }
      return result;
    }

    // The rows of some stages, with the one before them.
    std::vector<CurveRow>
    rows_of(const std::vector<CurveRow>    &curve,
            const std::vector<std::string> &stages,
            const StageStarts              &starts)
    {
      std::vector<CurveRow> rows;
      for (const CurveRow &row : curve)
        if (std::find(stages.begin(), stages.end(), row.stage) != stages.end())
          {
            const CurveRow *const before =
              rows.empty() ? row_before(curve, row.stage, starts) : nullptr;
            if (before != nullptr)
              rows.push_back(*before);
            rows.push_back(row);
          }
      return rows;
    }

    // Of a mode, or of a column that registers itself.
    double
    value_of_column(const CurveRow &row, const std::string &column)
    {
      if (MacroModes::number_of(column) < MacroModes::n)
        return curve_value(row, column);
      const auto found = row.further.find(column);
      return found == row.further.end() ? not_known : found->second;
    }

    TestCurve
    curve_of(const std::vector<CurveRow> &rows,
             const std::string           &x,
             const std::string           &y)
    {
      TestCurve curve;
      for (const CurveRow &row : rows)
        {
          const double x_value = value_of_column(row, x),
                       y_value = value_of_column(row, y);
          if (!std::isfinite(x_value) || !std::isfinite(y_value))
            continue;
          curve.x.push_back(x_value);
          curve.y.push_back(y_value);
        }
      return curve;
    }

    // n over H of the mode of a kind that is driven.
    TestCurve
    curve_of_mode(const std::vector<CurveRow> &rows,
                  bool (*is_wanted)(const MacroMode &))
    {
      unsigned int driven  = MacroModes::n;
      double       largest = 0;
      for (unsigned int k = 0; k < MacroModes::n; ++k)
        if (is_wanted(MacroModes::table[k]))
          {
            const double work = amount_of_work(rows, 0, rows.size() - 1, k);
            if (work > largest)
              {
                driven  = k;
                largest = work;
              }
          }
      if (driven == MacroModes::n)
        return {};
      return curve_of(rows,
                      MacroModes::table[driven].name,
                      MacroModes::table[driven].conjugate);
    }

    void
    add_bending(const std::vector<CurveRow> &rows,
                std::vector<KesValue>       &values)
    {
      const LoopValues loop(curve_of_mode(rows, [](const MacroMode &mode) {
        return mode.kind == MacroMode::Kind::bending;
      }));
      // The instrument goes to 2.5 /cm.
      const double      unit  = loop.amplitude() / 2.5;
      const double      B     = loop.slope(0.5 * unit, 1.5 * unit);
      const double      width = loop.width(unit);
      const std::string at = short_number(unit / KesUnits::per_cm, 3) + " /cm";
      values.push_back({"B",
                        B,
                        "N mm",
                        B / KesUnits::gf_cm2_per_cm,
                        "gf cm^2/cm",
                        "bending rigidity"});
      values.push_back({"2HB",
                        width,
                        "N",
                        width / KesUnits::gf_cm_per_cm,
                        "gf cm/cm",
                        "hysteresis of the moment at " + at});
    }

    void
    add_shear(const std::vector<CurveRow> &rows, std::vector<KesValue> &values)
    {
      const LoopValues loop(curve_of(rows, "shear_angle", "frame_force"));
      const double     G = loop.slope(0.5, 2.5);
      values.push_back({"G",
                        G,
                        "N/mm/degree",
                        G / KesUnits::gf_per_cm,
                        "gf/cm/degree",
                        "shear stiffness from 0.5 to 2.5 degrees"});
      for (const auto &[name, angle] :
           {std::make_pair("2HG", 0.5), std::make_pair("2HG5", 5.)})
        {
          const double width = loop.width(angle);
          values.push_back({name,
                            width,
                            "N/mm",
                            width / KesUnits::gf_per_cm,
                            "gf/cm",
                            "hysteresis of the shear force at " +
                              short_number(angle) + " degrees"});
        }
    }

    void
    add_tension(const std::vector<CurveRow> &rows,
                std::vector<KesValue>       &values)
    {
      const TestCurve curve = curve_of_mode(rows, [](const MacroMode &mode) {
        return mode.is_extension();
      });
      if (curve.x.empty())
        return;
      const CycleValues cycle(curve, 0.);
      const double      EMT = 100. * (cycle.x_end - cycle.x_start);
      values.push_back(
        {"EMT", EMT, "%", EMT, "%", "strain at the largest tension"});
      values.push_back({"LT",
                        cycle.linearity,
                        "-",
                        cycle.linearity,
                        "-",
                        "linearity of tension"});
      values.push_back({"WT",
                        cycle.work,
                        "N/mm",
                        cycle.work / KesUnits::gf_cm_per_cm2,
                        "gf cm/cm^2",
                        "work of tension per area"});
      values.push_back({"RT",
                        cycle.resilience,
                        "%",
                        cycle.resilience,
                        "%",
                        "resilience of tension"});
    }

    void
    add_compression(const std::vector<CurveRow> &rows,
                    std::vector<KesValue>       &values)
    {
      const TestCurve curve = curve_of(rows, "plate_distance", "pressure");
      if (curve.x.empty())
        return;
      // Work is done by plates that come nearer.
      TestCurve closing = curve;
      for (double &x : closing.x)
        x = -x;
      const CycleValues cycle(closing, 0.5 * KesUnits::gf_per_cm2);
      const double      T0 = -cycle.x_start, Tm = -cycle.x_end;
      values.push_back({"T0", T0, "mm", T0, "mm", "thickness at 0.5 gf/cm^2"});
      values.push_back(
        {"Tm", Tm, "mm", Tm, "mm", "thickness at the largest pressure"});
      values.push_back({"LC",
                        cycle.linearity,
                        "-",
                        cycle.linearity,
                        "-",
                        "linearity of compression"});
      values.push_back({"WC",
                        cycle.work,
                        "N/mm",
                        cycle.work / KesUnits::gf_cm_per_cm2,
                        "gf cm/cm^2",
                        "work of compression per area"});
      values.push_back({"RC",
                        cycle.resilience,
                        "%",
                        cycle.resilience,
                        "%",
                        "resilience of compression"});
    }
  } // namespace



  void
  KesParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "KES");
    const auto                add = [&](const std::string        &test,
                         std::vector<std::string> &stages,
                         const std::string        &text) {
      add_parameter(prm,
                    test + " stages",
                    stages,
                    text + " Written to kes.csv and the log. Empty: no such "
                                          "test.");
    };
    add("Bending",
        bending,
        "Stages that bend the fabric to a curvature, to its opposite and back: "
        "B, 2HB.");
    add("Shear",
        shear,
        "Stages that shear the fabric to an angle, to its opposite and back: "
        "G, 2HG, 2HG5.");
    add("Tension",
        tension,
        "Stages that stretch the fabric and let it go: EMT, LT, WT, RT.");
    add("Compression",
        compression,
        "Stages that press the fabric between plates and let it go: T0, Tm, "
        "LC, WC, RC.");
  }



  std::vector<std::pair<std::string, std::string>>
  KesParameters::stages() const
  {
    std::vector<std::pair<std::string, std::string>> result;
    const auto add = [&](const std::vector<std::string> &names,
                         const std::string              &entry) {
      for (const std::string &name : names)
        result.emplace_back(name, entry);
    };
    add(bending, "Bending stages");
    add(shear, "Shear stages");
    add(tension, "Tension stages");
    add(compression, "Compression stages");
    return result;
  }



  LoopValues::LoopValues(const TestCurve &curve)
  {
    if (curve.x.size() < 3)
      return;
    const std::size_t end  = curve.x.size() - 1;
    const std::size_t turn = begin_of_branch(curve, end);
    first_                 = part_of(curve, begin_of_branch(curve, turn), turn);
    second_                = part_of(curve, turn, end);
    amplitude_ = std::min(std::abs(curve.x[turn]), std::abs(curve.x[end]));
  }



  double
  LoopValues::slope(const double x1, const double x2) const
  {
    double sum = 0;
    for (const TestCurve *branch : {&first_, &second_})
      for (const double sign : {1., -1.})
        sum += 0.25 * sign *
               (value_at(*branch, sign * x2) - value_at(*branch, sign * x1)) /
               (x2 - x1);
    return sum;
  }



  double
  LoopValues::width(const double x) const
  {
    double sum = 0;
    for (const double sign : {1., -1.})
      sum += 0.5 *
             std::abs(value_at(first_, sign * x) - value_at(second_, sign * x));
    return sum;
  }



  CycleValues::CycleValues(const TestCurve &curve, const double y_start)
    : x_start(not_known)
    , x_end(not_known)
    , y_largest(not_known)
    , work(not_known)
    , linearity(not_known)
    , resilience(not_known)
  {
    const std::size_t top =
      std::max_element(curve.y.begin(), curve.y.end()) - curve.y.begin();
    if (top == curve.y.size())
      return;
    const TestCurve loading = above(part_of(curve, 0, top), y_start);
    const TestCurve unloading =
      above(part_of(curve, top, curve.y.size() - 1), y_start);
    if (loading.x.size() < 2)
      return;
    x_end     = loading.x.back();
    y_largest = loading.y.back();
    // A curve that begins above y_start has missed the begin of the test, one
    // that ends above it the end.
    const auto is_at_start = [&](const double y) {
      return y - y_start <= 1e-3 * y_largest;
    };
    if (!is_at_start(loading.y.front()))
      return;
    x_start   = loading.x.front();
    work      = integral(loading);
    linearity = 2. * work / (y_largest * std::abs(x_end - x_start));
    if (unloading.x.size() > 1 && is_at_start(unloading.y.back()))
      resilience = -100. * integral(unloading) / work;
  }



  std::vector<KesValue>
  kes_values(const std::vector<CurveRow> &curve,
             const KesParameters         &parameters,
             const StageStarts           &starts)
  {
    std::vector<KesValue> values;
    const auto            add = [&](const std::vector<std::string> &stages,
                         void (*of_rows)(const std::vector<CurveRow> &,
                                         std::vector<KesValue> &)) {
      const std::vector<CurveRow> rows = rows_of(curve, stages, starts);
      if (rows.size() > 1)
        of_rows(rows, values);
    };
    add(parameters.bending, add_bending);
    add(parameters.shear, add_shear);
    add(parameters.tension, add_tension);
    add(parameters.compression, add_compression);
    return values;
  }



  std::string
  describe(const std::vector<KesValue> &values)
  {
    std::string text;
    for (const KesValue &value : values)
      text += (text.empty() ? "KES: " : ", ") + value.name + " = " +
              (std::isfinite(value.kes_value) ?
                 short_number(value.kes_value, 4) +
                   (value.kes_unit == "-" ? "" : " " + value.kes_unit) :
                 std::string("not reached"));
    return text;
  }



  void
  write_kes_values(const std::string           &filename,
                   const std::vector<KesValue> &values)
  {
    TableWriter table(
      filename,
      {"name", "value", "unit", "KES value", "KES unit", "meaning"},
      {"Characteristic values after Kawabata, in mm and N and in the units of "
       "the instruments."});
    for (const KesValue &value : values)
      table.add_row({value.name,
                     value.value,
                     value.unit,
                     value.kes_value,
                     value.kes_unit,
                     value.meaning});
  }
} // namespace NPT
