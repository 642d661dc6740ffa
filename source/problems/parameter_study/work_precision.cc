// SPDX-License-Identifier: LGPL-2.1-or-later
// Error norms of curves, Pareto fronts, tables and the picture.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/parameter_study/work_precision.h>
#include <npt_dealii/problems/plate_results/study_plots.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <map>
#include <ostream>
#include <sstream>

namespace NPT
{
  namespace
  {
    // Linear between points; x inside their range.
    double
    interpolate(const std::vector<double> &x,
                const std::vector<double> &y,
                const double               at)
    {
      const std::size_t i = std::clamp<std::ptrdiff_t>(
        std::upper_bound(x.begin(), x.end(), at) - x.begin(), 1, x.size() - 1);
      const double t = (at - x[i - 1]) / (x[i] - x[i - 1]);
      return (1 - t) * y[i - 1] + t * y[i];
    }

    // A curve towards negative x is read in its mirror.
    StudyCurve
    increasing(StudyCurve curve)
    {
      if (curve.x.size() < 2)
        throw InputError("A curve needs two points to be compared.");
      if (curve.x.back() < curve.x.front())
        for (double &x : curve.x)
          x = -x;
      for (std::size_t i = 1; i < curve.x.size(); ++i)
        if (!(curve.x[i - 1] < curve.x[i]))
          throw InputError("A curve can only be compared if its abscissa "
                           "increases or decreases strictly.");
      return curve;
    }

    std::string
    percent(const double value)
    {
      if (std::isnan(value))
        return "unknown";
      return short_number(std::round(value * 1e4) / 100 != 0 ?
                            std::round(value * 1e5) / 1000 :
                            value * 100) +
             " %";
    }
  } // namespace



  std::vector<CurveRow>
  stage_rows(const std::vector<CurveRow> &rows,
             const std::string           &stage,
             const StageStarts           &starts)
  {
    std::vector<CurveRow> result;
    for (const CurveRow &row : rows)
      if (row.stage == stage)
        {
          if (result.empty())
            {
              const CurveRow *const before = row_before(rows, stage, starts);
              result.push_back(before == nullptr ? CurveRow() : *before);
            }
          result.push_back(row);
        }
    return result;
  }



  StudyCurve
  stage_curve(const std::vector<CurveRow> &rows,
              const std::string           &stage,
              const std::string           &x_column,
              const std::string           &y_column,
              const StageStarts           &starts)
  {
    StudyCurve curve;
    for (const CurveRow &row : stage_rows(rows, stage, starts))
      {
        curve.x.push_back(curve_value(row, x_column));
        curve.y.push_back(curve_value(row, y_column));
      }
    if (curve.x.size() < 2)
      throw InputError("The stage '" + stage + "' has no accepted load step.");
    const double sign = curve.x.back() < curve.x.front() ? -1 : 1;
    for (std::size_t i = 1; i < curve.x.size(); ++i)
      if (!(sign * curve.x[i - 1] < sign * curve.x[i]))
        throw InputError("In the stage '" + stage + "' " + x_column +
                         " does not increase or decrease all the time, so that "
                         "it cannot be the abscissa of a curve.");
    return curve;
  }



  CurveError
  compare_curves(const StudyCurve &given, const StudyCurve &given_reference)
  {
    const StudyCurve curve     = increasing(given),
                     reference = increasing(given_reference);
    const double begin         = std::max(curve.x.front(), reference.x.front()),
                 end           = std::min(curve.x.back(), reference.x.back());
    if (!(begin < end))
      throw InputError("The curve and its reference have no common range.");

    std::vector<double> x = {begin, end};
    for (const StudyCurve *c : {&curve, &reference})
      for (const double xi : c->x)
        if (begin < xi && xi < end)
          x.push_back(xi);
    std::sort(x.begin(), x.end());

    const auto integral = [](const double h, const double a, const double b) {
      return h * (a * a + a * b + b * b) / 3;
    };
    double difference = 0, norm = 0, d0 = 0, r0 = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      {
        const double r1 = interpolate(reference.x, reference.y, x[i]),
                     d1 = interpolate(curve.x, curve.y, x[i]) - r1;
        if (i > 0)
          {
            difference += integral(x[i] - x[i - 1], d0, d1);
            norm += integral(x[i] - x[i - 1], r0, r1);
          }
        d0 = d1;
        r0 = r1;
      }
    if (!(norm > 0))
      throw InputError("The reference curve vanishes, so that no relative "
                       "error can be given.");
    CurveError result;
    result.l2 = std::sqrt(difference / norm);
    result.end =
      r0 != 0 ? std::abs(d0 / r0) : std::numeric_limits<double>::quiet_NaN();
    result.range = (end - begin) / (reference.x.back() - reference.x.front());
    return result;
  }



