// SPDX-License-Identifier: LGPL-2.1-or-later
// Targets in the terms of fabric testers, and what is wrong with them.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/message_words.h>
#include <npt_dealii/base/short_number.h>
#include <npt_dealii/homogenization/yarn_frame.h>
#include <npt_dealii/problems/load_programme/tester_targets.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace NPT
{
  namespace TesterTargets
  {
    namespace
    {
      using Type = LoadStage::Type;

      constexpr double infinity = std::numeric_limits<double>::infinity();
      constexpr double degree   = dealii::numbers::PI / 180.;

      struct Target
      {
        const char *name;
        const char *unit;
        double      lowest, highest; // both excluded
      };

      // Angles at which yarns of any width would still have an area.
      const std::vector<Target> table = {
        {"shear_angle", "degree", -85., 85.},
        {"warp_stretch", "-", 0., infinity},
        {"weft_stretch", "-", 0., infinity},
        {"warp_tension", "N/mm", -infinity, infinity},
        {"weft_tension", "N/mm", -infinity, infinity},
        {"bias_stretch", "-", 0., infinity},
        {"plate_distance", "mm", 0., infinity},
        {"pressure", "MPa", 0., infinity}};

      std::vector<std::string>
      names_for(const Type type)
      {
        switch (type)
          {
            case Type::trellis:
              return {"shear_angle"};
            case Type::picture_frame:
              return {"shear_angle",
                      "warp_stretch",
                      "weft_stretch",
                      "warp_tension",
                      "weft_tension"};
            case Type::bias_extension:
              return {"shear_angle", "bias_stretch"};
            case Type::compression:
              return {"plate_distance", "pressure"};
            default:
              return {};
          }
      }

      const Target &
      target_named(const std::string &name)
      {
        for (const Target &target : table)
          if (name == target.name)
            return target;
        AssertThrow(false, dealii::ExcMessage("No target " + name + "."));
        return table.front();
      }

      std::string
      in_stage(const LoadStage &stage)
      {
        return " (subsection Stage " + stage.name + ").";
      }

      void
      check_names(const LoadStage &stage)
      {
        const auto        allowed = names_for(stage.type);
        const std::string what    = "a stage of type " + name_of(stage.type);
        for (const auto &[name, value] : stage.tester_targets)
          {
            if (std::find(allowed.begin(), allowed.end(), name) ==
                allowed.end())
              throw InputError("Targets names " + name + ", which " + what +
                               " does not have; it has " +
                               (allowed.empty() ? "H1 to H6 and n1 to n6" :
                                                  joined(allowed, ", ")) +
                               in_stage(stage));
            const Target &target = target_named(name);
            if (!(value > target.lowest && value < target.highest))
              throw InputError("Targets has " + name + ": " +
                               short_number(value) + "; it must be above " +
                               short_number(target.lowest) +
                               (target.highest < infinity ?
                                  " and below " + short_number(target.highest) :
                                  "") +
                               " " + target.unit + in_stage(stage));
          }
        if (!stage.leads_yarns())
          return;
        for (const auto *targets : {&stage.H_targets, &stage.n_targets})
          for (const auto &target : *targets)
            throw InputError(std::string("Targets names ") +
                             (targets == &stage.H_targets ?
                                MacroModes::table[target.first].name :
                                MacroModes::table[target.first].conjugate) +
                             ", which " + what + " does not have; it has " +
                             joined(allowed, ", ") + in_stage(stage));
      }

      void
      check_pairs(const LoadStage &stage)
      {
        const auto n_of = [&](const std::vector<std::string> &names) {
          unsigned int n = 0;
          for (const std::string &name : names)
            n += stage.tester_targets.count(name);
          return n;
        };
        const std::string type = name_of(stage.type);
        if ((stage.type == Type::trellis ||
             stage.type == Type::picture_frame) &&
            n_of({"shear_angle"}) == 0)
          throw InputError("Targets has no shear_angle; a stage of type " +
                           type + " needs it, as shear_angle: 30" +
                           in_stage(stage));
        const unsigned int n_stretches = n_of({"warp_stretch", "weft_stretch"}),
                           n_tensions  = n_of({"warp_tension", "weft_tension"});
        if (stage.type == Type::picture_frame &&
            (n_tensions == 1 || (n_tensions > 0 && n_stretches > 0)))
          throw InputError(
            "Targets mixes yarns that are clamped with yarns under tension; "
            "name both warp_tension and weft_tension, or neither" +
            in_stage(stage));
        if (stage.type == Type::bias_extension &&
            n_of({"shear_angle", "bias_stretch"}) != 1)
          throw InputError("Targets of a bias extension are either shear_angle "
                           "or bias_stretch, one of them" +
                           in_stage(stage));
        if (stage.type == Type::compression &&
            n_of({"plate_distance", "pressure"}) != 1)
          throw InputError("Targets of a compression are either plate_distance "
                           "or pressure, one of them" +
                           in_stage(stage));
      }
    } // namespace



    std::string
    choices()
    {
      std::string text;
      for (const Target &target : table)
        text += (text.empty() ? "" : "|") + std::string(target.name);
      return text;
    }



    std::string
    meaning()
    {
      return "Type = trellis: shear_angle [degree]. picture frame: shear_angle "
             "with warp_tension and weft_tension [N/mm], or with warp_stretch "
             "and weft_stretch [-]; without, yarns keep their stretch. bias "
             "extension: shear_angle or bias_stretch [-]. compression: "
             "plate_distance [mm] or pressure [MPa], and any H and n.";
    }



    void
    settle(LoadStage &stage)
    {
      check_names(stage);
      check_pairs(stage);
      const bool is_clamped = stage.tester_target("warp_stretch") &&
                              stage.tester_target("weft_stretch");
      if (stage.type != Type::trellis && !is_clamped)
        return;
      const Membrane H =
        YarnFrames::gradients({stage.tester_target("warp_stretch").value_or(1.),
                               stage.tester_target("weft_stretch").value_or(1.),
                               degree * *stage.tester_target("shear_angle")});
      for (unsigned int n = 0; n < n_membrane; ++n)
        stage.H_targets[n] = H[n];
    }



    std::optional<double>
    expected_shear_angle(const LoadStage &stage)
    {
      if (const auto g = stage.tester_target("shear_angle"))
        return degree * *g;
      const auto stretch = stage.tester_target("bias_stretch");
      if (!stretch || *stretch * *stretch >= 2.)
        return {};
      // |e_1 + e_2|^2 / 2 of yarns of constant length.
      return std::asin(*stretch * *stretch - 1.);
    }



    std::string
    with_unit(const std::string &name, const double value)
    {
      const std::string unit = target_named(name).unit;
      return name + " = " + short_number(value) +
             (unit == "-" ? "" : " " + unit);
    }
  } // namespace TesterTargets
} // namespace NPT
