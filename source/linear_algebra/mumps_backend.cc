// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS behind LinearSolver, with the order of elimination that METIS finds.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/linear_solver_backend.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <dmumps_c.h>
#ifdef DEAL_II_WITH_METIS
#  include <metis.h>
#endif
#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <exception>
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
     * unknowns (quadratic B-splines). Empty if deal.II has no METIS.
     *
     * @param transposed Columns of A^T by rows; METIS wants the graph of
     *   A + A^T without its diagonal.
     * @param ranks Each has a part of A; the first one gets the order, the
     *   others nothing.
     */
    std::vector<int>
    nested_dissection(const CSRMatrix                     &A,
                      const std::vector<std::vector<int>> &transposed,
                      const Ranks                         &ranks)
    {
#ifdef DEAL_II_WITH_METIS
      idx_t                         n = A.n();
      std::vector<std::vector<int>> graph(n);
      for (int i = 0; i < n; ++i)
        std::set_union(A.columns.begin() + A.row_start[i],
                       A.columns.begin() + A.row_start[i + 1],
                       transposed[i].begin(),
                       transposed[i].end(),
                       std::back_inserter(graph[i]));
      if (!ranks.is_alone())
        {
          const auto parts =
            dealii::Utilities::MPI::gather(ranks.communicator(), graph);
          if (!ranks.is_first())
            return {};
          std::vector<int> row;
          for (unsigned int p = 1; p < parts.size(); ++p)
            for (int i = 0; i < n; ++i)
              {
                row.clear();
                std::set_union(graph[i].begin(),
                               graph[i].end(),
                               parts[p][i].begin(),
                               parts[p][i].end(),
                               std::back_inserter(row));
                graph[i].swap(row);
              }
        }
      std::vector<idx_t> start(1, 0), neighbors;
      neighbors.reserve(A.n_nonzeros());
      for (int i = 0; i < n; ++i)
        {
          for (const int j : graph[i])
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
      (void)transposed;
      (void)ranks;
      return {};
#endif
    }



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

      MUMPSInstance(const Kind kind_of_matrix, const Ranks &ranks_of_run)
        : kind(kind_of_matrix)
        , ranks(ranks_of_run)
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
        if (error == -5 || error == -7 || error == -8 || error == -9 ||
            error == -13)
          throw OutOfMemory("MUMPS ran out of memory in the " + phase +
                            " (INFOG(1) = " + std::to_string(error) + ").");
        if (error < 0)
          throw LinearSolverFailed(
            "MUMPS stopped in the " + phase + " with INFOG(1:2) = " +
            std::to_string(error) + ", " + std::to_string(data.infog[1]) + ".");
      }

      const Kind     kind;
      const Ranks    ranks;
      DMUMPS_STRUC_C data         = {};
      int            extra_memory = 35; // per cent
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
      explicit MUMPSBackend(const Ranks &ranks_of_run)
        : ranks(ranks_of_run)
      {}

      void
      symbolic(const CSRMatrix &A) override
      {
        general.reset();
        positive_definite.reset();
        matrix = A;

        std::vector<std::vector<int>> columns_of_transposed(A.n());
        for (int i = 0; i < static_cast<int>(A.n()); ++i)
          for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
            columns_of_transposed[A.columns[k]].push_back(i);
        try_positive_definite =
          ranks.all(find_transposed(columns_of_transposed));
        order = nested_dissection(A, columns_of_transposed, ranks);
        rows.clear();
        columns.clear();
        lower_rows.clear();
        lower_columns.clear();
        lower.clear();
        for (int i = 0; i < static_cast<int>(A.n()); ++i)
          for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
            {
              rows.push_back(i + 1);
              columns.push_back(A.columns[k] + 1);
              if (A.columns[k] <= i)
                {
                  lower.push_back(k);
                  lower_rows.push_back(i + 1);
                  lower_columns.push_back(A.columns[k] + 1);
                }
            }
        lower_values.resize(lower.size());
      }

      void
      numeric(const CSRMatrix &A) override
      {
        matrix.values = A.values;
        if (try_positive_definite && ranks.all(is_symmetric()))
          {
            if (!positive_definite)
              {
                positive_definite = std::make_unique<MUMPSInstance>(
                  MUMPSInstance::Kind::positive_definite, ranks);
                positive_definite->analyze(A.n(),
                                           lower_rows,
                                           lower_columns,
                                           order);
              }
            for (std::size_t k = 0; k < lower.size(); ++k)
              lower_values[k] = matrix.values[lower[k]];
            if (positive_definite->factorize(lower_values))
              {
                in_use = positive_definite.get();
                return;
              }
            // The next ones will be indefinite as well.
            try_positive_definite = false;
            positive_definite.reset();
          }
        if (!general)
          {
            general =
              std::make_unique<MUMPSInstance>(MUMPSInstance::Kind::general,
                                              ranks);
            general->analyze(A.n(), rows, columns, order);
          }
        if (!general->factorize(matrix.values))
          throw LinearSolverFailed("MUMPS: the matrix of size " +
                                   std::to_string(A.n()) + " is singular." +
                                   singular_hint);
        in_use = general.get();
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

    private:
      // Return whether the pattern is symmetric. Row by row, a row meets the
      // entries of its column in order.
      bool
      find_transposed(const std::vector<std::vector<int>> &by_rows)
      {
        transposed.resize(matrix.n_nonzeros());
        std::vector<int> next(matrix.row_start.begin(),
                              matrix.row_start.end() - 1);
        for (int i = 0; i < static_cast<int>(matrix.n()); ++i)
          {
            if (!std::equal(by_rows[i].begin(),
                            by_rows[i].end(),
                            matrix.columns.begin() + matrix.row_start[i],
                            matrix.columns.begin() + matrix.row_start[i + 1]))
              return false;
            for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
              transposed[k] = next[matrix.columns[k]]++;
          }
        return true;
      }

      bool
      is_symmetric() const
      {
        const double *a = matrix.values.data();
        for (int i = 0; i < static_cast<int>(matrix.n()); ++i)
          {
            double largest = 0, difference = 0;
            for (int k = matrix.row_start[i]; k < matrix.row_start[i + 1]; ++k)
              {
                largest = std::max(largest, std::abs(a[k]));
                difference =
                  std::max(difference, std::abs(a[k] - a[transposed[k]]));
              }
            if (!(difference <= 1e-12 * largest))
              return false;
          }
        return true;
      }

      const Ranks         ranks;
      CSRMatrix           matrix;
      std::vector<int>    transposed; // position of the transposed entry
      std::vector<int>    order, rows, columns;
      std::vector<int>    lower, lower_rows, lower_columns;
      std::vector<double> lower_values;

      std::unique_ptr<MUMPSInstance> general, positive_definite;
      MUMPSInstance                 *in_use                = nullptr;
      bool                           try_positive_definite = true;
    };
  } // namespace



  std::unique_ptr<LinearSolver::Backend>
  make_mumps_backend(const Ranks &ranks)
  {
    return std::make_unique<MUMPSBackend>(ranks);
  }
} // namespace NPT
