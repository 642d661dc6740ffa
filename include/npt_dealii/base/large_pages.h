// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines memory in large pages.

#ifndef npt_dealii_base_large_pages_h
#define npt_dealii_base_large_pages_h

#include <sys/mman.h>

#include <cstddef>
#include <cstdlib>
#include <memory>

namespace NPT
{
  /// An array of numbers without values, in large pages where the system has
  /// them (Linux, if it lets programs ask for them): of ordinary pages, each
  /// 4 kB that are used for the first time cost a call of the system.
  template <typename Number>
  class LargePages
  {
  public:
    /// Make room for this many numbers at least, and return whether there is
    /// so much. If there was less before, what was there is lost.
    bool
    resize(const std::size_t n)
    {
      constexpr std::size_t page = std::size_t(1) << 21;
      const std::size_t bytes = (n * sizeof(Number) + page - 1) / page * page;
      if (bytes <= size)
        return true;
      numbers.reset();
      size = 0;
      numbers.reset(static_cast<Number *>(std::aligned_alloc(page, bytes)));
      if (!numbers)
        return false;
      size = bytes;
#ifdef MADV_HUGEPAGE
      // A hint: without it the pages are small.
      (void)madvise(numbers.get(), bytes, MADV_HUGEPAGE);
#endif
      return true;
    }

    Number *
    data()
    {
      return numbers.get();
    }

  private:
    struct Free
    {
      void
      operator()(Number *pointer) const
      {
        std::free(pointer);
      }
    };

    std::unique_ptr<Number[], Free> numbers;
    std::size_t                     size = 0; // in bytes
  };
} // namespace NPT

#endif
