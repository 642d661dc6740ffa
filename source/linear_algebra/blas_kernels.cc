// SPDX-License-Identifier: LGPL-2.1-or-later
// Choice of OpenBLAS kernels and threads.

#include <npt_dealii/linear_algebra/blas_kernels.h>

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>
#include <utility>

namespace NPT
{
  std::string
  blas_kernels()
  {
    // Looked up by name: the program must also run with another BLAS.
    using Function = char *(*)();
    const auto function =
      reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
    return function == nullptr ? "" : function();
  }



  void
  select_blas_kernels(char **argv)
  {
#if defined(__x86_64__) && defined(__GNUC__)
    if (std::getenv("OPENBLAS_CORETYPE") != nullptr ||
        blas_kernels() != "Prescott" || !__builtin_cpu_supports("avx2"))
      return;
    // Measured on an AVX-512 machine: both choices cost the same within noise;
    // the AVX2 kernels run on all processors of the last ten years.
    setenv("OPENBLAS_CORETYPE", "HASWELL", 1);
    execv("/proc/self/exe", argv);
    // If that failed, go on with slow kernels.
#else
    (void)argv;
#endif
  }



  void
  obey_thread_limits()
  {
    using Function = void (*)(int);
    for (const auto &[variable, setter] :
         {std::pair("OMP_NUM_THREADS", "omp_set_num_threads"),
          std::pair("OPENBLAS_NUM_THREADS", "openblas_set_num_threads")})
      {
        const char *const text = std::getenv(variable);
        const int         n    = text == nullptr ? 0 : std::atoi(text);
        const auto        set =
          reinterpret_cast<Function>(dlsym(RTLD_DEFAULT, setter));
        if (n > 0 && set != nullptr)
          set(n);
      }
  }



  void
  prepare_blas(char **argv)
  {
    select_blas_kernels(argv);
    obey_thread_limits();
  }
} // namespace NPT
