// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what one load step of a contact pair refers to.

#ifndef npt_dealii_contact_contact_step_h
#define npt_dealii_contact_contact_step_h

#include <npt_dealii/contact/contact_geometry.h>

namespace NPT
{
  /**
   * What the slip of one Gauss point is measured from during a load step. The
   * slip measure fills what it needs.
   */
  template <int dim>
  struct SlipReference
  {
    static constexpr int m = dim - 1;

    bool                  known   = false;
    unsigned int          surface = 0; ///< which primary surface
    std::array<double, m> u{};         ///< parameters xi_n there
    SurfaceShape<m>       shape;       ///< functions at xi_n
    std::array<double, m> start{};     ///< tau_a . (x^s - x^m(xi_n)) accepted
    double weight = 0; ///< 1 near the primary surface, 0 far from it
  };

  /**
   * Start values and references of one load step, a value: a function of the
   * accepted contact state and displacement. Only ContactPair::augment()
   * changes it, between the repetitions of the augmented Lagrangian.
   */
  template <int dim>
  struct ContactStep
  {
    static constexpr int m = dim - 1;

    bool                              friction_on = false;
    std::vector<ProjectionStart<dim>> starts; ///< by Gauss point
    ContactReach                      reach;
    std::vector<bool>                 behind;     ///< see ContactState
    std::vector<SlipReference<dim>>   references; ///< by Gauss point
    /// Inverse of the averaged metric of the secondary surface in the accepted
    /// state, by friction node: m^{11}, m^{12}, m^{22} of (A16).
    std::vector<std::array<double, SymmetricIndices<m>::n_second>>
      inverse_metric;
    /// Multipliers of the present repetition, by contact and friction node.
    std::vector<double>                multiplier;
    std::vector<std::array<double, m>> traction_multiplier;
    double                             penalty_scale = 1.;
    std::vector<double>                gap_shift;    ///< see ContactState
    std::vector<double>                slip_path;    ///< see ContactState
    std::vector<double>                law_pressure; ///< see ContactState
    /// mu / mu_0 of every friction node, (A38); empty: one.
    std::vector<double> friction_factor;
    /// Tells evaluations of this step from those of others, for assertions.
    unsigned long serial = 0;
  };
} // namespace NPT

#endif
