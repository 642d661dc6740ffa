// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the parameters of studies: their entries, and all cases read and
// checked.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/problems/parameter_study/sensitivity_ranges.h>
#include <npt_dealii/problems/parameter_study/study_parameters.h>
#include <npt_dealii/problems/plate_results/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <tuple>

namespace NPT
{
  namespace fs       = std::filesystem;
  namespace Patterns = dealii::Patterns;
  using dealii::Utilities::split_string_list;
  using StatementKind = ParameterText::Kind;

  namespace
  {
    const std::string in_study = " (subsection Study).";

    void
    append(ParameterText &text, const ParameterText &more)
    {
      text.statements.insert(text.statements.end(),
                             more.statements.begin(),
                             more.statements.end());
    }

    void
    append_entry(ParameterText     &text,
                 const std::string &path,
                 const std::string &value)
    {
      ParameterText more = with_overrides({}, {path + "=" + value});
      for (auto &statement : more.statements)
        statement.file = "parameter study";
      append(text, more);
    }

    ParameterText
    in_subsections(const ParameterText            &text,
                   const std::vector<std::string> &names)
    {
      ParameterText result;
      for (const std::string &name : names)
        result.statements.push_back(
          {StatementKind::subsection, name, "", "", 0});
      append(result, text);
      for (std::size_t i = 0; i < names.size(); ++i)
        result.statements.push_back({StatementKind::end, "", "", "", 0});
      return result;
    }

    // Fields and a picture of each of a hundred cases are rarely wanted, but
    // the study may ask for them.
    ParameterText
    defaults_of_cases()
    {
      ParameterText text;
      append_entry(text, "Output/Fields", "none");
      append_entry(text, "Output/Picture", "false");
      return text;
    }
  } // namespace



  template <>
  const EnumNames<StudyParameters::Kind> &
  enum_names<StudyParameters::Kind>()
  {
    using Kind                         = StudyParameters::Kind;
    static const EnumNames<Kind> names = {
      {Kind::sweep, "sweep"},
      {Kind::work_precision, "work-precision"},
      {Kind::stability_map, "stability map"},
      {Kind::sensitivity, "sensitivity"}};
    return names;
  }



  std::string
  display_value(const ParameterLoop &loop, const std::string &value)
  {
    return loop.path == base_entry ? fs::path(value).stem().string() : value;
  }



  std::string
  describe_axes(const ParameterLoops         &loops,
                const std::set<unsigned int> &axes,
                const unsigned int            c,
                const bool                    names_of_numbers_only)
  {
    std::string result;
    for (unsigned int l = 0; l < loops.loops().size(); ++l)
      {
        const ParameterLoop &loop = loops.loops()[l];
        if (axes.count(loop.axis) == 0)
          continue;
        bool repeats = false;
        for (unsigned int k = 0; k < loops.loops().size(); ++k)
          {
            const ParameterLoop &other = loops.loops()[k];
            repeats = repeats || (k != l && other.axis == loop.axis &&
                                  other.values == loop.values &&
                                  loop.is_array && (!other.is_array || k < l));
          }
        if (repeats)
          continue;
        const std::string value = display_value(loop, loops.value(l, c));
        const bool        plain = names_of_numbers_only && !value.empty() &&
                           std::isalpha(static_cast<unsigned char>(value[0]));
        result +=
          (result.empty() ? "" : ", ") + (plain ? "" : loop.name + " ") + value;
      }
    return result;
  }



