// SPDX-License-Identifier: LGPL-2.1-or-later
// A plate test to a wanted accuracy: choice of settings, rounds of runs,
// results.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/io/output_folder.h>
#include <npt_dealii/io/replace_file.h>
#include <npt_dealii/io/table_file.h>
#include <npt_dealii/problems/accuracy/error_controlled_test.h>
#include <npt_dealii/problems/plate_results/study_plots.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <ostream>

namespace NPT
{
  namespace fs = std::filesystem;

  namespace
  {
    // Elements between two crossings, each mesh about 1.4 times finer.
    const std::vector<unsigned int> meshes = {3, 4, 5, 7, 9, 13, 17, 25};

    const std::array<const char *, n_error_sources> source_names = {
      {"mesh", "layers", "penalty", "step"}};

    std::string
    percent(const double value)
    {
      return short_number(100. * value, 2) + " %";
    }

    const ErrorBars &
    worst(const std::vector<ErrorBars> &bars)
    {
      return *std::max_element(bars.begin(),
                               bars.end(),
                               [](const ErrorBars &a, const ErrorBars &b) {
                                 return a.relative < b.relative;
                               });
    }

    // Of a round: the main run and its probes.
    constexpr unsigned int n_runs = 6;

    template <typename T>
    std::array<T *, n_runs>
    all_of(Probes<T> &probes)
    {
      return {{&probes.main,
               &probes.coarse,
               &probes.base,
               &probes.more_layers,
               &probes.soft_contact,
               &probes.long_steps}};
    }
  } // namespace



  // ----------------------------------------------------------------- settings

  unsigned int
  AccuracySetting::coarser_mesh() const
  {
    const auto here =
      std::lower_bound(meshes.begin(), meshes.end(), n_elements);
    return here == meshes.begin() ? *here : *(here - 1);
  }



  bool
  AccuracySetting::refine(const ErrorSource source)
  {
    switch (source)
      {
        case ErrorSource::mesh:
          {
            const auto finer =
              std::upper_bound(meshes.begin(), meshes.end(), n_elements);
            if (finer == meshes.end())
              return false;
            n_elements = *finer;
            return true;
          }
        case ErrorSource::layers:
          ++n_layers;
          return n_layers <= 8;
        case ErrorSource::penalty:
          penalty *= penalty_ratio;
          return true;
        default:
          step *= 0.5;
          return step > 1e-3;
      }
  }



  std::string
  AccuracySetting::describe() const
  {
    const std::string n = std::to_string(n_elements);
    return n + " x " + n + " x " + std::to_string(n_layers) +
           " elements, penalties " + short_number(penalty, 3) +
           " N/mm^3, load steps of " + short_number(step, 3);
  }



  AccuracySetting
  first_setting(const PlateTestParameters &parameters)
  {
    const double    target = parameters.accuracy.target();
    AccuracySetting setting;
    setting.n_elements = target >= 0.008 ? 5 : target >= 0.0025 ? 7 : 9;
    setting.n_layers   = parameters.mesh.elements_through;
    setting.penalty    = (target >= 0.0025 ? 145. : 435.) *
                      parameters.contact.normal_penalty /
                      penalty_over_stiffness(parameters);
    setting.step = target >= 0.0025 ? 0.05 : 0.025;
    return setting;
  }



  // --------------------------------------------------------------------- runs

  ErrorControlledTest::ErrorControlledTest(
    const ParameterText            &text,
    const std::vector<std::string> &overrides,
    const std::string              &directory,
    const SweepOptions             &options,
    std::ostream                   &screen)
    : text_(text)
    , overrides_(overrides)
    , parameters_(PlateTestParameters::read(text, overrides))
    , directory_(directory)
    , options_(options)
    , screen_(screen)
  {}



  SweepCase
  ErrorControlledTest::make_case(const AccuracySetting &setting,
                                 const std::string     &name) const
  {
    const auto number = [](const double value) {
      return EntryValue<double>::text(value);
    };
    std::vector<std::string> entries = overrides_;
    // What the command line says of the same entry does not count.
    const auto set = [&](const std::string &path, const std::string &value) {
      const auto names_it = [&](const std::string &entry) {
        return entry.substr(0, entry.find('=')) == path;
      };
      entries.erase(std::remove_if(entries.begin(), entries.end(), names_it),
                    entries.end());
      entries.push_back(path + "=" + value);
    };
    const std::string n = std::to_string(setting.n_elements);
    set("Accuracy/Target", "off");
    // A larger limit must not run finished cases again.
    set("Accuracy/CPU limit",
        EntryValue<double>::text(AccuracyParameters().cpu_limit));
    set("Contact/Method", "KTS");
    set("Contact/Enforcement", "penalty");
    set("Contact/Automatic penalties", "false");
    set("Contact/Normal penalty", number(setting.penalty));
    set("Friction/Tangential penalty", number(setting.penalty));
    set("Mesh/Elements along", n);
    set("Mesh/Elements across", n);
    set("Mesh/Elements through", std::to_string(setting.n_layers));
    set("Output/Picture", "false");
    for (const LoadStage &stage : parameters_.load_programme.stages)
      if (stage.is_test())
        for (const char *entry : {"Initial step", "Maximum step"})
          set("Load programme/Stage " + stage.name + "/" + entry,
              number(setting.step));
    SweepCase result;
    result.values.emplace_back("run", name);
    result.parameters = PlateTestParameters::read(text_, entries).used_file;
    return result;
  }



