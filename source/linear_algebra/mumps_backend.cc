// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS behind LinearSolver.

#include <npt_dealii/base/available_memory.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/elimination_order.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>
#include <npt_dealii/linear_algebra/matrix_symmetry.h>

#include <deal.II/base/config.h>

#include <dmumps_c.h>
#include <mpi.h>

#include <algorithm>
#include <exception>
#include <sstream>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    /**
     * One instance of MUMPS: L U for a general matrix, or L D L^T without
     * pivoting for a positive definite one. It reads our index arrays and
     * values; nothing is converted in between.
     */
    class MUMPSInstance
    {
    public:
      enum class Kind
      {
        general,
        positive_definite
      };

      MUMPSInstance(const Kind   kind_of_matrix,
                    const double maximum_gigabytes,
                    const Ranks &ranks_of_run)
        : kind(kind_of_matrix)
        , maximum_memory(maximum_gigabytes)
        , ranks(ranks_of_run)
        // Without pivoting the analysis knows the memory.
        , extra_memory(kind == Kind::positive_definite && ranks.is_alone() ? 5 :
                                                                             35)
      {
        data.comm_fortran = MPI_Comm_c2f(ranks.communicator());
        data.par          = 1;
        data.sym          = kind == Kind::general ? 0 : 1;
        call(-1);
        for (const int stream : {1, 2, 3})
          control(stream) = -1;
        control(4) = 0;
        // No column permutation from the values: those of a later step differ.
        control(6) = 0;
        // No scaling: entries of all unknowns are stiffnesses of one size, and
        // what a penalty adds is too local to gain from it.
        control(8) = 0;
        // The root is factorized like the rest: the sign of each pivot counts.
        control(13) = 1;
        // Each process has entries of its own; those of one place are added.
        if (!ranks.is_alone())
          control(18) = 3;
      }

      // Collective: of several processes, one that an error ends alone would
      // wait here for the others, and say nothing.
      ~MUMPSInstance()
      {
        if (ranks.is_alone() || std::uncaught_exceptions() == 0)
          call(-2);
      }

      MUMPSInstance(const MUMPSInstance &) = delete;
      MUMPSInstance &
      operator=(const MUMPSInstance &) = delete;

      /// The symbolic factorization; the arrays must stay where they are.
      void
      analyze(const int         n,
              std::vector<int> &rows,
              std::vector<int> &columns,
              std::vector<int> &order)
      {
        data.n = n;
        if (ranks.is_alone())
          {
            data.nnz = rows.size();
            data.irn = rows.data();
            data.jcn = columns.data();
          }
        else
          {
            data.nnz_loc = rows.size();
            data.irn_loc = rows.data();
            data.jcn_loc = columns.data();
          }
#ifdef DEAL_II_WITH_METIS
        control(7) = 1;
        if (ranks.is_first())
          data.perm_in = order.data();
#else
        (void)order;
#endif
        analyze();
      }

      /// Of the factors and the workspace, on all processes, as the analysis
      /// foresees.
      double
      gigabytes() const
      {
        return 1e-3 * data.infog[is_on_disk ? 26 : 16];
      }

      /// Whether the factors are files (in $MUMPS_OOC_TMPDIR, /tmp), because
      /// they do not fit in the memory.
      bool
      has_factors_on_disk() const
      {
        return is_on_disk;
      }

      /// Return whether the matrix was factorized; a singular one, and one
      /// that is not positive definite for that kind, is not.
      bool
      factorize(std::vector<double> &values)
      {
        // Pivoting may need more memory than the analysis foresaw (-8, -9);
        // then more is granted once and for all.
        for (;;)
          {
            (ranks.is_alone() ? data.a : data.a_loc) = values.data();
            call(2);
            const int error = data.infog[0];
            if ((error == -8 || error == -9) && extra_memory < 1000)
              {
                extra_memory *= 3;
                analyze();
              }
            else
              break;
          }
        const int error = data.infog[0];
        if (error == -10)
          return false;
        check("factorization");
        return kind == Kind::general || data.infog[11] == 0;
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x)
      {
        x        = rhs;
        data.rhs = x.begin();
        call(3);
        check("solution");
        ranks.broadcast(x);
      }

    private:
      void
      analyze()
      {
        control(14) = extra_memory;
        call(1);
        check("analysis");
        // Asked before MUMPS takes it: a machine that has promised more than it
        // has ends processes.
        const double available =
          maximum_memory > 0 ? maximum_memory : available_gigabytes();
        const auto fits = [&](const int megabytes) {
          return ranks.all(ranks.n_on_machine() * 1e-3 * megabytes <=
                           available);
        };
        is_on_disk  = !fits(data.infog[15]);
        control(22) = is_on_disk ? 1 : 0;
        if (is_on_disk && !fits(data.infog[25]))
          {
            std::ostringstream detail;
            detail.precision(2);
            detail << "MUMPS would need "
                   << ranks.n_on_machine() * 1e-3 * data.infog[25]
                   << " GB even with its factors on disk, and " << available
                   << (maximum_memory > 0 ? " GB are allowed" :
                                            " GB are available");
            throw OutOfMemory(detail.str());
          }
      }

      int &
      control(const int number)
      {
        return data.icntl[number - 1];
      }

      void
      call(const int job)
      {
        data.job = job;
        dmumps_c(&data);
      }

      void
      check(const std::string &phase) const
      {
        const int error = data.infog[0];
        if (error == -90)
          throw OutOfMemory(
            "MUMPS cannot keep its factors on the disk in the " + phase +
            ": is the folder $MUMPS_OOC_TMPDIR, else "
            "/tmp, full or not there?");
        if (error == -5 || error == -7 || error == -8 || error == -9 ||
            error == -13 || error == -19 || error == -20)
          throw OutOfMemory("MUMPS ran out of memory in the " + phase +
                            " (INFOG(1) = " + std::to_string(error) + ").");
        if (error < 0)
          throw LinearSolverFailed(
            "MUMPS stopped in the " + phase + " with INFOG(1:2) = " +
            std::to_string(error) + ", " + std::to_string(data.infog[1]) + ".");
      }

      const Kind     kind;
      const double   maximum_memory; // GB
      const Ranks    ranks;
      DMUMPS_STRUC_C data = {};
      int            extra_memory; // per cent
      bool           is_on_disk = false;
    };



    /**
     * A matrix that is symmetric and positive definite (no friction, or all
     * points stick) is factorized as L D L^T, at half the operations and
     * without pivoting, which is stable then; every other one as L U. Which
     * of the two is decided by the values, each time.
     */
    class MUMPSBackend : public LinearSolver::Backend
    {
    public:
      MUMPSBackend(const double maximum_gigabytes, const Ranks &ranks_of_run)
        : maximum_memory(maximum_gigabytes)
        , ranks(ranks_of_run)
      {}

      void
      symbolic(const CSRMatrix &A) override
      {
        for (Part *part : {&general, &lower})
          *part = Part();
        matrix                  = A;
        const bool has_symmetry = has_symmetric_pattern(A);
        try_positive_definite   = ranks.all(has_symmetry) && !told_indefinite;
        found_indefinite        = told_indefinite;
        told_indefinite         = false;
        order                   = nested_dissection(A, has_symmetry, ranks);
      }

      void
      numeric(const CSRMatrix &A) override
      {
        matrix.values = A.values;
        if (try_positive_definite && ranks.all(has_symmetric_values(matrix)))
          {
            if (!lower.mumps)
              set_up(lower, MUMPSInstance::Kind::positive_definite);
            std::size_t k = 0;
            for_each_entry(true, [&](const int, const int at) {
              lower.values[k++] = matrix.values[at];
            });
            if (lower.mumps->factorize(lower.values))
              {
                in_use = lower.mumps.get();
                return;
              }
            // The next ones will be indefinite as well.
            try_positive_definite = false;
            found_indefinite      = true;
            lower                 = Part();
          }
        if (!general.mumps)
          set_up(general, MUMPSInstance::Kind::general);
        if (!general.mumps->factorize(matrix.values))
          throw LinearSolverFailed("MUMPS: the matrix of size " +
                                   std::to_string(A.n()) + " is singular." +
                                   singular_hint);
        in_use = general.mumps.get();
      }

      void
      solve(const Vector<double> &rhs, Vector<double> &x) override
      {
        in_use->solve(rhs, x);
      }

      void
      vmult(Vector<double> &y, const Vector<double> &x) const override
      {
        matrix.vmult(y, x);
        ranks.sum(y);
      }

      double
      gigabytes() const override
      {
        return in_use == nullptr ? 0 : in_use->gigabytes();
      }

      bool
      has_factors_on_disk() const override
      {
        return in_use != nullptr && in_use->has_factors_on_disk();
      }

      bool
      expects_indefinite() const override
      {
        return found_indefinite;
      }

      void
      expect_indefinite() override
      {
        told_indefinite = true;
      }

    private:
      // What MUMPS reads; made when it is needed for the first time.
      struct Part
      {
        std::vector<int>               rows, columns; // from 1
        std::vector<double>            values;        // of the lower triangle
        std::unique_ptr<MUMPSInstance> mumps;
      };

      // visit(row, position) for all entries, or those of the lower triangle.
      template <typename Visitor>
      void
      for_each_entry(const bool lower_only, const Visitor &visit) const
      {
        for (int i = 0; i < static_cast<int>(matrix.n()); ++i)
          for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
            if (!lower_only || matrix.columns[k] <= i)
              visit(i, k);
      }

      void
      set_up(Part &part, const MUMPSInstance::Kind kind)
      {
        const bool  lower_only = kind == MUMPSInstance::Kind::positive_definite;
        std::size_t n_entries  = 0;
        for_each_entry(lower_only, [&](const int, const int) { ++n_entries; });
        part.rows.reserve(n_entries);
        part.columns.reserve(n_entries);
        for_each_entry(lower_only, [&](const int row, const int at) {
          part.rows.push_back(row + 1);
          part.columns.push_back(matrix.columns[at] + 1);
        });
        if (lower_only)
          part.values.resize(n_entries);
        part.mumps =
          std::make_unique<MUMPSInstance>(kind, maximum_memory, ranks);
        part.mumps->analyze(matrix.n(), part.rows, part.columns, order);
      }

      const double     maximum_memory; // GB; 0: what is available
      const Ranks      ranks;
      CSRMatrix        matrix;
      std::vector<int> order;
      Part             general, lower;
      MUMPSInstance   *in_use                = nullptr;
      bool             try_positive_definite = true;
      bool             found_indefinite      = false;
      bool             told_indefinite       = false;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_mumps_backend(const LinearSolverParameters &parameters,
                     const Ranks                  &ranks)
  {
    return std::make_unique<MUMPSBackend>(parameters.maximum_memory, ranks);
  }
} // namespace NPT
