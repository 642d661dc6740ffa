// SPDX-License-Identifier: LGPL-2.1-or-later
// Residual, tangent and predictors of a load step in the free unknowns.

#include <npt_dealii/load_step/load_step.h>

#include <optional>
#include <utility>

namespace NPT
{
  using dealii::TimerOutput;
  using dealii::Vector;

  LoadStep::LoadStep(ConstrainedSystem    &system,
                     LinearSolver         &linear_solver,
                     FullSystem            full_system,
                     const Vector<double> &u_accepted,
                     const Vector<double> &m_target,
                     Vector<double>       &u,
                     Vector<double>       &residual,
                     TimerOutput          *timer)
    : system_(system)
    , linear_solver_(linear_solver)
    , full_system_(std::move(full_system))
    , m_target_(m_target)
    , u_(u)
    , residual_(residual)
    , timer_(timer)
  {
    AssertDimension(m_target.size(), system.n_independent());
    system.restrict_to_independent(u_accepted, m_accepted_);
    m_ = m_target;
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
    system_.expand(m, u_);
    force_scale_ = full_system_.residual(u_, residual_);
    system_.condense(residual_, condensed_);
    pick_free(condensed_, r);
  }



  void
  LoadStep::prepare_tangent()
  {
    full_system_.tangent(u_);
    std::optional<TimerOutput::Scope> scope;
    if (timer_ != nullptr)
      scope.emplace(*timer_, "Factorize");
    linear_solver_.factorize(system_.free_matrix());
  }



  void
  LoadStep::solve(const Vector<double> &rhs, Vector<double> &dx)
  {
    std::optional<TimerOutput::Scope> scope;
    if (timer_ != nullptr)
      scope.emplace(*timer_, "Solve");
    linear_solver_.solve(rhs, dx);
  }



  NewtonProblem
  LoadStep::problem()
  {
    NewtonProblem problem;
    problem.residual = [this](const Vector<double> &x, Vector<double> &r) {
      evaluate(x, r);
    };
    problem.prepare_tangent = [this](const Vector<double> &) {
      prepare_tangent();
    };
    problem.solve = [this](const Vector<double> &rhs, Vector<double> &dx) {
      solve(rhs, dx);
    };
    problem.force_scale = [this]() { return force_scale_; };
    return problem;
  }



  void
  LoadStep::extrapolate(const Vector<double> &u_previous,
                        const double          ratio,
                        Vector<double>       &x) const
  {
    Vector<double> m_previous;
    system_.restrict_to_independent(u_previous, m_previous);
    x.reinit(system_.n_free());
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      {
        const unsigned int i = system_.free_unknown(k);
        x[k] = m_accepted_[i] + ratio * (m_accepted_[i] - m_previous[i]);
      }
  }



  void
  LoadStep::follow_tangent(Vector<double> &x)
  {
    pick_free(m_accepted_, x);
    if (system_.n_free() == 0)
      return;
    Vector<double> r, K_increment, rhs(system_.n_free()), dx;
    evaluate_independent(m_accepted_, r);
    prepare_tangent();

    Vector<double> increment(m_target_);
    increment -= m_accepted_;
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      increment[system_.free_unknown(k)] = 0;
    system_.matrix().vmult(K_increment, increment);
    for (unsigned int k = 0; k < system_.n_free(); ++k)
      rhs[k] = -r[k] - K_increment[system_.free_unknown(k)];
    solve(rhs, dx);
    x += dx;
  }
} // namespace NPT