  void
  StudyParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "parameter study");
    const ParameterSubsection subsection(prm, "Study");
    add_parameter(
      prm,
      "Kind",
      kind,
      "What is made of the cases besides their table: the curves of all in "
      "one picture (sweep), error against CPU time with the Pareto front and "
      "recommended settings (work-precision), maps of success, iterations "
      "and cuts (stability map), or how much of the variance of a curve comes "
      "from each of the entries that have ranges {0.1 .. 0.4} (sensitivity).");
    add_parameter(prm,
                  "Base",
                  base_,
                  "Parameter file of a plate test to which the entries "
                  "of this file are added, relative to this file; may be "
                  "a loop, {shear.prm | tension.prm}. Empty: this file "
                  "has all.");
    add_parameter(prm, "Title", title, "Written over the pictures.");
    add_parameter(prm,
                  "Directory",
                  directory,
                  "Where all results go; created if missing. A study "
                  "that is started again goes on there. The option "
                  "--output of the program overrides it.",
                  Patterns::DirectoryName());
    add_parameter(prm,
                  "Cases side by side",
                  side_by_side,
                  "Number of cases that run at a time; 0 takes the "
                  "available cores. Under mpirun it is the number of "
                  "each process, and 0 means 1.",
                  Patterns::Integer(0, 10000));
    add_parameter(prm,
                  "CPU limit",
                  cpu_limit,
                  "CPU time after which a case is ended [s]; 0 sets no "
                  "limit.",
                  Patterns::Double(0.));
    add_parameter(prm,
                  "Repeat",
                  repeat,
                  "Run finished cases again, too; needed after a change "
                  "of the program itself.");
    add_picture_parameters(prm);
  }



  void
  StudyParameters::add_picture_parameters(dealii::ParameterHandler &prm)
  {
    add_parameter(prm,
                  "Curve",
                  curve_,
                  "Columns of curves.csv that are drawn and compared, "
                  "'H3: n3' or with several ordinates 'H3: n1, n3'. "
                  "`automatic` takes the component with the largest "
                  "target in the last stage and its conjugate.");
    add_parameter(prm,
                  "Stage",
                  stage,
                  "Stage of the curve; empty for the last one.");
    add_parameter(prm,
                  "Panels",
                  panels,
                  "sweep: swept entries that make a panel of their own "
                  "for each of their values. A stability map takes all "
                  "that are not its axes.");
    add_parameter(prm,
                  "Axes",
                  axes,
                  "stability map: the two swept entries on its axes, "
                  "horizontal first. Empty: the first two.",
                  Patterns::List(Patterns::Anything(), 0, 2));
    add_parameter(prm,
                  "Series",
                  series,
                  "work-precision: the swept entries that make a method, "
                  "with a symbol of its own in the picture. `automatic`: "
                  "those whose values are words.");
    add_parameter(prm,
                  "Accuracies",
                  accuracies,
                  "work-precision: relative errors of the curve for "
                  "which a setting is recommended [-].",
                  Patterns::List(positive_number()));
    add_parameter(prm,
                  "Mean iterations over",
                  mean_iterations,
                  "sweep: also draw the Newton iterations, averaged over "
                  "so many load steps; 0 does not.",
                  Patterns::Integer(0, 10000));
    add_parameter(prm,
                  "Rows",
                  rows,
                  "sensitivity: rows N of the design; with d ranges there are "
                  "N (d + 2) cases. Powers of 2 are best. More rows go on "
                  "with the cases of fewer.",
                  Patterns::Integer(2, 5000));
    add_parameter(prm,
                  "At",
                  at,
                  "sensitivity: the abscissas at which the ordinates of Curve "
                  "are compared, as in 10, 20, 30, 40.",
                  Patterns::List(Patterns::Double(), 0));
  }



  /// What to do, the reference, and the plate test, which are read apart.
  struct StudyParameters::Texts
  {
    ParameterText              study, reference, plate;
    std::vector<ParameterText> bases = std::vector<ParameterText>(1);

    explicit Texts(const ParameterText &text)
    {
      ParameterText without_reference;
      std::tie(reference, without_reference) =
        extract_subsection(text, "Study/Reference");
      // It repeats entries of the same file on purpose.
      for (auto &statement : reference.statements)
        statement.file += " (Reference)";
      const auto [entries, others] =
        extract_subsection(without_reference, "Study");
      study = in_subsections(entries, {"Study"});
      unsigned int                        depth = 0;
      std::map<std::string, unsigned int> lines; // of Problem
      for (const auto &statement : others.statements)
        {
          if (statement.kind == StatementKind::set && depth == 0 &&
              statement.name == "Problem")
            {
              // As of every entry, a file says it once.
              const auto [first, is_new] =
                lines.emplace(statement.file, statement.line);
              if (!is_new && first->second != statement.line)
                throw InputError(
                  statement.file + ":" + std::to_string(statement.line) +
                  ": entry 'Problem' outside all subsections is already set in "
                  "line " +
                  std::to_string(first->second) +
                  " of this file; keep only one of the two");
              continue;
            }
          depth += statement.kind == StatementKind::subsection;
          depth -= statement.kind == StatementKind::end;
          plate.statements.push_back(statement);
        }
    }
  };



  void
  StudyParameters::set_curve()
  {
    if (curve_ == "automatic")
      return;
    const auto parts = split_string_list(curve_, ':');
    if (parts.size() != 2 || parts[0].empty() || parts[1].empty())
      throw InputError("Curve is '" + curve_ +
                       "'; it must be 'automatic' or two columns of "
                       "curves.csv, as in 'H3: n3'" +
                       in_study);
    x_column  = parts[0];
    y_columns = split_list(parts[1]);
    curve_value(CurveRow(), x_column); // throws if there is none
    for (const std::string &column : y_columns)
      curve_value(CurveRow(), column);
    if (kind == Kind::work_precision && y_columns.size() > 1)
      throw InputError("Curve names " + std::to_string(y_columns.size()) +
                       " ordinates; a work-precision study compares one" +
                       in_study);
  }



  void
  StudyParameters::read_base_files(Texts &texts)
  {
    if (base_.empty())
      {
        group_names = {"curve"};
        return;
      }
    fs::path    folder;
    std::string where = "Base: ";
    visit_entries(texts.study,
                  [&](const std::string              &path,
                      const ParameterText::Statement &statement) {
                    if (path != base_entry)
                      return;
                    folder = statement.line == 0 ?
                               fs::path() :
                               fs::path(statement.file).parent_path();
                    where  = at_line(statement.file, statement.line);
                  });
    texts.bases.clear();
    for (const std::string &name : split_loop(base_, where).first)
      {
        const std::string file = (folder / name).lexically_normal();
        base_files_.push_back(file);
        group_names.push_back(fs::path(file).stem());
        try
          {
            texts.bases.push_back(read_parameter_text(file));
          }
        catch (const InputError &error)
          {
            throw InputError(where + "Base: " + error.what());
          }
        const std::string problem =
          get_entry(texts.bases.back(), {}, "Problem").value_or("plate test");
        if (problem != "plate test")
          throw InputError("The base file '" + file + "' is a " + problem +
                           "; studies run plate tests" + in_study);
      }
  }



  void
  StudyParameters::check_swept_entries() const
  {
    for (const auto *names : {&panels, &axes, &series})
      for (const std::string &name : *names)
        if (name != "automatic")
          loops->find(name, in_study);
    if (kind != Kind::stability_map)
      return;
    if (loops->axis_sizes().size() < 2 || axes.size() == 1)
      throw InputError(
        "A stability map needs two swept entries as axes, found " +
        std::to_string(loops->axis_sizes().size()) +
        " loops; write values in braces, {10 | 100}" + in_study);
    if (!axes.empty() && loops->loops()[loops->find(axes[0], in_study)].axis ==
                           loops->loops()[loops->find(axes[1], in_study)].axis)
      throw InputError("The Axes " + axes[0] + " and " + axes[1] +
                       " go along with each other; a map needs two "
                       "independent loops {...}" +
                       in_study);
  }



  ParameterText
  StudyParameters::sample_ranges(const Texts              &texts,
                                 std::vector<std::string> &paths) const
  {
    if (kind != Kind::sensitivity)
      return texts.plate;
    if (texts.bases.size() > 1)
      throw InputError("Base names " + std::to_string(texts.bases.size()) +
                       " files; a sensitivity study has one" + in_study);
    if (at.empty())
      throw InputError("At is empty; a sensitivity study compares the "
                       "ordinates of Curve at given abscissas, as At = 0.1, "
                       "0.2" +
                       in_study);
    const SensitivityRanges ranges(texts.plate);
    for (const InputRange &input : ranges.inputs())
      paths.push_back(input.path);
    return ranges.sampled(rows);
  }



  void
  StudyParameters::name_inputs(const std::vector<std::string> &paths)
  {
    for (std::size_t i = 0; i < paths.size(); ++i)
      {
        std::string name = loops->loops()[loops->find(paths[i], in_study)].name;
        if (std::count(paths.begin(), paths.end(), paths[i]) > 1)
          name +=
            " " + std::to_string(
                    std::count(paths.begin(), paths.begin() + i + 1, paths[i]));
        inputs.push_back(name);
      }
  }



  StudyParameters::Details
  StudyParameters::read_case(const Texts         &texts,
                             const unsigned int   group,
                             const ParameterText &entries,
                             const std::string   &name,
                             SweepCase           &result) const
  {
    ParameterText complete = texts.bases[group];
    append(complete, defaults_of_cases());
    append(complete, extract_subsection(entries, "Study").second);
    try
      {
        const PlateTestParameters parameters =
          PlateTestParameters::read(complete);
        result.parameters  = parameters.used_file;
        const auto &stages = parameters.load_programme.stages;
        Details     found;
        found.group      = group;
        found.last_stage = stages.back().name;
        found.starts     = parameters.load_programme.branches();
        double largest   = 0;
        for (const auto *targets :
             {&stages.back().n_targets, &stages.back().H_targets})
          for (const auto &[component, target] : *targets)
            if (std::abs(target) > largest)
              {
                largest         = std::abs(target);
                found.component = component;
              }
        if (!stage.empty() &&
            std::none_of(stages.begin(), stages.end(), [&](const LoadStage &s) {
              return s.name == stage;
            }))
          throw InputError("Stage is '" + stage +
                           "', which the load programme does not have" +
                           in_study);
        return found;
      }
    catch (const InputError &error)
      {
        throw InputError(std::string(error.what()) +
                         (name.empty() ? "" : " [" + name + "]"));
      }
  }



  void
  StudyParameters::read_cases(const Texts &texts)
  {
    for (unsigned int i = 0; i < loops->n_cases(); ++i)
      {
        SweepCase c;
        for (unsigned int l = 0; l < loops->loops().size(); ++l)
          c.values.emplace_back(loops->loops()[l].name,
                                display_value(loops->loops()[l],
                                              loops->value(l, i)));
        const std::string name =
          c.values.empty() ?
            "" :
            "case " + std::to_string(i + 1) + ": " + describe_case(c);
        details.push_back(
          read_case(texts,
                    texts.bases.size() > 1 ? loops->position(i)[0] : 0,
                    loops->text_of_case(i),
                    name,
                    c));
        cases.push_back(c);
      }
  }



  // The reference says what the finest case is.
  void
  StudyParameters::read_references(const Texts &texts)
  {
    if (kind != Kind::work_precision)
      {
        if (!texts.reference.statements.empty())
          throw InputError("Subsection Reference belongs to studies of Kind "
                           "work-precision; this one is a " +
                           name_of(kind) + in_study);
        return;
      }
    std::set<std::string> fixed;
    visit_entries(texts.reference,
                  [&](const std::string &path,
                      const ParameterText::Statement &) {
                    fixed.insert(path);
                  });
    for (const ParameterLoop &loop : loops->loops())
      if (loop.path != base_entry && fixed.count(loop.path) == 0)
        throw InputError(
          "A work-precision study needs a reference: set '" + loop.path +
          "', which is swept, in subsection Reference of subsection Study "
          "as well; {{a | b}} there gives the two finest cases, the finest "
          "last.");
    const ParameterLoops fine(texts.reference);
    for (unsigned int g = 0; g < texts.bases.size(); ++g)
      {
        references.emplace_back();
        for (unsigned int i = 0; i < fine.n_cases(); ++i)
          {
            SweepCase c;
            // The same columns as the other cases have.
            ParameterText entries = loops->text_of_case(0);
            append(entries, fine.text_of_case(i));
            for (const ParameterLoop &loop : loops->loops())
              c.values.emplace_back(
                loop.name,
                loop.path == base_entry ?
                  group_names[g] :
                  get_entry(entries, {}, loop.path).value_or(""));
            read_case(texts,
                      g,
                      entries,
                      "reference " + std::to_string(i + 1) + ": " +
                        describe_case(c),
                      c);
            references.back().push_back(c);
          }
      }
  }



  StudyParameters
  StudyParameters::read(const ParameterText            &given_text,
                        const std::vector<std::string> &overrides)
  {
    Texts                    texts(with_overrides(given_text, overrides));
    StudyParameters          study;
    dealii::ParameterHandler prm;
    study.add_parameters(prm);
    parse_parameter_text(prm, texts.study);
    study.set_curve();
    study.read_base_files(texts);

    // The entry Base may be a loop, and is then the first of all.
    ParameterText loop_text;
    if (!study.base_.empty())
      append_entry(loop_text, base_entry, study.base_);
    std::vector<std::string> paths; // of inputs
    append(loop_text, study.sample_ranges(texts, paths));
    study.loops = std::make_unique<ParameterLoops>(loop_text);
    study.name_inputs(paths);
    study.check_swept_entries();
    study.read_cases(texts);
    study.read_references(texts);

    // The file as it will be kept.
    study.documented_ = documented_parameters(prm);
    if (!texts.reference.statements.empty())
      study.reference_ = print_parameter_text(
        in_subsections(texts.reference, {"Study", "Reference"}));
    study.rest_     = print_parameter_text(texts.plate);
    study.used_file = study.used_file_in(".");
    return study;
  }



  std::string
  StudyParameters::used_file_in(const std::string &folder) const
  {
    std::string bases;
    for (const std::string &file : base_files_)
      bases +=
        (bases.empty() ? "" : " | ") + fs::proximate(file, folder).string();
    if (base_files_.size() > 1)
      bases = "{" + bases + "}";

    // The value of the entry Base is replaced in the documented text.
    std::istringstream in(documented_);
    std::string        result;
    for (std::string line; std::getline(in, line);)
      {
        const std::size_t start = line.find_first_not_of(' ');
        if (start != std::string::npos &&
            line.compare(start, 9, "set Base ") == 0)
          line.erase(line.find('=') + 1)
            .append(bases.empty() ? "" : " " + bases);
        result += line + "\n";
      }
    return result + (reference_.empty() ? "" : "\n" + reference_) +
           (rest_.empty() ? "" : "\n" + rest_);
  }
} // namespace NPT
