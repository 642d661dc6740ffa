// SPDX-License-Identifier: LGPL-2.1-or-later
// What all solvers share: when to set up anew, refinement, singular matrices.

#include <npt_dealii/base/available_memory.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/linear_algebra/flexible_gmres.h>
#include <npt_dealii/linear_algebra/linear_solver.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>

#include <chrono>
#include <cmath>
#include <sstream>
#include <tuple>
#include <utility>

namespace NPT
{
  using dealii::Vector;

  // A solution worse than this after refinement means a matrix that is
  // singular to working precision: Newton directions from it are noise.
  constexpr double unusable_residual = 1e-6;
  // Above this one step of refinement is worth its solve.
  constexpr double refine_above = 1e-12;
  // See amplification(). Measured on elastic boxes of 432 to 15,360 unknowns:
  // free 1e15 to 3e15, on a foundation of 1e-6 times their stiffness 2e6, on
  // one of 1 to 1e6 times their stiffness below 50.
  constexpr double singular_amplification = 1e13;
  // Factors of single precision are not used for a matrix above this, and if
  // a solution takes more iterations.
  constexpr double       single_precision_amplification = 1e5;
  constexpr unsigned int single_precision_iterations    = 30;
  // A residual of this size against |A| |x| is round-off.
  constexpr double round_off = 1e-15;

  namespace
  {
    double
    now()
    {
      return std::chrono::duration<double>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
    }

    /**
     * Return how strongly solving with A magnifies a rough right-hand side,
     * and the unknown that moves most.
     *
     * @f[ \max_i \frac{(|A| |x|)_i}{s_i}, \quad A x = b, \quad b_i = \pm s_i,
     *     \quad s_i = \sum_j |A_{ij}| @f]
     *
     * A lower bound of a condition number that does not change when equations
     * are scaled (macro unknowns have other units than displacements; scaling
     * of unknowns does change it). With several processes absolute values are
     * taken of what each has assembled. A factorization in floating point
     * passes over most singular matrices without a word (pivots are 1e-13
     * instead of zero), and the residual of a consistent system stays small,
     * but then Newton's correction contains rigid motions of arbitrary size.
     * Costs one solve and one product: the solve is 4 % of a factorization at
     * 1,452 unknowns, 2 % at 15,360. MUMPS' own detection of null pivots
     * (ICNTL(24)) was tried instead: of the six of a free body it finds none
     * with a threshold of 1e-14 and three with 1e-13.
     */
    std::pair<double, unsigned int>
    amplification(const CSRMatrix       &A,
                  const Ranks           &ranks,
                  LinearSolver::Backend &backend)
    {
      const unsigned int n = A.n();
      Vector<double>     s, b(n), x(n);
      unsigned int       random = 1;
      x                         = 1.;
      A.vmult_absolute(s, x);
      ranks.sum(s);
      for (unsigned int i = 0; i < n; ++i)
        {
          random = 1664525 * random + 1013904223; // same on every machine
          b[i]   = (random >> 16) % 2 ? s[i] : -s[i];
        }
      backend.solve(b, x);

      Vector<double> sums;
      A.vmult_absolute(sums, x);
      ranks.sum(sums);
      double       largest = 0;
      unsigned int unknown = 0;
      for (unsigned int i = 0; i < n; ++i)
        {
          const double sum = sums[i];
          // Written so that NaN counts as largest.
          if (!(sum <= largest * s[i]))
            largest = sum / s[i];
          if (std::abs(x[i]) > std::abs(x[unknown]))
            unknown = i;
        }
      return {largest, unknown};
    }
  } // namespace



  namespace
  {
    /*
     * OpenBLAS 0.3.21 takes a buffer of 128 MB of addresses with its first
     * product of matrices. If it does not get them (`ulimit -v`), it tries
     * again for ever. Later products use the same buffer.
     */
    void
    check_buffer_of_blas()
    {
      constexpr double buffer  = 0.15; // GB, with what else is due by then
      static bool      is_kept = false;
      if (is_kept)
        return;
      const double available = available_gigabytes();
      if (available < buffer)
        {
          std::ostringstream detail;
          detail.precision(2);
          detail << "the BLAS needs " << buffer << " GB for its buffer, and "
                 << available << " GB are available";
          throw OutOfMemory(detail.str());
        }
      is_kept = true;
    }
  } // namespace



