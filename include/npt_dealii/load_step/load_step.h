// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines one load step on a condensed system as a problem for Newton's method:
// the free unknowns, the targets of the others, and both predictors.

#ifndef npt_dealii_load_step_load_step_h
#define npt_dealii_load_step_load_step_h

#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/newton.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/vector.h>

#include <functional>

namespace NPT
{
  /**
   * The equations R(u) = 0 of a load step with u = C m and some of the m on
   * their targets. Newton's unknowns x are the free m,
   *
   * @f[ r(x) = \left( C^T R(C m) \right)_f, \qquad
   *     \frac{dr}{dx} = \left( C^T \frac{dR}{du} C \right)_{ff}. @f]
   *
   * All references must outlive the object, and the object its problem().
   */
  class LoadStep
  {
  public:
    /// The full system. What it throws is passed on.
    struct FullSystem
    {
      /// Fill R(u) and return the forces before they cancel [N], see
      /// NewtonProblem::force_scale.
      std::function<double(const dealii::Vector<double> &u,
                           dealii::Vector<double>       &residual)>
        residual;
      /// Assemble dR/du into the ConstrainedSystem, at the u of the last
      /// residual.
      std::function<void(const dealii::Vector<double> &u)> tangent;
    };

    /**
     * @param u_accepted The state at the start of the step.
     * @param m_target Prescribed entries: the end of the step. Free ones are
     *   ignored.
     * @param u, residual Filled by every evaluation with the state and its
     *   full residual, for the caller; u must not be u_accepted itself.
     * @param timer Sections "Factorize" and "Solve", if given.
     */
    LoadStep(ConstrainedSystem            &system,
             LinearSolver                 &linear_solver,
             FullSystem                    full_system,
             const dealii::Vector<double> &u_accepted,
             const dealii::Vector<double> &m_target,
             dealii::Vector<double>       &u,
             dealii::Vector<double>       &residual,
             dealii::TimerOutput          *timer = nullptr);

    LoadStep(const LoadStep &) = delete;
    LoadStep &
    operator=(const LoadStep &) = delete;

    NewtonProblem
    problem();

    /// Predictor: x = x_accepted + ratio (x_accepted - x_previous).
    void
    extrapolate(const dealii::Vector<double> &u_previous,
                const double                  ratio,
                dealii::Vector<double>       &x) const;

    /**
     * Predictor: along the tangent of the accepted state, loaded by its
     * residual and by the increments of the prescribed unknowns,
     *
     * @f[ K_{ff} (x - x_{accepted}) = - r - K_{fp} \Delta m_p. @f]
     *
     * Evaluates the accepted state, not x.
     */
    void
    follow_tangent(dealii::Vector<double> &x);

    /// r(x); also fills u and the full residual.
    void
    evaluate(const dealii::Vector<double> &x, dealii::Vector<double> &r);

  private:
    void
    pick_free(const dealii::Vector<double> &m, dealii::Vector<double> &x) const;
    void
    evaluate_independent(const dealii::Vector<double> &m,
                         dealii::Vector<double>       &r);
    void
    prepare_tangent();
    void
    solve(const dealii::Vector<double> &rhs, dealii::Vector<double> &dx);

    ConstrainedSystem            &system_;
    LinearSolver                 &linear_solver_;
    const FullSystem              full_system_;
    const dealii::Vector<double> &m_target_;
    dealii::Vector<double>       &u_;
    dealii::Vector<double>       &residual_;
    dealii::TimerOutput          *timer_;

    dealii::Vector<double> m_accepted_, m_, condensed_;
    double                 force_scale_ = 0;
  };
} // namespace NPT

#endif
