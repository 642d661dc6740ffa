// SPDX-License-Identifier: LGPL-2.1-or-later
// A front in blocks of columns, with ScaLAPACK.

#include <npt_dealii/linear_algebra/dense_kernels.h>
#include <npt_dealii/linear_algebra/shared_front.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_templates.h>

#include <algorithm>
#include <cmath>

namespace NPT
{
  namespace
  {
    template <typename Number>
    using LU = void(const int *,
                    const int *,
                    Number *,
                    const int *,
                    const int *,
                    const int *,
                    int *,
                    int *);
    template <typename Number>
    using Cholesky = void(const char *,
                          const int *,
                          Number *,
                          const int *,
                          const int *,
                          const int *,
                          int *);
    template <typename Number>
    using Solve = void(const char *,
                       const char *,
                       const char *,
                       const char *,
                       const int *,
                       const int *,
                       const Number *,
                       const Number *,
                       const int *,
                       const int *,
                       const int *,
                       Number *,
                       const int *,
                       const int *,
                       const int *);
    template <typename Number>
    using Product = void(const char *,
                         const char *,
                         const int *,
                         const int *,
                         const int *,
                         const Number *,
                         const Number *,
                         const int *,
                         const int *,
                         const int *,
                         const Number *,
                         const int *,
                         const int *,
                         const int *,
                         const Number *,
                         Number *,
                         const int *,
                         const int *,
                         const int *);
    template <typename Number>
    using Square = void(const char *,
                        const char *,
                        const int *,
                        const int *,
                        const Number *,
                        const Number *,
                        const int *,
                        const int *,
                        const int *,
                        const Number *,
                        Number *,
                        const int *,
                        const int *,
                        const int *);
  } // namespace
} // namespace NPT

extern "C"
{
  int Csys2blacs_handle(MPI_Comm);
  void
  Cblacs_gridinit(int *, const char *, int, int);
  void
  Cblacs_gridexit(int);
  void
  Cfree_blacs_system_handle(int);

  NPT::LU<double>       pdgetrf_;
  NPT::LU<float>        psgetrf_;
  NPT::Cholesky<double> pdpotrf_;
  NPT::Cholesky<float>  pspotrf_;
  NPT::Solve<double>    pdtrsm_;
  NPT::Solve<float>     pstrsm_;
  NPT::Product<double>  pdgemm_;
  NPT::Product<float>   psgemm_;
  NPT::Square<double>   pdsyrk_;
  NPT::Square<float>    pssyrk_;
}

namespace NPT
{
  using DenseKernels::one;

  namespace
  {
    template <typename Number>
    struct ScaLAPACK;

    template <>
    struct ScaLAPACK<double>
    {
      static constexpr auto getrf = &pdgetrf_;
      static constexpr auto potrf = &pdpotrf_;
      static constexpr auto trsm  = &pdtrsm_;
      static constexpr auto gemm  = &pdgemm_;
      static constexpr auto syrk  = &pdsyrk_;
    };

    template <>
    struct ScaLAPACK<float>
    {
      static constexpr auto getrf = &psgetrf_;
      static constexpr auto potrf = &pspotrf_;
      static constexpr auto trsm  = &pstrsm_;
      static constexpr auto gemm  = &psgemm_;
      static constexpr auto syrk  = &pssyrk_;
    };
  } // namespace



  ProcessRow::ProcessRow(const Ranks &ranks_of_run)
    : ranks(ranks_of_run)
    , columns{static_cast<int>(ranks.n())}
    , system_context(Csys2blacs_handle(ranks.communicator()))
    , context_(system_context)
  {
    Cblacs_gridinit(&context_, "Row", 1, ranks.n());
  }



  ProcessRow::~ProcessRow()
  {
    Cblacs_gridexit(context_);
    Cfree_blacs_system_handle(system_context);
  }



  template <typename Number>
  SharedFront<Number>::SharedFront(
    const int                                n_pivots,
    const int                                n_rows,
    const std::shared_ptr<const ProcessRow> &row_of_processes)
    : values(std::size_t(n_rows) *
             row_of_processes->columns.n_local(n_rows,
                                               row_of_processes->ranks.rank()))
    , n(n_pivots)
    , m(n_rows)
    , row(row_of_processes)
    , descriptor{1, // dense
                 row->context(),
                 m,
                 m,
                 BlockColumns::width,
                 BlockColumns::width,
                 0,
                 0,
                 m} // ScaLAPACK asks for one block more.
    , exchanges(m + BlockColumns::width)
    , change(m)
  {}



  template <typename Number>
  Number *
  SharedFront<Number>::column(const int c)
  {
    return values.data() + std::size_t(row->columns.local(c)) * m;
  }



  template <typename Number>
  bool
  SharedFront<Number>::factorize_general(const double largest_growth)
  {
    using B          = Blas<Number>;
    using S          = ScaLAPACK<Number>;
    is_symmetric     = false;
    Number    *A     = values.data();
    const int *desc  = descriptor.data();
    const int  first = n + 1, rest = m - n;
    int        info = 0;
    S::getrf(&n, &n, A, &one, &one, desc, exchanges.data(), &info);
    if (info != 0 || rest == 0)
      return info == 0;
    const int me         = row->ranks.rank();
    const int n_own      = row->columns.n_local(n, me);
    const int n_own_rest = row->columns.n_local(m, me) - n_own;
    B::laswp(&n_own_rest,
             A + std::size_t(n_own) * m,
             &m,
             &one,
             &n,
             exchanges.data(),
             &one);
    S::trsm("L",
            "L",
            "N",
            "U",
            &n,
            &rest,
            &B::plus,
            A,
            &one,
            &one,
            desc,
            A,
            &one,
            &first,
            desc);
    S::trsm("R",
            "U",
            "N",
            "N",
            &rest,
            &n,
            &B::plus,
            A,
            &one,
            &one,
            desc,
            A,
            &first,
            &one,
            desc);
    for (int c = 0; c < n_own; ++c)
      for (int r = n; r < m; ++r)
        if (!(std::abs(A[std::size_t(c) * m + r]) <= largest_growth))
          return false;
    S::gemm("N",
            "N",
            &rest,
            &rest,
            &n,
            &B::minus,
            A,
            &first,
            &one,
            desc,
            A,
            &one,
            &first,
            desc,
            &B::plus,
            A,
            &first,
            &first,
            desc);
    return true;
  }