  Probes<SweepCase>
  ErrorControlledTest::make_cases(const AccuracySetting &setting) const
  {
    Probes<SweepCase> cases;
    AccuracySetting   coarse = setting, base = setting;
    coarse.n_elements      = setting.coarser_mesh();
    base.n_elements        = std::min(base_mesh_, coarse.n_elements);
    AccuracySetting layers = base, soft = base, longer = base;
    ++layers.n_layers;
    soft.penalty /= penalty_ratio;
    longer.step *= 2.;
    cases.main         = make_case(setting, "main");
    cases.coarse       = make_case(coarse, "coarser mesh");
    cases.base         = make_case(base, "coarse mesh");
    cases.more_layers  = make_case(layers, "one more layer");
    cases.soft_contact = make_case(soft, "softer contact");
    cases.long_steps   = make_case(longer, "longer steps");
    return cases;
  }



  void
  ErrorControlledTest::run_all(Probes<SweepCase> &cases)
  {
    std::vector<SweepCase> list;
    for (const SweepCase *c : all_of(cases))
      list.push_back(*c);
    run_cases(list, options_, screen_);
    last_cpu_seconds_ = 0;
    for (unsigned int i = 0; i < list.size(); ++i)
      {
        *all_of(cases)[i] = list[i];
        if (counted_.insert(list[i].folder).second)
          last_cpu_seconds_ += list[i].result.cpu_seconds;
      }
    cpu_seconds_ += last_cpu_seconds_;
  }



  std::vector<ErrorBars>
  ErrorControlledTest::estimate(const Probes<SweepCase> &cases) const
  {
    Probes<SweepCase>                copy = cases;
    Probes<std::vector<AnswerCurve>> curves;
    for (unsigned int i = 0; i < n_runs; ++i)
      {
        const std::string file =
          directory_ + "/" + all_of(copy)[i]->folder + "/curves.csv";
        if (fs::exists(file))
          *all_of(curves)[i] =
            answer_curves(parameters_.load_programme.stages, read_curves(file));
      }
    std::vector<ErrorBars> bars;
    for (const AnswerCurve &answer : curves.main)
      {
        Probes<AnswerCurve> of_answer;
        bool                all = true;
        for (unsigned int i = 0; i < n_runs; ++i)
          {
            const auto &of_run = *all_of(curves)[i];
            const auto  same =
              std::find_if(of_run.begin(),
                           of_run.end(),
                           [&](const AnswerCurve &other) {
                             return other.stage == answer.stage &&
                                    other.driven == answer.driven;
                           });
            all = all && same != of_run.end();
            if (all)
              *all_of(of_answer)[i] = *same;
          }
        if (all)
          bars.push_back(estimate_errors(of_answer));
      }
    return bars;
  }



  void
  ErrorControlledTest::report(const AccuracySetting        &setting,
                              const std::vector<ErrorBars> &bars)
  {
    history_.push_back(setting.describe() + ": " +
                       short_number(last_cpu_seconds_, 3) + " s");
    for (const ErrorBars &b : bars)
      {
        std::string line = "  " + b.main.answer + " in stage " + b.main.stage +
                           ": error bar " + percent(b.relative) + " (";
        for (unsigned int s = 0; s < n_error_sources; ++s)
          line += std::string(s == 0 ? "" : ", ") + source_names[s] + " " +
                  percent(b.relative_parts[s]);
        history_.push_back(line + ")");
      }
    for (auto line = history_.end() - bars.size() - 1; line != history_.end();
         ++line)
      screen_ << *line << std::endl;
  }



