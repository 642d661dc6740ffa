// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the bending of one bundle to waves: its stiffness by the law of its
// fibers, beside the formulas for sliding layers and for loose fibers.

#ifndef npt_dealii_problems_bundle_bending_bundle_bending_test_h
#define npt_dealii_problems_bundle_bending_bundle_bending_test_h

#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/solid/deformable_bodies.h>

#include <vector>

namespace NPT
{
  /// The parameters of `set Problem = bundle bending`.
  struct BundleBendingParameters
  {
    double              thickness      = 0.6;    ///< t [mm]
    std::vector<double> half_waves     = {5.24}; ///< L [mm]
    std::vector<double> amplitudes     = {1e-4}; ///< over the thickness [-]
    double              fiber_diameter = 0.017;  ///< d [mm]
    /// B per width at the first half wave [N mm]; 0: not measured.
    double                 measured  = 0;
    unsigned int           degree    = 3;
    unsigned int           n_along   = 8; ///< elements per quarter wave
    unsigned int           n_across  = 8;
    double                 tolerance = 1; ///< of the first amplitude [-]
    MaterialParameters     material  = MaterialParameters("dry bundle");
    StepParameters         steps     = {0.25, 1e-4, 0.25};
    NewtonParameters       newton    = {1e-10};
    LinearSolverParameters linear_solver;
    std::string            directory = "output-bundle-bending";

    std::string used_file; ///< complete, with defaults

    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError with one sentence for the first mistake.
    static BundleBendingParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
  };

  /// What a bending stiffness says of the law of dry bundles, Eq. (A33).
  struct IdentifiedBending
  {
    double ratio;         ///< B over that of a solid [-]
    double slenderness;   ///< t/L [-]
    double shear_modulus; ///< along the fibers [MPa]
  };

  /// From the measured stiffness and the first half wave. Throws InputError
  /// unless it lies between 0 and that of a solid.
  IdentifiedBending
  identify_bending(const BundleBendingParameters &parameters);

  /// Bending stiffness of one wave, per width of the bundle [N mm].
  struct BundleBendingRow
  {
    double half_wave; ///< L [mm]
    double amplitude; ///< w_0 [mm]
    double stiffness; ///< B = 8 W / (k^4 w_0^2 L), W the energy per width
    double formula;   ///< r C t^3/12, Eq. (A33)
    double solid;     ///< C t^3/12
    double loose;     ///< of fibers that slide freely, Eq. (A34)
  };

  /**
   * A quarter of a wave of a bundle 0 < X1 < L/2, |X3| < t/2, all points of
   * which are deflected by
   *
   * @f[ u_3 = w_0 \sin k X_1, \qquad k = \pi/L, \quad u_2 = 0, @f]
   *
   * in proportion to the load factor; u_1 is free but for the section
   * X1 = L/2, where it is zero by symmetry. The bending stiffness is that of a
   * beam with the same energy. The moduli C and G of the formula are C_1111 and
   * C_3131 of the law at rest.
   */
  class BundleBendingWave : public EquilibriumProblem
  {
  public:
    BundleBendingWave(const BundleBendingParameters &parameters,
                      const double                   half_wave,
                      const double                   amplitude);

    Increment
    increment(const State &accepted, const double load_factor) const override;
    void
    evaluate(const Increment &increment, Trial &trial) const override;
    bool
    add_tangent(const Increment   &increment,
                const Trial       &trial,
                ConstrainedSystem &system) const override;
    double
    force_unit() const override;

    /// Bend it in load steps.
    BundleBendingRow
    run(RunLog &log);

  private:
    const BundleBendingParameters parameters_;
    const double                  half_wave_, amplitude_;
    const DeformableBodies        body_;
    ConstrainedSystem             system_;
    DeformableBodies::CellGroups  groups_;
    dealii::Vector<double>        target_; // by independent unknown
  };

  /**
   * Bend a bundle to all half waves and amplitudes.
   *
   * @param directory Existing folder for bending.csv; empty: write nothing.
   *
   * Throws StageFailed at the end if a wave of the first amplitude differs from
   * the formula by more than the tolerance; all rows are on disk then.
   */
  std::vector<BundleBendingRow>
  bend_bundle(const BundleBendingParameters &parameters,
              const std::string             &directory,
              std::ostream                  &screen);
} // namespace NPT

#endif
