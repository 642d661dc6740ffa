// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the MPI processes that compute one run together.

#ifndef npt_dealii_base_ranks_h
#define npt_dealii_base_ranks_h

#include <deal.II/lac/vector.h>

#include <mpi.h>

#include <string>

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
    /// What the first one has.
    void
    broadcast(dealii::Vector<double> &x) const;
    std::string
    broadcast(const std::string &text) const;

  private:
    MPI_Comm     communicator_ = MPI_COMM_SELF;
    unsigned int n_            = 1;
    unsigned int rank_         = 0;
  };
} // namespace NPT

#endif