  template <>
  const EnumNames<LinearSolverParameters::Type> &
  enum_names<LinearSolverParameters::Type>()
  {
    using Type                         = LinearSolverParameters::Type;
    static const EnumNames<Type> names = {{Type::automatic, "automatic"},
                                          {Type::MUMPS, "MUMPS"},
                                          {Type::UMFPACK, "UMFPACK"},
                                          {Type::ILU, "ILU"},
                                          {Type::ML, "ML"}};
    return names;
  }



  template <>
  const EnumNames<LinearSolverParameters::Precision> &
  enum_names<LinearSolverParameters::Precision>()
  {
    using Precision                         = LinearSolverParameters::Precision;
    static const EnumNames<Precision> names = {
      {Precision::automatic, "automatic"},
      {Precision::single_precision, "single"},
      {Precision::double_precision, "double"}};
    return names;
  }



  void
  LinearSolverParameters::add_parameters(dealii::ParameterHandler &prm)
  {
    namespace Patterns = dealii::Patterns;
    const ParameterSubsection subsection(prm, "Linear solver");
    add_parameter(
      prm,
      "Type",
      type,
      "automatic: fronts of the program's own up to 30,000 "
      "unknowns, else MUMPS, or ILU if the factors of MUMPS do not fit in the "
      "memory. Direct: MUMPS, UMFPACK. Iterative: GMRES with an incomplete "
      "factorization (ILU) or smoothed aggregation (ML); of the two ILU is "
      "the better one with contact.");
    add_parameter(
      prm,
      "Factors",
      factors,
      "Precision of the factors of fronts and MUMPS. single: half the memory and up to "
      "half the time; solutions are iterated to the residual of double "
      "precision, and matrices for which that does not do are factorized in "
      "double precision. automatic: single from 5,000 unknowns on.");
    add_parameter(prm,
                  "Tolerance",
                  tolerance,
                  "ILU, ML: residual over right-hand side at which the "
                  "iteration stops [-]. Direct solvers ignore it.",
                  Patterns::Double(1e-15, 1e-1));
    add_parameter(prm,
                  "Maximum iterations",
                  max_iterations,
                  "ILU, ML: GMRES iterations after which the load step "
                  "counts as failed [-].",
                  Patterns::Integer(1, 100000));
    add_parameter(prm,
                  "Maximum memory",
                  maximum_memory,
                  "Memory that MUMPS may take for its factors on one machine "
                  "[GB]. It is compared before it is taken; if more is needed, "
                  "factors go to the disk ($MUMPS_OOC_TMPDIR or /tmp). If that "
                  "does not do, automatic goes on with ILU on one process, and "
                  "MUMPS ends the run. 0: what is available at that time.",
                  Patterns::Double(0));
  }



  void
  LinearSolverParameters::check(const Ranks &ranks) const
  {
    if (!ranks.is_alone() && type != Type::MUMPS && type != Type::automatic)
      throw InputError("Type = " + name_of(type) +
                       " solves on one process, but this run has " +
                       std::to_string(ranks.n()) +
                       "; choose MUMPS (subsection Linear solver).");
  }



  LinearSolver::LinearSolver(const LinearSolverParameters &given,
                             const Ranks                  &given_ranks)
    : parameters(given)
    , chosen_by_program(given.type == LinearSolverParameters::Type::automatic)
    , ranks(given_ranks)
  {
    parameters.check(ranks);
    set_type(chosen_by_program ? LinearSolverParameters::Type::MUMPS :
                                 parameters.type);
  }



