// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines a bar that is pulled at its ends, an example of a further problem.

#ifndef npt_dealii_doc_extending_pulled_bar_h
#define npt_dealii_doc_extending_pulled_bar_h

#include <npt_dealii/base/parameter_file.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/load_stepper.h>
#include <npt_dealii/material/make_material.h>
#include <npt_dealii/solid/deformable_bodies.h>

namespace NPT
{
  /// The parameters of `set Problem = pulled bar`.
  struct PulledBarParameters
  {
    double                 length     = 4.;  ///< L [mm]
    double                 width      = 1.;  ///< of the square section [mm]
    double                 elongation = 0.2; ///< at the end, over L [-]
    MaterialParameters     material;
    StepParameters         steps = {0.25, 1e-4, 0.25};
    NewtonParameters       newton;
    LinearSolverParameters linear_solver;
    std::string            directory = "output-pulled-bar";

    std::string used_file; ///< complete, with defaults

    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError with one sentence for the first mistake.
    static PulledBarParameters
    read(const ParameterText            &text,
         const std::vector<std::string> &overrides = {});
  };

  /**
   * A bar 0 < X1 < L with a square section. Its end X1 = 0 is held along the
   * bar, its sides X2 = 0 and X3 = 0 are planes of symmetry, the others are
   * free, and the end X1 = L moves along the bar as one,
   *
   * @f[ u_1(L) = e L, @f]
   *
   * in proportion to the load factor. The unknowns are the displacements and
   * the elongation e L; State::reactions is the force conjugate to it [N].
   */
  class PulledBar : public EquilibriumProblem
  {
  public:
    explicit PulledBar(const PulledBarParameters &parameters);

    Increment
    increment(const State &accepted, const double load_factor) const override;
    void
    evaluate(const Increment &increment, Trial &trial) const override;
    bool
    add_tangent(const Increment   &increment,
                const Trial       &trial,
                ConstrainedSystem &system) const override;
    State
    accept(const State     &before,
           const Increment &increment,
           const Trial     &trial) const override;

    /// Pull the bar; one row of bar.csv per accepted step.
    void
    run(const std::string &directory, std::ostream &screen);

  private:
    const PulledBarParameters    parameters_;
    const DeformableBodies       body_;
    const unsigned int           elongation_; // number of this unknown
    ConstrainedSystem            system_;
    DeformableBodies::CellGroups groups_;
  };
} // namespace NPT

#endif
