// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines the choice of BLAS kernels on processors that are newer than the
// installed OpenBLAS, and the number of its threads.

#ifndef npt_dealii_linear_algebra_blas_kernels_h
#define npt_dealii_linear_algebra_blas_kernels_h

#include <string>

namespace NPT
{
  /**
   * OpenBLAS picks its kernels by a list of processor models while it is
   * loaded; on a model that it does not know it falls back to kernels of 2004
   * (without AVX), and factorizations take twice as long. If that is the case
   * and nothing was chosen by the user (OPENBLAS_CORETYPE), this function sets
   * the kernels that the processor can run and starts the program anew, which
   * is the only way before OpenBLAS is loaded. It returns if there is nothing
   * to gain. Call it before MPI is initialized.
   *
   * @param argv Arguments of the program, passed on.
   */
  void
  select_blas_kernels(char **argv);

  /**
   * Let BLAS and OpenMP have the threads that OPENBLAS_NUM_THREADS and
   * OMP_NUM_THREADS allow now. They read these variables while they are loaded,
   * which for a copy of a process, as the cases of a study are, was too early.
   */
  void
  obey_thread_limits();

  /// Both: what a program does before it computes.
  void
  prepare_blas(char **argv);

  /// Kernels in use, e.g. "SkylakeX"; empty if the BLAS is not OpenBLAS.
  std::string
  blas_kernels();
} // namespace NPT

#endif
