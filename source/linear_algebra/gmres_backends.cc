// SPDX-License-Identifier: LGPL-2.1-or-later
// GMRES with two preconditioners behind LinearSolver: ILU, ML.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/trilinos_backend.h>

#include <AztecOO.h>
#include <Ifpack_ILU.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    /// GMRES; derived classes provide the preconditioner.
    class GMRESBackend : public TrilinosBackend
    {
    public:
      explicit GMRESBackend(const LinearSolverParameters &given)
        : parameters(given)
      {
        is_direct = false;
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x) override
      {
        x            = 0.;
        n_iterations = 0;
        Epetra_Vector epetra_x(View, *map, x.begin());
        Epetra_Vector epetra_rhs(View, *map, const_cast<double *>(rhs.begin()));

        AztecOO gmres(matrix.get(), &epetra_x, &epetra_rhs);
        gmres.SetAztecOption(AZ_solver, AZ_gmres);
        gmres.SetAztecOption(AZ_output, AZ_none);
        gmres.SetAztecOption(AZ_conv, AZ_rhs);
        // Restarts cost convergence, long bases cost memory.
        gmres.SetAztecOption(AZ_kspace,
                             std::min(parameters.max_iterations, 200u));
        gmres.SetPrecOperator(preconditioner());

        const double rhs_norm = rhs.l2_norm();
        if (rhs_norm == 0)
          return;
        // The recursive residual may run ahead of the true one near round-off;
        // continuing from the iterate found mends that.
        Vector<double> residual(rhs.size());
        double         relative = 1;
        for (unsigned int attempt = 0;
             attempt < 3 && n_iterations < parameters.max_iterations;
             ++attempt)
          {
            const SilencedErrorStream silence;
            gmres.Iterate(parameters.max_iterations - n_iterations,
                          0.5 * parameters.tolerance);
            n_iterations += gmres.NumIters();
            if (!is_finite(x))
              return; // reported by LinearSolver
            vmult(residual, x);
            residual.sadd(-1., 1., rhs);
            relative = residual.l2_norm() / rhs_norm;
            if (relative <= parameters.tolerance || !std::isfinite(relative))
              break;
          }
        if (!(relative <= parameters.tolerance))
          {
            std::ostringstream detail;
            detail << "GMRES with " << name_of(parameters.type)
                   << " reached a relative residual of " << relative
                   << " instead of " << parameters.tolerance << " after "
                   << n_iterations << " of at most "
                   << parameters.max_iterations
                   << " iterations. Try Type = MUMPS (subsection Linear "
                      "solver).";
            throw LinearSolverFailed(detail.str());
          }
      }

    protected:
      virtual Epetra_Operator *
      preconditioner() = 0;

      const LinearSolverParameters parameters;
    };



    class ILUBackend : public GMRESBackend
    {
    public:
      using GMRESBackend::GMRESBackend;

      void
      symbolic(const CSRMatrix &A) override
      {
        TrilinosBackend::symbolic(A);
        factors = std::make_unique<Ifpack_ILU>(matrix.get());
        Teuchos::ParameterList list;
        list.set("fact: level-of-fill", 0);
        factors->SetParameters(list);
        if (factors->Initialize() != 0)
          throw LinearSolverFailed("Ifpack cannot set up ILU(0).");
      }

      void
      numeric(const CSRMatrix &A) override
      {
        copy_values(A);
        const SilencedErrorStream silence;
        if (factors->Compute() != 0)
          throw LinearSolverFailed(
            "Ifpack: zero pivot in ILU(0). Try Type = MUMPS (subsection Linear "
            "solver).");
      }

    private:
      void
      clear_solver() override
      {
        factors.reset();
      }

      Epetra_Operator *
      preconditioner() override
      {
        return factors.get();
      }

      std::unique_ptr<Ifpack_ILU> factors;
    };



    class MLBackend : public GMRESBackend
    {
    public:
      using GMRESBackend::GMRESBackend;

      void
      numeric(const CSRMatrix &A) override
      {
        copy_values(A);
        Teuchos::ParameterList list;
        ML_Epetra::SetDefaults("SA", list);
        list.set("ML output", 0);
        list.set("smoother: type", "symmetric Gauss-Seidel");
        list.set("smoother: sweeps", 2);
        list.set("coarse: type", "Amesos-KLU");
        list.set("aggregation: type", "Uncoupled");
        // Drop no coupling: a contact penalty makes the others look small.
        list.set("aggregation: threshold", 0.);
        const unsigned int components =
          A.n() % n_components == 0 ? n_components : 1;
        list.set("PDE equations", static_cast<int>(components));
        if (!near_null_space.empty())
          {
            modes.clear();
            for (const auto &mode : near_null_space)
              {
                AssertDimension(mode.size(), A.n());
                modes.insert(modes.end(), mode.begin(), mode.end());
              }
            list.set("null space: type", "pre-computed");
            list.set("null space: dimension",
                     static_cast<int>(near_null_space.size()));
            list.set("null space: vectors", modes.data());
            list.set("null space: add default vectors", false);
          }
        hierarchy.reset();
        const SilencedErrorStream silence;
        hierarchy =
          std::make_unique<ML_Epetra::MultiLevelPreconditioner>(*matrix,
                                                                list,
                                                                true);
        if (!hierarchy->IsPreconditionerComputed())
          throw LinearSolverFailed("ML cannot build its hierarchy. Try Type = "
                                   "ILU (subsection Linear solver).");
      }

    private:
      void
      clear_solver() override
      {
        hierarchy.reset();
      }

      Epetra_Operator *
      preconditioner() override
      {
        return hierarchy.get();
      }

      std::vector<double>                                  modes;
      std::unique_ptr<ML_Epetra::MultiLevelPreconditioner> hierarchy;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_ilu_backend(const LinearSolverParameters &parameters)
  {
    return std::make_unique<ILUBackend>(parameters);
  }



  std::unique_ptr<LinearSolver::Backend>
  make_ml_backend(const LinearSolverParameters &parameters)
  {
    return std::make_unique<MLBackend>(parameters);
  }
} // namespace NPT