  // A probe may be too coarse to be woven where the main run is not.
  bool
  ErrorControlledTest::make_probes_finer(AccuracySetting &setting,
                                         const bool       coarse_mesh_failed)
  {
    if (cpu_seconds_ + 3. * last_main_cpu_seconds_ >
        parameters_.accuracy.cpu_limit)
      return false;
    if (!coarse_mesh_failed)
      {
        AccuracySetting base;
        base.n_elements = base_mesh_;
        base.refine(ErrorSource::mesh);
        base_mesh_ = base.n_elements;
        if (base_mesh_ <= setting.coarser_mesh())
          return true;
      }
    return setting.refine(ErrorSource::mesh);
  }



  bool
  ErrorControlledTest::refine(AccuracySetting              &setting,
                              const std::vector<ErrorBars> &bars) const
  {
    // Twice the elements in each direction of the plane cost about four times
    // as much, and more where the factorization counts.
    const double next = 3. * last_main_cpu_seconds_;
    if (cpu_seconds_ + next > parameters_.accuracy.cpu_limit)
      return false;
    const ErrorBars &largest = worst(bars);
    const auto main_source   = std::max_element(largest.relative_parts.begin(),
                                              largest.relative_parts.end()) -
                             largest.relative_parts.begin();
    bool refined = false;
    for (unsigned int s = 0; s < n_error_sources; ++s)
      if (s == main_source ||
          largest.relative_parts[s] > 0.5 * parameters_.accuracy.target())
        refined = setting.refine(static_cast<ErrorSource>(s)) || refined;
    return refined;
  }



  void
  ErrorControlledTest::run()
  {
    const double    target  = parameters_.accuracy.target();
    AccuracySetting setting = first_setting(parameters_);
    base_mesh_              = setting.coarser_mesh();
    Probes<SweepCase>      cases;
    std::vector<ErrorBars> bars;
    // The last round of which all runs came to their ends.
    struct Round
    {
      AccuracySetting        setting;
      Probes<SweepCase>      cases;
      std::vector<ErrorBars> bars;
    };
    std::optional<Round> complete;
    for (bool enough = false; !enough;)
      {
        screen_ << setting.describe() << " and its probes:" << std::endl;
        cases = make_cases(setting);
        run_all(cases);
        last_main_cpu_seconds_ = cases.main.result.cpu_seconds;
        bars                   = estimate(cases);
        report(setting, bars);
        const SweepCase *failed = nullptr;
        for (const SweepCase *c : all_of(cases))
          if (c->result.status != "done" && failed == nullptr)
            failed = c;
        if (failed == nullptr && !bars.empty())
          complete = Round{setting, cases, bars};
        if (failed != nullptr && failed != &cases.main &&
            make_probes_finer(setting, failed == &cases.coarse))
          continue;
        enough = failed != nullptr || bars.empty() ||
                 worst(bars).relative <= target || !refine(setting, bars);
        if (!enough)
          continue;
        if (failed != nullptr && complete)
          write(complete->cases, complete->bars);
        else
          write(cases, bars);
        if (failed != nullptr)
          throw StageFailed(
            "The run '" + failed->values[0].second + "', " + failed->folder +
            ", ended early: " + failed->result.message +
            (complete ? " Curves and bars are those of the round before, " +
                          complete->setting.describe() + ", with a bar of " +
                          percent(worst(complete->bars).relative) + "." :
                        ""));
      }
    if (bars.empty())
      throw StageFailed("No load stage drives a component, so there is nothing "
                        "whose error could be told (Load programme/Stages).");
    if (!(worst(bars).relative <= target))
      throw StageFailed(
        "The error bar of " + worst(bars).main.answer + " is " +
        percent(worst(bars).relative) + ", above the Target of " +
        percent(target) + ", and a finer setting would pass the CPU limit of " +
        short_number(parameters_.accuracy.cpu_limit, 4) +
        " s or the finest mesh of " + std::to_string(meshes.back()) +
        " elements. The curves with their bars are complete. What to try: a larger "
        "CPU limit (subsection Accuracy).");
  }



  // ------------------------------------------------------------------ results