  std::vector<bool>
  pareto_front(const std::vector<double> &cost,
               const std::vector<double> &error)
  {
    const auto is_point = [&](const std::size_t i) {
      return std::isfinite(cost[i]) && std::isfinite(error[i]);
    };
    std::vector<bool> result(cost.size(), false);
    for (std::size_t i = 0; i < cost.size(); ++i)
      {
        result[i] = is_point(i);
        for (std::size_t j = 0; j < cost.size() && result[i]; ++j)
          if (is_point(j) && cost[j] <= cost[i] && error[j] <= error[i] &&
              (cost[j] < cost[i] || error[j] < error[i]))
            result[i] = false;
      }
    return result;
  }



  int
  cheapest_within(const std::vector<double> &cost,
                  const std::vector<double> &error,
                  const double               accuracy)
  {
    int best = -1;
    for (std::size_t i = 0; i < cost.size(); ++i)
      if (std::isfinite(cost[i]) && error[i] <= accuracy &&
          (best < 0 || cost[i] < cost[best] ||
           (cost[i] == cost[best] && error[i] < error[best])))
        best = i;
    return best;
  }



  namespace
  {
    constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

    // Costs and errors of one group; not a number where a case cannot be
    // compared or belongs to another group.
    void
    costs_and_errors(const std::vector<WorkPoint> &points,
                     const unsigned int            group,
                     std::vector<double>          &cost,
                     std::vector<double>          &error)
    {
      cost.clear();
      error.clear();
      for (const WorkPoint &point : points)
        {
          const bool counts = point.group == group && point.complete;
          cost.push_back(counts ? point.cpu : not_a_number);
          error.push_back(counts ? point.error.l2 : not_a_number);
        }
    }

    struct Recommendation
    {
      std::string curve, setting, folder, remark;
      double      accuracy, error = not_a_number, end_error = not_a_number,
                       cpu = not_a_number, reference_error = not_a_number;
    };

    // The reference must be clearly better than what it judges.
    std::string
    remark_on_reference(const double accuracy, const double of_reference)
    {
      return of_reference > 0.5 * accuracy ?
               "the reference itself is uncertain by " + percent(of_reference) :
               std::string();
    }

    Recommendation
    recommend_for_curve(const std::vector<WorkPoint> &points,
                        const WorkGroup              &group,
                        const unsigned int            g,
                        const double                  accuracy)
    {
      std::vector<double> cost, error;
      costs_and_errors(points, g, cost, error);
      const int      best = cheapest_within(cost, error, accuracy);
      Recommendation r;
      r.curve    = group.name;
      r.accuracy = accuracy;
      r.remark   = remark_on_reference(accuracy, group.reference_error);
      r.setting  = "none of the cases";

      r.reference_error = group.reference_error;
      if (best >= 0)
        {
          r.setting   = points[best].setting;
          r.folder    = points[best].folder;
          r.error     = points[best].error.l2;
          r.end_error = points[best].error.end;
          r.cpu       = points[best].cpu;
        }
      return r;
    }

