// SPDX-License-Identifier: LGPL-2.1-or-later
// Declaration of the parameters of subsection "Homogenization".

#include <npt_dealii/homogenization/homogenization_parameters.h>

namespace NPT
{
  template <>
  const EnumNames<HomogenizationParameters::Jumps> &
  enum_names<HomogenizationParameters::Jumps>()
  {
    using Jumps                         = HomogenizationParameters::Jumps;
    static const EnumNames<Jumps> names = {{Jumps::linear, "linear"},
                                           {Jumps::automatic, "automatic"},
                                           {Jumps::objective, "objective"}};
    return names;
  }



  void
  HomogenizationParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    const ParameterSubsection subsection(prm, "Homogenization");
    add_parameter(
      prm,
      "Jumps",
      jumps,
      "What a bent cell is periodic to. linear: the displacement jumps over a "
      "period linearly in H1..H6, (A1), as in the paper; neighboring cells do "
      "not turn, and errors grow with the curvature times the size of the "
      "cell. objective: neighboring cells turn with the plate, (A24), (A25), "
      "while it bends about one axis; other programs are refused. automatic: "
      "objective where that is possible, else linear; the log says which.");
  }
} // namespace NPT