  void
  ErrorControlledTest::write(const Probes<SweepCase>      &cases,
                             const std::vector<ErrorBars> &bars) const
  {
    for (const char *name : {"curves.csv", "summary.csv"})
      {
        const fs::path from = fs::path(directory_) / cases.main.folder / name;
        if (fs::exists(from))
          replace_file(directory_ + "/" + name, [&](std::ostream &out) {
            out << std::ifstream(from).rdbuf();
          });
      }
    {
      std::vector<std::string> columns = {
        "answer", "stage", "load_factor", "driven", "main", "value", "bar"};
      for (const char *source : source_names)
        columns.push_back(std::string("bar_by_") + source);
      TableWriter table(
        directory_ + "/accuracy.csv",
        columns,
        {"Answers with error bars: value +- bar. main is the run in " +
           cases.main.folder + "; value is extrapolated in the penalties.",
         "Units as in curves.csv; driven is the component that the stage "
         "changes."});
      for (const ErrorBars &b : bars)
        for (std::size_t i = 0; i < b.value.size(); ++i)
          {
            std::vector<TableCell> row = {b.main.answer,
                                          b.main.stage,
                                          b.main.load_factor[i],
                                          b.main.x[i],
                                          b.main.y[i],
                                          b.value[i],
                                          b.bar[i]};
            for (const auto &part : b.parts)
              row.push_back(part[i]);
            table.add_row(row);
          }
    }
    replace_file(directory_ + "/accuracy.txt", [&](std::ostream &out) {
      out << "Target " << percent(parameters_.accuracy.target())
          << " of every answer (L2 norm of its bar over its own).\n"
          << "Mesh, penalties and steps were chosen by the program; contact "
             "conditions are posed at points (KTS), which loses nothing of "
             "the spin at a crossing.\n\n";
      for (const std::string &line : history_)
        out << line << "\n";
      out << "\n"
          << short_number(cpu_seconds_, 3)
          << " s of CPU time in all. The last main run is in "
          << cases.main.folder << "; its probes:\n";
      Probes<SweepCase> copy = cases;
      for (const SweepCase *c : all_of(copy))
        out << "  " << c->folder << "  " << c->values[0].second << "  "
            << c->result.status << "  "
            << short_number(c->result.cpu_seconds, 3) << " s\n";
    });
    if (parameters_.output.picture)
      draw(bars);
    screen_ << "Curves with error bars are in " << directory_
            << "/accuracy.csv; " << short_number(cpu_seconds_, 3)
            << " s of CPU time" << std::endl;
  }



  void
  ErrorControlledTest::draw(const std::vector<ErrorBars> &bars) const
  {
    if (bars.empty())
      return;
    const unsigned int n_columns = bars.size() > 1 ? 2 : 1;
    const std::string  warning   = draw_picture(
      directory_,
      "accuracy",
      "",
      (bars.size() + n_columns - 1) / n_columns,
      n_columns,
      560,
      400,
      [&](std::ostream &out) {
        out << "  set format '%g'\n  set key left top reverse Left samplen 2\n";
        for (const ErrorBars &b : bars)
          {
            const auto column = [&](const std::string &value) {
              return "(strcol('answer') eq '" + b.main.answer +
                     "' && strcol('stage') eq " + gnuplot_text(b.main.stage) +
                     " ? " + value + " : NaN)";
            };
            const std::string x = column("column('driven')");
            out << "  set title "
                << gnuplot_text("stage " + b.main.stage + ", error bar " +
                                percent(b.relative))
                << " noenhanced\n  set xlabel "
                << gnuplot_text(b.main.driven + " [" +
                                curve_column_unit(b.main.driven) + "]")
                << "\n  set ylabel "
                << gnuplot_text(b.main.answer + " [" +
                                curve_column_unit(b.main.answer) + "]")
                << "\n  plot 'accuracy.csv' using " << x << ":"
                << column("column('value') - column('bar')") << ":"
                << column("column('value') + column('bar')")
                << " with filledcurves linecolor rgb '#9ecae1' title "
                      "'error bar', \\\n    '' using "
                << x << ":" << column("column('value')") << " with linespoints "
                << study_line_style(0)
                << " pointsize 0.4 title 'extrapolated'\n";
          }
      });
    if (!warning.empty())
      screen_ << "Warning: " << warning << std::endl;
  }



  namespace
  {
    void
    start(const ParameterText &text, const CommandLine &command)
    {
      const auto parameters =
        PlateTestParameters::read(text, command.overrides);
      if (done_with_parameters(command, parameters))
        return;
      SweepOptions options;
      options.directory =
        make_output_directory(command, parameters.output.directory);
      const OutputFolder folder(options.directory);
      options.cpu_limit = parameters.accuracy.cpu_limit;
      options.run       = command.run_again;
      options.continues = command.continues;
      replace_file(options.directory + "/used_parameters.prm",
                   [&](std::ostream &out) { out << parameters.used_file; });
      ErrorControlledTest(
        text, command.overrides, options.directory, options, std::cout)
        .run();
    }

    // Not in the list of problems: a plate test with a target becomes this one.
    // Its runs are copies of this process, which must not have MPI.
    const Registry<Problem>::Registration
      registration(PlateTestParameters::error_controlled,
                   {101,
                    "a plate test to an accuracy",
                    start,
                    false,
                    false,
                    false,
                    true,
                    {},
                    false});
  } // namespace
} // namespace NPT
