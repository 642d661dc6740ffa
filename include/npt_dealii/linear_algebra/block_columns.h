// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how columns of a matrix are dealt out to processes in blocks.

#ifndef npt_dealii_linear_algebra_block_columns_h
#define npt_dealii_linear_algebra_block_columns_h

namespace NPT
{
  /// Blocks in turn, as ScaLAPACK has them in a row of processes.
  struct BlockColumns
  {
    /// The fastest one of 32, 64 and 128 for 1,850 columns on two processes.
    static constexpr int width = 64;

    int n_processes = 1;

    int
    owner(const int column) const
    {
      return column / width % n_processes;
    }
    /// Number of an own column among the own ones.
    int
    local(const int column) const
    {
      return column / (width * n_processes) * width + column % width;
    }
    int
    n_local(const int n_columns, const int process) const
    {
      const int n_whole = n_columns / width, rest = n_columns % width;
      return (n_whole / n_processes + (process < n_whole % n_processes)) *
               width +
             (process == n_whole % n_processes ? rest : 0);
    }
  };
} // namespace NPT

#endif