  void
  LinearSolver::set_type(const LinearSolverParameters::Type type)
  {
    using Type      = LinearSolverParameters::Type;
    parameters.type = type;
    switch (type)
      {
        case Type::automatic:
          Assert(false, dealii::ExcInternalError());
          break;
        case Type::MUMPS:
          backend = chosen_by_program ? make_direct_backend(parameters, ranks) :
                                        make_mumps_backend(parameters, ranks);
          break;
        case Type::UMFPACK:
          backend = make_umfpack_backend();
          break;
        case Type::ILU:
          backend = make_ilu_backend(parameters);
          break;
        case Type::ML:
          backend = make_ml_backend(parameters);
          break;
      }
    AssertThrow(backend, dealii::ExcInternalError());
    pattern_id = 0;
  }



  LinearSolver::~LinearSolver() = default;



  void
  LinearSolver::factorize(const CSRMatrix &A)
  {
    const double start = now();
    usable             = false;
    n_unknowns         = A.n();
    check_buffer_of_blas();
    try
      {
        factorize_anew(A);
      }
    catch (const OutOfMemory &failure)
      {
        if (!chosen_by_program || !ranks.is_alone() ||
            parameters.type == LinearSolverParameters::Type::ILU)
          throw;
        reason = failure.what();
        set_type(LinearSolverParameters::Type::ILU);
        factorize_anew(A);
      }
    usable = true;
    seconds_factorize_ += now() - start;
  }



  void
  LinearSolver::factorize_anew(const CSRMatrix &A)
  {
    if (A.pattern_id() != pattern_id)
      {
        // Stays zero if the set-up throws, so that it is not taken for done.
        pattern_id = 0;
        backend->symbolic(A);
        ++n_symbolic_;
        pattern_id = A.pattern_id();
        if (pattern_id == told_of)
          backend->remember(told);
        told_of = 0;
      }
    backend->numeric(A);
    ++n_numeric_;
    if (backend->is_direct)
      check_condition(A);
  }



  void
  LinearSolver::check_condition(const CSRMatrix &A)
  {
    auto [factor, unknown] = amplification(A, ranks, *backend);
    if (backend->has_single_factors() &&
        !(factor < single_precision_amplification))
      {
        std::ostringstream why;
        why.precision(2);
        why << "as the condition is at least " << factor;
        use_double(why.str());
        std::tie(factor, unknown) = amplification(A, ranks, *backend);
      }
    if (!(factor < singular_amplification))
      {
        std::ostringstream detail;
        detail << name_of(parameters.type) << ": the matrix of size " << A.n()
               << " is singular to working precision (condition at least "
               << factor << "); unknown " << unknown << " moves most."
               << singular_hint;
        throw LinearSolverFailed(detail.str());
      }
  }



  void
  LinearSolver::use_double(const std::string &why)
  {
    usable = false;
    backend->use_double(why);
    ++n_numeric_;
  }



  std::string
  LinearSolver::description() const
  {
    std::ostringstream text;
    const std::string  name = backend->name();
    text << (name.empty() ? name_of(parameters.type) : name)
         << backend->description();
    if (chosen_by_program)
      text << (reason.empty() ? " (automatic)" :
                                " (automatic: " + reason + ")");
    return text.str();
  }



  void
  LinearSolver::solve(const Vector<double> &rhs, Vector<double> &x)
  {
    AssertThrow(usable,
                dealii::ExcMessage("solve() needs a successful factorize()."));
    AssertDimension(rhs.size(), n_unknowns);
    Assert(&rhs != &x, dealii::ExcMessage("rhs and x must differ."));
    const double start = now();

    if (!is_finite(rhs))
      throw LinearSolverFailed(name_of(parameters.type) +
                               ": the right-hand side is not finite.");
    x.reinit(n_unknowns);
    ++n_solves_;
    if (backend->has_single_factors())
      {
        if (solve_with_single_factors(rhs, x))
          {
            seconds_solve_ += now() - start;
            return;
          }
        use_double("as a solution did not reach a residual of 1e-12 in " +
                   std::to_string(single_precision_iterations) + " iterations");
        usable = true;
      }
    solve_with_factors(rhs, x);
    seconds_solve_ += now() - start;
  }



