// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the solution of the linearized system: direct and iterative solvers
// behind one factorize() and one solve().

#ifndef npt_dealii_linear_algebra_linear_solver_h
#define npt_dealii_linear_algebra_linear_solver_h

#include <npt_dealii/base/parameter_binding.h>
#include <npt_dealii/base/ranks.h>
#include <npt_dealii/linear_algebra/csr_matrix.h>

#include <deal.II/base/parameter_handler.h>
#include <deal.II/lac/vector.h>

#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  /// Subsection "Linear solver".
  struct LinearSolverParameters
  {
    enum class Type
    {
      automatic, ///< fronts, MUMPS, or ILU, by size and memory
      MUMPS,     ///< direct
      UMFPACK,   ///< direct
      ILU,       ///< GMRES with incomplete factorization
      ML         ///< GMRES with smoothed aggregation
    };

    /// Of the factors of fronts and MUMPS.
    enum class Precision
    {
      automatic, ///< single where it pays
      single_precision,
      double_precision
    };

    Type         type           = Type::automatic;
    Precision    factors        = Precision::automatic;
    double       tolerance      = 1e-10; ///< ILU, ML: relative residual [-]
    unsigned int max_iterations = 500;   ///< ILU, ML: GMRES iterations
    /// MUMPS: memory on one machine [GB]; 0: what is available.
    double maximum_memory = 0;

    /// Bind the members to the entries of the subsection.
    void
    add_parameters(dealii::ParameterHandler &prm);

    /// Throws InputError if the solver cannot work on these processes.
    void
    check(const Ranks &ranks) const;
  };

  template <>
  const EnumNames<LinearSolverParameters::Type> &
  enum_names<LinearSolverParameters::Type>();
  template <>
  const EnumNames<LinearSolverParameters::Precision> &
  enum_names<LinearSolverParameters::Precision>();



  /// What a solver has learned of matrices of one pattern and what decides how
  /// it factorizes the next one.
  struct LinearSolverMemory
  {
    bool is_indefinite = false; ///< though symmetric
    bool needs_double  = false; ///< factors of single precision do not do
  };



  /**
   * Solve A x = b for a general (friction: unsymmetric) sparse matrix. With
   * several processes A is the sum of what they have: each hands over what it
   * has assembled, in a matrix of full size whose pattern has only that. Fronts
   * and MUMPS take such a matrix; the others work on one process.
   *
   * What depends on the pattern only (ordering, symbolic factorization, copies
   * of the index arrays) is kept as long as CSRMatrix::pattern_id() stays the
   * same; the values are overwritten in place.
   *
   * - automatic: up to 30,000 unknowns Fronts, at two thirds of the time of
   *   MUMPS with 1,316 unknowns and three quarters with 12,630; a matrix with
   *   pivots too small for them, or too large for the memory, is left to MUMPS.
   *   Else MUMPS, the fastest one of the others in all sizes tried, up to
   *   76,000 unknowns. If it finds, before it takes it, that its factors need
   *   more memory than there is, they go to the disk; if that does not do, ILU
   *   takes over (on one process).
   * - MUMPS, UMFPACK: direct. The residual of every solution is computed (one
   *   product) and one step of iterative refinement
   *   is done only if it exceeds 1e-12 |b|: a solution that is already at
   *   round-off level gains nothing from it.
   * - Factors of single precision (automatic: from 5,000 unknowns on), of
   *   fronts or MUMPS: half the memory; those of MUMPS take the time of double
   *   precision at 2,500 unknowns, and 65 % of it at 12,630 (both with the
   *   solutions).
   *   They are the preconditioner of GMRES in double precision, which takes 2
   *   to 4 iterations to @f$|b - A x| \le 10^{-12} |b|@f$, or to round-off,
   *   @f$|b - A x| \le 10^{-15} \big| |A| |x| \big|@f$. If the matrix magnifies
   *   a right-hand side by 1e5 or more (a body that nothing holds: 6e7 to 7e8
   *   in single precision, at 432 to 5,832 unknowns), if it is singular, or if
   *   30 iterations do not do, it is factorized in double precision, and so are
   *   all of its pattern from then on: see LinearSolverMemory.
   * - ILU: GMRES with incomplete factorization without fill. The iterative
   *   solver of choice with contact, where the penalty spoils the coarse
   *   spaces of multigrid. On a well held elastic box as fast as MUMPS at 10^3
   *   unknowns and 2.5 times faster at 15,000; soft supports cost iterations.
   * - ML: GMRES with smoothed aggregation. Give it the rigid-body modes by
   *   set_near_null_space(); without them it knows only the constant vector
   *   and needs many more iterations for elasticity.
   *
   * Every failure throws LinearSolverFailed, which a load step may survive: a
   * singular matrix (direct solvers: found by factorize(), also where the
   * pivots are round-off instead of zero; or by a residual above 1e-6 |b|), a
   * right-hand side or solution that is not finite, an iteration that does not
   * converge. GMRES solves a singular system with a balanced load without
   * complaint, up to a rigid motion.
   */
  class LinearSolver
  {
  public:
    /// @param ranks The processes among which the entries of the matrix are
    ///   distributed; right-hand sides and solutions are the same on all.
    explicit LinearSolver(const LinearSolverParameters &parameters,
                          const Ranks                  &ranks = {});
    ~LinearSolver();

    LinearSolver(const LinearSolver &) = delete;
    LinearSolver &
    operator=(const LinearSolver &) = delete;

    /// Factorize, or set up the preconditioner. A must stay where and as it is
    /// as long as solve() is called: it is not copied (UMFPACK, ILU, ML do).
    void
    factorize(const CSRMatrix &A);

    /// @param x Resized; need not be initialized. Must not be `rhs` itself.
    void
    solve(const dealii::Vector<double> &rhs, dealii::Vector<double> &x);

    /**
     * Vectors that A maps to nearly zero; used by ML only, from the next
     * factorize() on.
     *
     * @param modes        Rigid-body modes, each of the size of A.
     * @param n_components Unknowns per control point if the unknowns are
     *   numbered point by point, else 1. Ignored if it does not divide the
     *   size of A (condensed or macro unknowns present).
     */
    void
    set_near_null_space(std::vector<dealii::Vector<double>> modes,
                        const unsigned int                  n_components = 1);

    /// Of the present pattern.
    LinearSolverMemory
    memory() const;
    /// Know this of a pattern, if it is that of the next factorize(), for a
    /// run that is continued: round-off then is that of the run that was not
    /// stopped.
    void
    remember(const LinearSolverMemory &memory, const std::size_t pattern_id);

    /// Set-ups of what depends on the pattern only.
    unsigned int
    n_symbolic() const;

    /// Factorizations or preconditioners.
    unsigned int
    n_numeric() const;

    unsigned int
    n_solves() const;

    /// Steps of iterative refinement (direct) or GMRES iterations, summed.
    unsigned int
    n_iterations() const;

    /// Which solver works, and why if the program chose it; for the log.
    std::string
    description() const;

    /// |b - A x| / |b| of the last solution [-].
    double
    relative_residual() const;

    /// Wall time in factorize() and solve() [s].
    double
    seconds_factorize() const;

    double
    seconds_solve() const;

    double
    seconds() const;

    class Backend; ///< one per solver, linear_solver_backend.h

  private:
    void
    set_type(const LinearSolverParameters::Type type);
    void
    factorize_anew(const CSRMatrix &A);
    void
    check_condition(const CSRMatrix &A);
    void
    use_double(const std::string &why);
    double
    residual(const dealii::Vector<double> &rhs,
             const dealii::Vector<double> &x,
             dealii::Vector<double>       &r) const;
    bool
    solve_with_single_factors(const dealii::Vector<double> &rhs,
                              dealii::Vector<double>       &x);
    void
    solve_with_factors(const dealii::Vector<double> &rhs,
                       dealii::Vector<double>       &x);

    LinearSolverParameters   parameters; ///< with the type that works
    const bool               chosen_by_program;
    const Ranks              ranks;
    std::string              reason; ///< why MUMPS does not work
    std::unique_ptr<Backend> backend;
    unsigned int             n_unknowns = 0;
    bool                     usable     = false;
    std::size_t              pattern_id = 0;
    LinearSolverMemory       told;
    std::size_t              told_of = 0; ///< pattern

    unsigned int n_symbolic_        = 0;
    unsigned int n_numeric_         = 0;
    unsigned int n_solves_          = 0;
    unsigned int n_iterations_      = 0;
    double       relative_residual_ = 0;
    double       seconds_factorize_ = 0;
    double       seconds_solve_     = 0;
  };
} // namespace NPT

#endif
