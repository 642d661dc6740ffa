// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS behind LinearSolver, with the order of elimination that METIS finds.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/trilinos_backend.h>

#include <deal.II/base/config.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Amesos_Mumps.h>
#include <Teuchos_ParameterList.hpp>
#ifdef DEAL_II_WITH_METIS
#  include <metis.h>
#endif

#include <algorithm>
#include <iterator>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    /**
     * Return the position (from 1) of each unknown in the order of
     * elimination. Debian's MUMPS knows no nested dissection of its own, which
     * saves 15 to 34 % of the operations on elastic boxes of 1,452 to 15,360
     * unknowns (quadratic B-splines).
     */
    std::vector<int>
    nested_dissection(const CSRMatrix &A)
    {
#ifdef DEAL_II_WITH_METIS
      // METIS wants the graph of A + A^T without its diagonal.
      idx_t                         n = A.n();
      std::vector<std::vector<int>> transposed(n);
      for (int i = 0; i < n; ++i)
        for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          transposed[A.columns[k]].push_back(i);

      std::vector<idx_t> start(1, 0), neighbors;
      neighbors.reserve(A.n_nonzeros());
      std::vector<int> row;
      for (int i = 0; i < n; ++i)
        {
          row.clear();
          std::set_union(A.columns.begin() + A.row_start[i],
                         A.columns.begin() + A.row_start[i + 1],
                         transposed[i].begin(),
                         transposed[i].end(),
                         std::back_inserter(row));
          for (const int j : row)
            if (j != i)
              neighbors.push_back(j);
          start.push_back(neighbors.size());
        }

      std::vector<idx_t> order(n), position(n);
      const int          status = METIS_NodeND(&n,
                                      start.data(),
                                      neighbors.data(),
                                      nullptr,
                                      nullptr,
                                      order.data(),
                                      position.data());
      AssertThrow(status == METIS_OK,
                  dealii::ExcMessage("METIS cannot order the matrix."));
      for (auto &p : position)
        ++p;
      return {position.begin(), position.end()};
#else
      (void)A;
      return {};
#endif
    }



    class MUMPSBackend : public TrilinosBackend
    {
    public:
      void
      symbolic(const CSRMatrix &A) override
      {
        TrilinosBackend::symbolic(A);
        ordering = nested_dissection(A);
        analyze();
      }

      void
      numeric(const CSRMatrix &A) override
      {
        copy_values(A);
        int status = 0;
        // Pivoting may need more memory than the analysis foresaw (-8, -9);
        // then more is granted once and for all.
        for (;;)
          {
            {
              const SilencedErrorStream silence;
              status = solver->NumericFactorization();
            }
            const int error = mumps().GetINFOG()[0];
            if ((error == -8 || error == -9) && extra_memory < 1000)
              {
                extra_memory *= 3;
                analyze();
              }
            else
              break;
          }
        check(status, "factorization");
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x) override
      {
        Epetra_Vector epetra_x(View, *map, x.begin());
        Epetra_Vector epetra_rhs(View, *map, const_cast<double *>(rhs.begin()));
        problem.SetLHS(&epetra_x);
        problem.SetRHS(&epetra_rhs);
        int status = 0;
        {
          const SilencedErrorStream silence;
          status = solver->Solve();
        }
        problem.SetLHS(nullptr);
        problem.SetRHS(nullptr);
        check(status, "solution");
      }

    private:
      Amesos_Mumps &
      mumps() const
      {
        return dynamic_cast<Amesos_Mumps &>(*solver);
      }

      void
      clear_solver() override
      {
        solver.reset();
      }

      void
      analyze()
      {
        solver.reset(Amesos().Create("Amesos_Mumps", problem));
        if (!solver)
          throw InputError("Type = MUMPS is not available because Trilinos was "
                           "built without it; choose UMFPACK (subsection "
                           "Linear solver).");
        Teuchos::ParameterList list;
        list.set("PrintTiming", false);
        list.set("PrintStatus", false);
        list.set("OutputLevel", 0);
        list.set("DebugLevel", 0);
        solver->SetParameters(list);
        for (const int stream : {1, 2, 3})
          mumps().SetICNTL(stream, -1);
        mumps().SetICNTL(4, 0);
        // No column permutation from the values: those of a later step differ.
        mumps().SetICNTL(6, 0);
        mumps().SetICNTL(14, extra_memory);
#ifdef DEAL_II_WITH_METIS
        mumps().SetICNTL(7, 1);
        mumps().SetOrdering(ordering.data());
#endif
        int status = 0;
        {
          const SilencedErrorStream silence;
          status = solver->SymbolicFactorization();
        }
        check(status, "analysis");
      }

      void
      check(const int status, const std::string &phase) const
      {
        const int *infog = mumps().GetINFOG();
        if (infog[0] == -10)
          throw LinearSolverFailed("MUMPS: the matrix of size " +
                                   std::to_string(map->NumMyElements()) +
                                   " is singular." + singular_hint);
        if (infog[0] == -5 || infog[0] == -7 || infog[0] == -8 ||
            infog[0] == -9 || infog[0] == -13)
          throw OutOfMemory("MUMPS ran out of memory in the " + phase +
                            " (INFOG(1) = " + std::to_string(infog[0]) + ").");
        if (infog[0] < 0 || status < 0)
          throw LinearSolverFailed(
            "MUMPS stopped in the " + phase + " with INFOG(1:2) = " +
            std::to_string(infog[0]) + ", " + std::to_string(infog[1]) + ".");
      }

      std::unique_ptr<Amesos_BaseSolver> solver;
      std::vector<int>                   ordering;
      int                                extra_memory = 35; // per cent
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_mumps_backend()
  {
    return std::make_unique<MUMPSBackend>();
  }
} // namespace NPT
