// SPDX-License-Identifier: LGPL-2.1-or-later
// Declares the functions of BLAS and LAPACK that deal.II does not wrap.

#ifndef npt_dealii_linear_algebra_dense_kernels_h
#define npt_dealii_linear_algebra_dense_kernels_h

namespace NPT
{
  namespace DenseKernels
  {
    /// For steps between numbers and first rows, which are passed by address.
    constexpr int one = 1;

    /// Exchange rows: n, a, stride, first, last, with which, step.
    template <typename Number>
    using Exchange = void(const int *,
                          Number *,
                          const int *,
                          const int *,
                          const int *,
                          const int *,
                          const int *);
    /// Side, triangle, transposed, unit diagonal, rows, columns, factor, a,
    /// stride, b, stride.
    template <typename Number>
    using SolveMatrix = void(const char *,
                             const char *,
                             const char *,
                             const char *,
                             const int *,
                             const int *,
                             const Number *,
                             const Number *,
                             const int *,
                             Number *,
                             const int *);
    /// Triangle, transposed, unit diagonal, n, a, stride, x, step.
    template <typename Number>
    using SolveVector = void(const char *,
                             const char *,
                             const char *,
                             const int *,
                             const Number *,
                             const int *,
                             Number *,
                             const int *);
  } // namespace DenseKernels
} // namespace NPT

extern "C"
{
  NPT::DenseKernels::Exchange<double>    dlaswp_;
  NPT::DenseKernels::Exchange<float>     slaswp_;
  NPT::DenseKernels::SolveMatrix<double> dtrsm_;
  NPT::DenseKernels::SolveMatrix<float>  strsm_;
  NPT::DenseKernels::SolveVector<double> dtrsv_;
  NPT::DenseKernels::SolveVector<float>  strsv_;
}

namespace NPT
{
  /// Of one precision, with the numbers that they take as factors.
  template <typename Number>
  struct Blas;

  template <>
  struct Blas<double>
  {
    static constexpr double plus = 1, minus = -1, zero = 0;

    static constexpr auto laswp = &dlaswp_;
    static constexpr auto trsm  = &dtrsm_;
    static constexpr auto trsv  = &dtrsv_;
  };

  template <>
  struct Blas<float>
  {
    static constexpr float plus = 1, minus = -1, zero = 0;

    static constexpr auto laswp = &slaswp_;
    static constexpr auto trsm  = &strsm_;
    static constexpr auto trsv  = &strsv_;
  };
} // namespace NPT

#endif
