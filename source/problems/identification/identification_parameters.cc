// SPDX-License-Identifier: LGPL-2.1-or-later
// Subsection "Identification".

#include <npt_dealii/problems/identification/identification_parameters.h>

#include <deal.II/base/patterns.h>
#include <deal.II/base/utilities.h>

namespace NPT
{
  namespace Patterns = dealii::Patterns;

  void
  IdentificationParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Identification");
    {
      prm.declare_entry("Curves",
                        "all",
                        Patterns::Anything(),
                        "Names of the curves that are fitted, separated by "
                        "commas, or `all`.");
      prm.declare_entry("Weights",
                        "",
                        Patterns::Map(Patterns::Anything(),
                                      Patterns::Double(0.),
                                      0,
                                      Patterns::Map::max_int_value,
                                      ",",
                                      ":"),
                        "Weights w_c of curves, `tension 1: 2, shear 23: "
                        "0.5`; curves not named have the weight 1 [-].");
      prm.declare_entry("Components",
                        "all",
                        Patterns::Selection("all|driven"),
                        "Which stresses of a curve are fitted: all that were "
                        "measured, or only those whose component of H is "
                        "driven (the curves of Fig. 8).");
      prm.declare_entry("Relative to curve",
                        "true",
                        Patterns::Bool(),
                        "Divide the stresses of each curve by its largest, so "
                        "that stiff and soft directions count alike; otherwise "
                        "absolute stresses count.");
      prm.declare_entry("Positive definite",
                        "true",
                        Patterns::Bool(),
                        "Demand a positive definite small-strain stiffness. A "
                        "law without it is refused by other runs.");
      prm.declare_entry("Elliptic",
                        "true",
                        Patterns::Bool(),
                        "Demand that the law is elliptic at all points of the "
                        "fitted curves.");
      prm.declare_entry("Stability margin",
                        "0.01",
                        Patterns::Double(1e-8),
                        "The least eigenvalue of stiffness and acoustic tensor "
                        "that the last two entries demand [MPa].");
    }
    prm.leave_subsection();
  }



  void
  IdentificationParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    using dealii::Utilities::split_string_list;
    prm.enter_subsection("Identification");
    curves.clear();
    if (prm.get("Curves") != "all")
      curves = split_string_list(prm.get("Curves"), ',');
    weights.clear();
    for (const std::string &item : split_string_list(prm.get("Weights"), ','))
      {
        const auto pair = split_string_list(item, ':');
        AssertDimension(pair.size(), 2); // checked by the pattern
        weights[pair[0]] = dealii::Utilities::string_to_double(pair[1]);
      }
    components =
      prm.get("Components") == "all" ? Components::all : Components::driven;
    relative_to_curve = prm.get_bool("Relative to curve");
    positive_definite = prm.get_bool("Positive definite");
    elliptic          = prm.get_bool("Elliptic");
    stability_margin  = prm.get_double("Stability margin");
    prm.leave_subsection();
  }
} // namespace NPT
