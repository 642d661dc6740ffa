// SPDX-License-Identifier: LGPL-2.1-or-later
// The copy of this process: its limits, its screen, its end.

#include "isolated_run.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>

namespace Fuzz
{
  namespace
  {
    // A file without a name that receives a screen.
    class Screen
    {
    public:
      Screen()
        : file_(memfd_create("screen", MFD_CLOEXEC))
      {
        if (file_ < 0)
          throw std::runtime_error("memfd_create failed");
      }

      ~Screen()
      {
        close(file_);
      }

      int
      file() const
      {
        return file_;
      }

      std::string
      text() const
      {
        std::string             result;
        std::array<char, 65536> part;
        lseek(file_, 0, SEEK_SET);
        for (ssize_t n = 0; (n = read(file_, part.data(), part.size())) > 0;)
          result.append(part.data(), n);
        return result;
      }

    private:
      const int file_;
    };

    std::size_t
    megabytes_of_this_process()
    {
      std::ifstream in("/proc/self/statm");
      std::size_t   pages = 0;
      in >> pages;
      return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) >> 20;
    }

    void
    set_limit(const int resource, const rlim_t value)
    {
      rlimit limit{};
      limit.rlim_cur = limit.rlim_max = value;
      setrlimit(resource, &limit);
    }
  } // namespace



  RunResult
  run_isolated(const std::function<int()> &action, const Limits &limits)
  {
    const Screen out, err;
    const rlim_t memory =
      static_cast<rlim_t>(megabytes_of_this_process() + limits.more_megabytes)
      << 20;
    std::cout.flush();
    std::fflush(nullptr);
    const pid_t pid = fork();
    if (pid < 0)
      throw std::runtime_error("fork failed");
    if (pid == 0)
      {
        dup2(out.file(), 1);
        dup2(err.file(), 2);
        set_limit(RLIMIT_CORE, 0);
        set_limit(RLIMIT_CPU, limits.cpu_seconds);
#ifdef NPT_SANITIZED
        // The shadow of the memory alone has terabytes of addresses.
        static_cast<void>(memory);
#else
        set_limit(RLIMIT_AS, memory);
#endif
        alarm(limits.wall_seconds);
        const int status = action();
        std::cout.flush();
        std::fflush(nullptr);
        _exit(status);
      }
    int    status = 0;
    rusage usage{};
    wait4(pid, &status, 0, &usage);
    RunResult result;
    result.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    result.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    result.out    = out.text();
    result.err    = err.text();
    result.cpu_seconds =
      usage.ru_utime.tv_sec + usage.ru_stime.tv_sec +
      1e-6 * (usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    return result;
  }
} // namespace Fuzz
