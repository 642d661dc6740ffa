// SPDX-License-Identifier: LGPL-2.1-or-later
// MUMPS: analysis, factorization, solution.

#include <npt_dealii/base/available_memory.h>
#include <npt_dealii/base/exceptions.h>
#include <npt_dealii/linear_algebra/mumps_factors.h>

#include <deal.II/base/config.h>

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <sstream>
#include <type_traits>

namespace NPT
{
  using dealii::Vector;

  namespace
  {
    template <typename Number>
    constexpr bool is_single = std::is_same_v<Number, float>;

    /// The exponent of the largest absolute value, 2^exponent <= value. Zero
    /// where that is not a number, or zero.
    template <typename Iterator>
    int
    exponent_of_largest(const Iterator begin, const Iterator end)
    {
      double largest = 0;
      for (Iterator value = begin; value != end; ++value)
        largest = std::max(largest, std::abs(*value));
      // 2^1074 is beyond the numbers.
      return std::isfinite(largest) && largest > 0 ?
               std::max(std::ilogb(largest), -1000) :
               0;
    }



    /// The largest of the exponents of all processes.
    int
    max(const int exponent, const Ranks &ranks)
    {
      constexpr int above_all = 10000;
      return above_all - static_cast<int>(ranks.min(above_all - exponent));
    }
  } // namespace



  template <typename Number>
  MUMPSInstance<Number>::MUMPSInstance(const Kind   kind_of_matrix,
                                       const double maximum_gigabytes,
                                       const Ranks &ranks_of_run)
    : kind(kind_of_matrix)
    , maximum_memory(maximum_gigabytes)
    , ranks(ranks_of_run)
    // Without pivoting the analysis knows the memory.
    , extra_memory(kind == Kind::positive_definite && ranks.is_alone() ? 5 : 35)
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



  template <typename Number>
  MUMPSInstance<Number>::~MUMPSInstance()
  {
    if (ranks.is_alone() || std::uncaught_exceptions() == 0)
      call(-2);
  }



