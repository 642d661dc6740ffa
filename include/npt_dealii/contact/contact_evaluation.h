// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the state of a contact pair at one displacement, and its figures.

#ifndef npt_dealii_contact_contact_evaluation_h
#define npt_dealii_contact_contact_evaluation_h

#include <npt_dealii/contact/contact_geometry.h>
#include <npt_dealii/contact/friction_law.h>

namespace NPT
{
  /// Slip of a Gauss point by relative displacement, (A16).
  template <int dim>
  struct SlipPoint
  {
    dealii::Tensor<1, dim>                      d;   ///< x^s - x^m(xi_n)
    std::array<dealii::Tensor<1, dim>, dim - 1> tau; ///< x^s_,a
    std::array<double, dim - 1>                 sigma{};
  };

  /// State at a contact node.
  template <int dim>
  struct NodeState
  {
    double gap      = 0;
    bool   active   = false;
    double pressure = 0; ///< p <= 0
    double slope    = 0;
    double energy   = 0;
  };

  /// State at a friction node.
  template <int dim>
  struct FrictionState
  {
    double                      pressure = 0; ///< |p| >= 0 [MPa]
    std::array<double, dim - 1> slip     = {};
    FrictionResponse<dim - 1>   response;
    double                      law_pressure = 0; ///< see ContactState
    double                      dissipation  = 0; ///< per area, (A46)

    bool
    active() const
    {
      return pressure > 0.;
    }
  };

  /**
   * Everything that ContactPair::evaluate() finds at one displacement of a load
   * step, a value. Its storage can be used again by the next evaluation.
   */
  template <int dim>
  struct ContactEvaluation
  {
    static constexpr int m = dim - 1;

    bool                            friction_on = false;
    ContactReach                    reach; ///< that of the step
    ContactPositions<dim>           positions;
    std::vector<ClosestPoint<dim>>  closest; ///< by Gauss point
    std::vector<SlipPoint<dim>>     slip;    ///< by Gauss point
    std::vector<NodeState<dim>>     nodes;
    std::vector<FrictionState<dim>> friction; ///< by friction node
    // Sums over the nodes of W_I A_Iq p^I and W_I A_Iq t_a^I at the points.
    std::vector<double>                point_pressure;
    std::vector<std::array<double, m>> point_traction;
    std::vector<bool>                  point_loaded;
    /// ContactStep::serial of the step that it belongs to.
    unsigned long serial = 0;
  };

  /// What the multipliers of the augmented Lagrangian still leave open [mm],
  /// with the penalties as they have grown.
  struct ContactViolation
  {
    double gap  = 0; ///< largest |p - lambda| / epsilon_N
    double slip = 0; ///< largest |t - lambda_t| / epsilon_T
  };

  /// Figures of an evaluated state.
  struct ContactSummary
  {
    unsigned int n_active            = 0;
    unsigned int n_stick             = 0;
    unsigned int n_slip              = 0;
    double       energy              = 0; ///< normal penalty energy [N mm]
    double       friction_energy     = 0; ///< tangential penalty [N mm]
    double       dissipation         = 0; ///< of this increment [N mm]
    double       largest_penetration = 0; ///< of Gauss points in reach [mm]
  };
} // namespace NPT

#endif