  double
  LinearSolver::residual(const Vector<double> &rhs,
                         const Vector<double> &x,
                         Vector<double>       &r) const
  {
    backend->vmult(r, x);
    r.sadd(-1., 1., rhs);
    const double rhs_norm = rhs.l2_norm();
    return rhs_norm > 0 ? r.l2_norm() / rhs_norm : 0.;
  }



  bool
  LinearSolver::solve_with_single_factors(const Vector<double> &rhs,
                                          Vector<double>       &x)
  {
    const LinearMap product = [&](const Vector<double> &from,
                                  Vector<double>       &to) {
      backend->vmult(to, from);
    };
    const LinearMap factors = [&](const Vector<double> &from,
                                  Vector<double>       &to) {
      backend->solve(from, to);
    };
    // Half of what is allowed: the recursion runs ahead of the residual.
    const double   tolerance = 0.5 * refine_above * rhs.l2_norm();
    unsigned int   n_left    = single_precision_iterations;
    Vector<double> r(rhs), correction, sums;
    for (;;)
      {
        const unsigned int n =
          flexible_gmres(product, factors, r, tolerance, n_left, correction);
        n_iterations_ += n;
        n_left -= n;
        x += correction;
        if (!is_finite(x))
          return false;
        relative_residual_ = residual(rhs, x, r);
        if (relative_residual_ <= refine_above)
          return true;
        backend->vmult_absolute(sums, x);
        if (r.l2_norm() <= round_off * sums.l2_norm())
          return true;
        if (n == 0 || n_left == 0)
          return false;
      }
  }



  void
  LinearSolver::solve_with_factors(const Vector<double> &rhs, Vector<double> &x)
  {
    backend->solve(rhs, x);
    if (!is_finite(x))
      throw LinearSolverFailed(name_of(parameters.type) +
                               ": the solution is not finite." + singular_hint);
    Vector<double> r;
    relative_residual_ = residual(rhs, x, r);
    if (!backend->is_direct)
      {
        n_iterations_ += backend->n_iterations;
        return;
      }
    if (relative_residual_ > refine_above)
      {
        Vector<double> refined(n_unknowns);
        backend->solve(r, refined);
        ++n_iterations_;
        refined += x;
        const double refined_residual = residual(rhs, refined, r);
        if (refined_residual < relative_residual_)
          {
            relative_residual_ = refined_residual;
            x.swap(refined);
          }
      }
    if (!(relative_residual_ <= unusable_residual))
      {
        std::ostringstream detail;
        detail << name_of(parameters.type)
               << ": the solution leaves a relative residual of "
               << relative_residual_
               << "; the matrix is singular to working precision."
               << singular_hint;
        throw LinearSolverFailed(detail.str());
      }
  }



  void
  LinearSolver::set_near_null_space(std::vector<Vector<double>> modes,
                                    const unsigned int          n_components)
  {
    Assert(n_components > 0, dealii::ExcZero());
    backend->near_null_space = std::move(modes);
    backend->n_components    = n_components;
  }



  LinearSolverMemory
  LinearSolver::memory() const
  {
    return backend->memory();
  }



  void
  LinearSolver::remember(const LinearSolverMemory &memory,
                         const std::size_t         of_pattern)
  {
    told    = memory;
    told_of = of_pattern;
  }



  unsigned int
  LinearSolver::n_symbolic() const
  {
    return n_symbolic_;
  }



  unsigned int
  LinearSolver::n_numeric() const
  {
    return n_numeric_;
  }



  unsigned int
  LinearSolver::n_solves() const
  {
    return n_solves_;
  }



  unsigned int
  LinearSolver::n_iterations() const
  {
    return n_iterations_;
  }



  double
  LinearSolver::relative_residual() const
  {
    return relative_residual_;
  }



  double
  LinearSolver::seconds_factorize() const
  {
    return seconds_factorize_;
  }



  double
  LinearSolver::seconds_solve() const
  {
    return seconds_solve_;
  }



  double
  LinearSolver::seconds() const
  {
    return seconds_factorize_ + seconds_solve_;
  }
} // namespace NPT
