// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how a stage leads the yarns of the cell: trellis, picture frame, bias
// extension.

#ifndef npt_dealii_problems_plate_test_frame_drive_h
#define npt_dealii_problems_plate_test_frame_drive_h

#include <npt_dealii/homogenization/macro_unknowns.h>
#include <npt_dealii/homogenization/yarn_frame.h>
#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/load_step/state.h>
#include <npt_dealii/problems/load_programme/load_programme.h>

#include <deal.II/lac/vector.h>

#include <optional>

namespace NPT
{
  /**
   * Loads of a stage on H1, H2, H3 in the coordinates q = (lambda_1, lambda_2,
   * g) of YarnFrame, all of them linear in the load factor s.
   *
   * Trellis and clamped picture frame prescribe all three: H follows from (A35)
   * at every s. In a picture frame under tension g alone is prescribed; the
   * sides bear the tensions f_1, f_2 and the torque m that g takes,
   *
   * @f[ n_k = f_1 \lambda_{1,k} + f_2 \lambda_{2,k} + m \, g_{,k},
   *     \qquad g(H) = \bar g(s) . @f]
   *
   * In a bias extension the edges along the bias are free. A traction along
   * e_b alone is p dlambda_b, as C = F^T F is all that the energy depends on:
   *
   * @f[ n_k = p \, \lambda_{b,k} + (1 - s) \, n_k^0, \qquad
   *     \lambda_b(H) = \bar\lambda_b(s) \text{ or } g(H) = \bar g(s)
   *     \qquad (A37) @f]
   *
   * What the sheet bore otherwise before the stage, n^0, goes linearly. m or p
   * is c times the support of MacroUnknowns. If the same function is prescribed
   * and loaded, the matrix is symmetric.
   */
  class FrameDrive
  {
  public:
    /// Leads nothing.
    FrameDrive() = default;

    /**
     * @param before The state at the end of the stage before.
     * @param area Of the cell [mm^2].
     * @param stiffness c, which only scales the support [N/mm^2].
     */
    FrameDrive(const LoadStage     &stage,
               const MacroUnknowns &macro,
               const State         &before,
               const double         area,
               const double         stiffness);

    /// Whether H1..H3 are unknowns that this drive loads, and the support is
    /// its force.
    bool
    uses_support() const
    {
      return loads_;
    }

    /// H1..H3 where they are prescribed.
    std::optional<Membrane>
    gradients(const double load_factor) const;

    /// The support at the start of the stage [mm].
    double
    support_at_start() const
    {
      return support_at_start_;
    }

    void
    add_group(ConstrainedSystem &system);
    /// Add what the drive exerts, -A n_k, and the condition.
    void
    add_residual(const double                  load_factor,
                 const dealii::Vector<double> &u,
                 dealii::Vector<double>       &residual) const;
    void
    add_tangent(const double                  load_factor,
                const dealii::Vector<double> &u,
                ConstrainedSystem            &system) const;

    /// n1, n2, n3 that the drive exerts [N/mm]; zero where it prescribes H.
    Membrane
    resultants(const double load_factor, const dealii::Vector<double> &u) const;

  private:
    using Number = YarnFrames::Number;

    Membrane
    gradients_of(const dealii::Vector<double> &u) const;
    // What m or p does work on, and what is prescribed less its value.
    Number
    loaded(const Membrane &H) const;
    Number
    condition(const double load_factor, const Membrane &H) const;
    // sum of f_j q_j, so that its gradient are their resultants.
    Number
    potential_of_tensions(const double load_factor, const Membrane &H) const;

    bool         loads_      = false;
    bool         prescribes_ = false;
    bool         is_bias_    = false;
    bool         by_angle_   = true;
    unsigned int first_      = 0; // of H1
    unsigned int support_    = 0;
    double       area_ = 0, stiffness_ = 0, support_at_start_ = 0;

    YarnFrame    from_, to_;
    double       bias_from_ = 1, bias_to_ = 1;
    Membrane     tension_from_{}, tension_to_{}; // of warp and weft
    Membrane     rest_{};                        // n^0
    unsigned int group_ = 0;
  };
} // namespace NPT

#endif
