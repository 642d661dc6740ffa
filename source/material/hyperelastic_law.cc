// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines what all hyperelastic laws share: the functions on deal.II tensors.

#include <npt_dealii/material/hyperelastic_law.h>

#include <array>

namespace NPT
{
  namespace
  {
    // Copies instead of pointer casts: deal.II does not promise that a tensor
    // of tensors is one contiguous array.
    template <int dim>
    std::array<double, dim * dim>
    to_array(const dealii::Tensor<2, dim> &T)
    {
      std::array<double, dim * dim> values;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int J = 0; J < dim; ++J)
          values[i * dim + J] = T[i][J];
      return values;
    }



    template <int dim>
    void
    copy(const std::array<double, dim * dim> &values, dealii::Tensor<2, dim> &T)
    {
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int J = 0; J < dim; ++J)
          T[i][J] = values[i * dim + J];
    }
  } // namespace



  template <int dim>
  double
  HyperelasticLaw<dim>::energy(const dealii::Tensor<2, dim> &F) const
  {
    return energy(to_array(F).data());
  }



  template <int dim>
  void
  HyperelasticLaw<dim>::stress(const dealii::Tensor<2, dim> &F,
                               dealii::Tensor<2, dim>       &P) const
  {
    std::array<double, dim * dim> P_values;
    stress(to_array(F).data(), P_values.data());
    copy(P_values, P);
  }



  template <int dim>
  void
  HyperelasticLaw<dim>::stress_and_tangent(const dealii::Tensor<2, dim> &F,
                                           dealii::Tensor<2, dim>       &P,
                                           dealii::Tensor<4, dim> &dP_dF) const
  {
    std::array<double, dim * dim>             P_values;
    std::array<double, dim * dim * dim * dim> A;
    stress_and_tangent(to_array(F).data(), P_values.data(), A.data());
    copy(P_values, P);

    const double *value = A.data();
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int J = 0; J < dim; ++J)
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int L = 0; L < dim; ++L)
            dP_dF[i][J][k][L] = *value++;
  }



  template <int dim>
  dealii::FullMatrix<double>
  HyperelasticLaw<dim>::small_strain_stiffness() const
  {
    dealii::Tensor<2, dim> one, P;
    dealii::Tensor<4, dim> A;
    for (unsigned int i = 0; i < dim; ++i)
      one[i][i] = 1.;
    stress_and_tangent(one, P, A);

    constexpr unsigned int    n              = (dim == 2 ? 3 : 6);
    static const unsigned int index_2d[3][2] = {{0, 0}, {1, 1}, {0, 1}};
    static const unsigned int index_3d[6][2] = {
      {0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
    const auto &index = [&]() -> const auto &
    {
      if constexpr (dim == 2)
        return index_2d;
      else
        return index_3d;
    }
    ();

    dealii::FullMatrix<double> C(n, n);
    for (unsigned int p = 0; p < n; ++p)
      for (unsigned int q = 0; q < n; ++q)
        C(p, q) = A[index[p][0]][index[p][1]][index[q][0]][index[q][1]];
    return C;
  }



  template class HyperelasticLaw<2>;
  template class HyperelasticLaw<3>;
} // namespace NPT
