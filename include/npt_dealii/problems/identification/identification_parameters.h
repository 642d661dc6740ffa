// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what an identification fits: curves, weights, components,
// constraints.

#ifndef npt_dealii_problems_identification_identification_parameters_h
#define npt_dealii_problems_identification_identification_parameters_h

#include <npt_dealii/base/parameter_binding.h>

#include <deal.II/base/parameter_handler.h>

#include <map>
#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "Identification".
  struct IdentificationParameters
  {
    enum class Components
    {
      all,   ///< every measured stress
      driven ///< stresses whose component of H is not zero in the curve
    };

    std::vector<std::string>      curves; ///< names; empty: all
    std::map<std::string, double> weights;
    Components                    components        = Components::all;
    bool                          relative_to_curve = true;
    bool                          positive_definite = true;
    bool                          elliptic          = true;
    double                        stability_margin  = 0.01; ///< [MPa]

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<IdentificationParameters::Components> &
  enum_names<IdentificationParameters::Components>();
} // namespace NPT

#endif
