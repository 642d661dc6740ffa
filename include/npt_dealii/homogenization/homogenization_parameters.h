// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the parameters of subsection "Homogenization".

#ifndef npt_dealii_homogenization_homogenization_parameters_h
#define npt_dealii_homogenization_homogenization_parameters_h

#include <npt_dealii/base/parameter_binding.h>

#include <deal.II/base/parameter_handler.h>

namespace NPT
{
  /// Subsection "Homogenization".
  struct HomogenizationParameters
  {
    /// How the displacement jumps over a period of a bent cell.
    enum class Jumps
    {
      linear,    ///< in H1..H6
      automatic, ///< objective where the program bends about one axis only
      objective  ///< and nothing else
    };

    Jumps jumps = Jumps::automatic;

    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  template <>
  const EnumNames<HomogenizationParameters::Jumps> &
  enum_names<HomogenizationParameters::Jumps>();
} // namespace NPT

#endif
