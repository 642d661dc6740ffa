// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS behind LinearSolver.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/elimination_order.h>
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
    // Number of unknowns from which on factors of single precision, and more
    // products with them, take less time than those of double precision.
    constexpr unsigned int single_precision_pays = 5000;

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
        order        = nested_dissection(A, has_symmetry, ranks);
        use_single   = prefers_single(A.n());
        why          = use_single ? why_single() : "";
        memory_      = LinearSolverMemory();
      }

      void
      numeric(const CSRMatrix &A) override
      {
        matrix       = &A;
        is_symmetric = has_symmetry && !memory_.is_indefinite &&
                       ranks.all(has_symmetric_values(A));
        if (use_single && !factorize(single_factors))
          use_double("as the matrix is singular in single precision");
        else if (!use_single)
          factorize_in_double();
      }

      void
      use_double(const std::string &given_why) override
      {
        clear();
        use_single           = false;
        why                  = given_why;
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
        return use_single;
      }

      std::string
      description() const override
      {
        std::ostringstream text;
        text.precision(2);
        if (!why.empty())
          text << ", factors in " << (use_single ? "single" : "double")
               << " precision, " << why;
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
        if (memory_.needs_double && use_single)
          {
            use_single = false;
            why        = "as an earlier matrix asked for it";
          }
      }

    private:
      // Made when they are needed for the first time.
      template <typename Number>
      struct Instances
      {
        std::unique_ptr<MUMPSInstance<Number>> general, positive_definite;
      };

      bool
      prefers_single(const unsigned int n) const
      {
        using Precision = LinearSolverParameters::Precision;
        return parameters.factors == Precision::single_precision ||
               (parameters.factors == Precision::automatic &&
                n >= single_precision_pays);
      }

      std::string
      why_single() const
      {
        return parameters.factors ==
                   LinearSolverParameters::Precision::single_precision ?
                 "as asked for" :
                 "as there are at least " +
                   std::to_string(single_precision_pays) + " unknowns";
      }

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
      bool                         use_single   = false;
      std::string                  why; // that precision
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
