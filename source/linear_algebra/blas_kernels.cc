// SPDX-License-Identifier: LGPL-2.1-or-later
// Choice of OpenBLAS kernels.

#include <npt_dealii/linear_algebra/blas_kernels.h>

#include <dlfcn.h>
#include <unistd.h>

#include <cstdlib>

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
} // namespace NPT
