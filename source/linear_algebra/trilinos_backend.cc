// SPDX-License-Identifier: LGPL-2.1-or-later
// The matrix of the solvers of Trilinos.

#include <npt_dealii/linear_algebra/trilinos_backend.h>

#include <algorithm>
#include <vector>

namespace NPT
{
  using dealii::Vector;

  void
  TrilinosBackend::symbolic(const CSRMatrix &A)
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
    AssertThrow(status == 0, dealii::ExcMessage("Epetra refused the matrix."));
    AssertThrow(std::equal(A.row_start.begin(), A.row_start.end(), offsets) &&
                  std::equal(A.columns.begin(), A.columns.end(), columns),
                dealii::ExcMessage(
                  "Epetra stores the entries in another order."));
    problem.SetOperator(matrix.get());
  }



  void
  TrilinosBackend::vmult(Vector<double> &y, const Vector<double> &x) const
  {
    y.reinit(x.size());
    Epetra_Vector       epetra_y(View, *map, y.begin());
    const Epetra_Vector epetra_x(View, *map, const_cast<double *>(x.begin()));
    matrix->Multiply(false, epetra_x, epetra_y);
  }



  void
  TrilinosBackend::copy_values(const CSRMatrix &A)
  {
    std::copy(A.values.begin(), A.values.end(), values);
  }
} // namespace NPT