    // One setting for all curves: sum of the work, largest error.
    Recommendation
    recommend_for_all(const std::vector<WorkPoint> &points,
                      const std::size_t             n_groups,
                      const double                  accuracy,
                      const double                  uncertainty)
    {
      struct Sum
      {
        unsigned int n   = 0;
        double       cpu = 0, error = 0, end = 0;
      };
      std::map<std::string, Sum> sums;
      for (const WorkPoint &point : points)
        if (point.complete)
          {
            Sum &sum = sums[point.setting];
            ++sum.n;
            sum.cpu += point.cpu;
            sum.error = std::max(sum.error, point.error.l2);
            sum.end   = std::max(sum.end, point.error.end);
          }
      Recommendation r;
      r.curve    = "all";
      r.accuracy = accuracy;
      r.setting  = "none of the cases";
      r.remark   = remark_on_reference(accuracy, uncertainty);

      r.reference_error = uncertainty;
      for (const auto &[setting, sum] : sums)
        if (sum.n == n_groups && sum.error <= accuracy && !(r.cpu <= sum.cpu))
          {
            r.setting   = setting;
            r.cpu       = sum.cpu;
            r.error     = sum.error;
            r.end_error = sum.end;
          }
      return r;
    }

    std::vector<Recommendation>
    recommend(const std::vector<WorkGroup> &groups,
              const std::vector<WorkPoint> &points,
              const std::vector<double>    &accuracies)
    {
      std::vector<Recommendation> result;
      for (const double accuracy : accuracies)
        {
          double uncertainty = 0;
          for (unsigned int g = 0; g < groups.size(); ++g)
            {
              uncertainty = std::max(uncertainty, groups[g].reference_error);
              result.push_back(
                recommend_for_curve(points, groups[g], g, accuracy));
            }
          if (groups.size() > 1)
            result.push_back(
              recommend_for_all(points, groups.size(), accuracy, uncertainty));
        }
      return result;
    }



    void
    write_point_table(const std::string              &directory,
                      const std::vector<WorkGroup>   &groups,
                      const std::vector<WorkPoint>   &points,
                      const std::vector<std::string> &series)
    {
      TableWriter table(
        directory + "/work_precision.csv",
        {"group",
         "series",
         "cpu_seconds",
         "error",
         "end_error",
         "range",
         "on_front",
         "curve",
         "case",
         "status",
         "method",
         "setting"},
        {"Error of the curve, relative L2 norm over the common range with the "
         "reference, and at its end, against CPU seconds of the whole run. "
         "Cases that did not reach the end have no error."});
      for (const WorkPoint &point : points)
        table.add_row({point.group,
                       static_cast<unsigned int>(
                         std::find(series.begin(), series.end(), point.series) -
                         series.begin()),
                       point.cpu,
                       point.complete ? point.error.l2 : not_a_number,
                       point.complete ? point.error.end : not_a_number,
                       point.error.range,
                       point.on_front ? 1 : 0,
                       groups[point.group].name,
                       point.folder,
                       point.status,
                       point.series,
                       point.setting});
    }

    void
    write_front_table(const std::string            &directory,
                      const std::vector<WorkGroup> &groups,
                      const std::vector<WorkPoint> &points)
    {
      TableWriter table(
        directory + "/pareto_front.csv",
        {"group", "cpu_seconds", "error", "curve", "case", "setting"},
        {"The cases that nobody beats, by CPU seconds."});
      std::vector<const WorkPoint *> front;
      for (const WorkPoint &point : points)
        if (point.on_front)
          front.push_back(&point);
      std::sort(front.begin(),
                front.end(),
                [](const WorkPoint *a, const WorkPoint *b) {
                  return a->group != b->group ? a->group < b->group :
                                                a->cpu < b->cpu;
                });
      for (const WorkPoint *point : front)
        table.add_row({point->group,
                       point->cpu,
                       point->error.l2,
                       groups[point->group].name,
                       point->folder,
                       point->setting});
    }

