// SPDX-License-Identifier: LGPL-2.1-or-later
// The direct solver that the program chooses: fronts or MUMPS.

#include <npt_dealii/base/available_memory.h>
#include <npt_dealii/linear_algebra/elimination_order.h>
#include <npt_dealii/linear_algebra/factor_precision.h>
#include <npt_dealii/linear_algebra/fronts.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>
#include <npt_dealii/linear_algebra/matrix_symmetry.h>

#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    // Measured on woven cells, see doc/performance.md.
    constexpr unsigned int most_unknowns_of_fronts = 30000;

    /**
     * Matrices of some thousand unknowns are factorized by Fronts, as L L^T if
     * they are symmetric and positive definite, else as L U; which of the two
     * is decided by the values, each time. MUMPS takes larger ones, those that
     * need more memory than there is, and all where there is a limit of the
     * memory, which it alone obeys.
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
        clear();
        tree.reset();
        matrix    = &A;
        memory_   = LinearSolverMemory();
        precision = FactorPrecision(parameters.factors, A.n());
        if (A.n() <= most_unknowns_of_fronts && parameters.maximum_memory == 0)
          make_tree();
        if (!tree)
          set_up_mumps();
      }

      void
      numeric(const CSRMatrix &A) override
      {
        matrix = &A;
        if (tree)
          factorize();
        else
          mumps->numeric(A);
      }

      void
      use_double(const std::string &why) override
      {
        if (!uses_fronts)
          {
            mumps->use_double(why);
            return;
          }
        change_to_double(why);
        factorize();
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
        if (precision.is_single())
          single_fronts->solve(x);
        else
          double_fronts->solve(x);
      }

      void
      vmult(Vector<double> &y, const Vector<double> &x) const override
      {
        matrix->vmult(y, x);
        ranks.sum(y);
      }

      void
      vmult_absolute(Vector<double> &y, const Vector<double> &x) const override
      {
        matrix->vmult_absolute(y, x);
        ranks.sum(y);
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
        text << precision.description() << ", memory of " << gigabytes()
             << " GB";
        return text.str();
      }

      bool
      has_single_factors() const override
      {
        return uses_fronts ? precision.is_single() :
                             mumps && mumps->has_single_factors();
      }

      LinearSolverMemory
      memory() const override
      {
        return tree || !mumps ? memory_ : mumps->memory();
      }

      void
      remember(const LinearSolverMemory &memory) override
      {
        if (!tree)
          {
            mumps->remember(memory);
            return;
          }
        if (memory.needs_double && precision.is_single())
          change_to_double("as an earlier matrix asked for it");
        memory_ = memory;
      }

    private:
      void
      clear()
      {
        mumps.reset();
        double_fronts.reset();
        single_fronts.reset();
        uses_fronts = false;
      }

      // Unless the fronts do not fit in the memory.
      void
      make_tree()
      {
        has_symmetry               = ranks.all(has_symmetric_pattern(*matrix));
        const BlockPattern pattern = make_block_pattern(*matrix, ranks);
        // Everyone computes the same.
        const auto new_tree = std::make_shared<FrontTree>(
          make_front_tree(pattern, nested_dissection(pattern)));
        deal_out(*new_tree, ranks.n());
        tree = new_tree;
        if (!ranks.all(gigabytes() * ranks.n_on_machine() <=
                       available_gigabytes()))
          tree.reset();
      }

      double
      gigabytes() const
      {
        return precision.is_single() ? Fronts<float>::gigabytes(*tree, ranks) :
                                       Fronts<double>::gigabytes(*tree, ranks);
      }

      void
      set_up_mumps()
      {
        mumps = make_mumps_backend(parameters, ranks);
        mumps->symbolic(*matrix);
      }

      void
      change_to_double(const std::string &why)
      {
        single_fronts.reset();
        precision.use_double(why);
        memory_.needs_double = true;
        // Single precision may have lost the sign of a pivot.
        memory_.is_indefinite = false;
      }

      void
      factorize()
      {
        uses_fronts = true;
        if (precision.is_single())
          {
            if (factorize(single_fronts))
              return;
            change_to_double("as the matrix is singular in single precision");
          }
        if (factorize(double_fronts))
          return;
        uses_fronts = false;
        if (!mumps)
          {
            set_up_mumps();
            // L U at once, whatever was found before.
            LinearSolverMemory general = memory_;
            general.is_indefinite      = true;
            mumps->remember(general);
          }
        mumps->numeric(*matrix);
      }

      template <typename Number>
      bool
      factorize(std::unique_ptr<Fronts<Number>> &fronts)
      {
        if (!fronts)
          fronts = std::make_unique<Fronts<Number>>(*matrix, tree, ranks);
        if (has_symmetry && !memory_.is_indefinite &&
            ranks.all(has_symmetric_values(*matrix)))
          {
            if (fronts->factorize_positive_definite(matrix->values))
              return true;
            // The next ones will be indefinite as well.
            memory_.is_indefinite = true;
          }
        return fronts->factorize_general(matrix->values);
      }

      const LinearSolverParameters     parameters;
      const Ranks                      ranks;
      const CSRMatrix                 *matrix = nullptr;
      std::shared_ptr<const FrontTree> tree; // none: MUMPS works
      // Made when they are needed for the first time.
      std::unique_ptr<Fronts<double>> double_fronts;
      std::unique_ptr<Fronts<float>>  single_fronts;
      std::unique_ptr<Backend>        mumps;
      FactorPrecision                 precision;
      bool                            uses_fronts  = false;
      bool                            has_symmetry = false; // the pattern
      LinearSolverMemory              memory_;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_direct_backend(const LinearSolverParameters &parameters,
                      const Ranks                  &ranks)
  {
    return std::make_unique<DirectBackend>(parameters, ranks);
  }
} // namespace NPT
