// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the Newton loop: criteria, line search, detection of cycles.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
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
    constexpr double smallest_force      = 1e-14; // of the force unit
    constexpr double same_norm           = 1e-6;  // relative, for cycles

    // Of an iteration that jumps to and fro over a kink: how many norms are
    // compared with as many before, by how much the largest must have fallen,
    // and what is left of the next corrections if it has not.
    constexpr unsigned int n_compared_norms  = 3;
    constexpr double       stalled_reduction = 0.75;
    constexpr double       damped_correction = 0.25;

    // An iteration that is about to converge may exceed its limit: what each
    // correction has to leave of the residual then, and what part of the limit.
    constexpr double       promising_reduction = 0.1;
    constexpr unsigned int part_beyond_limit   = 4; // a quarter

    // Of a kept tangent: how many corrections it may take to converge, by how
    // much each must reduce the residual, and what counts as converged then.
    constexpr double most_kept_corrections = 12;
    constexpr double worst_reduction       = 0.5;
    constexpr double kept_tolerance        = 0.1; // of the tolerance

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
  NewtonParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    const ParameterSubsection subsection(prm, "Newton");
    add_parameter(prm,
                  "Relative tolerance",
                  relative_tolerance,
                  "Residual norm over the norm of the internal forces "
                  "before they cancel, at which Newton has converged "
                  "[-].",
                  Patterns::Double(1e-14, 1));
    add_parameter(prm,
                  "Absolute tolerance",
                  absolute_tolerance,
                  "Residual norm that always counts as converged [N], in "
                  "addition to the round-off of states in which all forces "
                  "vanish: 1e-14 of the bodies' stiffness times size^2.",
                  Patterns::Double(0));
    add_parameter(prm,
                  "Maximum iterations",
                  max_iterations,
                  "Corrections after which the load step counts as "
                  "failed [-]; a quarter more while each leaves a "
                  "tenth of the residual.",
                  Patterns::Integer(1, 1000));
    add_parameter(prm,
                  "Line search",
                  line_search,
                  "Halve corrections that raise the residual, invert a "
                  "cell or lose a projection.");
    add_parameter(prm,
                  "Maximum halvings",
                  max_halvings,
                  "Halvings of one correction before the load step "
                  "counts as failed [-].",
                  Patterns::Integer(0, 50));
    add_parameter(prm,
                  "Non-monotone memory",
                  nonmonotone_memory,
                  "A correction is accepted if the residual falls below "
                  "the largest of this many last ones [-]. 1: it has to "
                  "fall every time, which stalls at first contact and at "
                  "changes between stick and slip.",
                  Patterns::Integer(1, 100));
    add_parameter(prm,
                  "Keep tangent",
                  keep_tangent,
                  "Use a tangent and its factorization for further corrections "
                  "of the step where they are seen to converge quickly. The "
                  "result is the same within the tolerance, for less time; "
                  "false for orders of convergence.");
  }



  double
  NewtonReport::order() const
  {
    std::size_t n = residual_norms.size();
    while (n > 0 && residual_norms[n - 1] <= round_off_factor * force_scale)
      --n;
    const auto kept = [this](const std::size_t correction) {
      return correction < kept_tangent.size() && kept_tangent[correction];
    };
    if (n < 3 || kept(n - 2) || kept(n - 3))
      return std::numeric_limits<double>::quiet_NaN();
    const double last    = residual_norms[n - 1] / residual_norms[n - 2];
    const double earlier = residual_norms[n - 2] / residual_norms[n - 3];
    if (!(earlier < 1))
      return std::numeric_limits<double>::quiet_NaN();
    return std::log(last) / std::log(earlier);
  }



  namespace
  {
    // The iteration of one call of solve_newton().
    class NewtonIteration
    {
    public:
      NewtonIteration(const NewtonParameters &parameters,
                      const NewtonProblem    &problem,
                      Vector<double>         &x)
        : parameters_(parameters)
        , problem_(problem)
        , x_(x)
        , r_(x.size())
        , rhs_(x.size())
        , dx_(x.size())
        , x_trial_(x.size())
      {}

      NewtonReport
      run(const Vector<double> *residual_at_start)
      {
        double norm = 0;
        if (residual_at_start != nullptr)
          {
            r_   = *residual_at_start;
            norm = measure();
          }
        else
          norm = evaluate(x_);
        if (!std::isfinite(norm))
          fail("invalid residual", "The residual of the start is not finite.");
        while (!converged(norm))
          {
            if (tangent_may_be_kept())
              {
                norm = correct_with_kept_tangent(norm);
                continue;
              }
            problem_.prepare_tangent(x_);
            ++report_.n_tangents;
            rhs_.equ(-1., r_);
            problem_.solve(rhs_, dx_);
            const unsigned int cuts = report_.n_line_search_cuts;
            norm = parameters_.line_search ? search_along() : full_step();
            ++report_.iterations;
            report_.kept_tangent.push_back(false);
            // A correction that had to be shortened says nothing on the next.
            tangent_is_good_ = report_.n_line_search_cuts == cuts;
          }
        return report_;
      }

    private:
      double
      tolerance() const
      {
        return std::max({parameters_.relative_tolerance * report_.force_scale,
                         parameters_.absolute_tolerance,
                         smallest_force * problem_.force_unit});
      }

      // Norm of the present residual.
      double
      measure()
      {
        report_.force_scale = problem_.force_scale();
        // In debug mode l2_norm() aborts on what a trial may well produce, and
        // on a system without unknowns.
        double sum = 0;
        for (const double component : r_)
          sum += std::abs(component);
        if (!std::isfinite(sum) || r_.size() == 0)
          return sum;
        return problem_.norm ? problem_.norm(r_) : r_.l2_norm();
      }

      double
      evaluate(const Vector<double> &at)
      {
        ++report_.n_residuals;
        problem_.residual(at, r_);
        return measure();
      }

      // Whether further corrections with the present tangent promise to
      // converge quickly, by the drop that the last correction has brought.
      bool
      tangent_may_be_kept() const
      {
        const auto &norms = report_.residual_norms;
        if (!parameters_.keep_tangent || !tangent_is_good_ || norms.size() < 2)
          return false;
        const double last = norms.back() / norms[norms.size() - 2];
        const double next = report_.kept_tangent.back() ? last : 2. * last;
        return next < worst_reduction &&
               std::log(kept_tolerance * tolerance() / norms.back()) /
                   std::log(next) <=
                 most_kept_corrections;
      }

      // Correct x_ and return the new norm; if that is no progress, x_ stays as
      // it is, with the old norm, and the tangent is not kept any more.
      double
      correct_with_kept_tangent(const double norm)
      {
        rhs_.equ(-1., r_);
        problem_.solve(rhs_, dx_);
        x_trial_ = x_;
        x_trial_ += dx_;
        double new_norm = std::numeric_limits<double>::infinity();
        try
          {
            new_norm = evaluate(x_trial_);
          }
        catch (const LoadStepFailure &)
          {
            // A new tangent, and the line search along its correction, have to
            // find out whether the step can be survived.
          }
        tangent_is_good_ = new_norm <= worst_reduction * norm;
        if (!(new_norm < norm))
          {
            report_.residual_norms.pop_back();
            if (problem_.state_summary)
              report_.state_summaries.pop_back();
            return evaluate(x_);
          }
        x_.swap(x_trial_);
        if (!report_.kept_tangent.back())
          ++report_.iterations;
        report_.kept_tangent.push_back(true);
        return new_norm;
      }

      // Record the norm and judge it; throws if there is no hope.
      bool
      converged(const double norm)
      {
        auto &norms = report_.residual_norms;
        norms.push_back(norm);
        if (problem_.state_summary)
          report_.state_summaries.push_back(problem_.state_summary());
        const bool kept =
          !report_.kept_tangent.empty() && report_.kept_tangent.back();
        if (norm <= (kept ? kept_tolerance : 1.) * tolerance())
          {
            report_.converged = true;
            return true;
          }
        if (report_.force_scale > 0 &&
            norm > divergence_factor * report_.force_scale)
          fail("diverged", "");
        // A constant norm has every period; it deserves its own name.
        if (repeats(norms, 1))
          fail<NewtonStalled>("stagnated", "");
        for (const unsigned int period : {2, 3})
          if (repeats(norms, period))
            fail<NewtonStalled>("active set cycling",
                                "Period " + std::to_string(period) + ".");
        const bool promises =
          norms.size() > 1 &&
          norm <= promising_reduction * norms[norms.size() - 2];
        const unsigned int limit = parameters_.max_iterations;
        if (report_.iterations >=
            (promises ? limit + limit / part_beyond_limit : limit))
          fail("iteration limit", "");
        return false;
      }

      double
      full_step()
      {
        x_ += dx_;
        const double norm = evaluate(x_);
        if (!std::isfinite(norm))
          fail("invalid residual",
               "The residual is not finite after a full step.");
        return norm;
      }

      // The nonmonotone line search lets pass what jumps over the solution and
      // back, falling by a little each time; a shorter correction breaks this.
      bool
      jumps_to_and_fro() const
      {
        constexpr unsigned int n     = n_compared_norms;
        const auto            &norms = report_.residual_norms;
        return norms.size() >= 2 * n &&
               *std::max_element(norms.end() - n, norms.end()) >
                 stalled_reduction *
                   *std::max_element(norms.end() - 2 * n, norms.end() - n);
      }

      // Three shortened corrections, then three full ones: from a valley of the
      // norm short ones alone do not lead out.
      double
      first_trial()
      {
        if (n_full_ > 0)
          {
            --n_full_;
            return 1.;
          }
        if (!jumps_to_and_fro())
          {
            n_shortened_ = 0;
            return 1.;
          }
        if (++n_shortened_ == n_compared_norms)
          {
            n_shortened_ = 0;
            n_full_      = n_compared_norms;
          }
        return damped_correction;
      }

      // Halve the correction until it is accepted.
      double
      search_along()
      {
        const auto       &norms = report_.residual_norms;
        const std::size_t memory =
          std::min<std::size_t>(parameters_.nonmonotone_memory, norms.size());
        const double reference =
          *std::max_element(norms.end() - memory, norms.end());
        double       alpha     = first_trial();
        double       best      = std::numeric_limits<double>::infinity();
        unsigned int n_refused = 0;
        std::string  last_refusal;
        for (unsigned int cut = 0; cut <= parameters_.max_halvings; ++cut)
          {
            if (cut > 0)
              {
                alpha *= 0.5;
                ++report_.n_line_search_cuts;
              }
            x_trial_ = x_;
            x_trial_.add(alpha, dx_);
            try
              {
                const double norm = evaluate(x_trial_);
                if (!std::isfinite(norm))
                  {
                    ++n_refused;
                    last_refusal = "invalid residual: not finite";
                    continue;
                  }
                best = std::min(best, norm);
                if (norm <= (1 - sufficient_decrease * alpha) * reference ||
                    norm <= tolerance())
                  {
                    x_.swap(x_trial_);
                    return norm;
                  }
              }
            catch (const LoadStepFailure &failure)
              {
                ++n_refused;
                last_refusal = failure.what();
              }
          }
        std::ostringstream why;
        why << "Best residual of " << parameters_.max_halvings + 1 << " trials "
            << best << " where " << reference << " had to be undercut";
        if (n_refused > 0)
          why << "; " << n_refused << " trials could not be evaluated ("
              << last_refusal << ")";
        fail("line search failed", why.str() + ".");
      }

      template <typename Failure = NewtonNotConverged>
      [[noreturn]] void
      fail(const std::string &reason, const std::string &why) const
      {
        const auto        &norms = report_.residual_norms;
        std::ostringstream detail;
        detail << why << (why.empty() ? "" : " ") << "Residual norms [N]:";
        const std::size_t n_shown = std::min<std::size_t>(norms.size(), 8);
        if (n_shown < norms.size())
          detail << " ...";
        for (std::size_t k = norms.size() - n_shown; k < norms.size(); ++k)
          detail << ' ' << norms[k];
        detail << "; tolerance " << tolerance() << " after "
               << report_.iterations << " iterations";
        if (!report_.state_summaries.empty())
          detail << "; " << report_.state_summaries.back();
        throw Failure(reason, detail.str() + ".");
      }

      const NewtonParameters &parameters_;
      const NewtonProblem    &problem_;
      NewtonReport            report_;
      bool                    tangent_is_good_ = false;
      unsigned int            n_shortened_ = 0; // in a row, by first_trial()
      unsigned int            n_full_      = 0; // corrections that are to come
      Vector<double>         &x_;
      Vector<double>          r_, rhs_, dx_, x_trial_;
    };
  } // namespace



  NewtonReport
  solve_newton(const NewtonParameters &parameters,
               const NewtonProblem    &problem,
               Vector<double>         &x,
               const Vector<double>   *residual_at_start)
  {
    return NewtonIteration(parameters, problem, x).run(residual_at_start);
  }
} // namespace NPT