    void
    write_recommendations(const std::string                 &directory,
                          const std::vector<WorkGroup>      &groups,
                          const std::vector<Recommendation> &recommendations)
    {
      TableWriter        table(directory + "/recommended.csv",
                        {"accuracy",
                                "curve",
                                "cpu_seconds",
                                "error",
                                "end_error",
                                "reference_error",
                                "case",
                                "setting",
                                "remark"},
                        {"The cheapest setting whose error is within the "
                                       "accuracy; 'all': one setting for all curves, CPU "
                                       "seconds together, largest error. Error of the "
                                       "reference: the difference of the two finest."});
      std::ostringstream text;
      text << "Recommended settings: the cheapest within each accuracy "
              "(relative L2 error of the curve).\n\n";
      for (const WorkGroup &group : groups)
        text << group.name << ", " << group.quantity << ": reference "
             << group.reference_folder << ", " << group.reference_cpu
             << " s; the two finest differ by "
             << percent(group.reference_error) << "\n";
      for (const Recommendation &r : recommendations)
        {
          table.add_row({r.accuracy,
                         r.curve,
                         r.cpu,
                         r.error,
                         r.end_error,
                         r.reference_error,
                         r.folder,
                         r.setting,
                         r.remark});
          text << '\n'
               << percent(r.accuracy) << ", " << r.curve << ": " << r.setting;
          if (r.cpu == r.cpu)
            text << "\n  " << r.cpu << " s, error " << percent(r.error)
                 << ", at the end " << percent(r.end_error);
          if (!r.remark.empty())
            text << "\n  (" << r.remark << ")";
          text << '\n';
        }
      replace_file(directory + "/recommended.txt",
                   [&](std::ostream &out) { out << text.str(); });
    }



    // The picture: one panel per group, error over CPU time.
    class WorkPrecisionPicture
    {
    public:
      WorkPrecisionPicture(const std::vector<WorkGroup>   &groups,
                           const std::vector<WorkPoint>   &points,
                           const std::vector<double>      &accuracies,
                           const std::vector<std::string> &series)
        : groups_(groups)
        , points_(points)
        , accuracies_(accuracies)
        , series_(series)
        // With several panels one legend in a place of its own, behind the
        // last.
        , own_legend_(groups.size() > 1)
      {}

      std::string
      draw(const std::string &directory, const std::string &title) const
      {
        const unsigned int n_places  = groups_.size() + (own_legend_ ? 1 : 0);
        const unsigned int n_columns = std::min(n_places, 2u);
        const unsigned int n_rows    = (n_places + n_columns - 1) / n_columns;
        const unsigned int n_series  = series_.size();
        return draw_picture(directory,
                            "work_precision",
                            title,
                            n_rows,
                            n_columns,
                            n_columns == 1 ? 760 : 620,
                            420 + (own_legend_ ? 0 : 18 * n_series),
                            [&](std::ostream &out) {
                              write_frame(out);
                              for (unsigned int g = 0; g < groups_.size(); ++g)
                                write_panel(out, g);
                              if (own_legend_)
                                write_legend(out);
                            });
      }

    private:
      void
      write_frame(std::ostream &out) const
      {
        std::size_t longest = 0;
        for (const std::string &name : series_)
          longest = std::max(longest, name.size());
        out << "  set logscale xy\n  set format '%g'\n"
            << "  set format y '10^{%T}'\n"
            << (own_legend_ ? "  unset key\n" :
                              "  set key below maxcols " +
                                std::to_string(longest > 30 ? 1 : 2) +
                                " reverse Left samplen 1 noenhanced font "
                                "',10'\n")
            << "  set xlabel 'CPU time [s]'\n"
            << "  set ylabel 'relative L2 error [-]'\n";
      }

      // All points and levels inside, with a margin.
      void
      write_ranges(std::ostream &out, const unsigned int g) const
      {
        double     cpu[2] = {1e300, 0}, errors[2] = {1e300, 0};
        const auto widen = [](double(&range)[2], const double value) {
          if (!(value > 0))
            return;
          range[0] = std::min(range[0], value);
          range[1] = std::max(range[1], value);
        };
        for (const WorkPoint &point : points_)
          if (point.group == g && point.complete)
            {
              widen(cpu, point.cpu);
              widen(errors, point.error.l2);
            }
        for (const double accuracy : accuracies_)
          widen(errors, accuracy);
        widen(errors, groups_[g].reference_error);
        if (cpu[0] < cpu[1])
          out << "  set xrange [" << 0.8 * cpu[0] << ":" << 1.25 * cpu[1]
              << "]\n";
        else
          out << "  set xrange [*:*]\n";
        out << "  set yrange [" << 0.6 * errors[0] << ":" << 1.6 * errors[1]
            << "]\n";
      }

