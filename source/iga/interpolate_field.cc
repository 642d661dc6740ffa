// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the transfer of a field between meshes, one direction at a time.

#include <npt_dealii/iga/interpolate_field.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace NPT
{
  using dealii::FullMatrix;
  using dealii::Tensor;
  using dealii::Vector;

  namespace
  {
    // T along one direction of a lattice of `size` points, first direction
    // fastest; `size` becomes that of the result.
    template <int dim>
    std::vector<Tensor<1, dim>>
    apply_along(const unsigned int                 direction,
                const FullMatrix<double>          &T,
                const std::vector<Tensor<1, dim>> &coefficients,
                std::array<unsigned int, dim>     &size)
    {
      AssertDimension(size[direction], T.n());
      unsigned int stride = 1, outer = 1;
      for (unsigned int d = 0; d < direction; ++d)
        stride *= size[d];
      for (unsigned int d = direction + 1; d < dim; ++d)
        outer *= size[d];
      std::vector<Tensor<1, dim>> result(stride * T.m() * outer);
      for (unsigned int o = 0; o < outer; ++o)
        for (unsigned int i = 0; i < T.m(); ++i)
          for (unsigned int j = 0; j < T.n(); ++j)
            if (T(i, j) != 0.)
              for (unsigned int s = 0; s < stride; ++s)
                result[s + stride * (i + T.m() * o)] +=
                  T(i, j) * coefficients[s + stride * (j + T.n() * o)];
      size[direction] = T.m();
      return result;
    }
  } // namespace



  template <int dim>
  Vector<double>
  interpolate_field(const IGASpace<dim>  &from,
                    const Vector<double> &u,
                    const IGASpace<dim>  &to)
  {
    AssertDimension(from.n_patches(), to.n_patches());
    Assert(from.basis() != Basis::Lagrange && to.basis() != Basis::Lagrange,
           dealii::ExcNotImplemented());
    Assert(u.size() >= dim * from.n_control_points(),
           dealii::ExcDimensionMismatch(u.size(),
                                        dim * from.n_control_points()));
    Vector<double> result(dim * to.n_control_points());
    for (unsigned int p = 0; p < from.n_patches(); ++p)
      {
        const NURBSPatch<dim>        &patch = from.patch(p);
        std::vector<Tensor<1, dim>>   coefficients(patch.n_control_points());
        std::array<unsigned int, dim> size;
        for (unsigned int l = 0; l < coefficients.size(); ++l)
          for (unsigned int i = 0; i < dim; ++i)
            coefficients[l][i] =
              patch.weights()[l] * u[dim * from.control_point(p, l) + i];
        for (unsigned int d = 0; d < dim; ++d)
          size[d] = patch.n_control_points(d);
        for (unsigned int d = 0; d < dim; ++d)
          coefficients =
            apply_along<dim>(d,
                             patch.knot_vector(d).interpolation_operator(
                               to.patch(p).knot_vector(d)),
                             coefficients,
                             size);
        for (unsigned int l = 0; l < coefficients.size(); ++l)
          for (unsigned int i = 0; i < dim; ++i)
            result[dim * to.control_point(p, l) + i] =
              coefficients[l][i] / to.patch(p).weights()[l];
      }
    return result;
  }



  template Vector<double>
  interpolate_field<2>(const IGASpace<2> &,
                       const Vector<double> &,
                       const IGASpace<2> &);
  template Vector<double>
  interpolate_field<3>(const IGASpace<3> &,
                       const Vector<double> &,
                       const IGASpace<3> &);
} // namespace NPT