  // visit(row, position) for the entries that MUMPS reads.
  template <typename Number>
  template <typename Visitor>
  void
  MUMPSInstance<Number>::for_each_entry(const CSRMatrix &A,
                                        const Visitor   &visit) const
  {
    const bool lower_only = kind == Kind::positive_definite;
    for (int i = 0; i < static_cast<int>(A.n()); ++i)
      for (int k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        if (!lower_only || A.columns[k] <= i)
          visit(i, k);
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::set_indices(const CSRMatrix &A)
  {
    std::size_t n_entries = 0;
    for_each_entry(A, [&](const int, const int) { ++n_entries; });
    rows.reserve(n_entries);
    columns.reserve(n_entries);
    for_each_entry(A, [&](const int row, const int at) {
      rows.push_back(row + 1);
      columns.push_back(A.columns[at] + 1);
    });
    data.n = A.n();
    if (ranks.is_alone())
      {
        data.nnz = n_entries;
        data.irn = rows.data();
        data.jcn = columns.data();
      }
    else
      {
        data.nnz_loc = n_entries;
        data.irn_loc = rows.data();
        data.jcn_loc = columns.data();
      }
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::analyze(const CSRMatrix &A, std::vector<int> &order)
  {
    set_indices(A);
#ifdef DEAL_II_WITH_METIS
    control(7) = 1;
    if (ranks.is_first())
      data.perm_in = order.data();
#else
    (void)order;
#endif
    analyze();
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::set_values(const CSRMatrix &A)
  {
    Number *first = nullptr;
    if constexpr (!is_single<Number>)
      if (kind == Kind::general)
        first = const_cast<double *>(A.values.data()); // is only read
    if (first == nullptr)
      {
        if (is_single<Number>)
          exponent =
            max(exponent_of_largest(A.values.begin(), A.values.end()), ranks);
        const double factor = std::ldexp(1., -exponent);
        values.resize(rows.size());
        std::size_t k = 0;
        for_each_entry(A, [&](const int, const int at) {
          values[k++] = factor * A.values[at];
        });
        first = values.data();
      }
    (ranks.is_alone() ? data.a : data.a_loc) = first;
  }



  template <typename Number>
  bool
  MUMPSInstance<Number>::factorize(const CSRMatrix &A)
  {
    set_values(A);
    // Pivoting may need more memory than the analysis foresaw (-8, -9, -11);
    // then more is granted once and for all.
    for (;;)
      {
        call(2);
        const int error = data.infog[0];
        if ((error == -8 || error == -9 || error == -11) && extra_memory < 1000)
          {
            extra_memory *= 3;
            analyze();
          }
        else
          break;
      }
    // Nothing but the factors is needed from here on.
    values = std::vector<Number>();
    if (data.infog[0] == -10)
      return false;
    check("factorization");
    return kind == Kind::general || data.infog[11] == 0;
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::solve(const Vector<double> &b, Vector<double> &x)
  {
    x = b;
    if constexpr (is_single<Number>)
      {
        const int    size   = exponent_of_largest(b.begin(), b.end());
        const double factor = std::ldexp(1., -size);
        solution.resize(b.size());
        for (unsigned int i = 0; i < b.size(); ++i)
          solution[i] = factor * b[i];
        data.rhs = solution.data();
        call(3);
        check("solution");
        // 2^-exponent alone may be beyond the range of numbers.
        for (unsigned int i = 0; i < b.size(); ++i)
          x[i] = std::ldexp(static_cast<double>(solution[i]), size - exponent);
      }
    else
      {
        data.rhs = x.begin();
        call(3);
        check("solution");
      }
    ranks.broadcast(x);
  }



  template <typename Number>
  double
  MUMPSInstance<Number>::gigabytes() const
  {
    return 1e-3 * data.infog[is_on_disk ? 26 : 16];
  }



  template <typename Number>
  bool
  MUMPSInstance<Number>::are_on_disk() const
  {
    return is_on_disk;
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::analyze()
  {
    control(14) = extra_memory;
    call(1);
    check("analysis");
    // Asked before MUMPS takes it: a machine that has promised more than it
    // has ends processes.
    const double available =
      maximum_memory > 0 ? maximum_memory : available_gigabytes();
    const auto fits = [&](const int megabytes) {
      return ranks.all(ranks.n_on_machine() * 1e-3 * megabytes <= available);
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
    provide_workspace();
  }



  // The array of fronts and factors. MUMPS would ask the system for it at every
  // factorization, and get pages that have to be made first.
  template <typename Number>
  void
  MUMPSInstance<Number>::provide_workspace()
  {
    constexpr std::int64_t one_million = 1000000;
    data.wk_user                       = nullptr;
    data.lwk_user                      = 0;
    if (is_on_disk)
      return;
    // Both numbers are in millions where they are negative.
    std::int64_t n_entries = data.info[7];
    if (n_entries < 0)
      n_entries *= -one_million;
    const std::int64_t n_millions =
      n_entries * (100 + extra_memory) / 100 / one_million + 1;
    if (!ranks.all(workspace.resize(n_millions * one_million)))
      throw OutOfMemory("The system has no memory for the factors of MUMPS.");
    data.wk_user  = workspace.data();
    data.lwk_user = -n_millions;
  }



  template <typename Number>
  int &
  MUMPSInstance<Number>::control(const int number)
  {
    return data.icntl[number - 1];
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::call(const int job)
  {
    data.job = job;
    MUMPSLibrary<Number>::function(&data);
  }



  template <typename Number>
  void
  MUMPSInstance<Number>::check(const std::string &phase) const
  {
    const int error = data.infog[0];
    if (error == -90)
      throw OutOfMemory("MUMPS cannot keep its factors on the disk in the " +
                        phase +
                        ": is the folder $MUMPS_OOC_TMPDIR, else "
                        "/tmp, full or not there?");
    if (error == -5 || error == -7 || error == -8 || error == -9 ||
        error == -13 || error == -19 || error == -20)
      throw OutOfMemory("MUMPS ran out of memory in the " + phase +
                        " (INFOG(1) = " + std::to_string(error) + ").");
    if (error < 0)
      throw LinearSolverFailed("MUMPS stopped in the " + phase +
                               " with INFOG(1:2) = " + std::to_string(error) +
                               ", " + std::to_string(data.infog[1]) + ".");
  }



  template class MUMPSInstance<double>;
  template class MUMPSInstance<float>;
} // namespace NPT