      static void
      write_level(std::ostream      &out,
                  const double       value,
                  const std::string &text,
                  const std::string &place,
                  const std::string &style)
      {
        out << "  set arrow from graph 0, first " << value
            << " to graph 1, first " << value << " nohead back " << style
            << "\n  set label " << gnuplot_text(text) << " at graph " << place
            << ", first " << value
            << " right offset 0,0.4 font ',9' noenhanced\n";
      }

      void
      write_panel(std::ostream &out, const unsigned int g) const
      {
        write_ranges(out, g);
        out << "  set title "
            << gnuplot_text(groups_[g].name + ", " + groups_[g].quantity)
            << " noenhanced\n  unset arrow\n  unset label\n";
        for (const double accuracy : accuracies_)
          write_level(out,
                      accuracy,
                      percent(accuracy),
                      "0.99",
                      "linecolor rgb '#888888' dashtype 2");
        if (groups_[g].reference_error > 0)
          write_level(out,
                      groups_[g].reference_error,
                      "difference of the two finest",
                      "0.85",
                      "linecolor rgb '#bb0000' dashtype 3");
        out << "  plot 'pareto_front.csv' using (column('group') == " << g
            << " ? column('cpu_seconds') : NaN):(column('error')) with "
            << front_style;
        for (unsigned int s = 0; s < series_.size(); ++s)
          out << ", \\\n    'work_precision.csv' using (column('group') == "
              << g << " && column('series') == " << s
              << " ? column('cpu_seconds') : NaN):(column('error')) with "
              << series_style(s);
        out << "\n";
      }

      void
      write_legend(std::ostream &out) const
      {
        out << "  unset logscale\n  unset arrow\n  unset label\n"
               "  unset title\n  unset border\n  unset tics\n"
               "  unset xlabel\n  unset ylabel\n  unset grid\n"
               "  set xrange [0:1]\n  set yrange [0:1]\n"
               "  set key at graph 0, graph 0.95 left top reverse Left "
               "maxcols 1 samplen 1 noenhanced font ',10'\n"
               "  plot NaN with "
            << front_style;
        for (unsigned int s = 0; s < series_.size(); ++s)
          out << ", \\\n    NaN with " << series_style(s);
        // The next terminal draws the same panels again.
        out
          << "\n  set border 3\n  set tics\n  set tics nomirror out\n  set grid\n";
      }

      std::string
      series_style(const unsigned int s) const
      {
        return "points " + study_line_style(s) + " pointsize 0.9 title " +
               gnuplot_text(series_[s].empty() ? "cases" : series_[s]);
      }

      static constexpr const char *front_style =
        "lines linecolor rgb '#444444' linewidth 1 title 'Pareto front'";

      const std::vector<WorkGroup>   &groups_;
      const std::vector<WorkPoint>   &points_;
      const std::vector<double>      &accuracies_;
      const std::vector<std::string> &series_;
      const bool                      own_legend_;
    };
  } // namespace



  std::string
  write_work_precision(const std::string            &directory,
                       const std::vector<WorkGroup> &groups,
                       std::vector<WorkPoint>       &points,
                       const std::vector<double>    &accuracies,
                       const std::string            &title)
  {
    std::vector<double> cost, error;
    for (unsigned int g = 0; g < groups.size(); ++g)
      {
        costs_and_errors(points, g, cost, error);
        const auto front = pareto_front(cost, error);
        for (std::size_t i = 0; i < points.size(); ++i)
          if (points[i].group == g)
            points[i].on_front = front[i];
      }

    std::vector<std::string> series;
    for (const WorkPoint &point : points)
      if (std::find(series.begin(), series.end(), point.series) == series.end())
        series.push_back(point.series);

    write_point_table(directory, groups, points, series);
    write_front_table(directory, groups, points);
    write_recommendations(directory,
                          groups,
                          recommend(groups, points, accuracies));
    return WorkPrecisionPicture(groups, points, accuracies, series)
      .draw(directory, title);
  }
} // namespace NPT
