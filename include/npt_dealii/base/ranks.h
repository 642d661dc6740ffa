// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the MPI processes that compute one run together.

#ifndef npt_dealii_base_ranks_h
#define npt_dealii_base_ranks_h

#include <deal.II/lac/vector.h>

#include <mpi.h>

#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace NPT
{
  /**
   * The MPI processes that compute one run together; by default this one alone.
   *
   * Vectors and states are the same on all of them, to the last bit: sums are
   * formed by the first one and handed out. So all take the same decisions
   * (converged? shorter step?) and throw the same exceptions without asking.
   * What is shared is the work on cells and contact nodes, the matrix, and its
   * factorization. The member functions are collective: all have to call them.
   */
  class Ranks
  {
  public:
    Ranks() = default;
    /// This process alone if MPI is not initialized.
    explicit Ranks(const MPI_Comm communicator);

    MPI_Comm
    communicator() const
    {
      return communicator_;
    }
    unsigned int
    n() const
    {
      return n_;
    }
    /// How many of them share the memory of this machine.
    unsigned int
    n_on_machine() const
    {
      return n_on_machine_;
    }
    unsigned int
    rank() const
    {
      return rank_;
    }
    /// The one that writes.
    bool
    is_first() const
    {
      return rank_ == 0;
    }
    bool
    is_alone() const
    {
      return n_ == 1;
    }
    /// Whether piece k of work is this process's, dealt out in turn.
    bool
    has(const unsigned int k) const
    {
      return k % n_ == rank_;
    }

    /// Which pieces of n_pieces in a row are this process's: from the first
    /// number to below the second one.
    std::pair<std::size_t, std::size_t>
    share_of(const std::size_t n_pieces) const
    {
      return {n_pieces * rank_ / n_, n_pieces * (rank_ + 1) / n_};
    }

    /// What the member functions have exchanged so far, copies of the object
    /// included; without what MUMPS exchanges.
    struct Traffic
    {
      unsigned long n_calls = 0; ///< collective calls of MPI
      double        bytes   = 0; ///< handed to them by each process
    };
    /// Null for a process alone.
    const Traffic *
    traffic() const
    {
      return traffic_.get();
    }

    void
    sum(dealii::Vector<double> &x) const;
    double
    sum(const double x) const;
    unsigned int
    min(const unsigned int x) const;
    /// Whether all of them say so.
    bool
    all(const bool yes) const;
    /// Whether one of them says so.
    bool
    any(const bool yes) const;
    /// What the process has whose first number is the lowest; of several with
    /// the same one, the first of them.
    std::vector<double>
    of_lowest(const std::vector<double> &numbers) const;
    /// Element k of what the process has that has(k), for all k. The elements
    /// are copied byte by byte.
    template <typename T>
    void
    exchange(std::vector<T> &elements) const
    {
      static_assert(std::is_trivially_copyable_v<T>);
      if (!is_alone())
        exchange(elements.data(), elements.size(), sizeof(T));
    }
    /// What the first one has.
    void
    broadcast(dealii::Vector<double> &x) const;
    std::string
    broadcast(const std::string &text) const;

  private:
    void
    count(const unsigned int n_calls, const std::size_t bytes) const;
    void
    exchange(void             *elements,
             const std::size_t n_elements,
             const std::size_t bytes_of_each) const;

    MPI_Comm     communicator_ = MPI_COMM_SELF;
    unsigned int n_            = 1;
    unsigned int rank_         = 0;
    unsigned int n_on_machine_ = 1;

    std::shared_ptr<Traffic> traffic_; // shared by copies
  };
} // namespace NPT

#endif
