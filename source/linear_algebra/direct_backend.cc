// SPDX-License-Identifier: LGPL-2.1-or-later
// The direct solver that the program chooses: fronts or MUMPS.

#include <npt_dealii/linear_algebra/elimination_order.h>
#include <npt_dealii/linear_algebra/fronts.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>
#include <npt_dealii/linear_algebra/matrix_symmetry.h>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    // Measured on woven cells, see doc/performance.md.
    constexpr unsigned int most_unknowns_of_fronts = 4000;

    /**
     * Small matrices on one process are factorized by Fronts, as L L^T if they
     * are symmetric and positive definite, else as L U; which of the two is
     * decided by the values, each time. MUMPS takes larger ones, and all where
     * there is a limit of the memory, which it alone obeys.
     *
     * It also takes a matrix whose pivots are too small for Fronts. That is
     * decided for each matrix alone, so that a run that is continued does what
     * the run would have done that was not stopped.
     */
    class DirectBackend : public LinearSolver::Backend
    {
    public:
      DirectBackend(const LinearSolverParameters &parameters_of_mumps,
                    const Ranks                  &ranks_of_run)
        : parameters(parameters_of_mumps)
        , ranks(ranks_of_run)
      {}

      void
      symbolic(const CSRMatrix &A) override
      {
        mumps.reset();
        uses_fronts           = false;
        const bool indefinite = told_indefinite;
        told_indefinite       = false;
        found_indefinite      = indefinite;
        is_small = ranks.is_alone() && A.n() <= most_unknowns_of_fronts &&
                   parameters.maximum_memory == 0;
        if (!is_small)
          {
            set_up_mumps(A, indefinite);
            return;
          }
        matrix                  = A;
        const bool has_symmetry = has_symmetric_pattern(A);
        try_positive_definite   = has_symmetry && !indefinite;
        fronts.analyze(A, nested_dissection(A, has_symmetry, ranks));
      }

      void
      numeric(const CSRMatrix &A) override
      {
        if (!is_small)
          {
            mumps->numeric(A);
            return;
          }
        matrix.values = A.values;
        uses_fronts   = factorize_fronts();
        if (uses_fronts)
          return;
        if (!mumps)
          // L U at once, whatever was found before.
          set_up_mumps(matrix, true);
        mumps->numeric(matrix);
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x) override
      {
        if (!uses_fronts)
          {
            mumps->solve(rhs, x);
            return;
          }
        x = rhs;
        fronts.solve(x);
      }

      void
      vmult(Vector<double> &y, const Vector<double> &x) const override
      {
        if (uses_fronts)
          matrix.vmult(y, x);
        else
          mumps->vmult(y, x);
      }

      std::string
      name() const override
      {
        return uses_fronts ? "fronts" : "MUMPS";
      }

      double
      gigabytes() const override
      {
        return uses_fronts ? fronts.gigabytes() :
               mumps       ? mumps->gigabytes() :
                             0;
      }

      bool
      has_factors_on_disk() const override
      {
        return !uses_fronts && mumps && mumps->has_factors_on_disk();
      }

      bool
      expects_indefinite() const override
      {
        return is_small || !mumps ? found_indefinite :
                                    mumps->expects_indefinite();
      }

      void
      expect_indefinite() override
      {
        told_indefinite = true;
      }

    private:
      void
      set_up_mumps(const CSRMatrix &A, const bool indefinite)
      {
        mumps = make_mumps_backend(parameters, ranks);
        if (indefinite)
          mumps->expect_indefinite();
        mumps->symbolic(A);
      }

      bool
      factorize_fronts()
      {
        if (try_positive_definite && has_symmetric_values(matrix))
          {
            if (fronts.factorize_positive_definite(matrix.values))
              return true;
            // The next ones will be indefinite as well.
            try_positive_definite = false;
            found_indefinite      = true;
          }
        return fronts.factorize_general(matrix.values);
      }

      const LinearSolverParameters parameters;
      const Ranks                  ranks;
      bool                         is_small = false;
      CSRMatrix                    matrix; // a small one
      Fronts                       fronts;
      std::unique_ptr<Backend>     mumps; // where it is needed
      bool                         uses_fronts           = false;
      bool                         try_positive_definite = true;
      bool                         found_indefinite      = false;
      bool                         told_indefinite       = false;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_direct_backend(const LinearSolverParameters &parameters,
                      const Ranks                  &ranks)
  {
    return std::make_unique<DirectBackend>(parameters, ranks);
  }
} // namespace NPT
