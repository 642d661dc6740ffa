// SPDX-License-Identifier: LGPL-2.1-or-later
// The MPI processes of one run.

#include <npt_dealii/base/ranks.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace NPT
{
  Ranks::Ranks(const MPI_Comm communicator)
  {
    if (!dealii::Utilities::MPI::job_supports_mpi())
      return;
    communicator_ = communicator;
    n_            = dealii::Utilities::MPI::n_mpi_processes(communicator);
    rank_         = dealii::Utilities::MPI::this_mpi_process(communicator);
    if (is_alone())
      return;
    traffic_ = std::make_shared<Traffic>();
    MPI_Comm machine;
    MPI_Comm_split_type(
      communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    n_on_machine_ = dealii::Utilities::MPI::n_mpi_processes(machine);
    MPI_Comm_free(&machine);
  }



  namespace
  {
    // MPI_Allreduce may add in another order on each process.
    void
    sum_of_first(double         *x,
                 const int       size,
                 const bool      is_first,
                 const MPI_Comm &communicator)
    {
      MPI_Reduce(is_first ? MPI_IN_PLACE : x,
                 x,
                 size,
                 MPI_DOUBLE,
                 MPI_SUM,
                 0,
                 communicator);
      MPI_Bcast(x, size, MPI_DOUBLE, 0, communicator);
    }
  } // namespace



  void
  Ranks::count(const unsigned int n_calls, const std::size_t bytes) const
  {
    traffic_->n_calls += n_calls;
    traffic_->bytes += bytes;
  }



  void
  Ranks::sum(dealii::Vector<double> &x) const
  {
    if (is_alone())
      return;
    count(2, 2 * sizeof(double) * x.size());
    sum_of_first(x.begin(), x.size(), is_first(), communicator_);
  }



  double
  Ranks::sum(const double x) const
  {
    double result = x;
    if (is_alone())
      return result;
    count(2, 2 * sizeof(double));
    sum_of_first(&result, 1, is_first(), communicator_);
    return result;
  }



  unsigned int
  Ranks::min(const unsigned int x) const
  {
    if (is_alone())
      return x;
    count(1, sizeof(x));
    return dealii::Utilities::MPI::min(x, communicator_);
  }



  bool
  Ranks::all(const bool yes) const
  {
    return min(yes ? 1u : 0u) == 1;
  }



  bool
  Ranks::any(const bool yes) const
  {
    return !all(!yes);
  }



  std::vector<double>
  Ranks::of_lowest(const std::vector<double> &numbers) const
  {
    if (is_alone())
      return numbers;
    count(1, sizeof(double) * numbers.size());
    const auto all = dealii::Utilities::MPI::all_gather(communicator_, numbers);
    unsigned int lowest = 0;
    for (unsigned int p = 1; p < all.size(); ++p)
      if (all[p][0] < all[lowest][0])
        lowest = p;
    return all[lowest];
  }



  void
  Ranks::exchange(void             *elements,
                  const std::size_t n_elements,
                  const std::size_t bytes_of_each) const
  {
    char *const bytes = static_cast<char *>(elements);
    // In the order of processes, as they come in.
    std::vector<int> sizes(n_, 0), offsets(n_ + 1, 0);
    for (unsigned int p = 0; p < n_; ++p)
      {
        if (n_elements > p)
          sizes[p] = ((n_elements - 1 - p) / n_ + 1) * bytes_of_each;
        offsets[p + 1] = offsets[p] + sizes[p];
      }
    std::vector<char> own, all(offsets[n_]);
    own.reserve(sizes[rank_]);
    for (std::size_t k = rank_; k < n_elements; k += n_)
      own.insert(own.end(),
                 bytes + k * bytes_of_each,
                 bytes + (k + 1) * bytes_of_each);
    count(1, own.size());
    MPI_Allgatherv(own.data(),
                   sizes[rank_],
                   MPI_BYTE,
                   all.data(),
                   sizes.data(),
                   offsets.data(),
                   MPI_BYTE,
                   communicator_);
    for (std::size_t k = 0; k < n_elements; ++k)
      {
        int &next = offsets[k % n_];
        std::copy_n(all.data() + next,
                    bytes_of_each,
                    bytes + k * bytes_of_each);
        next += bytes_of_each;
      }
  }



  void
  Ranks::broadcast(dealii::Vector<double> &x) const
  {
    if (is_alone())
      return;
    count(1, sizeof(double) * x.size());
    MPI_Bcast(x.begin(), x.size(), MPI_DOUBLE, 0, communicator_);
  }



  std::string
  Ranks::broadcast(const std::string &text) const
  {
    if (is_alone())
      return text;
    unsigned int size = text.size();
    count(2, sizeof(size) + size);
    MPI_Bcast(&size, 1, MPI_UNSIGNED, 0, communicator_);
    std::string result = is_first() ? text : std::string(size, ' ');
    MPI_Bcast(result.data(), size, MPI_CHAR, 0, communicator_);
    return result;
  }
} // namespace NPT
