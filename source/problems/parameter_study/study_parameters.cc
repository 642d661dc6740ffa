// SPDX-License-Identifier: LGPL-2.1-or-later
// Parameters of studies: their entries, and all cases read and checked.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/problems/parameter_study/study_parameters.h>
#include <npt_dealii/problems/plate_test/curve_writer.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

namespace NPT
{
  namespace fs       = std::filesystem;
  namespace Patterns = dealii::Patterns;
  using dealii::Utilities::split_string_list;
  using Kind = ParameterText::Kind;

  namespace
  {
    void
    declare_study(dealii::ParameterHandler &prm)
    {
      declare_problem(prm, "parameter study");
      prm.enter_subsection("Study");
      prm.declare_entry(
        "Kind",
        "sweep",
        Patterns::Selection("sweep|work-precision|stability map"),
        "What is made of the cases besides their table: the curves of all in "
        "one picture (sweep), error against CPU time with the Pareto front and "
        "recommended settings (work-precision), or maps of success, iterations "
        "and cuts (stability map).");
      prm.declare_entry("Base",
                        "",
                        Patterns::Anything(),
                        "Parameter file of a plate test to which the entries "
                        "of this file are added, relative to this file; may be "
                        "a loop, {shear.prm | tension.prm}. Empty: this file "
                        "has all.");
      prm.declare_entry("Title",
                        "",
                        Patterns::Anything(),
                        "Written over the pictures.");
      prm.declare_entry("Directory",
                        "output-study",
                        Patterns::DirectoryName(),
                        "Where all results go; created if missing. A study "
                        "that is started again goes on there. The option "
                        "--output of the program overrides it.");
      prm.declare_entry("Cases side by side",
                        "0",
                        Patterns::Integer(0, 10000),
                        "Number of cases that run at a time; 0 takes the "
                        "available cores. Under mpirun it is the number of "
                        "each process, and 0 means 1.");
      prm.declare_entry("CPU limit",
                        "600",
                        Patterns::Double(0.),
                        "CPU time after which a case is ended [s]; 0 sets no "
                        "limit.");
      prm.declare_entry("Repeat",
                        "false",
                        Patterns::Bool(),
                        "Run finished cases again, too; needed after a change "
                        "of the program itself.");
      prm.declare_entry("Curve",
                        "automatic",
                        Patterns::Anything(),
                        "Columns of curves.csv that are drawn and compared, "
                        "'H3: n3' or with several ordinates 'H3: n1, n3'. "
                        "`automatic` takes the component with the largest "
                        "target in the last stage and its conjugate.");
      prm.declare_entry("Stage",
                        "",
                        Patterns::Anything(),
                        "Stage of the curve; empty for the last one.");
      prm.declare_entry("Panels",
                        "",
                        Patterns::List(Patterns::Anything()),
                        "sweep: swept entries that make a panel of their own "
                        "for each of their values. A stability map takes all "
                        "that are not its axes.");
      prm.declare_entry("Axes",
                        "",
                        Patterns::List(Patterns::Anything(), 0, 2),
                        "stability map: the two swept entries on its axes, "
                        "horizontal first. Empty: the first two.");
      prm.declare_entry("Series",
                        "automatic",
                        Patterns::List(Patterns::Anything()),
                        "work-precision: the swept entries that make a method, "
                        "with a symbol of its own in the picture. `automatic`: "
                        "those whose values are words.");
      prm.declare_entry("Accuracies",
                        "0.1, 0.01, 0.001",
                        Patterns::List(
                          Patterns::Double(std::numeric_limits<double>::min())),
                        "work-precision: relative errors of the curve for "
                        "which a setting is recommended [-].");
      prm.declare_entry("Mean iterations over",
                        "0",
                        Patterns::Integer(0, 10000),
                        "sweep: also draw the Newton iterations, averaged over "
                        "so many load steps; 0 does not.");
      prm.leave_subsection();
    }



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



