// SPDX-License-Identifier: LGPL-2.1-or-later
// How much memory a process may still take.

#include <npt_dealii/base/available_memory.h>

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace NPT
{
  namespace
  {
    // What was given back to the C library, which keeps it for the program.
    double
    kept_gigabytes()
    {
#if defined(__GLIBC__) && __GLIBC_PREREQ(2, 33)
      return 1e-9 * static_cast<double>(mallinfo2().fordblks);
#else
      return 0.;
#endif
    }
  } // namespace



  double
  available_gigabytes()
  {
    double      result = std::numeric_limits<double>::infinity();
    std::string name;
    double      kilobytes = 0;
    for (std::ifstream in("/proc/meminfo"); in >> name >> kilobytes;
         in.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
      if (name == "MemAvailable:")
        result = 1.024e-6 * kilobytes;

    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
      {
        double pages = 0; // of the address space in use
        std::ifstream("/proc/self/statm") >> pages;
        const double left = 1e-9 * static_cast<double>(limit.rlim_cur) -
                            1e-9 * pages * sysconf(_SC_PAGESIZE);
        result = std::min(result, std::max(left, 0.));
      }
    return result + kept_gigabytes();
  }
} // namespace NPT
