// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines reading and checking the list of stages.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/problems/load_programme/load_programme.h>
#include <npt_dealii/problems/load_programme/tester_targets.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  template <>
  const EnumNames<LoadStage::Type> &
  enum_names<LoadStage::Type>()
  {
    using Type                         = LoadStage::Type;
    static const EnumNames<Type> names = {
      {Type::weave, "weave"},
      {Type::release, "release"},
      {Type::relax, "relax"},
      {Type::load, "load"},
      {Type::trellis, "trellis"},
      {Type::picture_frame, "picture frame"},
      {Type::bias_extension, "bias extension"},
      {Type::compression, "compression"}};
    return names;
  }



  LoadStage::LoadStage(const std::string &given_name)
    : name(given_name)
  {
    if (name == "weave")
      {
        // The first contact of flat bundles: a long step may end in a dent
        // far from the bundles' common path.
        steps.initial_step = 0.025;
        steps.maximum_step = 0.1;
      }
    else if (name == "release")
      steps.initial_step = steps.maximum_step = 1;
    else if (name == "shear")
      H_targets[2] = 0.2;
    else if (name == "tension")
      H_targets[0] = 0.2;
  }



  void
  LoadStage::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Stage " + name);
    add_parameter(prm,
                  "Type",
                  given_type,
                  "What the stage does. Automatic: weave or release if it is "
                  "so named, else load. relax: stress and contact pressure "
                  "relax, see Relaxed fraction. trellis: yarns of constant "
                  "length turn against each other; picture frame: yarns that "
                  "are clamped or under a constant tension turn; bias "
                  "extension: pulled half way between warp and weft, with free "
                  "edges; compression: pressed between two plates.");
    add_parameter(
      prm,
      "Targets",
      targets(),
      [this](const std::string &text) { set_targets(text); },
      "Values at the end of the stage, as H3: 0.2, n1: 0. H are the "
      "generalized displacement gradients (" +
        MacroModes::meaning_of_gradients() +
        "), n prescribe the conjugate resultants (" +
        MacroModes::units_of_conjugates() +
        ") instead of H. Components not named keep what is prescribed for "
        "them. " +
        TesterTargets::meaning(),
      Patterns::Map(Patterns::Selection(MacroModes::choices() + "|" +
                                        TesterTargets::choices()),
                    Patterns::Double()));
    add_parameter(prm,
                  "Start",
                  start,
                  "Name of an earlier stage at whose end this one begins; "
                  "empty: the stage before. So several stages are independent "
                  "tests of the same woven cell.");
    add_parameter(prm,
                  "Friction",
                  given_friction,
                  "Friction during the stage. Automatic: off in weave, release "
                  "and relax, on in all others.");
    add_parameter(prm,
                  "Relaxed fraction",
                  relaxed_fraction,
                  "Stage of type relax: how much of the stress and of the "
                  "contact pressure is gone at its end [-], as in a fabric "
                  "whose weaving stresses have relaxed; 1 leaves bundles "
                  "without stress that just touch. Their place is that before "
                  "the stage, so that 1 is best reached in one step (Initial "
                  "step and Maximum step 1); on the way bundles that little "
                  "holds may float.",
                  Patterns::Double(0., 1.));
    steps.add_parameters(prm);
  }



  std::string
  LoadStage::targets() const
  {
    std::string text;
    const auto  add = [&](const char *mode, const double value) {
      text += (text.empty() ? "" : ", ") + std::string(mode) + ": " +
              EntryValue<double>::text(value);
    };
    for (const auto &[component, value] : H_targets)
      add(MacroModes::table[component].name, value);
    for (const auto &[component, value] : n_targets)
      add(MacroModes::table[component].conjugate, value);
    for (const auto &[target, value] : tester_targets)
      add(target.c_str(), value);
    return text;
  }



  void
  LoadStage::set_targets(const std::string &text)
  {
    H_targets.clear();
    n_targets.clear();
    tester_targets.clear();
    const std::string place = " (subsection Stage " + name + ").";
    for (const std::string &item : split_list(text))
      {
        const auto key_value = dealii::Utilities::split_string_list(item, ':');
        AssertDimension(key_value.size(), 2); // checked by the pattern
        const std::string &key       = key_value[0];
        const unsigned int component = MacroModes::number_of(key);
        const double       value     = EntryValue<double>::value(key_value[1]);
        const bool         is_new    = component == MacroModes::n ?
                                         tester_targets.emplace(key, value).second :
                                       MacroModes::is_conjugate(key) ?
                                         n_targets.emplace(component, value).second :
                                         H_targets.emplace(component, value).second;
        if (!is_new)
          throw InputError("Targets names " + key + " twice; once is enough" +
                           place);
      }
    for (const auto &target : n_targets)
      if (H_targets.count(target.first) > 0)
        {
          const MacroMode &mode = MacroModes::table[target.first];
          throw InputError(std::string("Targets prescribes both ") + mode.name +
                           " and " + mode.conjugate +
                           "; of a component either the deformation or the "
                           "resultant can be prescribed" +
                           place);
        }
  }



  void
  LoadStage::complete()
  {
    type     = given_type        ? *given_type :
               name == "weave"   ? Type::weave :
               name == "release" ? Type::release :
                                   Type::load;
    friction = given_friction.value_or(is_test());
    TesterTargets::settle(*this);
    if (type == Type::load && H_targets.empty() && n_targets.empty())
      throw InputError("Targets is empty; a load stage needs at least one, "
                       "such as H3: 0.2 (subsection Stage " +
                       name + ").");
    if ((relaxed_fraction > 0.) != (type == Type::relax))
      throw InputError("Relaxed fraction is " +
                       EntryValue<double>::text(relaxed_fraction) +
                       (type == Type::relax ?
                          ", but a stage of type relax must relax something" :
                          ", but the stage is not of type relax") +
                       " (subsection Stage " + name + ").");
    steps.check("subsection Stage " + name);
  }



  std::optional<double>
  LoadStage::tester_target(const std::string &target) const
  {
    const auto found = tester_targets.find(target);
    return found == tester_targets.end() ? std::optional<double>() :
                                           found->second;
  }



  std::vector<unsigned int>
  LoadStage::driven_modes() const
  {
    std::vector<unsigned int> modes;
    for (unsigned int n = 0; n < MacroModes::n; ++n)
      if (H_targets.count(n) + n_targets.count(n) > 0 ||
          (leads_yarns() && n < TesterTargets::n_membrane))
        modes.push_back(n);
    return modes;
  }



  std::optional<unsigned int>
  stage_before(const std::vector<LoadStage> &stages, const unsigned int index)
  {
    AssertIndexRange(index, stages.size());
    if (index == 0)
      return {};
    unsigned int before = index - 1;
    if (!stages[index].start.empty())
      while (before > 0 && stages[before].name != stages[index].start)
        --before;
    return before;
  }



  std::vector<unsigned int>
  path_to(const std::vector<LoadStage> &stages, const unsigned int index)
  {
    std::vector<unsigned int> path;
    for (std::optional<unsigned int> k = index; k; k = stage_before(stages, *k))
      path.push_back(*k);
    std::reverse(path.begin(), path.end());
    return path;
  }



  namespace
  {
    const std::string default_stages = "weave, release, shear";

    // Names become parts of the names of files, and every stage has a dozen
    // entries.
    void
    check_list(const std::vector<std::string> &names)
    {
      const std::size_t most = 1000, longest = 100;
      if (names.size() > most)
        throw InputError("Stages names " + std::to_string(names.size()) +
                         " stages; there may be at most " +
                         std::to_string(most) +
                         " (subsection Load programme).");
      for (const std::string &name : names)
        if (name.size() > longest)
          throw InputError("Stages names " + in_quotes(name) + ", which has " +
                           std::to_string(name.size()) +
                           " characters; a name may have at most " +
                           std::to_string(longest) +
                           " (subsection Load programme).");
    }

    void
    check_start(const std::vector<LoadStage> &stages, const unsigned int index)
    {
      std::vector<std::string> earlier;
      for (unsigned int k = 0; k < index; ++k)
        earlier.push_back(stages[k].name);
      const LoadStage &stage = stages[index];
      if (stage.start.empty() ||
          std::find(earlier.begin(), earlier.end(), stage.start) !=
            earlier.end())
        return;
      throw InputError(
        "Start is " + in_quotes(stage.start) +
        (earlier.empty() ?
           ", but the first stage has none before it; leave it empty" :
           ", which is no stage before " + stage.name +
             " in Stages; those "
             "are " +
             listed(earlier) + did_you_mean(stage.start, earlier)) +
        " (subsection Stage " + stage.name + ").");
    }

    // On the way to a stage.
    void
    check_order(const std::vector<LoadStage>    &stages,
                const std::vector<unsigned int> &path)
    {
      const std::string where =
        "; the order is weave, release, load (entry Stages, subsection Load "
        "programme).";
      const LoadStage *weave = nullptr, *release = nullptr, *load = nullptr;
      for (const unsigned int k : path)
        {
          const LoadStage &stage = stages[k];
          switch (stage.type)
            {
              case LoadStage::Type::weave:
                if (load)
                  throw InputError("Stage " + stage.name +
                                   " weaves after load stage " + load->name +
                                   where);
                if (weave)
                  throw InputError("Stage " + stage.name +
                                   " weaves what stage " + weave->name +
                                   " has woven already" + where);
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
              case LoadStage::Type::relax:
                if (!release)
                  throw InputError("Stage " + stage.name +
                                   " relaxes, but no stage before it releases "
                                   "a weave" +
                                   where);
                break;
              default: // a test
                if (weave && !release)
                  throw InputError("Stage " + stage.name +
                                   " loads before the weave of stage " +
                                   weave->name + " is released" + where);
                load = &stage;
                break;
            }
        }
    }
  } // namespace



  LoadProgramme::LoadProgramme(const std::string &names)
    : names_(names)
  {
    std::vector<std::string> list = split_list(names);
    if (list.empty())
      {
        names_ = default_stages;
        list   = split_list(default_stages);
      }
    check_list(list);
    for (const std::string &name : list)
      stages.emplace_back(name);
  }



  void
  LoadProgramme::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Load programme");
    // The stages stand already; the text is that of the file, even if it is
    // no list.
    add_parameter(
      prm,
      "Stages",
      default_stages,
      [](const std::string &) {},
      "Names of the stages in their order, separated by "
      "commas. Each has its subsection Stage NAME.",
      Patterns::List(Patterns::Anything(), 1));
    add_parameter(
      prm,
      "Further stages",
      "",
      [](const std::string &) {},
      "Names of stages that the file describes and does not run; for other "
      "lists of stages, as those of --set 'Load programme/Stages=...'.",
      Patterns::List(Patterns::Anything(), 0));
    for (LoadStage &stage : stages)
      stage.add_parameters(prm);
  }



  void
  LoadProgramme::check()
  {
    std::set<std::string> known;
    for (LoadStage &stage : stages)
      {
        if (stage.name.empty())
          throw InputError("Stages is '" + names_ +
                           "' with nothing between two commas; remove one of "
                           "them (subsection Load programme).");
        if (stage.name.find('"') != std::string::npos)
          throw InputError("Stages names " + stage.name +
                           " in quotation marks; write the name without them "
                           "(subsection Load programme).");
        if (!known.insert(stage.name).second)
          throw InputError("Stages names " + stage.name +
                           " twice; give the second one its own name "
                           "(subsection Load programme).");
        stage.complete();
      }
    for (unsigned int k = 0; k < stages.size(); ++k)
      check_start(stages, k);
    for (unsigned int k = 0; k < stages.size(); ++k)
      check_order(stages, path_to(stages, k));
  }



  std::map<std::string, std::string>
  LoadProgramme::branches() const
  {
    std::map<std::string, std::string> result;
    for (unsigned int k = 1; k < stages.size(); ++k)
      if (const unsigned int before = *stage_before(stages, k); before + 1 != k)
        result[stages[k].name] = stages[before].name;
    return result;
  }



  std::string
  LoadProgramme::file_name(const std::string &stage) const
  {
    std::set<std::string> taken; // in lower case
    for (const LoadStage &other : stages)
      {
        std::string plain = other.name;
        for (char &c : plain)
          if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-')
            c = '_';
        std::string name = plain;
        for (unsigned int k = 2; !taken.insert(lower_case(name)).second; ++k)
          name = plain + "_" + std::to_string(k);
        if (other.name == stage)
          return name;
      }
    AssertThrow(false, dealii::ExcMessage("There is no stage " + stage + "."));
    return "";
  }
} // namespace NPT