  StudyParameters
  StudyParameters::read(const ParameterText            &given_text,
                        const std::vector<std::string> &overrides)
  {
    StudyParameters     study;
    const ParameterText text = with_overrides(given_text, overrides);

    // Apart: what to do, the reference, and the plate test.
    auto [reference_text, without_reference] =
      extract_subsection(text, "Study/Reference");
    // It repeats entries of the same file on purpose.
    for (auto &statement : reference_text.statements)
      statement.file += " (Reference)";
    const auto [study_entries, others] =
      extract_subsection(without_reference, "Study");
    ParameterText study_text, plate_text, base_text;
    study_text.statements.push_back({Kind::subsection, "Study", "", "", 0});
    append(study_text, study_entries);
    study_text.statements.push_back({Kind::end, "", "", "", 0});
    unsigned int depth = 0;
    for (const auto &statement : others.statements)
      {
        if (statement.kind == Kind::set && depth == 0 &&
            statement.name == "Problem")
          continue;
        depth += statement.kind == Kind::subsection;
        depth -= statement.kind == Kind::end;
        plate_text.statements.push_back(statement);
      }

    dealii::ParameterHandler prm;
    declare_study(prm);
    parse_parameter_text(prm, study_text);
    prm.enter_subsection("Study");
    study.kind            = prm.get("Kind");
    study.title           = prm.get("Title");
    study.directory       = prm.get("Directory");
    study.side_by_side    = prm.get_integer("Cases side by side");
    study.cpu_limit       = prm.get_double("CPU limit");
    study.repeat          = prm.get_bool("Repeat");
    study.stage           = prm.get("Stage");
    study.panels          = split_string_list(prm.get("Panels"), ',');
    study.axes            = split_string_list(prm.get("Axes"), ',');
    study.series          = split_string_list(prm.get("Series"), ',');
    study.mean_iterations = prm.get_integer("Mean iterations over");
    for (const std::string &number :
         split_string_list(prm.get("Accuracies"), ','))
      study.accuracies.push_back(dealii::Utilities::string_to_double(number));
    const std::string curve = prm.get("Curve");
    const std::string bases = prm.get("Base");
    prm.leave_subsection();

    const std::string place = " (subsection Study).";
    if (curve != "automatic")
      {
        const auto parts = split_string_list(curve, ':');
        if (parts.size() != 2 || parts[0].empty() || parts[1].empty())
          throw InputError("Curve is '" + curve +
                           "'; it must be 'automatic' or two columns of "
                           "curves.csv, as in 'H3: n3'" +
                           place);
        study.x_column  = parts[0];
        study.y_columns = split_string_list(parts[1], ',');
        curve_value(CurveRow(), study.x_column); // throws if there is none
        for (const std::string &column : study.y_columns)
          curve_value(CurveRow(), column);
        if (study.kind == "work-precision" && study.y_columns.size() > 1)
          throw InputError(
            "Curve names " + std::to_string(study.y_columns.size()) +
            " ordinates; a work-precision study compares one" + place);
      }

    // Base files: the entry may be a loop, and is the first of all.
    fs::path     folder;
    std::string  where   = "Base: ";
    unsigned int n_bases = 1;
    visit_entries(study_text,
                  [&](const std::string              &path,
                      const ParameterText::Statement &statement) {
                    if (path != base_entry)
                      return;
                    folder = statement.line == 0 ?
                               fs::path() :
                               fs::path(statement.file).parent_path();
                    where  = statement.file +
                            (statement.line == 0 ?
                               ": " :
                               ":" + std::to_string(statement.line) + ": ");
                  });
    std::vector<ParameterText> base_texts(1);
    if (!bases.empty())
      {
        append_entry(base_text, base_entry, bases);
        const auto names = split_loop(bases, where).first;
        n_bases          = names.size();
        base_texts.resize(n_bases);
        for (unsigned int b = 0; b < n_bases; ++b)
          {
            const std::string file = (folder / names[b]).lexically_normal();
            study.base_files_.push_back(file);
            study.group_names.push_back(fs::path(file).stem());
            try
              {
                base_texts[b] = read_parameter_text(file);
              }
            catch (const InputError &error)
              {
                throw InputError(where + "Base: " + error.what());
              }
            const std::string problem =
              get_entry(base_texts[b], {}, "Problem").value_or("plate test");
            if (problem != "plate test")
              throw InputError("The base file '" + file + "' is a " + problem +
                               "; studies run plate tests" + place);
          }
      }
    else
      study.group_names = {"curve"};

    ParameterText loop_text = base_text;
    append(loop_text, plate_text);
    study.loops                 = std::make_unique<ParameterLoops>(loop_text);
    const ParameterLoops &loops = *study.loops;

    // Names of swept entries must exist.
    for (const auto *names : {&study.panels, &study.axes, &study.series})
      for (const std::string &name : *names)
        if (name != "automatic")
          loops.find(name, place);
    if (study.kind == "stability map" &&
        (loops.axis_sizes().size() < 2 || study.axes.size() == 1))
      throw InputError(
        "A stability map needs two swept entries as axes, found " +
        std::to_string(loops.axis_sizes().size()) +
        " loops; write values in braces, {10 | 100}" + place);
    if (study.kind == "stability map" && !study.axes.empty() &&
        loops.loops()[loops.find(study.axes[0], place)].axis ==
          loops.loops()[loops.find(study.axes[1], place)].axis)
      throw InputError("The Axes " + study.axes[0] + " and " + study.axes[1] +
                       " go along with each other; a map needs two "
                       "independent loops {...}" +
                       place);

    // ---- All cases.
    const auto read_case = [&](const unsigned int   group,
                               const ParameterText &entries,
                               SweepCase           &c,
                               const std::string   &name) {
      ParameterText complete = base_texts[group];
      append(complete, defaults_of_cases());
      append(complete, extract_subsection(entries, "Study").second);
      try
        {
          const PlateTestParameters parameters =
            PlateTestParameters::read(complete);
          c.parameters          = parameters.used_file;
          const LoadStage &last = parameters.load_programme.stages.back();
          Details          details;
          details.group      = group;
          details.last_stage = last.name;
          double largest     = 0;
          for (const auto *targets : {&last.n_targets, &last.H_targets})
            for (const auto &[component, target] : *targets)
              if (std::abs(target) > largest)
                {
                  largest           = std::abs(target);
                  details.component = component;
                }
          if (!study.stage.empty() &&
              std::none_of(parameters.load_programme.stages.begin(),
                           parameters.load_programme.stages.end(),
                           [&](const LoadStage &s) {
                             return s.name == study.stage;
                           }))
            throw InputError("Stage is '" + study.stage +
                             "', which the load programme does not have" +
                             place);
          return details;
        }
      catch (const InputError &error)
        {
          throw InputError(std::string(error.what()) +
                           (name.empty() ? "" : " [" + name + "]"));
        }
    };
    for (unsigned int i = 0; i < loops.n_cases(); ++i)
      {
        SweepCase c;
        for (unsigned int l = 0; l < loops.loops().size(); ++l)
          c.values.emplace_back(loops.loops()[l].name,
                                display_value(loops.loops()[l],
                                              loops.value(l, i)));
        const unsigned int group = n_bases > 1 ? loops.position(i)[0] : 0;
        study.details.push_back(read_case(group,
                                          loops.text_of_case(i),
                                          c,
                                          c.values.empty() ?
                                            "" :
                                            "case " + std::to_string(i + 1) +
                                              ": " + describe_case(c)));
        study.cases.push_back(c);
      }

    // ---- The reference says what the finest case is.
    if (study.kind == "work-precision")
      {
        std::set<std::string> fixed;
        visit_entries(reference_text,
                      [&](const std::string &path,
                          const ParameterText::Statement &) {
                        fixed.insert(path);
                      });
        for (const ParameterLoop &loop : loops.loops())
          if (loop.path != base_entry && fixed.count(loop.path) == 0)
            throw InputError(
              "A work-precision study needs a reference: set '" + loop.path +
              "', which is swept, in subsection Reference of subsection Study "
              "as well; {{a | b}} there gives the two finest cases, the finest "
              "last.");
        const ParameterLoops fine(reference_text);
        for (unsigned int g = 0; g < n_bases; ++g)
          {
            study.references.emplace_back();
            for (unsigned int i = 0; i < fine.n_cases(); ++i)
              {
                SweepCase c;
                // The same columns as the other cases have.
                ParameterText entries = loops.text_of_case(0);
                append(entries, fine.text_of_case(i));
                for (const ParameterLoop &loop : loops.loops())
                  c.values.emplace_back(
                    loop.name,
                    loop.path == base_entry ?
                      study.group_names[g] :
                      get_entry(entries, {}, loop.path).value_or(""));
                read_case(g,
                          entries,
                          c,
                          "reference " + std::to_string(i + 1) + ": " +
                            describe_case(c));
                study.references.back().push_back(c);
              }
          }
      }
    else if (!reference_text.statements.empty())
      throw InputError("Subsection Reference belongs to studies of Kind "
                       "work-precision; this one is a " +
                       study.kind + place);

    // ---- The file as it will be kept.
    std::ostringstream documented;
    print_documented_parameters(prm, documented);
    study.documented_ = documented.str();
    if (!reference_text.statements.empty())
      study.reference_ = print_parameter_text([&]() {
        ParameterText t;
        t.statements.push_back({Kind::subsection, "Study", "", "", 0});
        t.statements.push_back({Kind::subsection, "Reference", "", "", 0});
        append(t, reference_text);
        t.statements.push_back({Kind::end, "", "", "", 0});
        t.statements.push_back({Kind::end, "", "", "", 0});
        return t;
      }());
    study.rest_     = print_parameter_text(plate_text);
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