  template <typename Number>
  bool
  SharedFront<Number>::factorize_positive_definite()
  {
    using B          = Blas<Number>;
    using S          = ScaLAPACK<Number>;
    is_symmetric     = true;
    Number    *A     = values.data();
    const int *desc  = descriptor.data();
    const int  first = n + 1, rest = m - n;
    int        info = 0;
    S::potrf("L", &n, A, &one, &one, desc, &info);
    if (info != 0 || rest == 0)
      return info == 0;
    S::trsm("R",
            "L",
            "T",
            "N",
            &rest,
            &n,
            &B::plus,
            A,
            &one,
            &one,
            desc,
            A,
            &first,
            &one,
            desc);
    S::syrk("L",
            "N",
            &rest,
            &n,
            &B::minus,
            A,
            &first,
            &one,
            desc,
            &B::plus,
            A,
            &first,
            &first,
            desc);
    return true;
  }



  template <typename Number>
  int
  SharedFront<Number>::n_blocks() const
  {
    return (n + BlockColumns::width - 1) / BlockColumns::width;
  }



  template <typename Number>
  int
  SharedFront<Number>::block_size(const int block) const
  {
    return std::min(BlockColumns::width, n - block * BlockColumns::width);
  }



  template <typename Number>
  void
  SharedFront<Number>::sum_at(const int process,
                              Number   *x,
                              const int size) const
  {
    const bool is_here =
      row->ranks.rank() == static_cast<unsigned int>(process);
    MPI_Reduce(is_here ? MPI_IN_PLACE : x,
               x,
               size,
               dealii::Utilities::MPI::mpi_type_id_for_type<Number>,
               MPI_SUM,
               process,
               row->ranks.communicator());
    if (!is_here)
      std::fill_n(x, size, Number(0));
  }



  template <typename Number>
  void
  SharedFront<Number>::broadcast(const int process,
                                 Number   *x,
                                 const int size) const
  {
    MPI_Bcast(x,
              size,
              dealii::Utilities::MPI::mpi_type_id_for_type<Number>,
              process,
              row->ranks.communicator());
  }



  template <typename Number>
  void
  SharedFront<Number>::solve_forward(Number *y)
  {
    using B = Blas<Number>;
    if (!is_symmetric)
      for (int r = 0; r < n; ++r)
        std::swap(y[r], y[exchanges[r] - 1]);
    for (int block = 0; block < n_blocks(); ++block)
      {
        const int begin = block * BlockColumns::width, size = block_size(block);
        const int process = row->columns.owner(begin);
        sum_at(process, y + begin, size);
        if (process != static_cast<int>(row->ranks.rank()))
          continue;
        const Number *const a = column(begin) + begin;
        B::trsv(
          "L", "N", is_symmetric ? "N" : "U", &size, a, &m, y + begin, &one);
        const int below = m - begin - size;
        if (below > 0)
          dealii::gemv("N",
                       &below,
                       &size,
                       &B::minus,
                       a + size,
                       &m,
                       y + begin,
                       &one,
                       &B::plus,
                       y + begin + size,
                       &one);
      }
  }



  template <typename Number>
  void
  SharedFront<Number>::solve_backward(Number *x)
  {
    using B      = Blas<Number>;
    const int me = row->ranks.rank();
    if (!is_symmetric)
      {
        const int n_own      = row->columns.n_local(n, me);
        const int n_own_rest = row->columns.n_local(m, me) - n_own;
        for (int c = n; c < m; ++c)
          if (row->columns.owner(c) == me)
            change[row->columns.local(c)] = x[c];
        if (n_own_rest > 0)
          dealii::gemv("N",
                       &n,
                       &n_own_rest,
                       &B::minus,
                       values.data() + std::size_t(n_own) * m,
                       &m,
                       change.data() + n_own,
                       &one,
                       &B::plus,
                       x,
                       &one);
      }
    for (int block = n_blocks() - 1; block >= 0; --block)
      {
        const int begin = block * BlockColumns::width, size = block_size(block);
        const int process = row->columns.owner(begin);
        if (!is_symmetric)
          sum_at(process, x + begin, size);
        if (process == me)
          {
            const Number *const top = column(begin), *const a = top + begin;
            const int below = m - begin - size;
            if (is_symmetric)
              {
                if (below > 0)
                  dealii::gemv("T",
                               &below,
                               &size,
                               &B::minus,
                               a + size,
                               &m,
                               x + begin + size,
                               &one,
                               &B::plus,
                               x + begin,
                               &one);
                B::trsv("L", "T", "N", &size, a, &m, x + begin, &one);
              }
            else
              {
                B::trsv("U", "N", "N", &size, a, &m, x + begin, &one);
                if (begin > 0)
                  dealii::gemv("N",
                               &begin,
                               &size,
                               &B::minus,
                               top,
                               &m,
                               x + begin,
                               &one,
                               &B::plus,
                               x,
                               &one);
              }
          }
        broadcast(process, x + begin, size);
      }
  }



  template class SharedFront<double>;
  template class SharedFront<float>;
} // namespace NPT
