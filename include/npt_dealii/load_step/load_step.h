// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines one attempt at a load step: the free unknowns, the targets of the
// others, the predictors, and the solution.

#ifndef npt_dealii_load_step_load_step_h
#define npt_dealii_load_step_load_step_h

#include <npt_dealii/linear_algebra/constrained_system.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/load_step/augmented_lagrangian.h>
#include <npt_dealii/load_step/equilibrium_problem.h>
#include <npt_dealii/load_step/newton.h>

#include <deal.II/base/timer.h>
#include <deal.II/lac/vector.h>

#include <vector>

namespace NPT
{
  /// What solving a load step took.
  struct LoadStepReport
  {
    /// Of the first solution, whose order tells of the tangent; iterations:
    /// the sum over all repetitions of the augmented Lagrangian.
    NewtonReport newton;
    /// Norm of the residual of the last solution [N].
    double final_residual = 0;
  };

  /**
   * The equations R(u) = 0 of a load step with u = C m and some of the m on
   * their targets. Newton's unknowns x are the free m,
   *
   * @f[ r(x) = \left( C^T R(C m) \right)_f, \qquad
   *     \frac{dr}{dx} = \left( C^T \frac{dR}{du} C \right)_{ff}. @f]
   *
   * The result is a function of the accepted state and the increment alone.
   * System, solver and timer are workspace; all references must outlive the
   * object.
   */
  class LoadStep
  {
  public:
    /**
     * @param accepted The state at the start of the step.
     * @param increment What the step adds, EquilibriumProblem::increment().
     * @param timer Sections "Pattern", "Factorize" and "Solve", if given.
     */
    LoadStep(const EquilibriumProblem &problem,
             const State              &accepted,
             Increment                 increment,
             ConstrainedSystem        &system,
             LinearSolver             &linear_solver,
             dealii::TimerOutput      *timer = nullptr);

    LoadStep(const LoadStep &) = delete;
    LoadStep &
    operator=(const LoadStep &) = delete;

    /**
     * Predictor: x = x_accepted + ratio (x_accepted - x_previous), with the
     * targets at the end of the step. Evaluated at once: false if the state
     * cannot be evaluated (extrapolated too far).
     */
    bool
    extrapolate(const dealii::Vector<double> &u_previous, const double ratio);

    /**
     * Predictor: along the tangent of the accepted state, loaded by its
     * residual and by the increments of the prescribed unknowns,
     *
     * @f[ K_{ff} (x - x_{accepted}) = - r - K_{fp} \Delta m_p. @f]
     */
    void
    follow_tangent();

    /**
     * Solve from the predicted x by Newton's method; with the augmented
     * Lagrangian again, with the tractions of the last solution as
     * multipliers, until penetration and stick drift are below their
     * tolerances, (A17). Without free unknowns the state is evaluated only.
     *
     * Throws a LoadStepFailure if there is no solution.
     */
    LoadStepReport
    solve(const NewtonParameters  &newton,
          const ContactParameters &augmentation = ContactParameters());

    const Increment &
    increment() const
    {
      return increment_;
    }
    /// The state evaluated last.
    const Trial &
    trial() const
    {
      return trial_;
    }

    /// The free unknowns as predicted.
    const dealii::Vector<double> &
    start() const
    {
      return x_;
    }

    /// r(x); also fills trial().
    void
    evaluate(const dealii::Vector<double> &x, dealii::Vector<double> &r);

  private:
    NewtonProblem
    equations();
    double
    norm(const dealii::Vector<double> &r) const;
    void
    pick_free(const dealii::Vector<double> &m, dealii::Vector<double> &x) const;
    void
    evaluate_independent(const dealii::Vector<double> &m,
                         dealii::Vector<double>       &r);
    void
    prepare_tangent(const bool free_only);
    void
    solve_linear(const dealii::Vector<double> &rhs, dealii::Vector<double> &dx);
    ContactViolation
    violation() const;

    const EquilibriumProblem &problem_;
    Increment                 increment_;
    ConstrainedSystem        &system_;
    LinearSolver             &linear_solver_;
    dealii::TimerOutput      *timer_;

    std::vector<double>    lever_arms_; // of the free unknowns
    dealii::Vector<double> m_accepted_, m_;
    Trial                  trial_;
    dealii::Vector<double> x_; // predicted
    dealii::Vector<double> r_; // there, if it was evaluated
    bool                   has_residual_ = false;
  };
} // namespace NPT

#endif
