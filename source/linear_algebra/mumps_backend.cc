// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS behind LinearSolver.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/elimination_order.h>
#include <npt_dealii/linear_algebra/factor_precision.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>
#include <npt_dealii/linear_algebra/matrix_symmetry.h>
#include <npt_dealii/linear_algebra/mumps_factors.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    /**
     * A matrix that is symmetric and positive definite (no friction, or all
     * points stick) is factorized as L D L^T, at half the operations and
     * without pivoting, which is stable then; every other one as L U. Which
     * of the two is decided by the values, each time.
     *
     * Factors are of single precision if that was asked for, until they are
     * found not to do for a matrix; then they are of double precision for all
     * that have its pattern.
     */
    class MUMPSBackend : public LinearSolver::Backend
    {
    public:
      MUMPSBackend(const LinearSolverParameters &given,
                   const Ranks                  &ranks_of_run)
        : parameters(given)
        , ranks(ranks_of_run)
      {}

      void
      symbolic(const CSRMatrix &A) override
      {
        clear();
        matrix       = &A;
        has_symmetry = ranks.all(has_symmetric_pattern(A));
        set_order(A);
        precision = FactorPrecision(parameters.factors, A.n());
        memory_   = LinearSolverMemory();
      }

      void
      numeric(const CSRMatrix &A) override
      {
        matrix       = &A;
        is_symmetric = has_symmetry && !memory_.is_indefinite &&
                       ranks.all(has_symmetric_values(A));
        if (!precision.is_single())
          factorize_in_double();
        else if (!factorize(single_factors))
          use_double("as the matrix is singular in single precision");
      }

      void
      use_double(const std::string &why) override
      {
        clear();
        precision.use_double(why);
        memory_.needs_double = true;
        // Single precision may have lost the sign of a pivot.
        memory_.is_indefinite = false;
        is_symmetric = has_symmetry && ranks.all(has_symmetric_values(*matrix));
        factorize_in_double();
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x) override
      {
        in_use->solve(rhs, x);
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

      bool
      has_single_factors() const override
      {
        return precision.is_single();
      }

      std::string
      description() const override
      {
        std::ostringstream text;
        text.precision(2);
        text << precision.description();
        if (in_use != nullptr)
          text << ", memory of " << in_use->gigabytes() << " GB";
        if (in_use != nullptr && in_use->are_on_disk())
          text << ", factors on disk, since they do not fit in the memory";
        return text.str();
      }

      LinearSolverMemory
      memory() const override
      {
        return memory_;
      }

      void
      remember(const LinearSolverMemory &memory) override
      {
        memory_ = memory;
        if (memory_.needs_double && precision.is_single())
          precision.use_double("as an earlier matrix asked for it");
      }

    private:
      // The first process tells MUMPS.
      void
      set_order(const CSRMatrix &A)
      {
        order.clear();
        const BlockPattern blocks = make_block_pattern(A, ranks);
        if (!ranks.is_first())
          return;
        const std::vector<int> order_of_blocks = nested_dissection(blocks);
        if (!order_of_blocks.empty())
          order = order_of_unknowns(blocks, order_of_blocks);
      }

      // Made when they are needed for the first time.
      template <typename Number>
      struct Instances
      {
        std::unique_ptr<MUMPSInstance<Number>> general, positive_definite;
      };

      void
      clear()
      {
        in_use         = nullptr;
        double_factors = Instances<double>();
        single_factors = Instances<float>();
      }

      void
      factorize_in_double()
      {
        if (!factorize(double_factors))
          throw LinearSolverFailed("MUMPS: the matrix of size " +
                                   std::to_string(matrix->n()) +
                                   " is singular." + singular_hint);
      }

      template <typename Number>
      bool
      factorize(Instances<Number> &instances)
      {
        using Kind = typename MUMPSInstance<Number>::Kind;
        if (is_symmetric && !memory_.is_indefinite)
          {
            if (factorize(instances.positive_definite, Kind::positive_definite))
              return true;
            // The next ones will be indefinite as well.
            memory_.is_indefinite = true;
            instances.positive_definite.reset();
          }
        return factorize(instances.general, Kind::general);
      }

      template <typename Number>
      bool
      factorize(std::unique_ptr<MUMPSInstance<Number>>    &instance,
                const typename MUMPSInstance<Number>::Kind kind)
      {
        if (!instance)
          {
            instance =
              std::make_unique<MUMPSInstance<Number>>(kind,
                                                      parameters.maximum_memory,
                                                      ranks);
            instance->analyze(*matrix, order);
          }
        in_use = instance.get();
        return instance->factorize(*matrix);
      }

      const LinearSolverParameters parameters;
      const Ranks                  ranks;
      const CSRMatrix             *matrix = nullptr;
      std::vector<int>             order;
      Instances<double>            double_factors;
      Instances<float>             single_factors;
      MUMPSFactors                *in_use       = nullptr;
      bool                         has_symmetry = false; // the pattern
      bool                         is_symmetric = false; // the values, too
      FactorPrecision              precision;
      LinearSolverMemory           memory_;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_mumps_backend(const LinearSolverParameters &parameters,
                     const Ranks                  &ranks)
  {
    return std::make_unique<MUMPSBackend>(parameters, ranks);
  }
} // namespace NPT
