// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines starting and ending MPI, and what is known of mpirun before.

#ifndef npt_dealii_base_mpi_session_h
#define npt_dealii_base_mpi_session_h

#include <mpi.h>

#include <limits>

namespace NPT
{
  /**
   * What mpirun, or whatever else starts the processes of a parallel run, tells
   * each of them by its environment. It is known without MPI.
   */
  struct Launcher
  {
    bool         is_present  = false;
    unsigned int n_processes = 1; ///< 1 also if that is not told
    unsigned int rank        = 0; ///< 0 also if that is not told

    static Launcher
    of_this_process();
  };



  /**
   * MPI, from the construction of an object of this class to its destruction;
   * one at a time, and one per process unless keep_for_later() was called.
   *
   * dealii::Utilities::MPI::MPI_InitFinalize does the same and starts PETSc,
   * SLEPc, p4est and Zoltan, too, which nobody uses here. A process without a
   * launcher is also spared what Open MPI does for processes that have
   * company; variables of the environment that are set already stay as they
   * are.
   */
  class MPISession
  {
  public:
    MPISession();
    ~MPISession();

    MPISession(const MPISession &) = delete;
    MPISession &
    operator=(const MPISession &) = delete;

    unsigned int
    n_processes() const
    {
      return n_processes_;
    }
    unsigned int
    rank() const
    {
      return rank_;
    }

    /**
     * Wait at the end of all work, done or given up, until all processes are
     * here. To be called once.
     *
     * @param patience How long [s].
     * @return Whether all are here. Otherwise the others still work, and wait
     *   for this process sooner or later: only MPI_Abort ends them.
     */
    bool
    meet_at_end(
      const double patience = std::numeric_limits<double>::infinity()) const;

    /// From now on MPI goes on at the end of a session, for the next one: it
    /// can be started only once in a process, and that takes longer than to
    /// compute a small case of a study.
    static void
    keep_for_later();

    /// End MPI after the last session, if it was kept.
    static void
    end_if_kept();

  private:
    unsigned int n_processes_, rank_;
    MPI_Comm     for_the_end_; // apart from what may still be on its way
  };
} // namespace NPT

#endif
