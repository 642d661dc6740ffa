// SPDX-License-Identifier: LGPL-2.1-or-later
// How much memory a process may still take.

#include <npt_dealii/base/available_memory.h>

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace NPT
{
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
    return result;
  }
} // namespace NPT
