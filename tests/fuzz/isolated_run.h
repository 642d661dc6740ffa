// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines running a part of the program in a copy of this process, which may
// crash, hang or take all memory without harm.

#ifndef npt_dealii_tests_fuzz_isolated_run_h
#define npt_dealii_tests_fuzz_isolated_run_h

#include <cstddef>
#include <functional>
#include <string>

namespace Fuzz
{
  struct Limits
  {
#ifdef NPT_SANITIZED
    unsigned int cpu_seconds  = 100;
    unsigned int wall_seconds = 600;
#else
    unsigned int cpu_seconds  = 20;
    unsigned int wall_seconds = 120;
#endif
    std::size_t more_megabytes = 1000; ///< beyond what this process has
  };

  struct RunResult
  {
    int         status = 0; ///< exit status, -1 after a signal
    int         signal = 0; ///< that ended the copy, or 0
    std::string out, err;   ///< what it wrote on the screen
    double      cpu_seconds = 0;
  };

  /// Run an action in a copy of this process, whose exit status is what the
  /// action returns.
  RunResult
  run_isolated(const std::function<int()> &action, const Limits &limits = {});
} // namespace Fuzz

#endif
