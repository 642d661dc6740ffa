// SPDX-License-Identifier: LGPL-2.1-or-later
// What the file npt_dealii, or verify, does before main(): it loads the two
// hundred libraries below deal.II one after the other, those that others need
// first, and then the program, which is a library itself (CMakeLists.txt,
// NPT_FAST_START). A library that is loaded so looks for its 300,000 symbols
// among those that it depends on, instead of among all; that halves the time to
// start, which is a fifth of a short run (doc/performance.md).
//
// More than half of the libraries are there because deal.II can read CAD files,
// use PETSc, and so on, which this program never asks for. For each of them the
// build folder has a link of its name to one small library
// (scripts/write_libraries.cmake), which is loaded first: the system then takes
// that name for loaded. Where the links are missing, the same call loads the
// library itself; where they are too old for a new deal.II, the program is
// started again without them.
//
// What is global is searched first by every library, so this file uses nothing
// but the C library.

#include <dlfcn.h>
#include <sys/auxv.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "libraries.h" // of the build folder: the names of all libraries

namespace
{
  // Set for the second start, without the links.
  const char *const with_all = "NPT_LOAD_ALL_LIBRARIES";



  // The C library takes its memory in large pages where the system has them
  // (Linux), and keeps what is given back: ordinary pages have to be made one
  // by one, two processes do so one after the other, and each page that is
  // taken again has to be cleared again. Of weave_25_steps that is 1 s of 19.
  // The C library has to be told before it starts; so early a second start
  // costs a millisecond.
  void
  keep_large_pages(char **argv)
  {
    const char *const name = "GLIBC_TUNABLES";
    // A privileged program is not told, however often it is started.
    if (std::getenv(name) != nullptr || getauxval(AT_SECURE) != 0)
      return;
    setenv(name,
           "glibc.malloc.hugetlb=1:glibc.malloc.mmap_max=0:"
           "glibc.malloc.trim_threshold=1000000000000000",
           1);
    execv("/proc/self/exe", argv);
    // If that failed, go on with small pages.
  }



  // A library that is not there any more is no loss: who needs another one
  // loads it. MPI comes first and is global: Open MPI loads parts of its own,
  // which look for it there, and what stands for MPI_IN_PLACE and the like in
  // Fortran is a variable that MUMPS, too, must take from it.
  void
  load_dependencies()
  {
    if (std::getenv(with_all) == nullptr)
      for (const char *const name : idle_libraries)
        dlopen(name, RTLD_LAZY | RTLD_LOCAL);
    for (const char *const name : libraries)
      if (std::strncmp(name, "libmpi.so", 9) == 0)
        dlopen(name, RTLD_LAZY | RTLD_GLOBAL);
    for (const char *const name : libraries)
      dlopen(name, RTLD_LAZY | RTLD_LOCAL);
  }
} // namespace



int
main(int argc, char **argv)
{
  keep_large_pages(argv);
  load_dependencies();
  void *const program = dlopen(program_library, RTLD_LAZY | RTLD_LOCAL);
  void *const entry   = program == nullptr ? nullptr : dlsym(program, "main");
  if (entry == nullptr)
    {
      if (std::getenv(with_all) == nullptr)
        {
          setenv(with_all, "1", 1);
          execv("/proc/self/exe", argv);
        }
      // As the system says it of libraries that it loads, with its status.
      std::fprintf(stderr,
                   "%s: error while loading shared libraries: %s. Keep this "
                   "file and %s in one folder.\n",
                   argv[0],
                   dlerror(),
                   program_library);
      return 127;
    }
  return reinterpret_cast<int (*)(int, char **)>(entry)(argc, argv);
}
