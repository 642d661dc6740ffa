// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines which macroscopic gradients leave something of the cell.

#ifndef npt_dealii_problems_load_programme_macro_limits_h
#define npt_dealii_problems_load_programme_macro_limits_h

#include <npt_dealii/homogenization/macro_modes.h>
#include <npt_dealii/problems/load_programme/load_programme.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace NPT
{
  /// H1..H6 as far as they are known; nothing where n is prescribed instead.
  using KnownGradients = std::array<std::optional<double>, MacroModes::n>;

  /**
   * What makes macroscopic gradients meaningless, in one clause with the
   * allowed range of the component that is named; empty if nothing does.
   *
   * The jumps (46) stretch the plane at the height Z3 by the symmetric, (A21),
   *
   * @f[ U(Z_3) = \begin{pmatrix}
   *       1 + H_1 + Z_3 H_4 & (H_3 + Z_3 H_6)/2 \\
   *       (H_3 + Z_3 H_6)/2 & 1 + H_2 + Z_3 H_5 \end{pmatrix} , @f]
   *
   * which must be positive definite in the whole layer, |Z3| <= h: else the
   * cell has no extent there, or is turned inside out. Such matrices form a
   * convex set. So the mid-plane and both faces speak for the layer, and two
   * admissible states speak for the straight path between them. Gradients that
   * are not known are taken to be such that they allow most.
   *
   * @param half_thickness h of the layer [mm].
   */
  std::string
  obstacle_of_gradients(const KnownGradients &H, const double half_thickness);

  /// Check the state at the end of every stage, as far as it is prescribed.
  /// Throws InputError with stage and entry.
  void
  check_targets(const std::vector<LoadStage> &stages,
                const double                  half_thickness);
} // namespace NPT

#endif
