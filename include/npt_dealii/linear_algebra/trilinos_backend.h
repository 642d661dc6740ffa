// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what the solvers of Trilinos share: the matrix of one process.

#ifndef npt_dealii_linear_algebra_trilinos_backend_h
#define npt_dealii_linear_algebra_trilinos_backend_h

#include <npt_dealii/linear_algebra/linear_solver_backend.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>
#include <Epetra_Map.h>
#include <Epetra_MpiComm.h>
#include <Epetra_Vector.h>

#include <iostream>
#include <memory>
#include <sstream>

namespace NPT
{
  /// Trilinos reports failures to std::cerr as well as by return values; a
  /// load step that is cut should not leave that on the screen.
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



  /// What all solvers of Trilinos share: a matrix of one process whose
  /// values are overwritten in place.
  class TrilinosBackend : public LinearSolver::Backend
  {
  public:
    void
    symbolic(const CSRMatrix &A) override;

    void
    vmult(dealii::Vector<double>       &y,
          const dealii::Vector<double> &x) const override;

  protected:
    /// Drop whatever refers to the matrix that is about to be replaced.
    virtual void
    clear_solver() = 0;

    void
    copy_values(const CSRMatrix &A);

    Epetra_MpiComm                    communicator{MPI_COMM_SELF};
    std::unique_ptr<Epetra_Map>       map;
    std::unique_ptr<Epetra_CrsMatrix> matrix;
    double                           *values = nullptr;
    Epetra_LinearProblem              problem;
  };
} // namespace NPT

#endif
