// SPDX-License-Identifier: LGPL-2.1-or-later
// Residual, tangent, predictors and solution of one load step.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/load_step.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace NPT
{
  using dealii::TimerOutput;
  using dealii::Vector;

  namespace
  {
    // A section of the timer, if there is one.
    class Section
    {
    public:
      Section(TimerOutput *timer, const std::string &name)
      {
        if (timer != nullptr)
          scope_.emplace(*timer, name);
      }

    private:
      std::optional<TimerOutput::Scope> scope_;
    };
  } // namespace



  LoadStep::LoadStep(const EquilibriumProblem &problem,
                     const State              &accepted,
                     Increment                 increment,
                     ConstrainedSystem        &system,
                     LinearSolver             &linear_solver,
                     TimerOutput              *timer)
    : problem_(problem)
    , increment_(std::move(increment))
    , system_(system)
    , linear_solver_(linear_solver)
    , timer_(timer)
  {
    AssertDimension(increment_.target.size(), system.n_independent());
    system.restrict_to_independent(accepted.u, m_accepted_);
    m_ = increment_.target;
    for (unsigned int k = 0; k < system.n_free(); ++k)
      lever_arms_.push_back(
        problem.lever_arm(system.unknown(system.free_unknown(k))));
  }



  void
  LoadStep::pick_free(const Vector<double> &m, Vector<double> &x) const
  {
    x.reinit(system_.n_free());
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      x[k] = m[system_.free_unknown(k)];
  }



  void
  LoadStep::evaluate(const Vector<double> &x, Vector<double> &r)
  {
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      m_[system_.free_unknown(k)] = x[k];
    evaluate_independent(m_, r);
  }



  void
  LoadStep::evaluate_independent(const Vector<double> &m, Vector<double> &r)
  {
    system_.expand(m, trial_.u);
    problem_.evaluate(increment_, trial_);
    system_.linearize(trial_.u);
    system_.condense(trial_.residual, trial_.condensed);
    pick_free(trial_.condensed, r);
  }



  void
  LoadStep::prepare_tangent(const bool free_only)
  {
    bool has_all_couplings = false;
    for (unsigned int attempt = 0; !has_all_couplings; ++attempt)
      {
        // The pattern just built holds all couplings of this very state.
        AssertThrow(attempt < 2, dealii::ExcInternalError());
        if (attempt > 0 || !system_.has_pattern())
          {
            const Section section(timer_, "Pattern");
            system_.build_pattern(problem_.couplings(increment_, trial_));
          }
        system_.set_zero(free_only);
        has_all_couplings = problem_.add_tangent(increment_, trial_, system_);
      }
    const Section section(timer_, "Factorize");
    linear_solver_.factorize(system_.free_matrix());
  }



  void
  LoadStep::solve_linear(const Vector<double> &rhs, Vector<double> &dx)
  {
    const Section section(timer_, "Solve");
    linear_solver_.solve(rhs, dx);
  }



  NewtonProblem
  LoadStep::equations()
  {
    NewtonProblem equations;
    equations.residual = [this](const Vector<double> &x, Vector<double> &r) {
      evaluate(x, r);
    };
    equations.prepare_tangent = [this](const Vector<double> &) {
      prepare_tangent(true);
    };
    equations.solve = [this](const Vector<double> &rhs, Vector<double> &dx) {
      solve_linear(rhs, dx);
    };
    equations.force_scale = [this]() { return trial_.force_scale; };
    equations.force_unit  = problem_.force_unit();
    equations.norm        = [this](const Vector<double> &r) { return norm(r); };
    return equations;
  }



  double
  LoadStep::norm(const Vector<double> &r) const
  {
    Vector<double> forces(r);
    for (unsigned int k = 0; k < forces.size(); ++k)
      forces[k] /= lever_arms_[k];
    return forces.l2_norm();
  }



  bool
  LoadStep::extrapolate(const Vector<double> &u_previous, const double ratio)
  {
    Vector<double> m_previous;
    system_.restrict_to_independent(u_previous, m_previous);
    x_.reinit(system_.n_free());
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      {
        const unsigned int i = system_.free_unknown(k);
        x_[k] = m_accepted_[i] + ratio * (m_accepted_[i] - m_previous[i]);
      }
    try
      {
        evaluate(x_, r_);
        has_residual_ = true;
      }
    catch (const LoadStepFailure &)
      {
        has_residual_ = false;
      }
    return has_residual_;
  }



  void
  LoadStep::follow_tangent()
  {
    has_residual_ = false;
    pick_free(m_accepted_, x_);
    if (system_.n_free() == 0)
      return;
    Vector<double> r, K_increment, rhs(system_.n_free()), dx;
    evaluate_independent(m_accepted_, r);
    prepare_tangent(false);

    Vector<double> increment(increment_.target);
    increment -= m_accepted_;
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      increment[system_.free_unknown(k)] = 0;
    system_.matrix().vmult(K_increment, increment);
    problem_.ranks().sum(K_increment);
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      rhs[k] = -r[k] - K_increment[system_.free_unknown(k)];
    solve_linear(rhs, dx);
    x_ += dx;
  }



  LoadStepReport
  LoadStep::solve(const NewtonParameters  &newton,
                  const ContactParameters &parameters)
  {
    LoadStepReport report;
    if (system_.n_free() == 0)
      {
        // Everything is moved by hand: nothing is left to solve for.
        evaluate(x_, r_);
        report.newton.converged = true;
        return report;
      }
    report.newton =
      solve_newton(newton, equations(), x_, has_residual_ ? &r_ : nullptr);
    report.final_residual = report.newton.residual_norms.back();

    AugmentedLagrangian augmentation(parameters);
    while (parameters.augmented())
      {
        const auto growth = augmentation.next_growth(violation());
        if (!growth)
          break;
        for (unsigned int k = 0; k < trial_.contact.size(); ++k)
          problem_.contacts()[k]->augment(increment_.contact[k],
                                          trial_.contact[k],
                                          *growth);
        const NewtonReport more = solve_newton(newton, equations(), x_);
        report.newton.iterations += more.iterations;
        report.newton.n_tangents += more.n_tangents;
        report.final_residual = more.residual_norms.back();
      }
    for (unsigned int k = 0; k < trial_.contact.size(); ++k)
      problem_.contacts()[k]->check_depth(trial_.contact[k]);
    return report;
  }



  ContactViolation
  LoadStep::violation() const
  {
    ContactViolation largest;
    for (unsigned int k = 0; k < trial_.contact.size(); ++k)
      {
        const ContactViolation of_pair =
          problem_.contacts()[k]->violation(increment_.contact[k],
                                            trial_.contact[k]);
        largest.gap  = std::max(largest.gap, of_pair.gap);
        largest.slip = std::max(largest.slip, of_pair.slip);
      }
    return largest;
  }
} // namespace NPT
