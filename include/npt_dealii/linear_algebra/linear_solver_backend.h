// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what LinearSolver asks of a solver, one function per solver to make
// it.

#ifndef npt_dealii_linear_algebra_linear_solver_backend_h
#define npt_dealii_linear_algebra_linear_solver_backend_h

#include <npt_dealii/linear_algebra/linear_solver.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace NPT
{
  class LinearSolver::Backend
  {
  public:
    virtual ~Backend() = default;

    /// Everything that depends on the pattern only.
    virtual void
    symbolic(const CSRMatrix &A) = 0;

    /// A stays where and as it is until the next one.
    virtual void
    numeric(const CSRMatrix &A) = 0;

    virtual void
    solve(const dealii::Vector<double> &rhs, dealii::Vector<double> &x) = 0;

    /// y = A x with the values of the last numeric().
    virtual void
    vmult(dealii::Vector<double> &y, const dealii::Vector<double> &x) const = 0;

    /// y = |A| |x| likewise; asked for with has_single_factors() only.
    virtual void
    vmult_absolute(dealii::Vector<double>       &y,
                   const dealii::Vector<double> &x) const
    {
      (void)y;
      (void)x;
      AssertThrow(false, dealii::ExcNotImplemented());
    }

    /// Of several solvers behind one type, the one that works; else empty.
    virtual std::string
    name() const
    {
      return "";
    }

    /// What the log says of it beside its name; begins with a comma.
    virtual std::string
    description() const
    {
      return "";
    }

    /// Whether solve() has single precision only.
    virtual bool
    has_single_factors() const
    {
      return false;
    }
    /// Factorize the matrix of the last numeric() again, and from now on all of
    /// its pattern, in double precision.
    virtual void
    use_double(const std::string &why)
    {
      (void)why;
    }

    virtual LinearSolverMemory
    memory() const
    {
      return LinearSolverMemory();
    }
    /// Known of the pattern of the last symbolic().
    virtual void
    remember(const LinearSolverMemory &)
    {}

    bool         is_direct    = true;
    unsigned int n_iterations = 0; ///< of the last solve()
    std::vector<dealii::Vector<double>> near_null_space;
    unsigned int                        n_components = 1;
  };

  std::unique_ptr<LinearSolver::Backend>
  make_mumps_backend(const LinearSolverParameters &parameters,
                     const Ranks                  &ranks);
  /// Fronts for small matrices, else MUMPS.
  std::unique_ptr<LinearSolver::Backend>
  make_direct_backend(const LinearSolverParameters &parameters,
                      const Ranks                  &ranks);
  std::unique_ptr<LinearSolver::Backend>
  make_umfpack_backend();
  /// GMRES with an incomplete factorization.
  std::unique_ptr<LinearSolver::Backend>
  make_ilu_backend(const LinearSolverParameters &parameters);
  /// GMRES with smoothed aggregation.
  std::unique_ptr<LinearSolver::Backend>
  make_ml_backend(const LinearSolverParameters &parameters);

  /// What a message on a singular matrix ends with.
  inline const std::string singular_hint =
    " Often a body that nothing holds: no contact yet, a missing support, or "
    "a macro unknown without stiffness.";

  inline bool
  is_finite(const dealii::Vector<double> &x)
  {
    // Sums of NaN and infinities do not become finite again.
    double sum = 0;
    for (const double value : x)
      sum += std::abs(value);
    return std::isfinite(sum);
  }
} // namespace NPT

#endif
