// SPDX-License-Identifier: LGPL-2.1-or-later
// Owns the solvers behind LinearSolver: MUMPS, UMFPACK, GMRES with ILU or ML.

#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/solver/linear_solver.h>

#include <deal.II/base/config.h>

#include <Amesos.h>
#include <Amesos_BaseSolver.h>
#include <Amesos_Mumps.h>
#include <AztecOO.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>
#include <Ifpack_ILU.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>
#ifdef DEAL_II_WITH_METIS
#  include <metis.h>
#endif
#include <umfpack.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iostream>
#include <iterator>
#include <sstream>
#include <utility>

namespace NPT
{
  using dealii::Vector;

  // A solution worse than this after refinement means a matrix that is
  // singular to working precision: Newton directions from it are noise.
  constexpr double unusable_residual = 1e-6;
  // Above this one step of refinement is worth its solve.
  constexpr double refine_above = 1e-12;
  // See amplification(). Measured on elastic boxes of 432 to 15,360 unknowns:
  // free 1e15 to 3e15, on a foundation of 1e-6 times their stiffness 2e6, on
  // one of 1 to 1e6 times their stiffness below 50.
  constexpr double singular_amplification = 1e13;

  namespace
  {
    const std::string singular_hint =
      " Often a body that nothing holds: no contact yet, a missing support, or "
      "a macro unknown without stiffness.";

    double
    now()
    {
      return std::chrono::duration<double>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
    }

    // Trilinos reports failures to std::cerr as well as by return values; a
    // load step that is cut should not leave that on the screen.
    class SilencedErrorStream
    {
    public:
      SilencedErrorStream()
        : original(std::cerr.rdbuf(text.rdbuf()))
      {}

      ~SilencedErrorStream()
      {
        std::cerr.rdbuf(original);
      }

    private:
      std::ostringstream text;
      std::streambuf    *original;
    };

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



    /**
     * Return how strongly solving with A magnifies a rough right-hand side,
     * and the unknown that moves most.
     *
     * @f[ \max_i \frac{(|A| |x|)_i}{s_i}, \quad A x = b, \quad b_i = \pm s_i,
     *     \quad s_i = \sum_j |A_{ij}| @f]
     *
     * A lower bound of a condition number that does not change when equations
     * are scaled (macro unknowns have other units than displacements; scaling
     * of unknowns does change it). A
     * factorization in floating point passes over most singular matrices
     * without a word (pivots are 1e-13 instead of zero), and the residual of a
     * consistent system stays small, but then Newton's correction contains
     * rigid motions of arbitrary size. Costs one solve and one product: the
     * solve is 4 % of a factorization at 1,452 unknowns, 2 % at 15,360. MUMPS'
     * own detection of null pivots (ICNTL(24)) was tried instead: of the six of
     * a free body it finds none with a threshold of 1e-14 and three with 1e-13.
     */
    std::pair<double, unsigned int>
    amplification(const CSRMatrix &A, LinearSolver::Backend &backend);

    bool
    is_finite(const Vector<double> &x)
    {
      // Sums of NaN and infinities do not become finite again.
      double sum = 0;
      for (const double value : x)
        sum += std::abs(value);
      return std::isfinite(sum);
    }
  } // namespace



  class LinearSolver::Backend
  {
  public:
    virtual ~Backend() = default;

    /// Everything that depends on the pattern only.
    virtual void
    symbolic(const CSRMatrix &A) = 0;

    virtual void
    numeric(const CSRMatrix &A) = 0;

    virtual void
    solve(const Vector<double> &rhs, Vector<double> &x) = 0;

    /// y = A x with the values of the last numeric().
    virtual void
    vmult(Vector<double> &y, const Vector<double> &x) const = 0;

    bool                        is_direct    = true;
    unsigned int                n_iterations = 0; ///< of the last solve()
    std::vector<Vector<double>> near_null_space;
    unsigned int                n_components = 1;
  };



  namespace
  {
    std::pair<double, unsigned int>
    amplification(const CSRMatrix &A, LinearSolver::Backend &backend)
    {
      const unsigned int n = A.n();
      Vector<double>     s(n), b(n), x(n);
      unsigned int       random = 1;
      for (unsigned int i = 0; i < n; ++i)
        {
          for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
            s[i] += std::abs(A.values[k]);
          random = 1664525 * random + 1013904223; // same on every machine
          b[i]   = (random >> 16) % 2 ? s[i] : -s[i];
        }
      backend.solve(b, x);

      double       largest = 0;
      unsigned int unknown = 0;
      for (unsigned int i = 0; i < n; ++i)
        {
          double sum = 0;
          for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
            sum += std::abs(A.values[k] * x[A.columns[k]]);
          // Written so that NaN counts as largest.
          if (!(sum <= largest * s[i]))
            largest = sum / s[i];
          if (std::abs(x[i]) > std::abs(x[unknown]))
            unknown = i;
        }
      return {largest, unknown};
    }



    /// UMFPACK, called directly because deal.II's class redoes the symbolic
    /// factorization every time.
    class BackendUMFPACK : public LinearSolver::Backend
    {
    public:
      BackendUMFPACK()
      {
        umfpack_di_defaults(control);
        // Refinement is done by LinearSolver, the same for all direct solvers.
        control[UMFPACK_IRSTEP] = 0;
      }

