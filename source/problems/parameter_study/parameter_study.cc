// SPDX-License-Identifier: LGPL-2.1-or-later
// Running a study, and what is made of the finished cases.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/interruption.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/problems/parameter_study/parameter_study.h>
#include <npt_dealii/problems/parameter_study/sensitivity_results.h>
#include <npt_dealii/problems/parameter_study/stability_map.h>
#include <npt_dealii/problems/parameter_study/work_precision.h>
#include <npt_dealii/problems/plate_results/curve_family.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <ostream>

namespace NPT
{
  namespace fs = std::filesystem;

  namespace
  {
    using Details = StudyParameters::Details;

    bool
    is_first_of_study()
    {
      return !dealii::Utilities::MPI::job_supports_mpi() ||
             dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
    }

    bool
    is_number(const std::string &text)
    {
      char *end = nullptr;
      std::strtod(text.c_str(), &end);
      return !text.empty() && *end == '\0';
    }

    std::vector<CurveRow>
    curve_of(const std::string &directory, const SweepCase &c)
    {
      const std::string file = directory + "/" + c.folder + "/curves.csv";
      return fs::exists(file) ? read_curves(file) : std::vector<CurveRow>();
    }

    std::string
    x_column(const StudyParameters &study, const Details &details)
    {
      return study.x_column.empty() ?
               MacroModes::table[details.component].name :
               study.x_column;
    }

    std::vector<std::string>
    y_columns(const StudyParameters &study, const Details &details)
    {
      return study.y_columns.empty() ?
               std::vector<std::string>{
                 MacroModes::table[details.component].conjugate} :
               study.y_columns;
    }

    // The number of the panel of every case, and the names of the panels.
    std::vector<unsigned int>
    make_panels(const StudyParameters        &study,
                const std::set<unsigned int> &axes,
                std::vector<std::string>     &names)
    {
      std::vector<unsigned int> result;
      names.clear();
      for (unsigned int i = 0; i < study.cases.size(); ++i)
        {
          const std::string name = describe_axes(*study.loops, axes, i, true);
          const auto        at   = std::find(names.begin(), names.end(), name);
          result.push_back(at - names.begin());
          if (at == names.end())
            names.push_back(name);
        }
      return result;
    }

    std::set<unsigned int>
    axes_of(const StudyParameters &study, const std::vector<std::string> &names)
    {
      std::set<unsigned int> result;
      for (const std::string &name : names)
        result.insert(study.loops->loops()[study.loops->find(name, "")].axis);
      return result;
    }

    std::set<unsigned int>
    all_other_axes(const StudyParameters        &study,
                   const std::set<unsigned int> &of)
    {
      std::set<unsigned int> result;
      for (const ParameterLoop &loop : study.loops->loops())
        if (of.count(loop.axis) == 0)
          result.insert(loop.axis);
      return result;
    }



    std::string
    finish_sweep(const StudyParameters        &study,
                 const std::vector<SweepCase> &cases,
                 const std::string            &directory)
    {
      const auto               panel_axes = axes_of(study, study.panels);
      std::vector<std::string> panels;
      const auto panel_of = make_panels(study, panel_axes, panels);

      std::vector<FamilyMember> members;
      for (unsigned int i = 0; i < cases.size(); ++i)
        {
          FamilyMember member;
          member.panel  = panel_of[i];
          member.folder = cases[i].folder;
          member.label =
            describe_axes(*study.loops, all_other_axes(study, panel_axes), i);
          member.rows =
            stage_rows(curve_of(directory, cases[i]),
                       study.stage.empty() ? study.details[i].last_stage :
                                             study.stage,
                       study.details[i].starts);
          // What ended early is drawn as far as it came, and says so.
          if (cases[i].result.status != "done")
            member.label += (member.label.empty() ? "(" : " (") +
                            cases[i].result.reason + ")";
          members.push_back(member);
        }
      std::string warning =
        write_curve_family(directory,
                           panels,
                           members,
                           x_column(study, study.details[0]),
                           y_columns(study, study.details[0]),
                           study.title);
      if (study.mean_iterations > 0)
        {
          const std::string more = write_iterations(
            directory, panels, members, study.mean_iterations, study.title);
          if (warning.empty())
            warning = more;
        }
      return warning;
    }



