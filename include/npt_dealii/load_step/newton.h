// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the Newton loop: criteria, line search, detection of cycles. Knows no
// physics; the problem comes as callables.

#ifndef npt_dealii_load_step_newton_h
#define npt_dealii_load_step_newton_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/vector.h>

#include <functional>
#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "Newton".
  struct NewtonParameters
  {
    double       relative_tolerance = 1e-7; ///< of the force scale [-]
    double       absolute_tolerance = 0;    ///< [N]
    unsigned int max_iterations     = 25;
    bool         line_search        = true;
    unsigned int max_halvings       = 8;
    unsigned int nonmonotone_memory = 3;
    bool         keep_tangent       = true;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);
  };

  /// What solve_newton() asks of a problem r(x) = 0. All functions that are
  /// not said to be optional are required.
  struct NewtonProblem
  {
    /// Evaluate r(x). May throw a LoadStepFailure (inverted cell, lost
    /// projection), which the line search takes for a step too long.
    std::function<void(const dealii::Vector<double> &x,
                       dealii::Vector<double>       &residual)>
      residual;

    /// Assemble and factorize the tangent dr/dx. Always called with the x of
    /// the last call of residual(), so that its intermediate results may be
    /// reused.
    std::function<void(const dealii::Vector<double> &x)> prepare_tangent;

    /// Solve (dr/dx) dx = rhs with the tangent of the last prepare_tangent().
    std::function<void(const dealii::Vector<double> &rhs,
                       dealii::Vector<double>       &dx)>
      solve;

    /// The forces that the residual is small against [N], at the last
    /// residual(): e.g. the norm of the internal forces before they cancel.
    std::function<double()> force_scale;

    /// A residual below 1e-14 of this force is round-off and counts as
    /// converged [N], e.g. stiffness times size^2.
    double force_unit = 0;

    /// Optional: the norm of a residual [N] where its components do not all
    /// have the unit N; else the Euclidean norm.
    std::function<double(const dealii::Vector<double> &residual)> norm;

    /// Optional: a few words on the state at the last residual(), e.g. the
    /// numbers of open, sticking and slipping points.
    std::function<std::string()> state_summary;
  };

  struct NewtonReport
  {
    /// Corrections with a new tangent; a series of corrections with a kept one
    /// counts as one more, for it stands for one with a new tangent.
    unsigned int             iterations = 0;
    unsigned int             n_tangents = 0;  ///< assembled and factorized
    std::vector<double>      residual_norms;  ///< [N], corrections + 1 entries
    std::vector<bool>        kept_tangent;    ///< one per correction
    std::vector<std::string> state_summaries; ///< one per norm, if asked for
    double                   force_scale        = 0; ///< at the last norm [N]
    bool                     converged          = false;
    unsigned int             n_line_search_cuts = 0;
    unsigned int             n_residuals        = 0; ///< evaluations

    /**
     * Return the observed order of convergence, from the last two drops:
     * @f[ q = \frac{\log(r_k / r_{k-1})}{\log(r_{k-1} / r_{k-2})} @f]
     *
     * Last residuals below 1e-13 of the force scale are left out: they are
     * round-off and would pull q toward zero. NaN if fewer than three
     * residuals remain, if the earlier of the two was no drop, or if one of
     * the two corrections was made with a kept tangent.
     */
    double
    order() const;
  };

  /**
   * Solve r(x) = 0 from the given x by Newton's method.
   *
   * Converged if |r| <= max(relative_tolerance * force_scale,
   * absolute_tolerance, 1e-14 * force_unit), tested before the first correction
   * too. The last is the floor for states in which all forces vanish.
   *
   * Line search: the correction dx is halved until
   * @f[ \|r(x + \alpha dx)\| \le (1 - 10^{-4} \alpha)
   *     \max_{0 \le j < m} \|r_{k-j}\| @f]
   * (Grippo, Lampariello, Lucidi 1986), m = nonmonotone_memory. m = 1 is the
   * usual monotone backtracking. At first contact and at changes between stick
   * and slip the full step often raises the residual once and converges
   * quadratically from there, hence m = 3. A trial that throws LoadStepFailure
   * or whose residual is not finite is rejected like one that is too large; a
   * converged trial is always accepted.
   *
   * At a kink, such as a contact point that opens and closes, corrections may
   * jump over the solution and back, with norms that fall by so little each
   * time that the iteration limit comes first. So the first trial is a quarter
   * of the correction where the largest of the last three norms is above three
   * quarters of the largest of the three before. After three such corrections
   * three are full in any case, since from a valley of the norm short ones
   * alone do not lead out.
   *
   * With keep_tangent a tangent serves for several corrections of one call,
   * never for those of another: what a call returns depends on its arguments
   * alone. If one correction reduces the residual by the factor theta, the next
   * with the same tangent do so by about 2 theta, as the error of the tangent
   * at the new x is twice that along the way. The tangent is kept if this
   * promises convergence within 12 corrections, each of which costs about a
   * tenth of one with a new tangent; it is renewed when a correction falls
   * short of that. With a kept tangent the residual has to fall below a tenth
   * of the tolerance: what is left is not squared away by the last correction.
   *
   * Throws NewtonNotConverged with one of the reasons
   * - "iteration limit": after max_iterations corrections, or a quarter more
   *   while each leaves a tenth of the residual or less,
   * - "line search failed": no halving is accepted; x gives no descent,
   * - "active set cycling": the residual norms repeat with period 2 or 3
   *   within 1e-6,
   * - "stagnated": four norms agree within 1e-6,
   * - "diverged": |r| > 1e8 times the force scale,
   * - "invalid residual": not finite at the start or without line search,
   * and passes on a LoadStepFailure of the start, of the tangent and of the
   * linear solver. x is then an iterate of no meaning; the caller restores it.
   *
   * @param residual_at_start r(x) of the given x, if it is known already; x
   *   must then be that of the last problem.residual().
   */
  NewtonReport
  solve_newton(const NewtonParameters       &parameters,
               const NewtonProblem          &problem,
               dealii::Vector<double>       &x,
               const dealii::Vector<double> *residual_at_start = nullptr);
} // namespace NPT

#endif