      ~BackendUMFPACK() override
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
          throw LinearSolverFailed(
            "UMFPACK ran out of memory in the " + phase +
            ". Try Type = MUMPS or ILU (subsection Linear solver).");
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



    /// What all solvers of Trilinos share: a matrix of one process whose
    /// values are overwritten in place.
    class BackendTrilinos : public LinearSolver::Backend
    {
    public:
      void
      symbolic(const CSRMatrix &A) override
      {
        const int n = A.n();
        clear_solver();
        matrix.reset();
        map = std::make_unique<Epetra_Map>(n, 0, communicator);

        std::vector<int> row_lengths(n);
        for (int i = 0; i < n; ++i)
          row_lengths[i] = A.row_start[i + 1] - A.row_start[i];
        // The map as column map keeps Epetra from numbering the columns anew.
        matrix = std::make_unique<Epetra_CrsMatrix>(
          Copy, *map, *map, row_lengths.data(), true);
        int status = 0;
        for (int i = 0; i < n; ++i)
          status |= matrix->InsertMyValues(i,
                                           row_lengths[i],
                                           A.values.data() + A.row_start[i],
                                           A.columns.data() + A.row_start[i]);
        status |= matrix->FillComplete(*map, *map);
        status |= matrix->OptimizeStorage();

        int *offsets = nullptr;
        int *columns = nullptr;
        status |= matrix->ExtractCrsDataPointers(offsets, columns, values);
        AssertThrow(status == 0,
                    dealii::ExcMessage("Epetra refused the matrix."));
        AssertThrow(
          std::equal(A.row_start.begin(), A.row_start.end(), offsets) &&
            std::equal(A.columns.begin(), A.columns.end(), columns),
          dealii::ExcMessage("Epetra stores the entries in another order."));
        problem.SetOperator(matrix.get());
      }

      void
      vmult(Vector<double> &y, const Vector<double> &x) const override
      {
        y.reinit(x.size());
        Epetra_Vector       epetra_y(View, *map, y.begin());
        const Epetra_Vector epetra_x(View,
                                     *map,
                                     const_cast<double *>(x.begin()));
        matrix->Multiply(false, epetra_x, epetra_y);
      }

    protected:
      /// Drop whatever refers to the matrix that is about to be replaced.
      virtual void
      clear_solver() = 0;

      void
      copy_values(const CSRMatrix &A)
      {
        std::copy(A.values.begin(), A.values.end(), values);
      }

      Epetra_MpiComm                    communicator{MPI_COMM_SELF};
      std::unique_ptr<Epetra_Map>       map;
      std::unique_ptr<Epetra_CrsMatrix> matrix;
      double                           *values = nullptr;
      Epetra_LinearProblem              problem;
    };



    class BackendMUMPS : public BackendTrilinos
    {
    public:
      void
      symbolic(const CSRMatrix &A) override
      {
        BackendTrilinos::symbolic(A);
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
          throw LinearSolverFailed(
            "MUMPS ran out of memory in the " + phase +
            " (INFOG(1) = " + std::to_string(infog[0]) +
            "). Try Type = ILU (subsection Linear solver).");
        if (infog[0] < 0 || status < 0)
          throw LinearSolverFailed(
            "MUMPS stopped in the " + phase + " with INFOG(1:2) = " +
            std::to_string(infog[0]) + ", " + std::to_string(infog[1]) + ".");
      }

      std::unique_ptr<Amesos_BaseSolver> solver;
      std::vector<int>                   ordering;
      int                                extra_memory = 35; // per cent
    };



    /// GMRES; derived classes provide the preconditioner.
    class BackendGMRES : public BackendTrilinos
    {
    public:
      explicit BackendGMRES(const LinearSolverParameters &given)
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
            detail << "GMRES with " << parameters.type
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



    class BackendILU : public BackendGMRES
    {
    public:
      using BackendGMRES::BackendGMRES;

