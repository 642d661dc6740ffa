// SPDX-License-Identifier: LGPL-2.1-or-later
// UMFPACK behind LinearSolver.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>

#include <umfpack.h>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    /// UMFPACK, called directly because deal.II's class redoes the symbolic
    /// factorization every time.
    class UMFPACKBackend : public LinearSolver::Backend
    {
    public:
      UMFPACKBackend()
      {
        umfpack_di_defaults(control);
        // Refinement is done by LinearSolver, the same for all direct solvers.
        control[UMFPACK_IRSTEP] = 0;
      }

      ~UMFPACKBackend() override
      {
        umfpack_di_free_symbolic(&symbolic_factors);
        umfpack_di_free_numeric(&numeric_factors);
      }

      void
      symbolic(const CSRMatrix &A) override
      {
        umfpack_di_free_symbolic(&symbolic_factors);
        const int n      = A.n();
        const int status = umfpack_di_symbolic(n,
                                               n,
                                               A.row_start.data(),
                                               A.columns.data(),
                                               A.values.data(),
                                               &symbolic_factors,
                                               control,
                                               info);
        check(status, "analysis");
      }

      void
      numeric(const CSRMatrix &A) override
      {
        matrix = A;
        umfpack_di_free_numeric(&numeric_factors);
        const int status = umfpack_di_numeric(matrix.row_start.data(),
                                              matrix.columns.data(),
                                              matrix.values.data(),
                                              symbolic_factors,
                                              &numeric_factors,
                                              control,
                                              info);
        check(status, "factorization");
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x) override
      {
        // UMFPACK reads our rows as columns, hence the transposed system.
        const int status = umfpack_di_solve(UMFPACK_At,
                                            matrix.row_start.data(),
                                            matrix.columns.data(),
                                            matrix.values.data(),
                                            x.begin(),
                                            rhs.begin(),
                                            numeric_factors,
                                            control,
                                            info);
        check(status, "solution");
      }

      void
      vmult(Vector<double> &y, const Vector<double> &x) const override
      {
        matrix.vmult(y, x);
      }

    private:
      static void
      check(const int status, const std::string &phase)
      {
        if (status == UMFPACK_OK)
          return;
        if (status == UMFPACK_WARNING_singular_matrix)
          throw LinearSolverFailed("UMFPACK: the matrix is singular." +
                                   singular_hint);
        if (status == UMFPACK_ERROR_out_of_memory)
          throw OutOfMemory("UMFPACK ran out of memory in the " + phase +
                            ". MUMPS needs less.");
        throw LinearSolverFailed("UMFPACK stopped in the " + phase +
                                 " with status " + std::to_string(status) +
                                 ".");
      }

      CSRMatrix matrix;
      void     *symbolic_factors = nullptr;
      void     *numeric_factors  = nullptr;
      double    control[UMFPACK_CONTROL];
      double    info[UMFPACK_INFO];
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_umfpack_backend()
  {
    return std::make_unique<UMFPACKBackend>();
  }
} // namespace NPT
