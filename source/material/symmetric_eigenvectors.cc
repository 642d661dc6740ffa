// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the eigenvectors of symmetric tensors, for every compiler.

#include <npt_dealii/material/symmetric_eigenvectors.h>

#ifdef __clang__
#  include <gsl/gsl_eigen.h>

#  include <memory>
#endif

namespace NPT
{
  using dealii::SymmetricTensor;
  using dealii::SymmetricTensorEigenvectorMethod;
  using dealii::Tensor;

#ifdef __clang__
  template <int dim>
  std::array<std::pair<double, Tensor<1, dim>>, dim>
  symmetric_eigenvectors(const SymmetricTensor<2, dim> &A,
                         const SymmetricTensorEigenvectorMethod)
  {
    double matrix[dim * dim], values[dim], vectors[dim * dim];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        matrix[i * dim + j] = A[i][j];
    auto a = gsl_matrix_view_array(matrix, dim, dim);
    auto v = gsl_matrix_view_array(vectors, dim, dim);
    auto w = gsl_vector_view_array(values, dim);
    const std::unique_ptr<gsl_eigen_symmv_workspace,
                          decltype(&gsl_eigen_symmv_free)>
      workspace(gsl_eigen_symmv_alloc(dim), &gsl_eigen_symmv_free);
    gsl_eigen_symmv(&a.matrix, &w.vector, &v.matrix, workspace.get());
    gsl_eigen_symmv_sort(&w.vector, &v.matrix, GSL_EIGEN_SORT_VAL_DESC);
    std::array<std::pair<double, Tensor<1, dim>>, dim> pairs;
    for (unsigned int k = 0; k < dim; ++k)
      {
        pairs[k].first = values[k];
        for (unsigned int i = 0; i < dim; ++i)
          pairs[k].second[i] = vectors[i * dim + k];
      }
    return pairs;
  }
#else
  template <int dim>
  std::array<std::pair<double, Tensor<1, dim>>, dim>
  symmetric_eigenvectors(const SymmetricTensor<2, dim>         &A,
                         const SymmetricTensorEigenvectorMethod method)
  {
    return dealii::eigenvectors(A, method);
  }
#endif

  template std::array<std::pair<double, Tensor<1, 2>>, 2>
  symmetric_eigenvectors<2>(const SymmetricTensor<2, 2> &,
                            const SymmetricTensorEigenvectorMethod);
  template std::array<std::pair<double, Tensor<1, 3>>, 3>
  symmetric_eigenvectors<3>(const SymmetricTensor<2, 3> &,
                            const SymmetricTensorEigenvectorMethod);
} // namespace NPT