    std::string
    finish_map(const StudyParameters        &study,
               const std::vector<SweepCase> &cases,
               const std::string            &directory)
    {
      const ParameterLoops &loops = *study.loops;
      // Loops on the axes; without a choice the first two {...}.
      std::vector<unsigned int> chosen;
      for (const std::string &name : study.axes)
        chosen.push_back(loops.find(name, ""));
      for (unsigned int l = 0; l < loops.loops().size() && chosen.size() < 2;
           ++l)
        if (!loops.loops()[l].is_array)
          chosen.push_back(l);
      const unsigned int axes[2] = {loops.loops()[chosen[0]].axis,
                                    loops.loops()[chosen[1]].axis};
      MapAxis            map_axes[2];
      for (unsigned int d = 0; d < 2; ++d)
        {
          map_axes[d].name = loops.loops()[chosen[d]].name;
          for (const std::string &value : loops.loops()[chosen[d]].values)
            map_axes[d].values.push_back(
              display_value(loops.loops()[chosen[d]], value));
        }
      std::vector<std::string> panels;
      const auto               panel_of =
        make_panels(study, all_other_axes(study, {axes[0], axes[1]}), panels);
      std::vector<MapCell> cells;
      for (unsigned int i = 0; i < cases.size(); ++i)
        {
          const auto position = loops.position(i);
          cells.push_back({panel_of[i],
                           position[axes[0]],
                           position[axes[1]],
                           cases[i].folder,
                           cases[i].result});
        }
      return write_stability_map(directory,
                                 map_axes[0],
                                 map_axes[1],
                                 panels,
                                 cells,
                                 study.details[0].last_stage,
                                 study.title);
    }



    // What makes a method: given, or all loops over words.
    std::set<unsigned int>
    series_axes(const StudyParameters        &study,
                const std::set<unsigned int> &of_bases)
    {
      if (study.series.size() != 1 || study.series[0] != "automatic")
        return axes_of(study, study.series);
      std::set<unsigned int> series;
      for (const ParameterLoop &loop : study.loops->loops())
        if (of_bases.count(loop.axis) == 0 &&
            !std::all_of(loop.values.begin(), loop.values.end(), is_number))
          series.insert(loop.axis);
      return series;
    }

    StudyCurve
    curve_of_case(const StudyParameters &study,
                  const Details         &details,
                  const std::string     &directory,
                  const SweepCase       &c)
    {
      return stage_curve(curve_of(directory, c),
                         study.stage.empty() ? details.last_stage : study.stage,
                         x_column(study, details),
                         y_columns(study, details)[0],
                         details.starts);
    }

    // The ordinate where the curve first passes an abscissa; not a number if
    // it does not.
    double
    value_at(const std::vector<CurveRow> &rows,
             const std::string           &x_name,
             const std::string           &y_name,
             const double                 x)
    {
      for (std::size_t i = 1; i < rows.size(); ++i)
        {
          const double a = curve_value(rows[i - 1], x_name),
                       b = curve_value(rows[i], x_name);
          if ((x - a) * (x - b) > 0. || !(a != b))
            continue;
          const double y = curve_value(rows[i - 1], y_name);
          return y + (x - a) / (b - a) * (curve_value(rows[i], y_name) - y);
        }
      return std::numeric_limits<double>::quiet_NaN();
    }

    std::string
    finish_sensitivity(const StudyParameters        &study,
                       const std::vector<SweepCase> &cases,
                       const std::string            &directory,
                       std::ostream                 &screen)
    {
      const Details                     &details = study.details[0];
      const std::string                  x_name  = x_column(study, details);
      std::vector<std::vector<CurveRow>> curves;
      for (const SweepCase &c : cases)
        curves.push_back(
          stage_rows(curve_of(directory, c),
                     study.stage.empty() ? details.last_stage : study.stage,
                     details.starts));
      std::vector<SensitivityQuantity> quantities;
      for (const std::string &y_name : y_columns(study, details))
        for (const double x : study.at)
          {
            std::vector<double> values;
            for (const std::vector<CurveRow> &rows : curves)
              values.push_back(value_at(rows, x_name, y_name, x));
            quantities.push_back(
              {y_name,
               x,
               study.rows,
               static_cast<unsigned int>(
                 std::count_if(values.begin(),
                               values.end(),
                               [](const double y) { return std::isnan(y); })),
               sensitivity_of(values, study.inputs.size())});
            screen << describe(quantities.back(), x_name, study.inputs)
                   << std::endl;
          }
      return write_sensitivity(
        directory, study.inputs, quantities, x_name, study.title);
    }



    // A group of cases and the finest of its references.
    std::pair<WorkGroup, StudyCurve>
    make_group(const StudyParameters        &study,
               const unsigned int            g,
               const std::vector<SweepCase> &references,
               const std::string            &directory)
    {
      unsigned int i = 0;
      while (study.details[i].group != g)
        ++i;
      const Details          &details = study.details[i];
      std::vector<StudyCurve> curves;
      for (const SweepCase &c : references)
        {
          if (c.result.status != "done")
            throw StageFailed("The reference of " + study.group_names[g] +
                              ", " + c.folder + ", did not come to its end (" +
                              c.result.reason +
                              "), so that there is nothing to compare with. "
                              "Make it easier to solve in subsection "
                              "Reference: " +
                              c.result.message);
          curves.push_back(curve_of_case(study, details, directory, c));
        }
      WorkGroup group;
      group.name = study.group_names[g];
      group.quantity =
        y_columns(study, details)[0] + "(" + x_column(study, details) + ")";
      group.reference_error =
        curves.size() < 2 ?
          std::numeric_limits<double>::quiet_NaN() :
          compare_curves(curves[curves.size() - 2], curves.back()).l2;
      group.reference_cpu    = references.back().result.cpu_seconds;
      group.reference_folder = references.back().folder;
      return {group, curves.back()};
    }