      void
      symbolic(const CSRMatrix &A) override
      {
        BackendTrilinos::symbolic(A);
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



    class BackendML : public BackendGMRES
    {
    public:
      using BackendGMRES::BackendGMRES;

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



  void
  LinearSolverParameters::declare_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Linear solver");
    {
      prm.declare_entry(
        "Type",
        "MUMPS",
        dealii::Patterns::Selection("MUMPS|UMFPACK|ILU|ML"),
        "Direct: MUMPS, UMFPACK. Iterative: GMRES with an incomplete "
        "factorization (ILU) or smoothed aggregation (ML); of the two ILU is "
        "the better one with contact.");
      prm.declare_entry("Tolerance",
                        "1e-10",
                        dealii::Patterns::Double(1e-15, 1e-1),
                        "ILU, ML: residual over right-hand side at which the "
                        "iteration stops [-]. Direct solvers ignore it.");
      prm.declare_entry("Maximum iterations",
                        "500",
                        dealii::Patterns::Integer(1, 100000),
                        "ILU, ML: GMRES iterations after which the load step "
                        "counts as failed [-].");
    }
    prm.leave_subsection();
  }



  void
  LinearSolverParameters::parse_parameters(dealii::ParameterHandler &prm)
  {
    prm.enter_subsection("Linear solver");
    {
      type           = prm.get("Type");
      tolerance      = prm.get_double("Tolerance");
      max_iterations = prm.get_integer("Maximum iterations");
    }
    prm.leave_subsection();
  }



  LinearSolver::LinearSolver(const LinearSolverParameters &given)
    : parameters(given)
  {
    if (parameters.type == "MUMPS")
      backend = std::make_unique<BackendMUMPS>();
    else if (parameters.type == "UMFPACK")
      backend = std::make_unique<BackendUMFPACK>();
    else if (parameters.type == "ILU")
      backend = std::make_unique<BackendILU>(parameters);
    else if (parameters.type == "ML")
      backend = std::make_unique<BackendML>(parameters);
    else
      throw InputError("Type is " + parameters.type +
                       "; it must be MUMPS, UMFPACK, ILU or ML (subsection "
                       "Linear solver).");
  }



  LinearSolver::~LinearSolver() = default;



  void
  LinearSolver::factorize(const CSRMatrix &A)
  {
    const double start = now();
    usable             = false;
    n_unknowns         = A.n();
    if (A.pattern_id() != pattern_id)
      {
        // Stays zero if the set-up throws, so that it is not taken for done.
        pattern_id = 0;
        backend->symbolic(A);
        ++n_symbolic_;
        pattern_id = A.pattern_id();
      }
    backend->numeric(A);
    ++n_numeric_;
    if (backend->is_direct)
      {
        const auto [factor, unknown] = amplification(A, *backend);
        if (!(factor < singular_amplification))
          {
            std::ostringstream detail;
            detail << parameters.type << ": the matrix of size " << A.n()
                   << " is singular to working precision (condition at least "
                   << factor << "); unknown " << unknown << " moves most."
                   << singular_hint;
            throw LinearSolverFailed(detail.str());
          }
      }
    usable = true;
    seconds_factorize_ += now() - start;
  }



  void
  LinearSolver::solve(const Vector<double> &rhs, Vector<double> &x)
  {
    AssertThrow(usable,
                dealii::ExcMessage("solve() needs a successful factorize()."));
    AssertDimension(rhs.size(), n_unknowns);
    Assert(&rhs != &x, dealii::ExcMessage("rhs and x must differ."));
    const double start = now();

    if (!is_finite(rhs))
      throw LinearSolverFailed(parameters.type +
                               ": the right-hand side is not finite.");
    x.reinit(n_unknowns);
    backend->solve(rhs, x);
    ++n_solves_;
    if (!is_finite(x))
      throw LinearSolverFailed(parameters.type +
                               ": the solution is not finite." + singular_hint);

    Vector<double> residual(n_unknowns);
    const double   rhs_norm     = rhs.l2_norm();
    const auto     set_residual = [&](const Vector<double> &solution) {
      backend->vmult(residual, solution);
      residual.sadd(-1., 1., rhs);
      return rhs_norm > 0 ? residual.l2_norm() / rhs_norm : 0.;
    };
    relative_residual_ = set_residual(x);
    if (backend->is_direct)
      {
        if (relative_residual_ > refine_above)
          {
            Vector<double> refined(n_unknowns);
            backend->solve(residual, refined);
            ++n_iterations_;
            refined += x;
            const double refined_residual = set_residual(refined);
            if (refined_residual < relative_residual_)
              {
                relative_residual_ = refined_residual;
                x.swap(refined);
              }
          }
      }
    else
      n_iterations_ += backend->n_iterations;
    seconds_solve_ += now() - start;

    if (backend->is_direct && !(relative_residual_ <= unusable_residual))
      {
        std::ostringstream detail;
        detail << parameters.type
               << ": the solution leaves a relative residual of "
               << relative_residual_
               << "; the matrix is singular to working precision."
               << singular_hint;
        throw LinearSolverFailed(detail.str());
      }
  }



  void
  LinearSolver::set_near_null_space(std::vector<Vector<double>> modes,
                                    const unsigned int          n_components)
  {
    Assert(n_components > 0, dealii::ExcZero());
    backend->near_null_space = std::move(modes);
    backend->n_components    = n_components;
  }



  unsigned int
  LinearSolver::n_symbolic() const
  {
    return n_symbolic_;
  }



  unsigned int
  LinearSolver::n_numeric() const
  {
    return n_numeric_;
  }



  unsigned int
  LinearSolver::n_solves() const
  {
    return n_solves_;
  }



  unsigned int
  LinearSolver::n_iterations() const
  {
    return n_iterations_;
  }



  double
  LinearSolver::relative_residual() const
  {
    return relative_residual_;
  }



  double
  LinearSolver::seconds_factorize() const
  {
    return seconds_factorize_;
  }



  double
  LinearSolver::seconds_solve() const
  {
    return seconds_solve_;
  }



  double
  LinearSolver::seconds() const
  {
    return seconds_factorize_ + seconds_solve_;
  }
} // namespace NPT
