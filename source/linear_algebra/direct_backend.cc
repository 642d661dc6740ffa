// SPDX-License-Identifier: LGPL-2.1-or-later
// The direct solver that the program chooses: fronts or MUMPS.

#include <npt_dealii/linear_algebra/elimination_order.h>
#include <npt_dealii/linear_algebra/fronts.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>
#include <npt_dealii/linear_algebra/matrix_symmetry.h>

#include <memory>
#include <sstream>
#include <string>

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
     * there is a limit of the memory or factors of single precision are asked
     * for, which it alone obeys.
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
        uses_fronts = false;
        memory_     = LinearSolverMemory();
        is_small    = ranks.is_alone() && A.n() <= most_unknowns_of_fronts &&
                   parameters.maximum_memory == 0 &&
                   parameters.factors !=
                     LinearSolverParameters::Precision::single_precision;
        if (!is_small)
          {
            set_up_mumps(A);
            return;
          }
        matrix       = &A;
        has_symmetry = has_symmetric_pattern(A);
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
        matrix      = &A;
        uses_fronts = factorize_fronts();
        if (uses_fronts)
          return;
        if (!mumps)
          {
            set_up_mumps(A);
            // L U at once, whatever was found before.
            LinearSolverMemory general;
            general.is_indefinite = true;
            mumps->remember(general);
          }
        mumps->numeric(A);
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
          matrix->vmult(y, x);
        else
          mumps->vmult(y, x);
      }

      void
      vmult_absolute(Vector<double> &y, const Vector<double> &x) const override
      {
        if (uses_fronts)
          matrix->vmult_absolute(y, x);
        else
          mumps->vmult_absolute(y, x);
      }

      std::string
      name() const override
      {
        return uses_fronts ? "fronts" : "MUMPS";
      }

      std::string
      description() const override
      {
        if (!uses_fronts)
          return mumps ? mumps->description() : "";
        std::ostringstream text;
        text.precision(2);
        text << ", memory of " << fronts.gigabytes() << " GB";
        return text.str();
      }

      bool
      has_single_factors() const override
      {
        return !uses_fronts && mumps && mumps->has_single_factors();
      }

      void
      use_double(const std::string &why) override
      {
        mumps->use_double(why);
      }

      LinearSolverMemory
      memory() const override
      {
        return is_small || !mumps ? memory_ : mumps->memory();
      }

      void
      remember(const LinearSolverMemory &memory) override
      {
        if (is_small)
          memory_ = memory;
        else
          mumps->remember(memory);
      }

    private:
      void
      set_up_mumps(const CSRMatrix &A)
      {
        mumps = make_mumps_backend(parameters, ranks);
        mumps->symbolic(A);
      }

      bool
      factorize_fronts()
      {
        if (has_symmetry && !memory_.is_indefinite &&
            has_symmetric_values(*matrix))
          {
            if (fronts.factorize_positive_definite(matrix->values))
              return true;
            // The next ones will be indefinite as well.
            memory_.is_indefinite = true;
          }
        return fronts.factorize_general(matrix->values);
      }

      const LinearSolverParameters parameters;
      const Ranks                  ranks;
      bool                         is_small = false;
      const CSRMatrix             *matrix   = nullptr; // a small one
      Fronts                       fronts;
      std::unique_ptr<Backend>     mumps; // where it is needed
      bool                         uses_fronts  = false;
      bool                         has_symmetry = false; // the pattern
      LinearSolverMemory           memory_;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_direct_backend(const LinearSolverParameters &parameters,
                      const Ranks                  &ranks)
  {
    return std::make_unique<DirectBackend>(parameters, ranks);
  }
} // namespace NPT