    std::string
    finish_work_precision(const StudyParameters                     &study,
                          const std::vector<SweepCase>              &cases,
                          const std::vector<std::vector<SweepCase>> &references,
                          const std::string                         &directory)
    {
      const ParameterLoops  &loops = *study.loops;
      std::set<unsigned int> of_bases;
      for (const ParameterLoop &loop : loops.loops())
        if (loop.path == base_entry)
          of_bases.insert(loop.axis);
      const std::set<unsigned int> series = series_axes(study, of_bases);

      std::vector<WorkGroup>  groups;
      std::vector<StudyCurve> finest;
      for (unsigned int g = 0; g < references.size(); ++g)
        {
          const auto [group, curve] =
            make_group(study, g, references[g], directory);
          groups.push_back(group);
          finest.push_back(curve);
        }

      std::vector<WorkPoint> points;
      for (unsigned int i = 0; i < cases.size(); ++i)
        {
          const RunSummary &result  = cases[i].result;
          const Details    &details = study.details[i];
          WorkPoint         point;
          point.group  = details.group;
          point.series = describe_axes(loops, series, i, true);
          point.setting =
            describe_axes(loops, all_other_axes(study, of_bases), i);
          point.folder   = cases[i].folder;
          point.complete = result.status == "done";
          point.status   = point.complete ? "done" : result.reason;
          point.cpu      = result.cpu_seconds;
          if (point.complete)
            point.error =
              compare_curves(curve_of_case(study, details, directory, cases[i]),
                             finest[details.group]);
          points.push_back(point);
        }
      return write_work_precision(
        directory, groups, points, study.accuracies, study.title);
    }
  } // namespace



  void
  run_parameter_study(const StudyParameters &study,
                      const std::string     &directory,
                      std::ostream          &screen,
                      const std::function<int(std::vector<std::string>)> &run,
                      const bool continues)
  {
    const Interruption interruption;
    const bool         first = is_first_of_study();
    if (first)
      replace_file(directory + "/used_study.prm", [&](std::ostream &out) {
        out << study.used_file_in(directory);
      });

    // References take longest, so they begin.
    std::vector<SweepCase> all;
    for (const auto &references : study.references)
      all.insert(all.end(), references.begin(), references.end());
    const std::size_t n_references = all.size();
    all.insert(all.end(), study.cases.begin(), study.cases.end());

    SweepOptions options;
    options.directory    = directory;
    options.side_by_side = study.side_by_side;
    options.cpu_limit    = study.cpu_limit;
    options.repeat       = study.repeat;
    options.run          = run;
    options.continues    = continues;
    run_cases(all, options, screen);
    if (!first)
      return;

    write_case_table(directory + "/cases.csv", all);
    double                              cpu = 0;
    std::map<std::string, unsigned int> endings;
    std::set<std::string>               folders;
    for (const SweepCase &c : all)
      if (folders.insert(c.folder).second)
        {
          cpu += c.result.cpu_seconds;
          ++endings[c.result.status == "done" ? "done" : c.result.reason];
        }
    screen << folders.size() << " runs, " << std::lround(cpu)
           << " s of CPU time:";
    for (const auto &[ending, n] : endings)
      screen << "  " << ending << " " << n;
    screen << std::endl;

    std::vector<std::vector<SweepCase>> references = study.references;
    auto                                next       = all.begin();
    for (auto &group : references)
      for (SweepCase &c : group)
        c = *next++;
    const std::vector<SweepCase> cases(all.begin() + n_references, all.end());
    const std::string            warning =
      study.kind == StudyParameters::Kind::sweep ?
                   finish_sweep(study, cases, directory) :
                 study.kind == StudyParameters::Kind::stability_map ?
                   finish_map(study, cases, directory) :
                 study.kind == StudyParameters::Kind::sensitivity ?
                   finish_sensitivity(study, cases, directory, screen) :
                   finish_work_precision(study, cases, references, directory);
    if (!warning.empty())
      screen << "Warning: " << warning << std::endl;
    screen << "Tables and pictures are in " << directory << std::endl;
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters = StudyParameters::read(text, command.overrides);
      if (command.action == CommandLine::Action::validate)
        std::cout << parameters.cases.size() << " cases: ";
      if (done_with_parameters(command, parameters))
        return;
      const std::string directory =
        make_output_directory(command, parameters.directory);
      const OutputFolder folder(is_first_of_study() ? directory : "");
      run_parameter_study(
        parameters, directory, std::cout, command.run_again, command.continues);
    }

    // One process needs no MPI, and must have none to hand out copies of itself
    // to the cases.
    const Registry<Problem>::Registration registration(
      "parameter study",
      {3, "a study of many plate tests", start, false, true, false, true});
  } // namespace
} // namespace NPT
