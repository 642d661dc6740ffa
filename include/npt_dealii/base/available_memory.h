// SPDX-License-Identifier: LGPL-2.1-or-later
// Defines how much memory a process may still take.

#ifndef npt_dealii_base_available_memory_h
#define npt_dealii_base_available_memory_h

namespace NPT
{
  /// Memory that this process may still take [GB, 1e9 bytes]: what the machine
  /// has left, or less if the process is limited (`ulimit -v`). Infinite if
  /// the system does not say.
  double
  available_gigabytes();
} // namespace NPT

#endif
