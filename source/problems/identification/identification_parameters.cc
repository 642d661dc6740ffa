// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the entries of subsection "Identification".

#include <npt_dealii/problems/identification/identification_parameters.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  template <>
  const EnumNames<IdentificationParameters::Components> &
  enum_names<IdentificationParameters::Components>()
  {
    using Components = IdentificationParameters::Components;
    static const EnumNames<Components> names = {{Components::all, "all"},
                                                {Components::driven, "driven"}};
    return names;
  }



  namespace
  {
    std::string
    text_of(const std::map<std::string, double> &weights)
    {
      std::string text;
      for (const auto &[curve, weight] : weights)
        text += (text.empty() ? "" : ", ") + curve + ": " +
                EntryValue<double>::text(weight);
      return text;
    }

    std::map<std::string, double>
    weights_of(const std::string &text)
    {
      std::map<std::string, double> weights;
      for (const std::string &item : split_list(text))
        {
          const auto pair = dealii::Utilities::split_string_list(item, ':');
          AssertDimension(pair.size(), 2); // checked by the pattern
          weights[pair[0]] = EntryValue<double>::value(pair[1]);
        }
      return weights;
    }
  } // namespace



  void
  IdentificationParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Identification");
    add_parameter(
      prm,
      "Curves",
      curves.empty() ? "all" : EntryValue<decltype(curves)>::text(curves),
      [this](const std::string &text) {
        curves.clear();
        if (text != "all")
          curves = split_list(text);
      },
      "Names of the curves that are fitted, separated by "
      "commas, or `all`.",
      Patterns::Anything());
    add_parameter(
      prm,
      "Weights",
      text_of(weights),
      [this](const std::string &text) { weights = weights_of(text); },
      "Weights w_c of curves, `tension 1: 2, shear 23: "
      "0.5`; curves not named have the weight 1 [-].",
      Patterns::Map(Patterns::Anything(),
                    Patterns::Double(0.),
                    0,
                    Patterns::Map::max_int_value,
                    ",",
                    ":"));
    add_parameter(prm,
                  "Components",
                  components,
                  "Which stresses of a curve are fitted: all that were "
                  "measured, or only those whose component of H is "
                  "driven (the curves of Fig. 8).");
    add_parameter(prm,
                  "Relative to curve",
                  relative_to_curve,
                  "Divide the stresses of each curve by its largest, so "
                  "that stiff and soft directions count alike; otherwise "
                  "absolute stresses count.");
    add_parameter(prm,
                  "Positive definite",
                  positive_definite,
                  "Demand a positive definite small-strain stiffness. A "
                  "law without it is refused by other runs.");
    add_parameter(prm,
                  "Elliptic",
                  elliptic,
                  "Demand that the law is elliptic at all points of the "
                  "fitted curves.");
    add_parameter(prm,
                  "Stability margin",
                  stability_margin,
                  "The least eigenvalue of stiffness and acoustic tensor "
                  "that the last two entries demand [MPa].",
                  Patterns::Double(1e-8));
  }
} // namespace NPT
