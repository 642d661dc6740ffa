// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines reading and checking the list of stages.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/problems/plate_test/load_programme.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace NPT
{
  namespace
  {
    const std::string default_stages = "weave, release, shear";

    std::vector<std::string>
    split_names(const std::string &list)
    {
      return dealii::Utilities::split_string_list(list, ',');
    }

    std::string
    default_targets(const std::string &name)
    {
      return name == "shear" ? "H3: 0.2" : name == "tension" ? "H1: 0.2" : "";
    }

    StepParameters
    default_steps(const std::string &name)
    {
      StepParameters steps;
      if (name == "weave")
        {
          // The first contact of flat bundles: a long step may end in a dent
          // far from the bundles' common path.
          steps.initial_step = 0.025;
          steps.maximum_step = 0.1;
        }
      else if (name == "release")
        steps.initial_step = steps.maximum_step = 1;
      return steps;
    }

    LoadStage::Type
    stage_type(const std::string &choice, const std::string &name)
    {
      const std::string &type = choice == "automatic" ? name : choice;
      return type == "weave"   ? LoadStage::Type::weave :
             type == "release" ? LoadStage::Type::release :
                                 LoadStage::Type::load;
    }

    /// "H3: 0.2, n1: 0" into the two maps of the stage.
    void
    read_targets(const std::string &text, LoadStage &stage)
    {
      using namespace dealii::Utilities;
      const std::string place = " (subsection Stage " + stage.name + ").";
      for (const std::string &item : split_string_list(text, ','))
        {
          const auto key_value = split_string_list(item, ':');
          AssertDimension(key_value.size(), 2); // checked by the pattern
          const std::string &key       = key_value[0];
          const unsigned int component = key[1] - '1';
          auto &targets = key[0] == 'H' ? stage.H_targets : stage.n_targets;
          if (!targets.emplace(component, string_to_double(key_value[1]))
                 .second)
            throw InputError("Targets names " + key + " twice; once is enough" +
                             place);
        }
      for (const auto &[component, value] : stage.n_targets)
        if (stage.H_targets.count(component) > 0)
          {
            const std::string i = std::to_string(component + 1);
            throw InputError("Targets prescribes both H" + i + " and n" + i +
                             "; of a component either the deformation or the "
                             "resultant can be prescribed" +
                             place);
          }
    }

    void
    check_order(const std::vector<LoadStage> &stages)
    {
      const std::string where =
        "; the order is weave, release, load (entry Stages, subsection Load "
        "programme).";
      const LoadStage *weave = nullptr, *release = nullptr, *load = nullptr;
      for (const LoadStage &stage : stages)
        switch (stage.type)
          {
            case LoadStage::Type::weave:
              if (load)
                throw InputError("Stage " + stage.name +
                                 " weaves after load stage " + load->name +
                                 where);
              if (weave)
                throw InputError("Stage " + stage.name + " weaves what stage " +
                                 weave->name + " has woven already" + where);
              weave = &stage;
              break;
            case LoadStage::Type::release:
              if (!weave)
                throw InputError("Stage " + stage.name +
                                 " releases, but no stage before it weaves" +
                                 where);
              if (release)
                throw InputError("Stage " + stage.name +
                                 " releases what stage " + release->name +
                                 " has released already" + where);
              release = &stage;
              break;
            case LoadStage::Type::load:
              if (weave && !release)
                throw InputError("Stage " + stage.name +
                                 " loads before the weave of stage " +
                                 weave->name + " is released" + where);
              load = &stage;
              break;
          }
    }
  } // namespace



  std::vector<std::string>
  LoadProgramme::read_stage_names(const std::string &prm_text)
  {
    std::string              found = default_stages;
    std::vector<std::string> path;
    std::istringstream       input(prm_text);
    std::string              line, joined;
    while (std::getline(input, line))
      {
        line = dealii::Utilities::trim(line);
        if (!line.empty() && line.back() == '\\')
          {
            line.pop_back();
            joined += line;
            continue;
          }
        joined += line;
        std::istringstream words(joined.substr(0, joined.find('#')));
        joined.clear();

        std::string keyword, rest, word;
        words >> keyword;
        std::transform(keyword.begin(),
                       keyword.end(),
                       keyword.begin(),
                       tolower);
        while (words >> word)
          rest += (rest.empty() ? "" : " ") + word;

        if (keyword == "subsection")
          path.push_back(rest);
        else if (keyword == "end")
          {
            if (!path.empty())
              path.pop_back();
          }
        else if (keyword == "set" &&
                 path == std::vector<std::string>{"Load programme"})
          {
            const auto equal = rest.find('=');
            if (equal != std::string::npos &&
                dealii::Utilities::trim(rest.substr(0, equal)) == "Stages")
              found = rest.substr(equal + 1);
          }
      }
    return split_names(found);
  }



  void
  LoadProgramme::declare_parameters(dealii::ParameterHandler       &prm,
                                    const std::vector<std::string> &stage_names)
  {
    using namespace dealii;
    prm.enter_subsection("Load programme");
    {
      prm.declare_entry("Stages",
                        default_stages,
                        Patterns::List(Patterns::Anything(), 1),
                        "Names of the stages in their order, separated by "
                        "commas. Each has its subsection Stage NAME.");
      for (const std::string &name : stage_names)
        {
          prm.enter_subsection("Stage " + name);
          {
            prm.declare_entry(
              "Type",
              "automatic",
              Patterns::Selection("automatic|weave|release|load"),
              "What the stage does. Automatic: weave or release if it is so "
              "named, else load.");
            prm.declare_entry(
              "Targets",
              default_targets(name),
              Patterns::Map(Patterns::Selection("H1|H2|H3|H4|H5|H6|"
                                                "n1|n2|n3|n4|n5|n6"),
                            Patterns::Double()),
              "Values at the end of the stage, as H3: 0.2, n1: 0. "
              "H1..H6 are the generalized displacement gradients (stretch 1, "
              "stretch 2, shear [-]; bending 1, bending 2, torsion [1/mm]). "
              "n1..n6 prescribe the conjugate resultant (n1..n3 [N/mm], "
              "n4..n6 [N]) instead of H. Components not named keep what is "
              "prescribed for them.");
            prm.declare_entry("Friction",
                              "automatic",
                              Patterns::Selection("automatic|true|false"),
                              "Friction during the stage. Automatic: off in "
                              "weave and release, on in load.");
            default_steps(name).declare_parameters(prm);
          }
          prm.leave_subsection();
        }
    }
    prm.leave_subsection();
  }



  void
  LoadProgramme::parse_parameters(dealii::ParameterHandler &prm)
  {
    // Leaves the subsections also if a check throws.
    class Section
    {
    public:
      Section(dealii::ParameterHandler &handler, const std::string &name)
        : prm(handler)
      {
        prm.enter_subsection(name);
      }

      ~Section()
      {
        prm.leave_subsection();
      }

    private:
      dealii::ParameterHandler &prm;
    };

    stages.clear();
    std::set<std::string> known;
    const Section         programme(prm, "Load programme");
    for (const std::string &name : split_names(prm.get("Stages")))
      {
        if (name.empty())
          throw InputError("Stages is '" + prm.get("Stages") +
                           "' with nothing between two commas; remove one of "
                           "them (subsection Load programme).");
        if (name.find('"') != std::string::npos)
          throw InputError("Stages names " + name +
                           " in quotation marks; write the name without them "
                           "(subsection Load programme).");
        if (!known.insert(name).second)
          throw InputError("Stages names " + name +
                           " twice; give the second one its own name "
                           "(subsection Load programme).");
        const std::string section_name = "Stage " + name;
        AssertThrow(prm.subsection_path_exists({section_name}),
                    dealii::ExcMessage(section_name +
                                       " was not declared; use the names of "
                                       "read_stage_names()."));
        const Section section(prm, section_name);

        LoadStage stage;
        stage.name = name;
        stage.type = stage_type(prm.get("Type"), name);
        read_targets(prm.get("Targets"), stage);
        if (stage.type == LoadStage::Type::load && stage.H_targets.empty() &&
            stage.n_targets.empty())
          throw InputError("Targets is empty; a load stage needs at least one, "
                           "such as H3: 0.2 (subsection " +
                           section_name + ").");
        const std::string friction = prm.get("Friction");
        stage.friction             = friction == "automatic" ?
                                       stage.type == LoadStage::Type::load :
                                       friction == "true";
        stage.steps.parse_parameters(prm, "subsection " + section_name);
        stages.push_back(stage);
      }
    check_order(stages);
  }
} // namespace NPT
