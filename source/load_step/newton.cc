// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the Newton loop: criteria, line search, detection of cycles.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/load_step/newton.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    constexpr double sufficient_decrease = 1e-4; // of the line search
    constexpr double divergence_factor   = 1e8;  // of the force scale
    constexpr double round_off_factor    = 1e-13;
    constexpr double same_norm           = 1e-6; // relative, for cycles

    /// Do the last norms repeat with this period? Asks for two full periods,
    /// of a constant for four equal norms.
    bool
    repeats(const std::vector<double> &norms, const unsigned int period)
    {
      const unsigned int n_compared = period == 1 ? 3 : period;
      if (norms.size() < n_compared + period)
        return false;
      for (unsigned int j = 1; j <= n_compared; ++j)
        {
          const double a = norms[norms.size() - j];
          const double b = norms[norms.size() - j - period];
          if (std::abs(a - b) > same_norm * std::max(a, b))
            return false;
        }
      return true;
    }
  } // namespace



  void
  NewtonParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    using namespace dealii;
    prm.enter_subsection("Newton");
    {
      prm.declare_entry("Relative tolerance",
                        "1e-7",
                        Patterns::Double(1e-14, 1),
                        "Residual norm over the norm of the internal forces "
                        "before they cancel, at which Newton has converged "
                        "[-].");
      prm.declare_entry("Absolute tolerance",
                        "1e-10",
                        Patterns::Double(0),
                        "Residual norm that always counts as converged [N]: "
                        "the floor for states in which all forces vanish.");
      prm.declare_entry("Maximum iterations",
                        "25",
                        Patterns::Integer(1, 1000),
                        "Corrections after which the load step counts as "
                        "failed [-].");
      prm.declare_entry("Line search",
                        "true",
                        Patterns::Bool(),
                        "Halve corrections that raise the residual, invert a "
                        "cell or lose a projection.");
      prm.declare_entry("Maximum halvings",
                        "8",
                        Patterns::Integer(0, 50),
                        "Halvings of one correction before the load step "
                        "counts as failed [-].");
      prm.declare_entry("Non-monotone memory",
                        "3",
                        Patterns::Integer(1, 100),
                        "A correction is accepted if the residual falls below "
                        "the largest of this many last ones [-]. 1: it has to "
                        "fall every time, which stalls at first contact and at "
                        "changes between stick and slip.");
    }
    prm.leave_subsection();
  }



  void
  NewtonParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Newton");
    {
      relative_tolerance = prm.get_double("Relative tolerance");
      absolute_tolerance = prm.get_double("Absolute tolerance");
      max_iterations     = prm.get_integer("Maximum iterations");
      line_search        = prm.get_bool("Line search");
      max_halvings       = prm.get_integer("Maximum halvings");
      nonmonotone_memory = prm.get_integer("Non-monotone memory");
    }
    prm.leave_subsection();
  }



  double
  NewtonReport::order() const
  {
    std::size_t n = residual_norms.size();
    while (n > 0 && residual_norms[n - 1] <= round_off_factor * force_scale)
      --n;
    if (n < 3)
      return std::numeric_limits<double>::quiet_NaN();
    const double last    = residual_norms[n - 1] / residual_norms[n - 2];
    const double earlier = residual_norms[n - 2] / residual_norms[n - 3];
    if (!(earlier < 1))
      return std::numeric_limits<double>::quiet_NaN();
    return std::log(last) / std::log(earlier);
  }



  NewtonReport
  solve_newton(const NewtonParameters &parameters,
               const NewtonProblem    &problem,
               Vector<double>         &x)
  {
    NewtonReport   report;
    Vector<double> r(x.size()), rhs(x.size()), dx(x.size()), x_trial(x.size());
    auto          &norms = report.residual_norms;

    const auto tolerance = [&]() {
      return std::max(parameters.relative_tolerance * report.force_scale,
                      parameters.absolute_tolerance);
    };
    const auto evaluate = [&](const Vector<double> &at) {
      ++report.n_residuals;
      problem.residual(at, r);
      report.force_scale = problem.force_scale();
      // In debug mode l2_norm() aborts on what a trial may well produce, and on
      // a system without unknowns.
      double sum = 0;
      for (const double component : r)
        sum += std::abs(component);
      return std::isfinite(sum) && r.size() > 0 ? r.l2_norm() : sum;
    };
    const auto fail = [&](const std::string &reason, const std::string &why) {
      std::ostringstream detail;
      detail << why << (why.empty() ? "" : " ") << "Residual norms [N]:";
      const std::size_t n_shown = std::min<std::size_t>(norms.size(), 8);
      if (n_shown < norms.size())
        detail << " ...";
      for (std::size_t k = norms.size() - n_shown; k < norms.size(); ++k)
        detail << ' ' << norms[k];
      detail << "; tolerance " << tolerance() << " after " << report.iterations
             << " iterations";
      if (!report.state_summaries.empty())
        detail << "; " << report.state_summaries.back();
      throw NewtonNotConverged(reason, detail.str() + ".");
    };

    double norm = evaluate(x);
    if (!std::isfinite(norm))
      fail("invalid residual", "The residual of the start is not finite.");

    for (;;)
      {
        norms.push_back(norm);
        if (problem.state_summary)
          report.state_summaries.push_back(problem.state_summary());

        if (norm <= tolerance())
          {
            report.converged = true;
            return report;
          }
        if (report.force_scale > 0 &&
            norm > divergence_factor * report.force_scale)
          fail("diverged", "");
        // A constant norm has every period; it deserves its own name.
        if (repeats(norms, 1))
          fail("stagnated", "");
        for (const unsigned int period : {2, 3})
          if (repeats(norms, period))
            fail("active set cycling",
                 "Period " + std::to_string(period) + ".");
        if (report.iterations >= parameters.max_iterations)
          fail("iteration limit", "");

        problem.prepare_tangent(x);
        rhs.equ(-1., r);
        problem.solve(rhs, dx);

        if (!parameters.line_search)
          {
            x += dx;
            norm = evaluate(x);
            if (!std::isfinite(norm))
              fail("invalid residual",
                   "The residual is not finite after a full step.");
            ++report.iterations;
            continue;
          }

        const std::size_t memory =
          std::min<std::size_t>(parameters.nonmonotone_memory, norms.size());
        const double reference =
          *std::max_element(norms.end() - memory, norms.end());
        double       alpha     = 1;
        double       best      = std::numeric_limits<double>::infinity();
        unsigned int n_refused = 0;
        std::string  last_refusal;
        bool         accepted = false;
        for (unsigned int cut = 0; cut <= parameters.max_halvings; ++cut)
          {
            if (cut > 0)
              {
                alpha *= 0.5;
                ++report.n_line_search_cuts;
              }
            x_trial = x;
            x_trial.add(alpha, dx);
            try
              {
                norm = evaluate(x_trial);
                if (!std::isfinite(norm))
                  throw LoadStepFailure("invalid residual", "not finite");
                best = std::min(best, norm);
                if (norm <= (1 - sufficient_decrease * alpha) * reference ||
                    norm <= tolerance())
                  {
                    accepted = true;
                    break;
                  }
              }
            catch (const LoadStepFailure &failure)
              {
                ++n_refused;
                last_refusal = failure.what();
              }
          }
        if (!accepted)
          {
            std::ostringstream why;
            why << "Best residual of " << parameters.max_halvings + 1
                << " trials " << best << " where " << reference
                << " had to be undercut";
            if (n_refused > 0)
              why << "; " << n_refused << " trials could not be evaluated ("
                  << last_refusal << ")";
            fail("line search failed", why.str() + ".");
          }
        x.swap(x_trial);
        ++report.iterations;
      }
  }
} // namespace NPT
