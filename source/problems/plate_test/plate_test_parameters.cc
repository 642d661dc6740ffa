// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines gathering, reading and cross-checking of all parameters.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/nearest_name.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/problem_names.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/base/unused_sections.h>
#include <npt_dealii/fabric/weave_pattern.h>
#include <npt_dealii/homogenization/cell_modes.h>
#include <npt_dealii/problems/load_programme/bending_directions.h>
#include <npt_dealii/problems/load_programme/macro_limits.h>
#include <npt_dealii/problems/load_programme/neighbor_distance.h>
#include <npt_dealii/problems/plate_test/cell_sizes.h>
#include <npt_dealii/problems/plate_test/plate_test_parameters.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <tuple>
#include <utility>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  template <>
  const EnumNames<OutputParameters::Fields> &
  enum_names<OutputParameters::Fields>()
  {
    using Fields                         = OutputParameters::Fields;
    static const EnumNames<Fields> names = {{Fields::none, "none"},
                                            {Fields::stages, "stages"},
                                            {Fields::steps, "steps"}};
    return names;
  }



  void
  OutputParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Output");
    add_parameter(prm,
                  "Directory",
                  directory,
                  "Where all results go; created if missing. The option "
                  "--output of the program overrides it.",
                  Patterns::DirectoryName());
    add_parameter(prm,
                  "Fields",
                  fields,
                  "When fields (VTU) are written: never, at the end of "
                  "every stage, or after every accepted load step.");
    add_parameter(prm,
                  "Picture",
                  picture,
                  "Draw with gnuplot: at the end of every stage the deformed "
                  "cell, colored by von Mises stress (cell_STAGE.svg), "
                  "and at the end of the run the curves (curves.svg).");
    exports.add_parameters(prm);
  }



  double
  AccuracyParameters::target() const
  {
    std::string text    = dealii::Utilities::trim(wanted);
    const bool  percent = !text.empty() && text.back() == '%';
    if (percent)
      text = dealii::Utilities::trim(text.substr(0, text.size() - 1));
    char        *end    = nullptr;
    const double value  = std::strtod(text.c_str(), &end);
    const double result = percent ? 0.01 * value : value;
    if (text.empty() || *end != '\0' || !(result >= 1e-4 && result <= 0.2))
      throw InputError("Target is '" + wanted +
                       "'; it must be off or an accuracy from 0.01 % to 20 %, "
                       "as 1 % or 0.01 (subsection Accuracy).");
    return result;
  }



  void
  AccuracyParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Accuracy");
    add_parameter(
      prm,
      "Target",
      wanted,
      "off: the test runs once, as the file says. An accuracy, as 1 %: the "
      "program chooses mesh, contact method, penalties and steps of the load "
      "stages, estimates the error of every driven resultant by further runs "
      "(coarser mesh, one more layer of elements, softer contact, longer "
      "steps), refines until the error bars are below the target, and writes "
      "the curves with their bars (accuracy.csv, accuracy.svg). What the "
      "file says of these entries does not count then.");
    add_parameter(prm,
                  "CPU limit",
                  cpu_limit,
                  "Seconds of CPU time of all runs beyond which no further "
                  "refinement begins [s]; also the limit of a single run.",
                  positive_number());
  }



  void
  CheckpointParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Checkpoint");
    add_parameter(prm,
                  "Every steps",
                  every_steps,
                  "Accepted load steps after which all that the run needs to "
                  "go on is written to checkpoint.bin; 0: not by steps [-]. "
                  "The option --continue goes on from there.",
                  Patterns::Integer(0));
    add_parameter(prm,
                  "Every minutes",
                  every_minutes,
                  "The same by time: after the first load step that ends so "
                  "long after the last checkpoint; 0: not by time [min]. There "
                  "is also one at the end of every stage and where the run "
                  "ends early, unless both entries are 0.",
                  Patterns::Double(0));
  }



  template <>
  const EnumNames<StabilityParameters::OnLoss> &
  enum_names<StabilityParameters::OnLoss>()
  {
    using OnLoss                         = StabilityParameters::OnLoss;
    static const EnumNames<OnLoss> names = {{OnLoss::stop, "stop"},
                                            {OnLoss::warn, "warn"}};
    return names;
  }



  void
  StabilityParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Stability");
    add_parameter(
      prm,
      "Check ellipticity",
      check_ellipticity,
      "true: as On loss of ellipticity = stop. A loss is looked for in any "
      "case.");
    add_parameter(
      prm,
      "On loss of ellipticity",
      on_loss,
      "What to do where the lowest eigenvalue of the acoustic tensor is not "
      "positive at some quadrature point after a load step. stop: the step is "
      "refused and cut, so that the run ends at the loss and names bundle, "
      "place and direction. warn: the same words are a warning, and the run "
      "goes on; what follows depends on the mesh.");
    add_parameter(
      prm,
      "Energy tolerance",
      energy_tolerance,
      "A stage is warned of whose work differs from the growth of the energies "
      "plus the dissipation by more than this fraction [-]. A load step after "
      "which more than this fraction of the energy content is missing, and "
      "more than the length of the step explains, has jumped to another "
      "branch: it is cut, and warned of if it cannot be cut any more.",
      Patterns::Double(0.));
  }



  namespace
  {
    // A mode that the cell's symmetry forbids would give wrong numbers without
    // any sign of error, so it is refused here.
    void
    check_modes(const PlateTestParameters &parameters)
    {
      const FabricCell cell(parameters.cell, parameters.mesh);
      for (const LoadStage &stage : parameters.load_programme.stages)
        {
          const auto check = [&](const unsigned int n, const char *name) {
            if (!represents_mode(cell, n))
              throw InputError(
                "Stage " + stage.name + " prescribes " + name + ", which the " +
                parameters.cell.type + " cannot represent: its " +
                obstacle(cell, n) +
                " turns this mode into its opposite, so that the cell would "
                "rotate instead of deforming; only " +
                MacroModes::list_of_names(represented_modes(cell)) +
                " are allowed (subsection Stage " + stage.name + ").");
          };
          for (const unsigned int n : stage.driven_modes())
            check(n,
                  stage.n_targets.count(n) > 0 ?
                    MacroModes::table[n].conjugate :
                    MacroModes::table[n].name);
        }
    }

    // Drop the targets of modes that mirror planes forbid, where they are zero;
    // false if one is not, or nothing would be left of a stage.
    bool
    drop_forbidden_targets(LoadStage &stage)
    {
      const SymmetryOperation mirror =
        SymmetryOperation::mirror_plane("", 0, dealii::Tensor<1, 3>());
      const bool had_targets =
        !stage.H_targets.empty() || !stage.n_targets.empty();
      for (auto *targets : {&stage.H_targets, &stage.n_targets})
        for (auto target = targets->begin(); target != targets->end();)
          if (!keeps_mode(mirror, target->first) && target->second == 0.)
            target = targets->erase(target);
          else
            ++target;
      for (const unsigned int n : stage.driven_modes())
        if (!keeps_mode(mirror, n))
          return false;
      return !(had_targets && stage.H_targets.empty() &&
               stage.n_targets.empty());
    }

    // In-plane compression, in which the fabric may shear by itself.
    bool
    compresses(const LoadStage &stage)
    {
      for (const auto *targets : {&stage.H_targets, &stage.n_targets})
        for (const auto &[n, value] : *targets)
          if (MacroModes::table[n].kind == MacroMode::Kind::membrane &&
              value < 0.)
            return true;
      return false;
    }

    // Mirror planes as constraints, where the load programme allows them.
    void
    settle_mirror_planes(PlateTestParameters &parameters)
    {
      using MirrorPlanes   = CellParameters::MirrorPlanes;
      CellParameters &cell = parameters.cell;
      if (cell.mirror_planes == MirrorPlanes::no)
        return;
      const bool is_choice = cell.mirror_planes == MirrorPlanes::automatic;
      auto      &stages    = parameters.load_programme.stages;
      std::vector<LoadStage> without  = stages;
      bool                   allowed  = true;
      bool                   has_test = false;
      for (LoadStage &stage : without)
        has_test = has_test || stage.is_test();
      for (LoadStage &stage : without)
        if (!drop_forbidden_targets(stage) || (is_choice && compresses(stage)))
          allowed = false;
      if (is_choice)
        cell.mirror_planes =
          allowed && has_test && cell.obstacle_to_mirror_planes().empty() ?
            MirrorPlanes::yes :
            MirrorPlanes::no;
      if (allowed && cell.mirror_planes == MirrorPlanes::yes)
        stages = without;
      parameters.chose_mirror_planes =
        is_choice && cell.mirror_planes == MirrorPlanes::yes;
    }

    // Where a smooth closure would gain nothing or could not be kept; empty: it
    // can be used.
    std::string
    obstacle_to_smooth_closure(const PlateTestParameters &parameters)
    {
      if (parameters.mesh.basis != Basis::NURBS)
        return "Smooth closure is true with the Basis " +
               name_of(parameters.mesh.basis) +
               ", whose functions are only C0 between all elements, so that a "
               "smooth seam would gain nothing; use Basis = NURBS or Smooth "
               "closure = false (subsections Cell and Mesh).";
      for (const LoadStage &stage : parameters.load_programme.stages)
        if (!stage.is_test())
          for (unsigned int n = 0; n < MacroModes::n; ++n)
            if (MacroModes::table[n].kind == MacroMode::Kind::bending &&
                stage.H_targets.count(n) + stage.n_targets.count(n) > 0)
              return "Smooth closure is true and stage " + stage.name +
                     " prescribes mode " + std::to_string(n + 1) +
                     ", but the woven state, to which bending and torsion "
                     "refer, must then be reached without them; prescribe it "
                     "in a load stage (subsections Cell and Stage " +
                     stage.name + ").";
      return "";
    }

    // Whether bundles bend at their seams: they pass two crossings on the same
    // side.
    bool
    seams_bend(const CellParameters &cell)
    {
      return cell.type != "laminate" && !WeavePattern(cell.weave).is_plain();
    }

    void
    settle_smooth_closure(PlateTestParameters &parameters)
    {
      using SmoothClosure       = CellParameters::SmoothClosure;
      CellParameters   &cell    = parameters.cell;
      const std::string against = obstacle_to_smooth_closure(parameters);
      if (cell.smooth_closure == SmoothClosure::automatic)
        cell.smooth_closure = seams_bend(cell) && against.empty() ?
                                SmoothClosure::yes :
                                SmoothClosure::no;
      else if (cell.smooth_closure == SmoothClosure::yes && !against.empty())
        throw InputError(against);
    }

    // Two seams that share an inner neighbor need it in the frames of both.
    bool
    seams_share_neighbors(const PlateTestParameters &parameters)
    {
      const MeshParameters &mesh = parameters.mesh;
      const unsigned int    fewest =
        parameters.cell.type == "laminate" ?
             std::min(mesh.elements_along, mesh.elements_across) :
             mesh.elements_along;
      return parameters.cell.smooth_closure ==
               CellParameters::SmoothClosure::yes &&
             fewest + mesh.degree < 4;
    }

    bool
    bends_with_linear_jumps(const std::vector<LoadStage> &stages)
    {
      for (const LoadStage &stage : stages)
        for (const unsigned int n : stage.driven_modes())
          if (MacroModes::table[n].kind == MacroMode::Kind::bending &&
              !stage.bends_along)
            return true;
      return false;
    }

    // Which stages turn neighboring cells with the plate.
    void
    settle_jumps(PlateTestParameters &parameters)
    {
      using Jumps       = HomogenizationParameters::Jumps;
      const Jumps jumps = parameters.homogenization.jumps;
      if (jumps == Jumps::linear)
        return;
      auto       &stages   = parameters.load_programme.stages;
      std::string obstacle = set_bending_directions(stages);
      if (obstacle.empty() && seams_share_neighbors(parameters))
        obstacle = "a smooth closure needs two elements along a bundle then";
      if (jumps == Jumps::objective && !obstacle.empty())
        throw InputError(
          "Jumps is objective, but a plate is mapped onto itself only if it "
          "bends about one axis (H4 alone, H5 alone, or H4, H5 and H6 in one "
          "ratio with H6^2 = 4 H4 H5), and here " +
          obstacle +
          "; use Jumps = automatic or linear (subsections Homogenization and "
          "Load programme).");
      if (!obstacle.empty())
        for (LoadStage &stage : stages)
          stage.bends_along.reset();
      const bool bends =
        std::any_of(stages.begin(), stages.end(), [](const LoadStage &stage) {
          return stage.bends_along.has_value();
        });
      if (jumps == Jumps::automatic && (bends || !obstacle.empty()))
        parameters.reason_for_jumps =
          bends ? "objective: neighboring cells turn with the bent plate" :
                  "linear: neighboring cells do not turn, because " + obstacle;
    }

    // A mistake in a stage that is described and not run would be one on the
    // day when it is run, so that all stages that a text names are read.
    void
    check_all_stages(const ParameterText            &text,
                     const std::vector<std::string> &overrides,
                     const LoadProgramme            &programme)
    {
      std::vector<std::string> names;
      for (const LoadStage &stage : programme.stages)
        names.push_back(stage.name);
      const std::size_t n_run = names.size();
      visit_entries(text, [&](const std::string &path, const auto &statement) {
        if (path == "Load programme/Stages" ||
            path == "Load programme/Further stages")
          for (const std::string &name : split_list(statement.value))
            if (std::find(names.begin(), names.end(), name) == names.end())
              names.push_back(name);
      });
      if (names.size() == n_run)
        return;
      std::string list;
      for (const std::string &name : names)
        list += (list.empty() ? "" : ", ") + name;
      PlateTestParameters described;
      described.load_programme = LoadProgramme(list);
      dealii::ParameterHandler prm;
      described.add_parameters(prm);
      parse_parameter_text(prm, text, overrides);
    }
  } // namespace



  namespace
  {
    // A stage that is left out would be a jump in the curve of the test.
    void
    check_order_of_kes_stages(const KesParameters            &kes,
                              const std::vector<LoadStage>   &programme,
                              const std::vector<std::string> &names)
    {
      const auto name_before = [&](const std::string &name) {
        const auto before =
          stage_before(programme,
                       std::find(names.begin(), names.end(), name) -
                         names.begin());
        return before ? names[*before] : std::string();
      };
      const auto stages = kes.stages();
      for (std::size_t k = 1; k < stages.size(); ++k)
        {
          const auto &[before, entry]   = stages[k - 1];
          const auto &[name, its_entry] = stages[k];
          if (its_entry == entry && name_before(name) != before)
            throw InputError(entry + " names " + before + " and " + name +
                             ", which do not follow each other in Stages; the "
                             "stages of a test are one curve (subsection "
                             "KES).");
        }
    }

    void
    check_testers_stages(const PlateTestParameters &parameters)
    {
      const auto              &stages = parameters.load_programme.stages;
      std::vector<std::string> names;
      // Of every stage the last one up to its end that presses.
      std::vector<std::string> pressed_by;
      for (unsigned int k = 0; k < stages.size(); ++k)
        {
          const LoadStage &stage = stages[k];
          names.push_back(stage.name);
          const auto        before = stage_before(stages, k);
          const std::string pressed_before =
            before ? pressed_by[*before] : std::string();
          const bool presses = stage.type == LoadStage::Type::compression;
          if (parameters.cell.n_layers > 1 && !presses &&
              !pressed_before.empty())
            throw InputError("Stage " + stage.name + " comes after stage " +
                             pressed_before +
                             ", which presses layers together; behind it they "
                             "can only be pressed (subsections Load programme "
                             "and Cell, entry Layers).");
          pressed_by.push_back(presses ? stage.name : pressed_before);
          for (const unsigned int n : stage.driven_modes())
            if (parameters.cell.n_layers > 1 &&
                MacroModes::table[n].kind == MacroMode::Kind::bending)
              throw InputError(
                "Layers is " + std::to_string(parameters.cell.n_layers) +
                ", but stage " + stage.name + " bends by " +
                MacroModes::table[n].name +
                "; layers can be stretched, sheared and pressed (subsections "
                "Cell and Stage " +
                stage.name + ").");
          if (stage.bends_along &&
              (stage.type == LoadStage::Type::compression ||
               (stage.leads_yarns() && stage.H_targets.empty())))
            throw InputError(
              "Stage " + stage.name + " is of type " + name_of(stage.type) +
              ", which tests a flat fabric, but it comes after bending with "
              "objective jumps; test before bending, or use Jumps = linear "
              "(subsections Load programme and Homogenization).");
        }
      for (const auto &[name, entry] : parameters.kes.stages())
        if (std::find(names.begin(), names.end(), name) == names.end())
          throw InputError(entry + " names " + name +
                           ", which the load programme does not have" +
                           did_you_mean(name, names) + "; it has " +
                           joined(names, ", ") + " (subsection KES).");
      check_order_of_kes_stages(parameters.kes, stages, names);
    }
  } // namespace



  void
  PlateTestParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    declare_problem(prm, "plate test");
    cell.add_parameters(prm);
    mesh.add_parameters(prm);
    material.add_parameters(prm);
    weft_material.add_parameters(prm, "Weft material", "warp");
    contact.add_parameters(prm);
    friction.add_parameters(prm);
    homogenization.add_parameters(prm);
    load_programme.add_parameters(prm);
    newton.add_parameters(prm);
    linear_solver.add_parameters(prm);
    stability.add_parameters(prm);
    output.add_parameters(prm);
    checkpoint.add_parameters(prm);
    accuracy.add_parameters(prm);
    kes.add_parameters(prm);
  }



  PlateTestParameters
  PlateTestParameters::read(const ParameterText            &given_text,
                            const std::vector<std::string> &overrides)
  {
    PlateTestParameters parameters;
    // The names of the stages decide what else there is to declare.
    parameters.load_programme = LoadProgramme(
      get_entry(given_text, overrides, "Load programme/Stages").value_or(""));
    check_all_stages(given_text, overrides, parameters.load_programme);
    ParameterText         text = given_text;
    std::set<std::string> further;
    for (const std::string &name :
         split_list(get_entry(text, overrides, "Load programme/Further stages")
                      .value_or("")))
      further.insert("Stage " + name);
    for (const LoadStage &stage : parameters.load_programme.stages)
      further.erase("Stage " + stage.name);
    take_out_subsections(text, "Load programme", further);
    parameters.remarks =
      remove_unused_sections(text,
                             overrides,
                             {"Load programme", "Stages", "Stage "});
    dealii::ParameterHandler prm;
    parameters.add_parameters(prm);
    parse_parameter_text(prm, text, overrides);
    parameters.complete();
    parameters.used_file = documented_parameters(prm);
    return parameters;
  }



  void
  PlateTestParameters::check_exports() const
  {
    std::vector<std::string> stages;
    for (const LoadStage &stage : load_programme.stages)
      stages.push_back(stage.name);
    output.exports.check(stages);
    if (output.exports.has(ExportParameters::Format::texgen) &&
        cell.type == "laminate")
      throw InputError("Export names texgen, but a laminate has no yarns; "
                       "abaqus and gmsh take it (subsection Output).");
  }



  void
  PlateTestParameters::complete()
  {
    check_exports();
    friction.check();
    if (accuracy.is_on())
      accuracy.target(); // or refused
    cell.check();
    material.check();
    weft_material.check("Weft material", &material);
    load_programme.check();
    check_targets(load_programme.stages, 0.5 * layer_thickness(cell));
    if (cell.type == "automatic")
      {
        std::vector<unsigned int> modes;
        for (const LoadStage &stage : load_programme.stages)
          for (const unsigned int n : stage.driven_modes())
            modes.push_back(n);
        if (cell.n_layers > 1) // whatever the modes, as bending
          modes.push_back(MacroModes::number_of("H4"));
        std::tie(cell.type, reason_for_type) = smallest_cell_type(cell, modes);
        if (cell.n_layers > 1)
          reason_for_type = "because layers have no glide plane in common";
      }
    if (cell.side_contact == CellParameters::SideContact::automatic)
      {
        reason_for_side_contact =
          NPT::reason_for_side_contact(cell, load_programme);
        cell.side_contact = reason_for_side_contact.empty() ?
                              CellParameters::SideContact::off :
                              CellParameters::SideContact::on;
      }
    contact.set_thickness(cell.bundle_thickness.smaller());
    if (contact.automatic_penalties)
      {
        const double penalty = automatic_penalty(*this);
        const auto   replace = [&](const std::string &entry,
                                 const double       otherwise,
                                 double            &value) {
          // A default, or what a used file has kept, is no wish.
          if (value != otherwise && std::abs(value - penalty) > 1e-6 * penalty)
            remarks.push_back(entry + " is " + short_number(value) +
                              ", which does not count, because Automatic "
                                "penalties are on and take " +
                              short_number(penalty) +
                              " N/mm^3; set them to false to choose.");
          value = penalty;
        };
        replace("Normal penalty",
                ContactParameters().normal_penalty,
                contact.normal_penalty);
        replace("Tangential penalty",
                FrictionParameters().tangential_penalty,
                friction.tangential_penalty);
      }
    // What the cell forbids without them is not their fault.
    const CellParameters::MirrorPlanes mirror_planes =
      std::exchange(cell.mirror_planes, CellParameters::MirrorPlanes::no);
    check_modes(*this);
    cell.mirror_planes = mirror_planes;
    settle_mirror_planes(*this);
    check_modes(*this);
    settle_smooth_closure(*this);
    settle_jumps(*this);
    cell.integrate_pieces = !bends_with_linear_jumps(load_programme.stages);
    check_testers_stages(*this);
  }



  std::string
  PlateTestParameters::documented_defaults()
  {
    return read({}).used_file;
  }
} // namespace NPT
