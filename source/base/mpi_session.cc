// SPDX-License-Identifier: LGPL-2.1-or-later
// Start and end of MPI.

#include <npt_dealii/base/mpi_session.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

namespace NPT
{
  Launcher
  Launcher::of_this_process()
  {
    const auto number = [](const char *name, const unsigned int otherwise) {
      const char *const text = std::getenv(name);
      return text == nullptr ?
               otherwise :
               static_cast<unsigned int>(std::strtoul(text, nullptr, 10));
    };
    // mpirun of Open MPI; MPICH, Intel MPI and srun; MVAPICH.
    for (const auto &[size, rank] :
         {std::pair("OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"),
          std::pair("PMI_SIZE", "PMI_RANK"),
          std::pair("MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK")})
      if (std::getenv(size) != nullptr && std::getenv(rank) != nullptr)
        return {true, number(size, 1), number(rank, 0)};
    // Launchers that do not tell the size: srun with PMIx, old MPICH.
    for (const char *name : {"PMIX_RANK", "PMI_RANK", "PMI_ID", "PMI_FD"})
      if (std::getenv(name) != nullptr)
        return {true, 1, number("PMIX_RANK", number("PMI_RANK", 0))};
    return {};
  }



  namespace
  {
    bool keep_running = false;

    /*
     * Measured with Open MPI 4.1: MPI_Init costs 0.05 s of CPU time and 0.4 s
     * of waiting; these settings leave half of the first, under a third of the
     * second.
     */
    void
    do_without_company()
    {
      for (const auto &[name, value] :
           {// Else it starts a helper process, orted, which would be there if
            // this process wanted to start others by MPI.
            std::pair("OMPI_MCA_ess_singleton_isolated", "1"),
            // All processes without orted have one folder in /tmp, which each
            // of them removes at its end. One that starts just then fails; of
            // runs side by side one of a hundred did.
            std::pair("OMPI_MCA_orte_create_session_dirs", "0"),
            // No search for a network: messages to itself at most.
            std::pair("OMPI_MCA_pml", "ob1"),
            std::pair("OMPI_MCA_btl", "self"),
            // No search for devices: hwloc reads all of PCI and asks for X
            // servers, to learn where processes are best placed.
            std::pair("HWLOC_COMPONENTS", "no_os,stop")})
        setenv(name, value, 0);
    }



    bool
    is_on_one_machine()
    {
      const char *const all  = std::getenv("OMPI_COMM_WORLD_SIZE");
      const char *const here = std::getenv("OMPI_COMM_WORLD_LOCAL_SIZE");
      return all != nullptr && here != nullptr && std::string(all) == here;
    }



    /*
     * What searches for networks of clusters is not loaded: 0.2 s of the
     * 0.9 s that mpirun and two processes take for a cell of 3 x 3 elements
     * (Open MPI 4.1). Processes of one machine use its memory.
     */
    void
    do_without_network()
    {
      setenv("OMPI_MCA_pml", "^ucx,cm", 0);
    }
  } // namespace



  MPISession::MPISession()
  {
    if (!dealii::Utilities::MPI::job_supports_mpi())
      {
        if (!Launcher::of_this_process().is_present)
          do_without_company();
        else if (is_on_one_machine())
          do_without_network();
        // Where there is no /sys, as in some containers, hwloc would say so on
        // the screen of every run.
        setenv("HWLOC_HIDE_ERRORS", "2", 0);
        MPI_Init(nullptr, nullptr);
      }
    n_processes_ = dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    rank_        = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    MPI_Comm_dup(MPI_COMM_WORLD, &for_the_end_);
  }



  MPISession::~MPISession()
  {
    MPI_Comm_free(&for_the_end_);
    if (!keep_running)
      MPI_Finalize();
  }



  void
  MPISession::keep_for_later()
  {
    keep_running = true;
  }



  void
  MPISession::end_if_kept()
  {
    if (keep_running && dealii::Utilities::MPI::job_supports_mpi())
      MPI_Finalize();
  }



  bool
  MPISession::meet_at_end(const double patience) const
  {
    using Clock = std::chrono::steady_clock;
    if (n_processes_ == 1)
      return true;
    // Asked for now and then, so that a waiting process leaves its core to one
    // that draws pictures.
    const auto  start = Clock::now();
    MPI_Request request;
    MPI_Ibarrier(for_the_end_, &request);
    for (int all_here = 0;;)
      {
        MPI_Test(&request, &all_here, MPI_STATUS_IGNORE);
        if (all_here != 0)
          return true;
        if (std::chrono::duration<double>(Clock::now() - start).count() >
            patience)
          return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
  }
} // namespace NPT
